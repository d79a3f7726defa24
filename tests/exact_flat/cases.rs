//! The traps: ties, grazes, slivers and the ends of the range.

use crate::bodies::{self, Body};
use crate::oracle::Oracle;
use feeler::narrow_phase::exact::{Crossing, flat_crossing};
use feeler::{Feature, Polytope, Shape};
use glam::{DQuat, DVec3};

fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

/// A unit box, as a box and as a polytope.
fn unit_boxes() -> [Body; 2] {
    let cuboid = bodies::cuboid(DVec3::splat(0.5));
    let polytope = bodies::polytope(&cuboid.hull.points);
    [cuboid, polytope]
}

fn cast(a: &Body, b: &Body, between: DVec3, motion: DVec3) -> Option<Crossing> {
    let turn = DQuat::IDENTITY;
    let found = flat_crossing(&a.shape, turn, &b.shape, turn, between, motion);
    let oracle = Oracle::new((&a.hull, turn), (&b.hull, turn), between, motion);
    assert_eq!(
        oracle.complaint(found.as_ref()),
        None,
        "{between} {motion} {found:?}"
    );
    found
}

fn each(check: impl Fn(&Body, &Body)) {
    let boxes = unit_boxes();
    for a in &boxes {
        for b in &boxes {
            check(a, b);
        }
    }
}

#[test]
fn unit_boxes_exactly_head_on() {
    each(|a, b| {
        for axis in DVec3::AXES {
            for axis in [axis, -axis] {
                let found = cast(a, b, 3.0 * axis, -4.0 * axis).unwrap();
                assert!((found.enter.fraction - 0.5).abs() < 1e-15, "{found:?}");
                assert!((found.leave - 1.0).abs() < 1e-15);
                assert!((found.enter.normal - axis).length() < 1e-15);
                assert!(
                    (found.enter.point - 0.5 * axis).length() < 1e-14,
                    "{found:?}"
                );
                assert!(matches!(
                    found.enter.features,
                    [Feature::Face(_), Feature::Face(_)]
                ));
            }
        }
    });
}

#[test]
fn boxes_sliding_past_at_small_gaps_miss() {
    each(|a, b| {
        for gap in [1e-6, 1e-9, 1e-12, 1e-3, 0.2] {
            for height in [1.0 + gap, -1.0 - gap] {
                assert!(cast(a, b, v(3.0, height, 0.25), v(-4.0, 0.0, 0.0)).is_none());
                assert!(cast(a, b, v(0.0, height, 0.25), v(-4.0, 0.0, 1.0)).is_none());
            }
            let found = cast(a, b, v(3.0, 1.0 - gap, 0.25), v(-4.0, 0.0, 0.0)).unwrap();
            assert!((found.enter.normal - DVec3::X).length() < 1e-15);
        }
    });
}

#[test]
fn boxes_sliding_in_touch_touch() {
    each(|a, b| {
        let found = cast(a, b, v(3.0, 1.0, 0.25), v(-4.0, 0.0, 0.0)).unwrap();
        assert!((found.enter.fraction - 0.5).abs() < 1e-14 && (found.leave - 1.0).abs() < 1e-14);
    });
}

#[test]
fn edges_and_vertices_meet_exactly() {
    each(|a, b| {
        // Edge on edge, along a face's diagonal; vertex on vertex, along a body's.
        let edges = cast(a, b, v(3.0, 3.0, 0.0), v(-4.0, -4.0, 0.0)).unwrap();
        assert!((edges.enter.fraction - 0.5).abs() < 1e-14);
        let vertices = cast(a, b, v(3.0, 3.0, 3.0), v(-4.0, -4.0, -4.0)).unwrap();
        assert!((vertices.enter.fraction - 0.5).abs() < 1e-14);
        assert!((vertices.enter.point - DVec3::splat(0.5)).length() < 1e-13);
        // Past each other, by one edge or one vertex.
        assert!(cast(a, b, v(1.0, 1.0, 3.0), v(0.0, 0.0, -1.0)).is_some());
        assert!(cast(a, b, v(1.0, 1.0, 1.0), v(1.0, -1.0, 0.0)).is_some());
    });
}

