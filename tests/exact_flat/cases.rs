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

/// Two casts that found the search's rounding, at any size.
#[test]
fn a_box_that_glides_along_its_own_edge_past_a_vertex() {
    // The edge passes the vertex at 3e-15 m, 5e-10 off the motion: from points that lie 1e-4 m
    // along the ray, what is across it was lost in rounding, and another face was taken.
    let a = bodies::cuboid(DVec3::splat(5.772862902566831e-5));
    let b = bodies::polytope(&[
        v(
            -0.0006972024459588127,
            -0.00033076452250790456,
            -0.0011100435274490185,
        ),
        v(
            -0.0006582025427716234,
            -0.0008300050655289709,
            -0.0008399726523628681,
        ),
        v(
            6.282977343951387e-5,
            0.0009654291708620882,
            -0.0009442944394892801,
        ),
        v(
            0.0007685946720866205,
            -0.000329905188414448,
            0.001062128923214871,
        ),
        v(
            0.00030749224332483617,
            0.0012440792112773855,
            0.00043059086055650513,
        ),
        v(
            -0.00020207736951498135,
            0.0006477456829851521,
            -0.0011693089068917153,
        ),
    ]);
    let turns = [
        DQuat::from_xyzw(
            1.852496511527457e-10,
            2.516143094883625e-10,
            1.1623152345461182e-10,
            1.0,
        ),
        DQuat::from_xyzw(
            0.4863644784729642,
            -0.2704753198204577,
            -0.4752694257774545,
            0.6814775626305765,
        ),
    ];
    let between = v(
        -0.000642840146363889,
        -0.0012136139524459954,
        -0.0014505362295302534,
    );
    turned(&a, &b, turns, between, v(0.0, 0.0, 0.007866895029216447));
}

#[test]
fn a_slab_that_leaves_a_needle_by_its_rim() {
    // The rim is 1e-9 off the motion: of the areas by which the place on it was found, seen
    // along the motion, one part in 1e4 was rounding.
    let a = bodies::cuboid(v(6.883056702496231, 4.339513161661147, 0.0688305670249623));
    let b = bodies::polytope(&[
        v(45.234794886617955, -0.3981005134984768, 0.07365686329464365),
        v(-3.2464255136869666, 0.17243915752495026, -0.520938394523707),
        v(
            -7.187369213040211,
            0.7616956279526153,
            -0.023243634304010285,
        ),
        v(48.40818278872898, -0.3154176107635005, -0.06554292704337002),
        v(28.269726845576386, 0.43994963832917433, -0.3363508032383828),
        v(8.586940431149552, -0.7589528613216974, 0.018802724234675317),
        v(-33.75923809217297, -0.5888689943376496, 0.06957571054787202),
    ]);
    let turns = [
        DQuat::from_xyzw(
            -7.210274530307574e-10,
            4.7630357038846955e-11,
            1.4571233452242724e-10,
            1.0,
        ),
        DQuat::from_xyzw(
            0.429005036533066,
            -0.3902876974375759,
            0.803942600050183,
            0.13155412453697213,
        ),
    ];
    let between = v(-4.564272489205385, -6.824811994082326, -153.58371562675242);
    turned(&a, &b, turns, between, v(0.0, 0.0, 26.044153334792558));
}

/// Casts turned bodies both ways.
fn turned(a: &Body, b: &Body, [turn_a, turn_b]: [DQuat; 2], between: DVec3, motion: DVec3) {
    for motion in [motion, -motion] {
        let found = flat_crossing(&a.shape, turn_a, &b.shape, turn_b, between, motion);
        assert!(found.is_some(), "they meet");
        let oracle = Oracle::new((&a.hull, turn_a), (&b.hull, turn_b), between, motion);
        assert_eq!(oracle.complaint(found.as_ref()), None, "{motion} {found:?}");
    }
}

