//! Cases by name: the traps others fell into, and the edges of the domain.

use crate::check::{cast, check};
use crate::draw::{Cast, Draw, KINDS};
use feeler::narrow_phase::exact::{ball_ball, ball_crossing};
use feeler::{Cuboid, Feature, Polytope, Shape, Sphere, Triangle};
use glam::{DQuat, DVec3};

fn ball(radius: f64) -> Sphere {
    Sphere::new(radius).unwrap()
}

fn at_rest(shape: impl Into<Shape>, radius: f64, position: DVec3, motion: DVec3) -> Cast {
    Cast {
        ball: ball(radius),
        position,
        shape: shape.into(),
        orientation: DQuat::IDENTITY,
        motion,
    }
}

/// A box as a polytope, corners numbered alike.
fn hull_of(half: DVec3) -> Polytope {
    Polytope::from_points(Cuboid::new(half).unwrap().vertices()).unwrap()
}

#[test]
fn small_balls_far_apart_meet_off_centre() {
    // Balls of a centimetre, a hundred metres apart, aimed five millimetres off.
    let between = DVec3::new(100.0, 0.005, 0.0);
    let crossing = ball_ball(0.01, 0.01, between, DVec3::new(200.0, 0.0, 0.0)).unwrap();
    let back = (0.02_f64 * 0.02 - 0.005 * 0.005).sqrt();
    assert!((crossing.enter.fraction * 200.0 - (100.0 - back)).abs() < 5e-14);
    assert!((crossing.leave * 200.0 - (100.0 + back)).abs() < 5e-14);
    let normal = DVec3::new(-back, -0.005, 0.0) / 0.02;
    assert!(crossing.enter.normal.distance(normal) < 1e-12);
    check(&at_rest(
        ball(0.01),
        0.01,
        -between,
        DVec3::new(200.0, 0.0, 0.0),
    ));
}

#[test]
fn a_ball_dropped_on_a_wide_slab() {
    for (half, mesh) in [(5.0, 0), (5.0, 1), (5e3, 0), (5e3, 1), (5e5, 0), (5e5, 1)] {
        let size = DVec3::new(half, half, 1.0);
        let slab: Shape = if mesh == 0 {
            Cuboid::new(size).unwrap().into()
        } else {
            hull_of(size).into()
        };
        for place in [
            DVec3::new(0.1, 0.2, 3.4),
            DVec3::new(0.31 * half, -0.77 * half, 3.4),
        ] {
            for motion in [DVec3::new(0.0, 0.0, -10.0), DVec3::new(0.3, 0.1, -10.0)] {
                let crossing =
                    ball_crossing(&ball(0.4), place, &slab, DQuat::IDENTITY, motion).unwrap();
                let off = (crossing.enter.fraction * 10.0 - 2.0).abs();
                assert!(off < 1e-15 * 4.0, "{half} {mesh}: {off:e}");
                assert_eq!(crossing.enter.normal, DVec3::Z);
            }
        }
    }
}

#[test]
fn motions_of_any_length() {
    let mut draw = Draw::new(7);
    for kind in 0..KINDS.len() {
        for _ in 0..50 {
            let shape = draw.shape(kind, 1.0);
            let mut case = draw.cast(shape, 1.0, 2.0);
            let reference = cast(&case);
            let motion = case.motion;
            for exponent in [-300, -100, -20, 3, 20, 100, 300] {
                let scale = 2.0_f64.powi(exponent);
                case.motion = motion * scale;
                let got = cast(&case);
                let back = got.map(|crossing| crossing.enter.fraction * scale);
                assert_eq!(back, reference.map(|crossing| crossing.enter.fraction));
                let back = got.map(|crossing| (crossing.leave * scale, crossing.enter.features));
                assert_eq!(back, reference.map(|c| (c.leave, c.enter.features)));
            }
            for length in [1e-30, 1e6] {
                case.motion = motion.normalize() * length;
                check(&case);
            }
        }
    }
}

#[test]
fn no_motion_and_no_numbers_give_nothing() {
    let mut draw = Draw::new(8);
    for kind in 0..KINDS.len() {
        let shape = draw.shape(kind, 1.0);
        let mut case = draw.cast(shape, 1.0, 0.0);
        for bad in [
            DVec3::ZERO,
            DVec3::NAN,
            DVec3::new(1.0, f64::NAN, 0.0),
            DVec3::new(0.0, f64::INFINITY, 0.0),
        ] {
            case.motion = bad;
            assert!(cast(&case).is_none(), "{case:?}");
        }
        case.motion = DVec3::X;
        for bad in [f64::NAN, f64::INFINITY, 1e101, f64::MAX] {
            case.position.y = bad;
            assert!(cast(&case).is_none(), "{case:?}");
        }
    }
}