#[test]
fn starts_in_touch_and_inside() {
    each(|a, b| {
        let touching = cast(a, b, v(1.0, 0.0, 0.0), v(-1.0, 0.0, 0.0)).unwrap();
        assert!(touching.enter.fraction.abs() < 1e-15 && (touching.leave - 2.0).abs() < 1e-15);
        let same = cast(a, b, DVec3::ZERO, v(0.0, 2.0, 0.0)).unwrap();
        assert!((same.enter.fraction + 0.5).abs() < 1e-15 && (same.leave - 0.5).abs() < 1e-15);
        assert!((same.enter.normal + DVec3::Y).length() < 1e-15);
    });
}

#[test]
fn motions_of_any_length() {
    each(|a, b| {
        for length in [1e-30, 1e-9, 1.0, 1e6, 1e150] {
            let motion = length * v(-1.0, -0.1, 0.05);
            let found = flat_crossing(
                &a.shape,
                DQuat::IDENTITY,
                &b.shape,
                DQuat::IDENTITY,
                v(2.0, 0.2, 0.0),
                motion,
            )
            .unwrap();
            assert!(
                (found.enter.fraction * length - 1.0).abs() < 1e-14,
                "{found:?}"
            );
            assert_eq!(
                found.enter.features.map(|f| matches!(f, Feature::Face(_))),
                [true; 2]
            );
        }
        for length in [1e-310, 1e300] {
            let motion = v(-length, 0.0, 0.0);
            let found = flat_crossing(
                &a.shape,
                DQuat::IDENTITY,
                &b.shape,
                DQuat::IDENTITY,
                v(2.0, 0.2, 0.0),
                motion,
            )
            .unwrap();
            assert!(found.enter.fraction.is_finite() && found.enter.point.is_finite());
        }
    });
}

#[test]
fn no_motion_and_no_numbers_give_none() {
    each(|a, b| {
        for (between, motion) in [
            (DVec3::ZERO, DVec3::ZERO),
            (v(1.0, 0.0, 0.0), DVec3::ZERO),
            (DVec3::NAN, DVec3::X),
            (DVec3::X, DVec3::NAN),
            (DVec3::X, v(f64::INFINITY, 0.0, 0.0)),
        ] {
            let turn = DQuat::IDENTITY;
            assert!(flat_crossing(&a.shape, turn, &b.shape, turn, between, motion).is_none());
        }
    });
}

#[test]
fn coplanar_triangles() {
    let a = bodies::triangle([DVec3::ZERO, DVec3::X, DVec3::Y]);
    let b = bodies::triangle([v(0.0, -1.0, 0.0), v(1.0, 0.0, 0.0), v(0.0, 1.0, 0.0)]);
    let found = cast(&a, &b, v(3.0, 0.0, 0.0), v(-4.0, 0.0, 0.0)).unwrap();
    assert!((found.enter.fraction - 0.5).abs() < 1e-15, "{found:?}");
    assert!((found.enter.point - DVec3::X).length() < 1e-14);
    // Above each other, and face to face.
    assert!(cast(&a, &b, v(3.0, 0.0, 1e-6), v(-4.0, 0.0, 0.0)).is_none());
    let faces = cast(&a, &b, v(0.0, 0.0, 1.0), v(0.0, 0.0, -2.0)).unwrap();
    assert!((faces.enter.fraction - 0.5).abs() < 1e-15 && (faces.leave - 0.5).abs() < 1e-15);
    assert_eq!(faces.enter.normal, DVec3::Z);
}

#[test]
fn a_triangle_against_itself() {
    let triangle = bodies::triangle([v(0.1, 0.2, 0.3), v(1.0, -0.3, 0.2), v(-0.4, 0.8, -0.6)]);
    for motion in [DVec3::X, DVec3::Y, v(-1.0, 1.0, 0.5), v(0.9, -0.5, -0.1)] {
        let found = cast(&triangle, &triangle, DVec3::ZERO, motion).unwrap();
        assert!(
            found.enter.fraction <= 1e-15 && found.leave >= -1e-15,
            "{found:?}"
        );
        let found = cast(&triangle, &triangle, -3.0 * motion, motion).unwrap();
        assert!(found.enter.fraction <= 3.0 + 1e-14 && found.leave >= 3.0 - 1e-14);
    }
}

