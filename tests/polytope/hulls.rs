//! Hulls of points.

use crate::checks::{assert_sound, size, vertex_set};
use crate::oracle::{self, OracleHull, Point};
use crate::points::{Source, cube, cylinder};
use feeler::{Polytope, ShapeError};
use glam::DVec3;
use std::collections::BTreeSet;

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

/// Whether the polytope's faces can be told apart at f64.
#[derive(Clone, Copy, PartialEq)]
enum Faces {
    Distinct,
    /// Some lie in one plane to within rounding, and become one.
    Rounded,
}

/// The polytope's vertices, faces and their corners are the oracle's.
fn assert_is(hull: &Polytope, want: &OracleHull, unit: f64, shift: DVec3, faces: Faces) {
    let back = |v: DVec3| ((v - shift) / unit).to_array().map(|x| x as i128);
    let vertices: BTreeSet<Point> = hull.vertices().iter().map(|&v| back(v)).collect();
    if faces == Faces::Rounded {
        assert!(vertices.is_subset(&want.vertices));
        let rounding = 32.0 * f64::EPSILON * size(hull.vertices());
        for left_out in want.vertices.difference(&vertices) {
            let p = DVec3::from_array(left_out.map(|x| x as f64)) * unit + shift;
            let outside = hull.faces().map(|f| f.normal.dot(p) - f.offset);
            assert!(outside.fold(f64::NEG_INFINITY, f64::max) <= rounding);
        }
        return;
    }
    assert_eq!(vertices, want.vertices);
    let faces: BTreeSet<BTreeSet<Point>> = hull
        .faces()
        .map(|face| {
            let rim = face.vertices.iter();
            rim.map(|&v| back(hull.vertices()[v as usize])).collect()
        })
        .collect();
    assert_eq!(faces, want.faces);
    assert_eq!(faces.len(), hull.faces().len());
}

/// Builds the hull in several orders, scales and places, all exact, and
/// compares; `false` if the points are flat.
fn compare(source: &mut Source, points: &[Point], shifts: &[f64], faces: Faces) -> bool {
    let want = oracle::hull(points);
    for &shift in shifts {
        let most = points.iter().flatten().fold(1, |most, x| x.abs().max(most)) as f64;
        let room = (5e8 / (most + 2.0 * shift)).log2().floor() as i32;
        let unit = 2.0_f64.powi(room.min(source.below(26) as i32 - 15));
        // A multiple of the unit, so that no coordinate is rounded.
        let shift = DVec3::new(shift, -2.0 * shift, shift) * unit;
        let place = |p: &Point| DVec3::from_array(p.map(|x| x as f64)) * unit + shift;
        let given: Vec<DVec3> = points.iter().map(place).collect();
        let hull = match Polytope::from_points(given.iter().copied()) {
            Ok(hull) => hull,
            Err(ShapeError::Flat { .. }) => {
                assert!(want.vertices.is_empty(), "{points:?}");
                return false;
            }
            Err(error) => panic!("{error} for {points:?}"),
        };
        assert_sound(&hull, 32.0 * f64::EPSILON * size(&given));
        assert_is(&hull, &want, unit, shift, faces);
        let other = Polytope::from_points(source.shuffled(given.clone())).unwrap();
        assert_sound(&other, 32.0 * f64::EPSILON * size(&given));
        assert_eq!(vertex_set(hull.vertices()), vertex_set(other.vertices()));
        assert_eq!(hull.face_normals(), other.face_normals());
        assert_is(&other, &want, unit, shift, faces);
        // Vertices come in the order of the points.
        let mut rest = given.iter();
        assert!(hull.vertices().iter().all(|v| rest.any(|p| p == v)));
    }
    true
}

#[test]
fn hulls_of_grid_points_are_the_oracles() {
    let mut source = Source::new(3);
    let mut solid = 0;
    for round in 0..300 {
        let count = 4 + source.below(24);
        let width = 2 + source.below(4) as i128 * (1 + source.below(3) as i128);
        let points: Vec<Point> = (0..count)
            .map(|_| std::array::from_fn(|_| source.below(width as u64) as i128))
            .collect();
        let shifts = [[0.0, 1e6], [0.0, 12_345.0]][round % 2];
        solid += u32::from(compare(&mut source, &points, &shifts, Faces::Distinct));
    }
    assert!(
        (200..300).contains(&solid),
        "lopsided: {solid} of 300 solid"
    );
}

#[test]
fn hulls_of_full_grids_slabs_and_needles_are_the_oracles() {
    let mut source = Source::new(4);
    for [x, y, z] in [[3, 3, 3], [2, 5, 3], [2, 2, 8], [1, 2, 3]] {
        for stretch in [1, 1_000, 1_000_000] {
            let mut points = Vec::new();
            for i in 0..=x {
                for j in 0..=y {
                    for k in 0..=z {
                        if points.len() < 48 {
                            points.push([i * stretch, j * stretch, k]);
                        }
                    }
                }
            }
            assert!(compare(&mut source, &points, &[0.0, 1e6], Faces::Distinct));
        }
    }
}