#[test]
fn absurd_numbers_give_finite_answers_or_none() {
    let mut draw = Draw::new(9);
    let mut given = 0;
    for round in 0..20_000 {
        let shape = draw.shape(round % KINDS.len(), 1.0);
        let mut case = draw.cast(shape, 1.0, 0.0);
        let (far, fast) = (draw.log(1e-300, 1e100), draw.log(1e-320, 1e308));
        let mut uneven = || DVec3::from_array([0; 3].map(|_| draw.log(1e-300, 1.0)));
        (case.position, case.motion) = (far * uneven(), fast * uneven());
        if let Some(crossing) = cast(&case) {
            given += 1;
            assert!(crossing.enter.fraction.is_finite() && crossing.leave.is_finite());
            assert!(crossing.enter.fraction <= crossing.leave);
            assert!(
                crossing.enter.normal.is_normalized(),
                "{case:?} {crossing:?}"
            );
            assert!(crossing.enter.point.is_finite());
        }
    }
    assert!(given > 1000, "{given}");
}

#[test]
fn concentric_balls_part_after_the_sum_of_their_radii() {
    let crossing = ball_ball(1.0, 2.0, DVec3::ZERO, DVec3::new(0.0, 6.0, 0.0)).unwrap();
    assert_eq!((crossing.enter.fraction, crossing.leave), (-0.5, 0.5));
    assert_eq!(crossing.enter.normal, -DVec3::Y);
    assert_eq!(crossing.enter.point, DVec3::new(0.0, -2.0, 0.0));
}

#[test]
fn a_ball_amid_a_box_parts_by_the_way_it_goes() {
    let half = DVec3::new(1.0, 2.0, 3.0);
    for shape in [
        Shape::from(Cuboid::new(half).unwrap()),
        hull_of(half).into(),
    ] {
        let crossing = cast(&at_rest(shape, 0.5, DVec3::ZERO, 2.0 * DVec3::Y)).unwrap();
        assert_eq!((crossing.enter.fraction, crossing.leave), (-1.25, 1.25));
    }
}

#[test]
fn touching_exactly_is_fraction_zero() {
    let w = DVec3::new(2.0, 3.0, 6.0);
    assert_eq!(ball_ball(3.0, 4.0, w, w).unwrap().enter.fraction, 0.0);
    let apart = DVec3::new(2.0, 3.0, 6.0_f64.next_up());
    assert!(ball_ball(3.0, 4.0, apart, w).unwrap().enter.fraction > 0.0);
    let within = DVec3::new(2.0, 3.0, 6.0_f64.next_down());
    assert!(ball_ball(3.0, 4.0, within, w).unwrap().enter.fraction < 0.0);
    let cuboid = Cuboid::new([1.0, 1.0, 1.0]).unwrap();
    for (position, feature) in [
        (DVec3::new(1.5, 0.2, 0.3), Feature::Face(1)),
        (DVec3::new(1.3, 1.4, 0.3), Feature::Edge(11)),
        (
            DVec3::new(9.0 / 7.0, 10.0 / 7.0, 13.0 / 7.0),
            Feature::Vertex(7),
        ),
    ] {
        let radius = if feature == Feature::Vertex(7) {
            1.0
        } else {
            0.5
        };
        let got = cast(&at_rest(
            cuboid,
            radius,
            position,
            DVec3::new(-1.0, -1.0, -1.0),
        ))
        .unwrap();
        assert!(got.enter.fraction.abs() < 4e-16, "{got:?}");
        assert_eq!(got.enter.features, [Feature::Surface, feature]);
    }
}

/// Gliding along a face, an edge, a vertex at exactly the radius is a touch.
#[test]
fn tangents_are_touches() {
    let half = DVec3::new(1.0, 2.0, 3.0);
    let shapes = [
        Shape::from(Cuboid::new(half).unwrap()),
        hull_of(half).into(),
    ];
    for shape in shapes {
        for (position, motion, length) in [
            // Over a face, along it: from edge to edge.
            (DVec3::new(1.5, -9.0, 0.3), DVec3::Y, 4.0),
            (DVec3::new(0.1, 2.5, -9.0), DVec3::Z, 6.0),
            // Along an edge: from vertex to vertex.
            (DVec3::new(1.3, 2.4, -9.0), DVec3::Z, 6.0),
            // Past an edge and past a vertex.
            (
                DVec3::new(1.3, 2.4, 0.5) - 8.0 * DVec3::new(4.0, -3.0, 0.0),
                DVec3::new(4.0, -3.0, 0.0),
                0.0,
            ),
            (
                DVec3::new(1.3, 2.4, 3.0) - 8.0 * DVec3::new(4.0, -3.0, 1.0),
                DVec3::new(4.0, -3.0, 1.0),
                0.0,
            ),
        ] {
            let case = at_rest(shape.clone(), 0.5, position, motion);
            let got = cast(&case).unwrap_or_else(|| panic!("{case:?}"));
            let lasts = (got.leave - got.enter.fraction) * motion.length();
            // A graze lasts as long as the root of rounding.
            assert!(
                (lasts - length).abs() < 1e-6,
                "{lasts} for {length}: {case:?}"
            );
            check(&case);
            let aside = got.enter.normal;
            let passing = at_rest(shape.clone(), 0.5, position + 1e-9 * aside, motion);
            assert!(cast(&passing).is_none(), "{passing:?}");
        }
    }
    let (position, motion) = (DVec3::new(3.0, -9.0, 0.0), DVec3::Y);
    let got = cast(&at_rest(ball(1.0), 2.0, position, motion)).unwrap();
    assert_eq!((got.enter.fraction, got.leave), (9.0, 9.0));
}

