//! Closed forms, and the oracles against each other.

use super::*;
use crate::casts::Kind;
use glam::DQuat;

fn hit(truth: Truth) -> (f64, DVec3) {
    match truth {
        Truth::Hit {
            fraction, normal, ..
        } => (fraction, normal),
        Truth::Clear { margin } => panic!("a miss by {margin} m"),
    }
}

#[track_caller]
fn assert_hit(truth: Truth, fraction: f64, normal: DVec3) {
    let found = hit(truth);
    assert!((found.0 - fraction).abs() < 1e-14, "{truth:?}");
    assert!((found.1 - normal).length() < 1e-14, "{truth:?}");
}

#[track_caller]
fn assert_clear(truth: Truth, margin: f64) {
    let Truth::Clear { margin: found } = truth else {
        panic!("{truth:?}");
    };
    assert!((found - margin).abs() < 1e-14, "{truth:?}");
}

/// One cast of `solids` from `start` by `motion`, the second turned.
fn cast(solids: [Solid; 2], start: DVec3, motion: DVec3, turned: DQuat) -> Truth {
    let placed = |solid, position, orientation| Placed {
        solid,
        position,
        orientation,
    };
    let cast = Cast {
        a: placed(0, start, DQuat::IDENTITY),
        b: placed(1, DVec3::ZERO, turned),
        motion,
    };
    let set = CastSet {
        kinds: [Kind::Box, Kind::Box],
        solids: solids.to_vec(),
        casts: vec![cast],
    };
    Oracle::new(&set).truth(&set.casts[0])
}

const UNTURNED: DQuat = DQuat::IDENTITY;

fn cube() -> Solid {
    Solid::Cuboid(DVec3::ONE)
}

#[test]
fn ball_meets_ball() {
    let balls = || [Solid::Ball(1.0), Solid::Ball(1.5)];
    let (start, motion) = (DVec3::new(-10.0, 0.0, 0.0), 10.0 * DVec3::X);
    assert_hit(cast(balls(), start, motion, UNTURNED), 0.75, DVec3::NEG_X);
    // 3-4-5: 1.5 aside, 2 before.
    let aside = start + DVec3::new(0.0, 1.5, 0.0);
    let normal = DVec3::new(-0.8, 0.6, 0.0);
    assert_hit(cast(balls(), aside, motion, UNTURNED), 0.8, normal);
    let past = start + DVec3::new(0.0, 3.0, 0.0);
    assert_clear(cast(balls(), past, motion, UNTURNED), 0.5);
    // Two metres too short.
    assert_clear(cast(balls(), start, 5.5 * DVec3::X, UNTURNED), 2.0);
}

#[test]
fn ball_meets_face_edge_and_corner_of_a_box() {
    let solids = || [Solid::Ball(0.5), cube()];
    let motion = 8.0 * DVec3::X;
    let meet = |y: f64, z: f64, turned| cast(solids(), DVec3::new(-5.5, y, z), motion, turned);
    assert_hit(meet(0.3, 0.2, UNTURNED), 0.5, DVec3::NEG_X);
    // Past the edge by 0.3: 0.4 before it, 3-4-5.
    assert_hit(
        meet(1.3, 0.2, UNTURNED),
        4.1 / 8.0,
        DVec3::new(-0.8, 0.6, 0.0),
    );
    // Past the corner by 0.3 each way.
    let before = (0.25_f64 - 0.18).sqrt();
    let normal = DVec3::new(-before, 0.3, 0.3) / 0.5;
    assert_hit(meet(1.3, 1.3, UNTURNED), (4.5 - before) / 8.0, normal);
    assert_clear(meet(1.6, 0.0, UNTURNED), 0.1);
    // Turned by 45° the edge comes first.
    let turned = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_4);
    assert_hit(
        meet(0.0, 0.0, turned),
        (5.0 - 2_f64.sqrt()) / 8.0,
        DVec3::NEG_X,
    );
}