#[test]
fn hulls_of_cospherical_grid_points_are_the_oracles() {
    let mut source = Source::new(5);
    for square in [3, 9, 14, 17, 26] {
        let mut points: Vec<Point> = Vec::new();
        for x in -5..=5_i128 {
            for y in -5..=5_i128 {
                for z in -5..=5_i128 {
                    if x * x + y * y + z * z == square {
                        points.push([x, y, z]);
                    }
                }
            }
        }
        let mut points = source.shuffled(points);
        points.truncate(40);
        assert!(
            compare(&mut source, &points, &[0.0], Faces::Distinct),
            "{square}"
        );
    }
}

#[test]
fn hulls_of_near_duplicates_are_the_oracles_to_within_rounding() {
    let mut source = Source::new(6);
    for _ in 0..60 {
        // Steps of one in 2⁴⁰, some 1e-12: corners come as clusters.
        let points: Vec<Point> = (0..24)
            .map(|i| {
                std::array::from_fn(|axis| {
                    let side = if i >> axis & 1 == 1 {
                        1 << 39
                    } else {
                        -(1 << 39)
                    };
                    side + source.below(5) as i128 - 2
                })
            })
            .collect();
        assert!(compare(&mut source, &points, &[0.0], Faces::Rounded));
    }
}

#[test]
fn clusters_within_ulps_give_sound_hulls() {
    let mut source = Source::new(7);
    for round in 0..400 {
        let scale = 10_f64.powf(12.0 * source.signed() - 2.0).clamp(1e-8, 1e8);
        let spread = [0.0, 1e-16, 4e-16, 1e-15, 1e-14, 1e-12][round % 6];
        let turn = source.rotation();
        let base = if round % 2 == 0 { cube() } else { cylinder(9) };
        let points: Vec<DVec3> = (0..100)
            .map(|i| (turn * base[i % base.len()] + source.in_cube() * spread) * scale)
            .collect();
        let hull = Polytope::from_points(points.iter().copied()).unwrap();
        assert_sound(&hull, 64.0 * f64::EPSILON * size(&points));
        // Nothing given lies outside by more than the faces' own unevenness.
        for face in hull.faces() {
            for p in &points {
                let outside = face.normal.dot(*p) - face.offset;
                assert!(
                    outside <= 64.0 * f64::EPSILON * size(&points),
                    "{outside:e}"
                );
            }
        }
        let again =
            Polytope::from_triangles(hull.vertices().to_vec(), hull.triangles().to_vec()).unwrap();
        assert_eq!(again.vertices(), hull.vertices());
        assert_eq!(again.triangles(), hull.triangles());
        assert_sound(&again, 64.0 * f64::EPSILON * size(&points));
    }
}

#[test]
fn turned_grids_become_boxes() {
    let mut source = Source::new(8);
    for round in 0..60 {
        let turn = source.rotation();
        let shift = source.in_cube() * [0.0, 10.0, 1e6][round % 3];
        let mut points = Vec::new();
        for i in 0..6 {
            for j in 0..6 {
                for k in 0..6 {
                    points.push(turn * DVec3::new(i.into(), j.into(), k.into()) + shift);
                }
            }
        }
        let hull = Polytope::from_points(points.iter().copied()).unwrap();
        assert_sound(&hull, 64.0 * f64::EPSILON * size(&points));
        assert_eq!(hull.faces().len(), 6, "round {round}");
    }
}

#[test]
fn extremes_of_scale_are_sound() {
    let mut source = Source::new(9);
    for scale in [2e-9, 1e-6, 1e6, 9.9e8] {
        for _ in 0..20 {
            let mut points: Vec<DVec3> = (0..50).map(|_| source.in_cube() * scale).collect();
            // Coordinates whose products would vanish.
            points.extend([DVec3::new(1e-300, -0.0, 5e-324), DVec3::splat(1e-120)]);
            points.extend(cube().into_iter().map(|p| p * scale));
            let hull = Polytope::from_points(points).unwrap();
            assert_sound(&hull, 64.0 * f64::EPSILON * scale);
            assert_eq!((hull.vertices().len(), hull.faces().len()), (8, 6));
        }
    }
}

#[test]
fn thin_slabs_keep_both_sides() {
    let mut source = Source::new(10);
    for thickness in [1e-3, 1e-6, 1e-8] {
        let points: Vec<DVec3> = (0..200)
            .map(|i| {
                let p = source.in_cube();
                DVec3::new(p.x, p.y, if i % 2 == 0 { 0.0 } else { thickness })
            })
            .collect();
        let hull = Polytope::from_points(points).unwrap();
        assert_sound(&hull, 1e-15);
        for normal in [DVec3::Z, DVec3::NEG_Z] {
            assert!(hull.face_normals().contains(&normal));
        }
    }
}