#[test]
fn hulls_with_slivers() {
    // A cube with corners doubled, a picometre beside.
    let mut points = unit_boxes()[0].hull.points.clone();
    for sign in [-1.0, 1.0] {
        points.push(v(0.5 * sign, 0.5, 0.5 + 1e-12));
        points.push(v(0.5 + 1e-12, 0.5 * sign, -0.5));
    }
    let sliver = bodies::polytope(&points);
    let mut hits = 0;
    for i in -6..=6 {
        for j in -6..=6 {
            let aside = 0.1 * v(f64::from(i), f64::from(j), 0.0);
            for (from, motion) in [
                (v(0.0, 0.0, 3.0), v(0.0, 0.0, -4.0)),
                (v(0.0, 0.0, -3.0), v(0.1, 0.2, 4.0)),
                (v(3.0, 0.0, 0.3), v(-4.0, 0.0, 0.0)),
            ] {
                hits += usize::from(cast(&sliver, &sliver, from + aside, motion).is_some());
            }
        }
    }
    assert!(hits > 300, "{hits}");
}

#[test]
fn identical_hulls_at_identical_places() {
    let points: Vec<DVec3> = (0..60)
        .map(|i| {
            let (y, x) = (2.4 * f64::from(i)).sin_cos();
            let z = f64::from(2 * i + 1) / 60.0 - 1.0;
            v(x * (1.0 - z * z).sqrt(), y * (1.0 - z * z).sqrt(), z)
        })
        .collect();
    let hull = bodies::polytope(&points[..]);
    for motion in [DVec3::X, DVec3::Y, DVec3::Z, v(1.0, -2.0, 0.5)] {
        let found = cast(&hull, &hull, DVec3::ZERO, motion).unwrap();
        assert!(found.enter.fraction < 0.0 && (found.enter.fraction + found.leave).abs() < 1e-13);
    }
}

fn pyramid() -> Body {
    bodies::polytope(&[
        v(0.0, 1.0, 0.0),
        v(1.0, -1.0, 1.0),
        v(-1.0, -1.0, 1.0),
        v(0.0, -1.0, -1.0),
    ])
}

#[test]
fn scene_5_of_the_thesis() {
    let pyramid = pyramid();
    let found = cast(&pyramid, &pyramid, v(0.0, 0.0, 5.0), v(0.0, 0.0, -5.0)).unwrap();
    assert!((found.enter.fraction - 0.6).abs() < 1e-14, "{found:?}");
    assert!((found.enter.point - v(0.0, -1.0, 1.0)).length() < 1e-13);
    // Between (0, 1, 2)/√5 and the base's (0, −1, 0).
    let normal = found.enter.normal;
    assert!(normal.x.abs() < 1.0 && normal.z >= -1e-15 && normal.y <= 1.0 / 5.0_f64.sqrt() + 1e-15);
}

#[test]
fn scene_6_of_the_thesis() {
    let pyramid = pyramid();
    let found = cast(&pyramid, &pyramid, v(0.0, -0.5, 5.0), v(0.0, 0.0, -5.0)).unwrap();
    let normal = v(0.0, -1.0, 2.0) / 5.0_f64.sqrt();
    assert!((found.enter.normal - normal).length() < 1e-15, "{found:?}");
    assert!((found.enter.point - v(0.0, -1.0, 1.0)).length() < 1e-14);
    assert!(matches!(
        found.enter.features,
        [Feature::Edge(_), Feature::Edge(_)]
    ));
}

#[test]
fn far_from_the_shapes_own_origin() {
    let far = v(1e4, -2e4, 3e4);
    let near = pyramid();
    let moved: Vec<DVec3> = near.hull.points.iter().map(|&p| p + far).collect();
    let moved = Shape::from(Polytope::from_points(moved).unwrap());
    let turn = DQuat::IDENTITY;
    let motion = v(0.3, 0.2, -5.0);
    let found = flat_crossing(
        &moved,
        turn,
        &near.shape,
        turn,
        v(0.0, -0.5, 5.0) - far,
        motion,
    )
    .unwrap();
    let want = flat_crossing(
        &near.shape,
        turn,
        &near.shape,
        turn,
        v(0.0, -0.5, 5.0),
        motion,
    )
    .unwrap();
    assert!((found.enter.fraction - want.enter.fraction).abs() < 1e-11);
    assert!((found.enter.normal - want.enter.normal).length() < 1e-11);
}