#[test]
fn ball_meets_triangle() {
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let fall = |x: f64, y: f64| {
        let solids = [Solid::Ball(0.5), Solid::Triangle(corners)];
        cast(solids, DVec3::new(x, y, 2.0), -4.0 * DVec3::Z, UNTURNED)
    };
    assert_hit(fall(0.25, 0.25), 1.5 / 4.0, DVec3::Z);
    assert_hit(fall(0.5, -0.3), 1.6 / 4.0, DVec3::new(0.0, -0.6, 0.8));
    assert_hit(fall(1.3, 0.0), 1.6 / 4.0, DVec3::new(0.6, 0.0, 0.8));
    assert_clear(fall(0.5, -0.7), 0.2);
}

#[test]
fn box_meets_box() {
    let motion = 8.0 * DVec3::X;
    let meet = |y: f64, turned| cast([cube(), cube()], DVec3::new(-6.0, y, 0.25), motion, turned);
    assert_hit(meet(0.5, UNTURNED), 0.5, DVec3::NEG_X);
    assert_clear(meet(2.25, UNTURNED), 0.25);
    // The other's edge against the face.
    let turned = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_4);
    assert_hit(meet(0.5, turned), (5.0 - 2_f64.sqrt()) / 8.0, DVec3::NEG_X);
}

#[test]
fn crossed_edges_meet() {
    // Two cubes stand on edges, one edge along y, the other along x, one above the other.
    let root = 2_f64.sqrt();
    let quarter = std::f64::consts::FRAC_PI_4;
    let corners = |turn: DQuat| -> Vec<DVec3> {
        let corners = cube().corners();
        corners.into_iter().map(|corner| turn * corner).collect()
    };
    let upper = Solid::Hull(corners(DQuat::from_rotation_y(quarter)));
    let lower = Solid::Hull(corners(DQuat::from_rotation_x(quarter)));
    let start = DVec3::new(0.1, 0.2, 5.0);
    let truth = cast([upper, lower], start, -5.0 * DVec3::Z, UNTURNED);
    assert_hit(truth, (5.0 - 2.0 * root) / 5.0, DVec3::Z);
}

#[test]
fn ray_meets_box() {
    let from = DVec3::new(-3.0, 0.5, 0.25);
    let motion = DVec3::new(4.0, 0.0, 0.0);
    let solids = || [Solid::Point, cube()];
    assert_hit(cast(solids(), from, motion, UNTURNED), 0.5, DVec3::NEG_X);
    let past = from + DVec3::new(0.0, 0.75, 0.0);
    assert_clear(cast(solids(), past, motion, UNTURNED), 0.25);
}

#[test]
fn faces_are_all_found() {
    // A cube: six faces of four corners, four triples each.
    assert_eq!(faces::supporting_triples(&cube().corners()).len(), 24);
    // Points on an ellipsoid: all are corners, faces are triangles, 2n − 4 of them.
    for points in [4, 12, 40] {
        let set = CastSet::new([Kind::Hull(points), Kind::Point], 1.0, 1, 7);
        for solid in set.solids.iter().take(4) {
            let triples = faces::supporting_triples(&solid.corners());
            assert_eq!(triples.len(), 2 * points - 4);
        }
    }
}

/// Where the random casts must not be lopsided.
fn assert_balanced(hits: usize, casts: usize) {
    assert!(
        (casts / 5..=casts * 4 / 5).contains(&hits),
        "the casts are lopsided: {hits} hits of {casts}"
    );
}

