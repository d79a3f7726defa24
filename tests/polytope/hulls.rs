//! Hulls of points.

use crate::checks::{assert_sound, size, vertex_set};
use crate::points::{Source, cube, cylinder};
use feeler::{Polytope, ShapeError};
use glam::DVec3;

#[test]
fn a_cube_with_points_on_its_faces_and_edges_is_a_cube() {
    let mut points = cube();
    for i in -1..=1 {
        for j in -1..=1 {
            for k in -1..=1 {
                points.push(DVec3::new(f64::from(i), f64::from(j), f64::from(k)));
            }
        }
    }
    let hull = Polytope::from_points(points).unwrap();
    assert_sound(&hull, 0.0);
    assert_eq!(hull.vertices(), cube());
    assert_eq!((hull.face_normals().len(), hull.edges().len()), (6, 12));
    assert_eq!(hull.centre(), DVec3::ZERO);
    assert!((hull.max_dist() - 3.0_f64.sqrt()).abs() < 1e-14);
}

#[test]
fn turned_and_shifted_cubes_and_cylinders_keep_their_faces() {
    let mut source = Source::new(1);
    for round in 0..300 {
        let turn = source.rotation();
        let shift = source.in_cube() * [0.0, 1.0, 1e3, 1e6][round % 4];
        let scale = 10_f64.powf(2.0 * source.signed());
        let place = |p: &DVec3| turn * (*p * scale) + shift;
        let n = 3 + source.below(60) as u32;
        for (points, faces) in [(cube(), 6), (cylinder(n), n as usize + 2)] {
            let points: Vec<DVec3> = points.iter().map(place).collect();
            let hull = Polytope::from_points(points.iter().copied()).unwrap();
            assert_sound(&hull, 64.0 * f64::EPSILON * size(&points));
            assert_eq!(hull.vertices().len(), points.len());
            assert_eq!(hull.face_normals().len(), faces, "round {round} n {n}");
        }
    }
}

#[test]
fn points_on_a_sphere_are_all_vertices() {
    let mut source = Source::new(2);
    for n in [4, 5, 12, 100, 1000] {
        let points: Vec<DVec3> = (0..n).map(|_| source.on_sphere()).collect();
        let hull = Polytope::from_points(points.iter().copied()).unwrap();
        assert_sound(&hull, 1e-14);
        assert_eq!(vertex_set(hull.vertices()), vertex_set(&points));
    }
}

#[test]
fn what_has_no_volume_is_refused() {
    let flat = |points: Vec<DVec3>| match Polytope::from_points(points) {
        Err(ShapeError::Flat { dimensions, .. }) => dimensions,
        other => panic!("{other:?}"),
    };
    let line = |i: i32| DVec3::new(1.0, 2.0, 3.0) * f64::from(i);
    let plane = |i: i32| DVec3::new(f64::from(i % 3), f64::from(i / 3), 1.0);
    assert_eq!(flat(vec![DVec3::ONE; 10]), 0);
    assert_eq!(flat((0..10).map(line).collect()), 1);
    assert_eq!(flat((0..9).map(plane).collect()), 2);
    let three = Polytope::from_points([DVec3::ZERO, DVec3::X, DVec3::Y]);
    assert_eq!(three, Err(ShapeError::TooFewPoints { count: 3, min: 4 }));
    for bad in [f64::NAN, f64::INFINITY, 1.1e9] {
        let mut points = cube();
        points[3].y = bad;
        let hull = Polytope::from_points(points);
        assert!(matches!(hull, Err(ShapeError::Value(_))), "{hull:?}");
    }
}
