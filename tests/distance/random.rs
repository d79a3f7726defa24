//! Random pairs against the oracle.

use crate::case::*;
use feeler::Pose;
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// Runs `count` random pairs of each two kinds, made apart by `make` and brought to gaps from
/// 1e-12 to 10 of their size.
fn every_pair(seed: u64, count: u32, make: impl Fn(&mut ChaCha8Rng, usize, usize) -> Case) {
    let count = cases(count);
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    for (kind_a, name_a) in LABELS.iter().enumerate() {
        for (kind_b, name_b) in LABELS.iter().enumerate() {
            let mut apart = 0;
            for index in 0..count {
                let case = make(&mut rng, kind_a, kind_b);
                let gap = case.size() * log_uniform(&mut rng, 1e-12, 10.0);
                let case = case.with_gap(gap);
                let label = format!("{name_a} {name_b} {index}");
                let found = case.check(&label);
                if let Some(found) = found {
                    let off = (found.distance - gap).abs();
                    assert!(
                        off <= 2.0 * case.exact(),
                        "{label}: planted {gap:e}, off by {off:e}"
                    );
                    apart += 1;
                }
            }
            assert!(
                apart > count / 2,
                "{name_a} {name_b}: lopsided, {apart} of {count} apart"
            );
        }
    }
}

#[test]
fn random_pairs_of_like_size() {
    every_pair(1, 60, |rng, kind_a, kind_b| {
        let a = shape(rng, kind_a, 1.0, DVec3::ONE);
        let b = shape(rng, kind_b, 1.0, DVec3::ONE);
        placed(rng, a, b, DVec3::ZERO)
    });
}

#[test]
fn random_pairs_of_any_scale() {
    every_pair(2, 40, |rng, kind_a, kind_b| {
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
    every_pair(3, 60, |rng, kind_a, kind_b| {
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
        placed(rng, a, b, DVec3::ZERO)
    });
}

#[test]
fn random_pairs_not_turned() {
    // Edges and faces are parallel.
    every_pair(4, 40, |rng, kind_a, kind_b| {
        let a = shape(rng, kind_a, 1.0, DVec3::ONE);
        let b = shape(rng, kind_b, 1.0, DVec3::ONE);
        let mut case = placed(rng, a, b, DVec3::ZERO);
        case.pose_a = Pose::at(5.0 * (1.5 * direction(rng)).round());
        if case.pose_a.position == DVec3::ZERO {
            case.pose_a.position = DVec3::new(0.0, -5.0, 0.0);
        }
        case.pose_b.orientation = DQuat::IDENTITY;
        case
    });
}

#[test]
fn random_pairs_ten_kilometres_from_the_origin() {
    every_pair(5, 30, |rng, kind_a, kind_b| {
        let a = shape(rng, kind_a, 1.0, DVec3::ONE);
        let b = shape(rng, kind_b, 1.0, DVec3::ONE);
        let around = 1e4 * direction(rng);
        placed(rng, a, b, around)
    });
}

#[test]
fn random_pairs_turned_by_a_hair() {
    // Nearly parallel faces and edges.
    every_pair(6, 40, |rng, kind_a, kind_b| {
        let a = shape(rng, kind_a, 1.0, DVec3::ONE);
        let b = shape(rng, kind_b, 1.0, DVec3::ONE);
        let hair = DQuat::from_axis_angle(direction(rng), log_uniform(rng, 1e-16, 1e-3));
        let mut case = placed(rng, a, b, DVec3::ZERO);
        case.pose_a.orientation = (case.pose_b.orientation * hair).normalize();
        if unit_float(rng) < 0.5 {
            // Face to face.
            let axis = case.pose_b.orientation * DVec3::AXES[(3.0 * unit_float(rng)) as usize];
            case.pose_a.position = case.pose_b.position + 4.0 * axis;
        }
        case
    });
}

#[test]
fn one_shape_beside_itself() {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    for (kind, name) in LABELS.iter().enumerate() {
        for index in 0..cases(60) {
            let a = shape(&mut rng, kind, 1.0, DVec3::ONE);
            let pose = Pose::new(vector(&mut rng), turn(&mut rng));
            let case = Case {
                a: a.clone(),
                pose_a: Pose::new(pose.position + 4.0 * direction(&mut rng), pose.orientation),
                b: a,
                pose_b: pose,
            };
            let gap = log_uniform(&mut rng, 1e-12, 10.0);
            let found = case
                .with_gap(gap)
                .check(&format!("{name} beside itself {index}"));
            assert!(found.is_some());
        }
    }
}

#[test]
fn hulls_of_many_points() {
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    for index in 0..cases(12) {
        let stretch = DVec3::new(1.0, log_uniform(&mut rng, 0.01, 1.0), 1.0);
        let count = [4, 30, 100][index as usize % 3];
        let a = hull(&mut rng, count, 1.0, DVec3::ONE);
        let b = hull(&mut rng, 60, 0.5, stretch);
        let case = placed(&mut rng, a, b, DVec3::ZERO);
        let gap = log_uniform(&mut rng, 1e-12, 10.0);
        assert!(
            case.with_gap(gap)
                .check(&format!("hulls {index}"))
                .is_some()
        );
    }
}

#[test]
fn hulls_far_from_their_own_origin() {
    let mut rng = ChaCha8Rng::seed_from_u64(9);
    for index in 0..cases(60) {
        let away = log_uniform(&mut rng, 1.0, 1e6) * direction(&mut rng);
        let points: Vec<DVec3> = (0..12).map(|_| away + direction(&mut rng)).collect();
        let a = feeler::Polytope::from_points(points).unwrap().into();
        let b = shape(&mut rng, index as usize % 4, 1.0, DVec3::ONE);
        let case = placed(&mut rng, a, b, DVec3::ZERO);
        // What the oracle turns around the far origin is rounded as far as that.
        let gap = log_uniform(&mut rng, 1e-8, 10.0);
        let label = format!("far hull {index}, {away}");
        assert!(case.with_gap(gap).check(&label).is_some(), "{label}");
    }
}