/// The regions around a box's corner, where case analyses of a moving ball are known to go wrong: lines
/// that cross a face's grown plane beyond its rectangle and touch a feature that
/// is not next to it.
#[test]
fn all_ways_past_a_corner_of_a_box() {
    let mut draw = Draw::new(10);
    let mut features = [0; 3];
    for _ in 0..3_000 {
        let half = DVec3::new(
            draw.log(0.01, 1.0),
            draw.log(0.01, 1.0),
            draw.log(0.01, 1.0),
        );
        let cuboid = Cuboid::new(half).unwrap();
        let radius = draw.log(0.01, 3.0);
        let target = half + radius * draw.cube();
        let motion = draw.direction();
        let case = at_rest(cuboid, radius, target - 4.0 * motion, motion);
        if check(&case).hit {
            match cast(&case).unwrap().enter.features[1] {
                Feature::Face(_) => features[0] += 1,
                Feature::Edge(_) => features[1] += 1,
                Feature::Vertex(_) => features[2] += 1,
                Feature::Surface => panic!("a box has none"),
            }
        }
    }
    assert!(features.iter().all(|&count| count > 100), "{features:?}");
}

/// As a box or as a hull: the same crossing.
#[test]
fn boxes_and_their_hulls_agree() {
    let mut draw = Draw::new(11);
    for _ in 0..3_000 {
        let half = DVec3::new(
            draw.log(0.05, 3.0),
            draw.log(0.05, 3.0),
            draw.log(0.05, 3.0),
        );
        let mut case = draw.cast(Cuboid::new(half).unwrap().into(), 1.0, 3.0);
        let one = cast(&case);
        case.shape = hull_of(half).into();
        let other = cast(&case);
        assert_eq!(one.is_some(), other.is_some(), "{case:?}");
        if let (Some(one), Some(other)) = (one, other) {
            let steep = one.enter.normal.dot(case.motion).abs();
            let off = (one.enter.fraction - other.enter.fraction).abs() * steep;
            assert!(off < 1e-13, "{off:e} {case:?}");
        }
    }
}

#[test]
fn a_triangle_has_two_sides_and_no_thickness() {
    let triangle = Triangle::new([0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0]).unwrap();
    let cast_at = |position, motion| cast(&at_rest(triangle, 0.5, position, motion)).unwrap();
    let down = cast_at(DVec3::new(1.0, 1.0, 2.5), -4.0 * DVec3::Z);
    assert_eq!((down.enter.fraction, down.leave), (0.5, 0.75));
    assert_eq!(down.enter.features[1], Feature::Face(0));
    let up = cast_at(DVec3::new(1.0, 1.0, -2.5), 4.0 * DVec3::Z);
    assert_eq!((up.enter.fraction, up.leave), (0.5, 0.75));
    assert_eq!(
        (up.enter.features[1], up.enter.normal),
        (Feature::Face(1), -DVec3::Z)
    );
    // In its plane: onto an edge, onto a vertex.
    let edge = cast_at(DVec3::new(1.0, -2.5, 0.0), DVec3::Y);
    assert_eq!(
        (edge.enter.fraction, edge.enter.features[1]),
        (2.0, Feature::Edge(0))
    );
    let vertex = cast_at(DVec3::new(0.0, -2.5, 0.0), DVec3::Y);
    assert_eq!(
        (vertex.enter.fraction, vertex.enter.normal),
        (2.0, -DVec3::Y)
    );
}

/// Turned with everything else, a cast gives the same.
#[test]
fn nothing_depends_on_where_the_axes_point() {
    let mut draw = Draw::new(12);
    for round in 0..2_000 {
        let shape = draw.shape(round % KINDS.len(), 1.0);
        let mut case = draw.cast(shape, 1.0, 3.0);
        case.orientation = DQuat::IDENTITY;
        let Some(one) = cast(&case) else { continue };
        let turn = draw.orientation();
        case.position = turn * case.position;
        case.motion = turn * case.motion;
        case.orientation = turn;
        let Some(other) = cast(&case) else { continue };
        let steep = one.enter.normal.dot(turn.conjugate() * case.motion).abs();
        if steep > 1e-3 * case.motion.length() {
            let off = (one.enter.fraction - other.enter.fraction).abs() * steep;
            assert!(off < 1e-13 * 10.0, "{off:e} {case:?}");
            assert!((turn * one.enter.normal).distance(other.enter.normal) < 1e-8);
            assert!((turn * one.enter.point).distance(other.enter.point) < 1e-8);
        }
    }
}