#[test]
fn axes_and_cuts_agree() {
    let pairs = [
        ([Kind::Box, Kind::Box], 300),
        ([Kind::Slab, Kind::Slab], 300),
        ([Kind::Hull(12), Kind::Hull(12)], 300),
        ([Kind::Point, Kind::Hull(12)], 300),
        ([Kind::Hull(30), Kind::Box], 40),
    ];
    for (kinds, count) in pairs {
        let set = CastSet::new(kinds, 1.0, count, 11);
        let triples: Vec<_> = set
            .solids
            .iter()
            .map(|solid| faces::supporting_triples(&solid.corners()))
            .collect();
        let oracle = Oracle::new(&set);
        let mut hits = 0;
        for cast in &set.casts {
            let [a, b] = [&cast.a, &cast.b].map(|at| oracle.corners_at(at, cast.b.position));
            let by_cuts = cuts::truth(&a, &b, cast.motion);
            let [a, b] = [(a, cast.a), (b, cast.b)]
                .map(|(corners, at)| Flat::new(corners, &triples[at.solid]));
            let by_axes = axes::truth(&a, &b, cast.motion);
            match (by_axes, by_cuts) {
                (
                    Truth::Hit {
                        fraction,
                        normal,
                        margin,
                    },
                    Truth::Hit {
                        fraction: other,
                        normal: cut_normal,
                        margin: least,
                    },
                ) => {
                    hits += 1;
                    // A graze multiplies rounding by one over the sine of its angle.
                    let graze = normal.dot(cast.motion.normalize()).abs();
                    let error = (fraction - other).abs() * cast.motion.length();
                    assert!(
                        error * graze < 1e-13,
                        "{}: {by_axes:?} {by_cuts:?}",
                        set.name()
                    );
                    assert!(
                        normal.dot(cut_normal) > 1.0 - 1e-9,
                        "{by_axes:?} {by_cuts:?}"
                    );
                    assert!(least <= margin + 1e-13, "{least} is above {margin}");
                }
                (Truth::Clear { .. }, Truth::Clear { .. }) => {}
                _ => panic!("{}: {by_axes:?} {by_cuts:?}", set.name()),
            }
        }
        assert_balanced(hits, count);
    }
}

#[test]
fn a_tiny_ball_is_a_ray() {
    let set = CastSet::new([Kind::Point, Kind::Hull(12)], 1.0, 1000, 12);
    let oracle = Oracle::new(&set);
    let radius = 1e-9;
    let mut hits = 0;
    for cast in &set.casts {
        let [a, b] = [&cast.a, &cast.b].map(|at| oracle.corners_at(at, cast.b.position));
        let triples = &oracle.triples[cast.b.solid];
        let ball = rounded::truth(a[0], radius, &b, triples, cast.motion);
        let ray = oracle.truth(cast);
        match (ray, ball) {
            (
                Truth::Hit {
                    fraction, normal, ..
                },
                Truth::Hit {
                    fraction: other, ..
                },
            ) => {
                hits += 1;
                let closing = -normal.dot(cast.motion);
                assert!((fraction - other - radius / closing).abs() < 1e-13);
            }
            (Truth::Clear { .. }, Truth::Clear { .. }) => {}
            _ if ray.margin().abs() < 2.0 * radius => {}
            _ => panic!("{ray:?} {ball:?}"),
        }
    }
    assert_balanced(hits, set.casts.len());
}

/// Of every kind: at the time of contact they touch along the normal and overlap
/// along every other axis; a moment before they are apart.
#[test]
fn contacts_are_contacts() {
    let others = [
        Kind::Ball,
        Kind::Box,
        Kind::Slab,
        Kind::Hull(12),
        Kind::Triangle,
    ];
    let balls = others.map(|kind| [Kind::Ball, kind]);
    let hulls = [
        [Kind::Hull(100); 2],
        [Kind::Point, Kind::Hull(1000)],
        [Kind::Box; 2],
    ];
    for kinds in balls.into_iter().chain(hulls) {
        let set = CastSet::new(kinds, 1.0, 300, 13);
        let oracle = Oracle::new(&set);
        let mut hits = 0;
        let mut random = crate::random::Random::new(14);
        for cast in &set.casts {
            if let Truth::Hit {
                fraction,
                normal,
                margin,
            } = oracle.truth(cast)
            {
                hits += 1;
                assert!(margin >= 0.0);
                assert!(normal.dot(cast.motion) < 0.0 && (normal.length() - 1.0).abs() < 1e-14);
                let apart = oracle.separation(cast, normal, fraction);
                assert!(apart.abs() < 1e-13, "{}: {apart}", set.name());
                for _ in 0..50 {
                    let axis = (normal + 0.1 * random.direction()).normalize();
                    let apart = oracle.separation(cast, axis, fraction);
                    assert!(apart < 1e-13, "{}: {apart}", set.name());
                }
            }
        }
        assert_balanced(hits, set.casts.len());
    }
}
