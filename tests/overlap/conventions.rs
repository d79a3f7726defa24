//! Touch, ties, and the ends of the domain.

use crate::case::*;
use feeler::{Cuboid, Feature, Pose, Shape, Sphere, Triangle, overlap};
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

#[test]
fn triangles_in_one_plane_only_touch() {
    let triangle = Shape::from(Triangle::new([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]).unwrap());
    let mut rng = ChaCha8Rng::seed_from_u64(10);
    for _ in 0..200 {
        let common = turn(&mut rng);
        let spin = DQuat::from_rotation_z(unit_float(&mut rng));
        let shift = DVec3::new(0.2 * signed(&mut rng), 0.2 * signed(&mut rng), 0.0);
        let at = Pose::new(common * shift, (common * spin).normalize());
        let found = overlap(&triangle, &at, &triangle, &Pose::new(DVec3::ZERO, common));
        assert!(found.is_none(), "{found:?}");
    }
}

#[test]
fn a_triangle_through_a_box_takes_the_shortest_way() {
    let plate =
        Shape::from(Triangle::new([-9.0, -9.0, 0.0], [9.0, -9.0, 0.0], [0.0, 9.0, 0.0]).unwrap());
    let cube = Shape::from(Cuboid::new([1.0, 1.0, 1.0]).unwrap());
    let found = overlap(&plate, &Pose::at([0.0, 0.0, 0.25]), &cube, &Pose::IDENTITY).unwrap();
    assert!((found.depth - 0.75).abs() < 1e-15 && found.direction.distance(DVec3::Z) < 1e-15);
    assert_eq!(
        (found.feature_a, found.feature_b),
        (Feature::Face(1), Feature::Face(5))
    );
    assert!(
        found.point.distance(DVec3::new(0.0, 0.0, 0.625)) < 1e-14,
        "{found:?}"
    );
}

#[test]
fn ties_break_the_same_way_each_time() {
    let ball = Shape::from(Sphere::new(1.0).unwrap());
    let cube = Shape::from(Cuboid::new([1.0, 1.0, 1.0]).unwrap());
    for shape in [&ball, &cube] {
        let found = overlap(shape, &Pose::IDENTITY, shape, &Pose::IDENTITY).unwrap();
        assert_eq!((found.depth, found.direction), (2.0, DVec3::X));
    }
    let found = overlap(&ball, &Pose::IDENTITY, &cube, &Pose::IDENTITY).unwrap();
    assert_eq!((found.depth, found.direction), (2.0, DVec3::X));
    let swapped = overlap(&cube, &Pose::IDENTITY, &ball, &Pose::IDENTITY).unwrap();
    assert_eq!((swapped.depth, swapped.direction), (2.0, DVec3::NEG_X));
}

#[test]
fn the_largest_and_smallest_shapes_give_finite_answers() {
    let mut rng = ChaCha8Rng::seed_from_u64(11);
    let sizes = [2e-9, 1e-6, 1.0, 1e6, 4e8];
    for kind_a in 0..KINDS {
        for kind_b in 0..KINDS {
            for (size_a, size_b) in sizes.iter().flat_map(|a| sizes.map(|b| (*a, b))) {
                // Hulls of a nanometre are no hulls.
                let size = |kind, size: f64| if kind == 3 { size.max(1e-6) } else { size };
                let a = shape(&mut rng, kind_a, size(kind_a, size_a), DVec3::ONE);
                let b = shape(&mut rng, kind_b, size(kind_b, size_b), DVec3::ONE);
                for around in [DVec3::ZERO, DVec3::splat(1e12)] {
                    let mut case = placed(&mut rng, a.clone(), b.clone(), around);
                    for _ in 0..2 {
                        if let Some(found) = case.overlap() {
                            assert!(found.depth > 0.0 && found.depth <= 2.0 * case.size());
                            assert!((found.direction.length() - 1.0).abs() < 1e-14);
                            assert!(found.point.is_finite(), "{found:?}");
                        }
                        case.pose_a.position = around;
                    }
                    // From one centre a solid pair always overlaps, where f64 can tell.
                    if kind_a != 2 && kind_b != 2 && kind_a + kind_b < 3 && around == DVec3::ZERO {
                        assert!(
                            case.overlap().is_some(),
                            "{kind_a} {kind_b} {size_a} {size_b}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn poses_that_are_not_finite_overlap_nothing() {
    let ball = Shape::from(Sphere::new(1.0).unwrap());
    let cube = Shape::from(Cuboid::new([1.0; 3]).unwrap());
    for wrong in [f64::NAN, f64::INFINITY] {
        for pose in [
            Pose::at([wrong, 0.0, 0.0]),
            Pose::new([0.0; 3], DQuat::from_xyzw(0.0, wrong, 0.0, 1.0)),
        ] {
            for a in [&ball, &cube] {
                for b in [&ball, &cube] {
                    assert!(overlap(a, &pose, b, &Pose::IDENTITY).is_none());
                    assert!(overlap(a, &Pose::IDENTITY, b, &pose).is_none());
                }
            }
        }
    }
}