/// Along an edge of one, in the plane of a face of their difference: all that was left of the
/// place on that face was rounding, and the exit came 0.1 motions late.
#[test]
fn a_slab_that_glides_off_a_box_along_its_own_edge() {
    let half_a = v(
        0.014858768035123236,
        0.00686223074150386,
        0.00014858768035123232,
    );
    let half_b = v(
        0.007291690922343988,
        0.003134263525194147,
        0.0029940241677749316,
    );
    let turns = [
        DQuat::from_xyzw(
            0.27788558539142083,
            -0.26554932405282905,
            -0.9094752914568881,
            0.15848612606837637,
        ),
        DQuat::from_xyzw(
            -0.5030142373059566,
            0.04277837047402653,
            -0.2985143039259866,
            0.8099604301684604,
        ),
    ];
    let between = v(
        0.06421798723958409,
        0.04348651547903946,
        0.027008801415161657,
    );
    let motion = v(
        -0.004699649038345776,
        -0.0025755602042307523,
        -0.0024894367318880374,
    );
    let [a, b] = [half_a, half_b].map(bodies::cuboid);
    turned(&a, &b, turns, between, motion);
    let [a, b] = [a, b].map(|body| bodies::polytope(&body.hull.points));
    turned(&a, &b, turns, between, motion);
}

/// Rounding told which of their edges met, and the point lay 1e-5 of the size outside of one.
#[test]
fn boxes_whose_faces_are_parallel_but_for_a_hair_share_the_point() {
    let a = bodies::cuboid(DVec3::splat(5.766002770787062));
    let turns = [
        DQuat::IDENTITY,
        DQuat::from_xyzw(
            9.998574044504985e-14,
            -1.0106499535758387e-12,
            -8.289032755412742e-13,
            1.0,
        ),
    ];
    let between = v(13.499849636777608, 1.8580272257644994, -56.73657235090751);
    turned(
        &a,
        &a,
        turns,
        between,
        v(-1.304675752678388, -1.7412995551396069, 37.61634211306881),
    );
}

/// In its own plane: what is left of the difference's thickness is rounding.
#[test]
fn a_triangle_that_slides_onto_itself_in_its_plane() {
    let triangle = bodies::triangle([
        v(
            0.0015274966605156259,
            -0.0112321913902947,
            0.007810196893016277,
        ),
        v(
            -0.008333224239120975,
            -0.004513056782811052,
            0.00998419937899017,
        ),
        v(
            -0.003346212132063177,
            -0.008200119354663728,
            -0.010538285055941524,
        ),
    ]);
    let turn = DQuat::from_xyzw(
        0.11698414302950545,
        0.2582894746892765,
        -0.009887281714531895,
        0.9589074508025721,
    );
    let between = v(
        -0.05024912080617401,
        0.027180009515802274,
        -0.044792721284585856,
    );
    let motion = v(
        0.0752130857412532,
        -0.04016128185378188,
        0.07105417625724168,
    );
    turned(&triangle, &triangle, [turn, turn], between, motion);
}

/// The needle's end is so small that the tilt of the triangle does not show on it.
#[test]
fn a_needle_s_end_on_a_triangle_that_is_tilted_by_a_hair() {
    let needle = bodies::cuboid(v(
        0.0003712855841075976,
        0.0003712855841075976,
        0.03712855841075976,
    ));
    let triangle = bodies::triangle([
        DVec3::ZERO,
        v(0.02049276609138346, 0.0, 0.0),
        v(-0.005131015706528049, 0.02049276609138346, 0.0),
    ]);
    let turns = [
        DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2),
        DQuat::from_xyzw(
            1.941957201702514e-12,
            -3.3117911789601198e-12,
            -4.879920410718424e-12,
            1.0,
        ),
    ];
    let between = v(
        -0.09331837130307974,
        -0.026077296672636897,
        0.15201292214099135,
    );
    let motion = v(
        0.03767302091616709,
        0.019871769804766334,
        -0.04928529638282231,
    );
    turned(&needle, &triangle, turns, between, motion);
}