/// Backwards, the way out is the way in.
#[test]
fn a_cast_backwards_changes_the_ends() {
    let mut draw = Draw::new(13);
    for round in 0..2_000 {
        let shape = draw.shape(round % KINDS.len(), 1.0);
        let mut case = draw.cast(shape, 1.0, 3.0);
        let one = cast(&case);
        case.motion = -case.motion;
        let other = cast(&case);
        assert_eq!(one.is_some(), other.is_some(), "{case:?}");
        if let (Some(one), Some(other)) = (one, other)
            && one.leave - one.enter.fraction > 1e-3
        {
            assert!(
                (one.enter.fraction + other.leave).abs() < 1e-11,
                "{case:?} {one:?} {other:?}"
            );
        }
    }
}

#[test]
fn swapped_balls_give_the_mirror_image() {
    let mut draw = Draw::new(14);
    for _ in 0..1_000 {
        let (a, b) = (draw.log(0.1, 2.0), draw.log(0.1, 2.0));
        let (between, motion) = (3.0 * draw.cube(), draw.cube());
        let (one, other) = (
            ball_ball(a, b, between, motion),
            ball_ball(b, a, -between, -motion),
        );
        assert_eq!(
            one.map(|c| (c.enter.fraction, c.leave, c.enter.normal)),
            other.map(|c| (c.enter.fraction, c.leave, -c.enter.normal))
        );
    }
}

#[test]
fn a_line_beside_a_triangles_edge() {
    let triangle = Triangle::new([0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0]).unwrap();
    for tilt in [0.0, 1e-18, 1e-16, 1e-15, 1e-14, 1e-10, 1e-5] {
        for sign in [-1.0, 1.0] {
            let motion = DVec3::new(1.0, sign * tilt, 0.3 * tilt);
            for height in [0.0, 0.2, 0.499_999_999, 0.5, 0.500_000_1] {
                let case = at_rest(triangle, 0.5, DVec3::new(-5.0, -height, 0.0), motion);
                let hit = check(&case).hit;
                // At the radius, nearly, the tilt decides.
                assert!(
                    (height - 0.5_f64).abs() < 1e-3 || hit == (height < 0.5),
                    "{case:?}"
                );
            }
        }
    }
}

/// Tangential to rounding, from touch: entry was the quotient of two roundings, 0.99 motions later.
#[test]
fn a_ball_that_slides_off_a_ball_in_touch_touches_at_once() {
    let from = DVec3::new(-1.175711519071355, 1.1478518101917987, 1.1402362236669812);
    let motion = DVec3::new(
        -0.4319438374676795,
        0.22546032684394607,
        -0.6723487411506748,
    );
    let found = ball_ball(1.0, 1.0, -from, motion).unwrap();
    assert!(found.enter.fraction.abs() < 1e-15, "{found:?}");
}

/// Above the rim of a face, beyond it by less than rounding tells: the touch was put on the edge
/// opposite.
#[test]
fn a_ball_above_a_rim_that_hardly_moves() {
    check(&Cast {
        ball: ball(0.49645972933048305),
        position: DVec3::new(
            -0.6969527867056888,
            -0.28692389918044026,
            1.0786341986998649,
        ),
        shape: Cuboid::new([0.011913677596703287, 0.9116852091034853, 0.4523333931207119])
            .unwrap()
            .into(),
        orientation: DQuat::from_xyzw(
            0.21675639930783885,
            0.20261860957015101,
            0.20843230235245958,
            -0.9319433125201405,
        ),
        motion: DVec3::new(4.440892098500626e-16, 0.0, 1.1102230246251565e-16),
    });
}

/// Out of the box with a start on the line of an edge, to the last bit: its height over both planes
/// is zero there, and yet it sticks out of them later on.
#[test]
fn a_ball_that_sets_out_from_an_edge() {
    check(&Cast {
        ball: ball(0.362280807012986),
        position: DVec3::new(
            1.2489133010410387,
            -0.38324108564904436,
            0.08372132955296803,
        ),
        shape: Cuboid::new([0.710314755742034, 0.695161529857493, 0.28276601891268704])
            .unwrap()
            .into(),
        orientation: DQuat::from_xyzw(
            -0.3289047743832251,
            0.027417630520176536,
            -0.43989613236741026,
            0.835201362338911,
        ),
        motion: DVec3::Y,
    });
}
