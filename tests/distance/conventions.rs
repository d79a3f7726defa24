//! Touch, ties, and the ends of the domain.

use crate::case::*;
use feeler::narrow_phase::distance::closest_points;
use feeler::{Cuboid, Pose, Shape, Sphere, Triangle, overlap};
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

#[test]
fn what_overlaps_has_no_closest_points_and_what_is_apart_does_not_overlap() {
    let mut rng = ChaCha8Rng::seed_from_u64(20);
    for kind_a in 0..KINDS {
        for kind_b in 0..KINDS {
            let mut apart = 0;
            for _ in 0..cases(200) {
                let a = shape(&mut rng, kind_a, 1.0, DVec3::ONE);
                let b = shape(&mut rng, kind_b, 1.0, DVec3::ONE);
                let mut case = placed(&mut rng, a, b, DVec3::ZERO);
                case.pose_a.position *= unit_float(&mut rng);
                let found = case.closest();
                let overlap = overlap(&case.a, &case.pose_a, &case.b, &case.pose_b);
                if let Some(overlap) = overlap {
                    assert!(found.is_none(), "{overlap:?} {found:?}");
                } else {
                    let found = found.unwrap();
                    let moved = case.moved(-(found.distance + 1e-9) * found.normal);
                    // The rims of triangles may slip past.
                    assert!(moved.closest().is_none() || kind_a == 2 || kind_b == 2);
                    apart += 1;
                }
            }
            assert!((10..cases(200)).contains(&apart), "lopsided: {apart}");
        }
    }
}

#[test]
fn touching_and_concentric_bodies_have_none() {
    let cube = Shape::from(Cuboid::new([0.5; 3]).unwrap());
    let ball = Shape::from(Sphere::new(0.5).unwrap());
    let triangle: Shape = Triangle::new([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
        .unwrap()
        .into();
    for (a, b) in [
        (&cube, &cube),
        (&cube, &ball),
        (&ball, &ball),
        (&ball, &cube),
    ] {
        for place in [DVec3::ZERO, DVec3::X, -DVec3::Z, 0.3 * DVec3::Y] {
            assert!(closest_points(a, &Pose::at(place), b, &Pose::IDENTITY).is_none());
        }
    }
    // Face, edge and corner against each other.
    for place in [[1.0, 0.4, 0.0], [1.0, 1.0, 0.2], [-1.0, 1.0, -1.0]] {
        assert!(closest_points(&cube, &Pose::at(place), &cube, &Pose::IDENTITY).is_none());
    }
    for place in [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(0.25, 0.25, 0.0)] {
        assert!(closest_points(&triangle, &Pose::at(place), &triangle, &Pose::IDENTITY).is_none());
    }
}

#[test]
fn distances_do_not_depend_on_where_the_pair_stands() {
    let mut rng = ChaCha8Rng::seed_from_u64(21);
    for index in 0..cases(200) {
        let (kind_a, kind_b) = (index as usize % 4, index as usize / 4 % 4);
        let a = shape(&mut rng, kind_a, 1.0, DVec3::ONE);
        let b = shape(&mut rng, kind_b, 1.0, DVec3::ONE);
        let mut case = placed(&mut rng, a, b, DVec3::ZERO);
        // Few enough bits that sums with whole kilometres are exact.
        case.pose_a.position = (case.pose_a.position * 1e6).round() * 2_f64.powi(-20);
        let Some(found) = case.closest() else {
            continue;
        };
        for away in [
            DVec3::X,
            DVec3::new(-1024.0, 4096.0, 1e6),
            DVec3::splat(10_000.0),
        ] {
            let mut moved = case.moved(away);
            moved.pose_b.position += away;
            assert_eq!(moved.closest().unwrap(), found);
        }
    }
}

#[test]
fn no_input_makes_nan() {
    let cube = Shape::from(Cuboid::new([0.5; 3]).unwrap());
    let ball = Shape::from(Sphere::new(1e-9).unwrap());
    let numbers = [
        0.0,
        1e-300,
        1e12,
        1e80,
        1e160,
        1e300,
        f64::MAX,
        f64::INFINITY,
        f64::NAN,
    ];
    for x in numbers {
        for y in numbers {
            for (a, b) in [(&cube, &cube), (&ball, &cube), (&ball, &ball)] {
                for turn in [DQuat::IDENTITY, DQuat::from_xyzw(x, y, 0.0, 1.0)] {
                    let pose = Pose::new([x, -y, 0.5], turn);
                    if let Some(found) = closest_points(a, &pose, b, &Pose::IDENTITY) {
                        assert!(found.distance > 0.0 && found.distance.is_finite());
                        assert!(found.normal.is_finite() && found.point_a.is_finite());
                        assert!(found.point_b.is_finite());
                    }
                }
            }
        }
    }
}
