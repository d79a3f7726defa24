//! Needles: hulls of points next to one line, whose triangles are slivers.

use feeler::{Polytope, Ray, RayCast, RayHit};
use glam::DVec3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

fn unit(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

/// Hulls of 6 to 25 points that stray from a line by 1e-18 to 1e-6 m.
fn needles() -> Vec<Polytope> {
    let mut rng = ChaCha8Rng::seed_from_u64(31);
    let along = DVec3::new(1.0, 2.0, 3.0);
    let mut needles = Vec::new();
    while needles.len() < 100 {
        let points: Vec<DVec3> = (0..6 + needles.len() % 20)
            .map(|_| {
                let stray = 10_f64.powf(-18.0 + 12.0 * unit(&mut rng));
                let aside = DVec3::from_array(std::array::from_fn(|_| 2.0 * unit(&mut rng) - 1.0));
                unit(&mut rng) * along + stray * aside
            })
            .collect();
        // Some are too thin for a body.
        needles.extend(Polytope::from_points(points));
    }
    needles
}

#[test]
fn every_face_of_a_needle_holds_its_corners() {
    for needle in needles() {
        for face in needle.faces() {
            for &corner in face.vertices {
                let depth = face.offset - face.normal.dot(needle.vertices()[corner as usize]);
                assert!(
                    depth.abs() < 1e-14,
                    "{depth:e} below {face:?} of {needle:?}"
                );
            }
        }
    }
}

#[test]
fn a_needle_is_made_again_of_its_own_triangles() {
    for needle in needles() {
        let again = Polytope::from_triangles(
            needle.vertices().iter().copied(),
            needle.triangles().iter().copied(),
        );
        assert_eq!(
            again.map(|again| again.faces().len()),
            Ok(needle.faces().len())
        );
    }
}

#[test]
fn a_needle_holds_its_middle_and_nothing_far_away() {
    let mut rng = ChaCha8Rng::seed_from_u64(32);
    for needle in needles() {
        let vertices = needle.vertices();
        let middle = vertices.iter().sum::<DVec3>() / vertices.len() as f64;
        let deep = needle
            .faces()
            .map(|face| face.offset - face.normal.dot(middle));
        let is_inside = deep.fold(f64::INFINITY, f64::min) > 1e-13;
        for _ in 0..100 {
            let aside = DVec3::from_array(std::array::from_fn(|_| 2.0 * unit(&mut rng) - 1.0));
            assert!(!needle.contains_point(middle + 3.0 * aside.normalize()));
            let ray = Ray::new(middle, aside);
            if is_inside {
                assert_eq!(
                    needle.first_hit(&ray),
                    Some(RayHit::Inside),
                    "{needle:?} {ray:?}"
                );
            }
        }
    }
}
