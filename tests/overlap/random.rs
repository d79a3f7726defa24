//! Random pairs against the oracle.

use crate::case::*;
use feeler::Pose;
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// Runs `count` random pairs of each two kinds, made by `make`; guards that both
/// outcomes come up.
fn every_pair(seed: u64, count: u32, make: impl Fn(&mut ChaCha8Rng, usize, usize) -> Case) {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    for (kind_a, name_a) in LABELS.iter().enumerate() {
        for (kind_b, name_b) in LABELS.iter().enumerate() {
            let mut hits = 0;
            for index in 0..count {
                let case = make(&mut rng, kind_a, kind_b);
                let label = format!("{name_a} {name_b} {index}");
                hits += u32::from(case.check(&label));
            }
            assert!(
                (count / 40..count).contains(&hits),
                "{name_a} {name_b}: lopsided, {hits} of {count} overlap"
            );
        }
    }
}

#[test]
fn random_pairs_of_like_size() {
    every_pair(1, 150, |rng, kind_a, kind_b| {
        let a = shape(rng, kind_a, 1.0, DVec3::ONE);
        let b = shape(rng, kind_b, 1.0, DVec3::ONE);
        placed(rng, a, b, DVec3::ZERO)
    });
}

#[test]
fn random_pairs_of_any_scale() {
    every_pair(2, 60, |rng, kind_a, kind_b| {
        let scale = log_uniform(rng, 1e-3, 1e3);
        let other = scale * log_uniform(rng, 0.03, 30.0);
        let a = shape(rng, kind_a, scale, DVec3::ONE);
        let b = shape(rng, kind_b, other, DVec3::ONE);
        let around = scale * vector(rng);
        placed(rng, a, b, around)
    });
}

#[test]
fn random_slabs_and_needles() {
    every_pair(3, 80, |rng, kind_a, kind_b| {
        let stretch = |rng: &mut ChaCha8Rng| {
            if unit_float(rng) < 0.6 {
                DVec3::new(1.0, 0.01, 1.0)
            } else {
                DVec3::new(0.01, 0.01, 1.0)
            }
        };
        let (stretch_a, stretch_b) = (stretch(rng), stretch(rng));
        let a = shape(rng, kind_a, 1.0, stretch_a);
        let b = shape(rng, kind_b, 1.0, stretch_b);
        let mut case = placed(rng, a, b, DVec3::ZERO);
        case.pose_a.position *= unit_float(rng);
        case
    });
}

#[test]
fn random_pairs_not_turned() {
    // Edges and faces are parallel: every crossing of arcs is a degenerate one.
    every_pair(4, 60, |rng, kind_a, kind_b| Case {
        a: shape(rng, kind_a, 1.0, DVec3::ONE),
        pose_a: Pose::at((2.0 * vector(rng)).round() * 0.5),
        b: shape(rng, kind_b, 1.0, DVec3::ONE),
        pose_b: Pose::at((2.0 * vector(rng)).round() * 0.5),
    });
}

#[test]
fn random_pairs_ten_kilometres_from_the_origin() {
    every_pair(5, 40, |rng, kind_a, kind_b| {
        let a = shape(rng, kind_a, 1.0, DVec3::ONE);
        let b = shape(rng, kind_b, 1.0, DVec3::ONE);
        let around = 1e4 * direction(rng);
        placed(rng, a, b, around)
    });
}

#[test]
fn random_pairs_turned_by_a_hair() {
    // Nearly parallel faces and edges.
    every_pair(6, 60, |rng, kind_a, kind_b| {
        let a = shape(rng, kind_a, 1.0, DVec3::ONE);
        let b = shape(rng, kind_b, 1.0, DVec3::ONE);
        let hair = DQuat::from_axis_angle(direction(rng), log_uniform(rng, 1e-16, 1e-3));
        let mut case = placed(rng, a, b, DVec3::ZERO);
        case.pose_a.orientation = (case.pose_b.orientation * hair).normalize();
        case
    });
}

#[test]
fn one_shape_on_itself_and_nearly_so() {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    for (kind, name) in LABELS.iter().enumerate() {
        for index in 0..60 {
            let a = shape(&mut rng, kind, 1.0, DVec3::ONE);
            let pose = Pose::new(vector(&mut rng), turn(&mut rng));
            let nudge = log_uniform(&mut rng, 1e-16, 1e-2) * direction(&mut rng);
            let hair =
                DQuat::from_axis_angle(direction(&mut rng), log_uniform(&mut rng, 1e-16, 1e-2));
            let poses = [
                pose,
                Pose::new(pose.position + nudge, pose.orientation),
                Pose::new(pose.position, (pose.orientation * hair).normalize()),
            ];
            for pose_b in poses {
                let case = Case {
                    a: a.clone(),
                    pose_a: pose,
                    b: a.clone(),
                    pose_b,
                };
                let hit = case.check(&format!("{name} on itself {index}"));
                assert!(hit || kind == 2, "{name} does not overlap itself");
            }
        }
    }
}

#[test]
fn hulls_of_forty_points() {
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    for index in 0..4 {
        let case = Case {
            a: hull(&mut rng, 40, 1.0, DVec3::ONE),
            pose_a: Pose::new(0.4 * vector(&mut rng), turn(&mut rng)),
            b: hull(&mut rng, 40, 0.5, DVec3::new(1.0, 0.3, 1.0)),
            pose_b: Pose::new(0.4 * vector(&mut rng), turn(&mut rng)),
        };
        assert!(case.check(&format!("hulls of 40 points {index}")));
    }
}
