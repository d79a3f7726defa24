//! Shapes cast along paths, against straight casts and against looking at many places.

use crate::worlds::{Crowd, Random};
use crate::{all, shape, world};
use feeler::{
    Body, CollisionWorld, Path, Pose, QueryError, QueryFilter, Shape, Sphere, ValueError,
    closest_points, overlap,
};
use glam::{DQuat, DVec3};

#[test]
fn along_straight_paths_is_met_what_straight_casts_meet() {
    for crowd in Crowd::ALL {
        let (mut hits, mut casts) = (0, 0);
        for round in 0..4 {
            let mut random = Random::seeded(3000 * round + crowd as u64);
            let world = world(crowd, &mut random);
            let places: Vec<DVec3> = all(&world).map(|(_, _, pose)| pose.position).collect();
            for _ in 0..40 {
                let (shape, turn) = shape(&mut random);
                let from = places[random.below(places.len())] + 3.0 * random.vector();
                let motion = 10_f64.powf(random.within(-2.0, 1.5)) * random.vector();
                let Ok(path) = Path::line(from, from + motion) else {
                    continue;
                };
                // As the path has it, whose end is rounded.
                let motion = path.end() - from;
                let filter = QueryFilter::default();
                let straight = world.cast(&shape, &Pose::new(from, turn), motion, &filter);
                let along = world.cast_along(&shape, turn, &path, &filter);
                let (straight, along) = (straight.unwrap(), along.unwrap());
                let told = |hit: feeler::BodyHit| (hit.body, hit.distance);
                match (straight.map(told), along.map(told)) {
                    (Some((one, distance)), Some((other, flown))) => {
                        let off = (distance - flown).abs();
                        let slack = 1e-9 + 2e-12 * from.abs().max_element();
                        assert!(one == other && off < slack, "{crowd:?}: {distance} {flown}");
                    }
                    (one, other) => assert_eq!(one, other, "{crowd:?} {shape:?} {path:?}"),
                }
                hits += usize::from(along.is_some());
                casts += 1;
            }
        }
        assert!(10 * hits > casts && hits < casts, "{crowd:?}: {hits}");
    }
}

/// How far apart two bodies are, negative where they overlap.
fn gap(a: (&Shape, &Pose), b: (&Shape, &Pose)) -> f64 {
    if let Some(found) = overlap(a.0, a.1, b.0, b.1) {
        return -found.depth;
    }
    closest_points(a.0, a.1, b.0, b.1).map_or(0.0, |found| found.distance)
}

#[test]
fn along_curves_the_first_touch_is_where_a_body_is_and_none_is_before() {
    const LOOKS: u32 = 400;
    let (mut hits, mut at_once, mut casts) = (0, 0, 0);
    for crowd in Crowd::ALL {
        let mut random = Random::seeded(4000 + crowd as u64);
        let world = world(crowd, &mut random);
        let bodies: Vec<_> = all(&world).collect();
        for _ in 0..12 {
            let (shape, turn) = shape(&mut random);
            let mut knot = || bodies[random.below(bodies.len())].2.position + 3.0 * random.vector();
            let Ok(path) = Path::catmull_rom([knot(), knot(), knot()], feeler::Knots::Centripetal)
            else {
                continue;
            };
            let hit = match world.cast_along(&shape, turn, &path, &QueryFilter::default()) {
                Ok(hit) => hit,
                Err(QueryError::Undecided { .. }) => continue,
                Err(error) => panic!("{error}"),
            };
            casts += 1;
            let at = |distance: f64| Pose::new(path.position_at(distance), turn);
            let until = hit.map_or(path.length(), |hit| hit.distance);
            // Some of these worlds are far from the origin.
            let far = path.start().abs().max_element();
            let slack = 1e-9 * (shape.max_dist() + path.length()) + 2e-12 * far;
            for look in (0..LOOKS).filter(|_| until > 0.0) {
                let distance = until * f64::from(look) / f64::from(LOOKS);
                let pose = at(distance);
                for (id, other, other_pose) in &bodies {
                    let depth =
                        overlap(&shape, &pose, other, other_pose).map_or(0.0, |it| it.depth);
                    assert!(depth <= slack, "{depth} in {id} at {distance} of {until}");
                }
            }
            let Some(hit) = hit else {
                continue;
            };
            let (_, other, other_pose) = bodies.iter().find(|body| body.0 == hit.body).unwrap();
            let gap = gap((&shape, &at(hit.distance)), (other, other_pose));
            if hit.distance > 0.0 {
                assert!(gap.abs() <= slack, "{gap} at {hit:?}");
            } else {
                at_once += usize::from(gap < 0.0);
            }
            assert!((hit.normal.unwrap().length() - 1.0).abs() < 1e-12);
            hits += 1;
        }
    }
    assert!(casts > 80 && hits > 30 && hits < casts, "{hits} of {casts}");
    assert!(at_once > 3, "{at_once}");
}

#[test]
fn a_path_beyond_all_bodies_and_one_that_is_filtered_out_meet_nothing() {
    let mut world = CollisionWorld::default();
    let ball = Shape::from(Sphere::new(1.0).unwrap());
    let target = world
        .insert(Body::fixed(ball.clone(), [50.0, 0.0, 0.0]))
        .unwrap();
    let path = |y: f64| {
        Path::bezier([
            [0.0, y, 0.0],
            [30.0, y, 9.0],
            [70.0, y, 9.0],
            [100.0, y, 0.0],
        ])
    };
    let cast = |y: f64, filter: &QueryFilter<'_>| {
        world.cast_along(&ball, DQuat::IDENTITY, &path(y).unwrap(), filter)
    };
    let everyone = QueryFilter::default();
    assert_eq!(cast(3.0, &everyone), Ok(None));
    let not_it = |id| id != target;
    assert_eq!(cast(0.0, &everyone.where_body(&not_it)), Ok(None));
    // The path passes 6.75 m above it at its middle.
    assert_eq!(cast(0.0, &everyone), Ok(None));
    let low = Path::bezier([
        [0.0; 3],
        [30.0, 0.0, 1.0],
        [70.0, 0.0, 1.0],
        [100.0, 0.0, 0.0],
    ]);
    let hit = world.cast_along(&ball, DQuat::IDENTITY, &low.unwrap(), &everyone);
    assert_eq!(hit.unwrap().map(|hit| hit.body), Some(target));
}

#[test]
fn orientations_that_are_none_are_refused() {
    let (world, path) = (
        CollisionWorld::default(),
        Path::line([0.0; 3], [1.0, 0.0, 0.0]),
    );
    let (ball, path) = (Sphere::new(1.0).unwrap().into(), path.unwrap());
    for (bad, expected) in [
        (DQuat::from_xyzw(0.0, 0.0, 0.0, 2.0), true),
        (DQuat::from_xyzw(0.0, 0.0, 0.0, f64::NAN), true),
        (DQuat::from_xyzw(0.0, 0.0, 0.0, 1.0 + 1e-9), false),
    ] {
        let found = world.cast_along(&ball, bad, &path, &QueryFilter::default());
        let refused = matches!(
            found,
            Err(QueryError::Value(
                ValueError::TooLarge {
                    field: "orientation.length",
                    ..
                } | ValueError::NotFinite {
                    field: "orientation.length",
                    ..
                }
            ))
        );
        assert_eq!(refused, expected, "{bad} {found:?}");
    }
}
