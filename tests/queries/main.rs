//! Queries against brute force over all bodies.

#![allow(
    clippy::unwrap_used,
    reason = "planted input that is refused shall fail the test"
)]

mod along;
mod in_touch;
mod near;
#[path = "../crowds/worlds.rs"]
mod worlds;

use feeler::narrow_phase::exact::crossing;
use feeler::tolerance::TOUCH;
use feeler::{
    BodyId, CollisionWorld, Cuboid, Groups, Pose, QueryError, QueryFilter, Ray, RayCast, Shape,
    Sphere, ValueError, overlap,
};
use glam::{DQuat, DVec3};
use worlds::{Crowd, Random};

/// A world in the midst of its life: stepped, and meddled with since.
fn world(crowd: Crowd, random: &mut Random) -> CollisionWorld {
    let mut world = CollisionWorld::default();
    let count = 30 + random.below(200);
    let bodies = crowd.bodies(count, random);
    let mut groups = || Groups::new(1 << random.below(3), u32::MAX);
    for body in bodies {
        world.insert(body.in_groups(groups())).unwrap();
    }
    for round in 0..random.below(3) {
        world.step(1.0 / 60.0).unwrap();
        let ids: Vec<BodyId> = world.bodies().collect();
        for (index, new) in crowd
            .bodies(count, random)
            .into_iter()
            .take(ids.len().min(90))
            .enumerate()
        {
            match index % 3 + round {
                0 => drop(world.remove(ids[index])),
                1 => drop(world.set_motion(ids[index], new.motion().clone())),
                _ => drop(world.insert(new)),
            }
        }
    }
    // Calm frames, for several of which boxes hold, and a few changes since.
    // Fast bodies would be far from each other.
    let dt = if crowd == Crowd::Fast {
        1e-3
    } else {
        1.0 / 60.0
    };
    for _ in 0..random.below(12) {
        world.step(dt).unwrap();
    }
    let ids: Vec<BodyId> = world.bodies().collect();
    for _ in 0..random.below(4) {
        let id = ids[random.below(ids.len())];
        world.set_velocity(id, 20.0 * random.vector()).unwrap();
    }
    world
}

/// Every body: shape and pose.
fn all(world: &CollisionWorld) -> impl Iterator<Item = (BodyId, &Shape, Pose)> {
    let body = |id| (id, world.shape(id).unwrap(), world.pose(id).unwrap());
    world.bodies().map(body)
}

fn reaches(random: &mut Random) -> f64 {
    [f64::INFINITY, 100.0, 5.0, 0.0][random.below(4)]
}

#[test]
fn rays_find_what_brute_force_finds() {
    let rounds = std::env::var("WORLDS").map_or(6, |worlds| worlds.parse().unwrap());
    for crowd in Crowd::ALL {
        let (mut hits, mut rays) = (0, 0);
        for round in 0..rounds {
            let mut random = Random::seeded(1000 * round + crowd as u64);
            let world = world(crowd, &mut random);
            let places: Vec<DVec3> = all(&world).map(|(_, _, pose)| pose.position).collect();
            for _ in 0..60 {
                let from = places[random.below(places.len())] + 6.0 * random.vector();
                let to = places[random.below(places.len())] + random.vector();
                let direction = match random.below(6) {
                    0 => DVec3::AXES[random.below(3)],
                    1 => DVec3::new(1.0, 1e-300, -1e-12),
                    _ => (to - from) * 10_f64.powf(random.within(-3.0, 3.0)),
                };
                let (ray, reach) = (Ray::new(from, direction), reaches(&mut random));
                let mut expected = Vec::new();
                for (id, shape, pose) in all(&world) {
                    if let Some(hit) = shape.first_hit_at(&pose, &ray) {
                        let distance = hit.fraction() * direction.length();
                        if hit.fraction() <= reach / direction.length() {
                            expected.push((distance, id));
                        }
                    }
                }
                expected.sort_by(|a, b| a.partial_cmp(b).unwrap());
                let filter = QueryFilter::default();
                let found = world.cast_ray_all(&ray, reach, &filter).unwrap();
                let told: Vec<_> = found.iter().map(|hit| (hit.distance, hit.body)).collect();
                assert_eq!(told, expected, "{crowd:?} {ray:?} {reach}");
                let first = world.cast_ray(&ray, reach, &filter).unwrap();
                assert_eq!(first, found.first().copied(), "{crowd:?} {ray:?}");
                let many = world.cast_rays(&[ray, ray], reach, &filter).unwrap();
                assert_eq!(many, [first, first]);
                if let Some(hit) = first {
                    // No two bodies are as near, or the lower one is told.
                    assert!(found.iter().all(|other| other.distance >= hit.distance));
                }
                // Of some groups, without the first one found.
                let keep = |id| Some(id) != first.map(|hit| hit.body);
                let filter = filter.meeting(Groups::new(1, 0b101)).where_body(&keep);
                let few = world.cast_ray_all(&ray, reach, &filter).unwrap();
                assert!(few.len() <= found.len() && few.iter().all(|hit| found.contains(hit)));
                assert!(few.iter().all(|hit| keep(hit.body)));
                hits += usize::from(first.is_some());
                rays += 1;
            }
        }
        println!("{crowd:?}: {hits} of {rays} rays hit");
        assert!(
            10 * hits > rays && hits < rays,
            "{crowd:?}: {hits} of {rays}"
        );
    }
}

pub(crate) fn shape(random: &mut Random) -> (Shape, DQuat) {
    let size = 3.0 * 10_f64.powf(random.within(-2.0, 0.0));
    let turn = DQuat::from_axis_angle(random.vector().normalize(), random.within(0.0, 6.0));
    let shape = match random.below(2) {
        0 => Sphere::new(size).unwrap().into(),
        _ => Cuboid::new(size * (DVec3::ONE + 0.9 * random.vector()))
            .unwrap()
            .into(),
    };
    (shape, turn)
}

#[test]
fn casts_and_overlaps_find_what_brute_force_finds() {
    let rounds = std::env::var("WORLDS").map_or(6, |worlds| worlds.parse().unwrap());
    for crowd in Crowd::ALL {
        let (mut hits, mut overlapped, mut casts) = (0, 0, 0);
        for round in 0..rounds {
            let mut random = Random::seeded(2000 * round + crowd as u64);
            let world = world(crowd, &mut random);
            let places: Vec<DVec3> = all(&world).map(|(_, _, pose)| pose.position).collect();
            for _ in 0..40 {
                let (shape, turn) = shape(&mut random);
                let from = places[random.below(places.len())] + 3.0 * random.vector();
                let pose = Pose::new(from, turn);
                let motion = 10_f64.powf(random.within(-2.0, 1.0)) * random.vector();
                let filter = QueryFilter::default();

                let mut expected: Vec<(BodyId, f64)> = Vec::new();
                let mut first: Option<(f64, BodyId)> = None;
                for (id, other, other_pose) in all(&world) {
                    let depth = overlap(&shape, &pose, other, &other_pose);
                    expected.extend(depth.map(|found| (id, -found.depth)));
                    let far = from.abs().max(other_pose.position.abs()).max_element();
                    let touch = TOUCH * (shape.max_dist() + other.max_dist() + far);
                    let length = motion.length();
                    let fraction = crossing(&shape, &pose, other, &other_pose, motion)
                        .filter(|met| (met.enter.fraction - 1.0) * length <= touch)
                        .filter(|met| met.leave * length >= -touch)
                        .filter(|met| {
                            // In touch as it starts, it must come nearer: who met long before and
                            // does not overlap any more is about to part.
                            let enter = &met.enter;
                            let closing = -motion.dot(enter.normal);
                            let nearer = closing > 0.0 && -enter.fraction * closing <= touch;
                            depth.is_some() || enter.fraction > 0.0 || nearer
                        })
                        .map(|met| met.enter.fraction.clamp(0.0, 1.0) * length);
                    if let Some(distance) = fraction
                        && first.is_none_or(|first| (distance, id) < first)
                    {
                        first = Some((distance, id));
                    }
                }
                let found = world.overlaps(&shape, &pose, &filter).unwrap();
                let told: Vec<_> = found.iter().map(|hit| (hit.body, hit.distance)).collect();
                assert_eq!(told, expected, "{crowd:?} {shape:?} {pose:?}");
                let hit = world.cast(&shape, &pose, motion, &filter).unwrap();
                let told = hit.map(|hit| (hit.distance, hit.body));
                assert_eq!(told, first, "{crowd:?} {shape:?} {pose:?} {motion:?}");
                hits += usize::from(hit.is_some());
                overlapped += usize::from(!found.is_empty());
                casts += 1;
            }
        }
        println!("{crowd:?}: {hits} hits, {overlapped} overlaps of {casts} casts");
        assert!(
            10 * hits > casts && hits < casts,
            "{crowd:?}: {hits} of {casts}"
        );
        assert!(
            overlapped > casts / 40,
            "{crowd:?}: {overlapped} of {casts}"
        );
    }
}

#[test]
fn bad_questions_are_refused() {
    let world = world(Crowd::Balls, &mut Random::seeded(1));
    let all = QueryFilter::default();
    let ball = Shape::from(Sphere::new(1.0).unwrap());
    let ray = Ray::new([0.0; 3], [1.0, 0.0, 0.0]);
    let refused = |answer: Result<(), QueryError>, field: &str| {
        let Err(QueryError::Value(
            ValueError::NotFinite { field: named, .. }
            | ValueError::TooSmall { field: named, .. }
            | ValueError::TooLarge { field: named, .. },
        )) = answer
        else {
            panic!("{field}: {answer:?}");
        };
        assert_eq!(named, field);
    };
    for (origin, direction, reach, field) in [
        (DVec3::NAN, DVec3::X, 1.0, "ray.origin"),
        (DVec3::splat(2e12), DVec3::X, 1.0, "ray.origin"),
        (DVec3::ZERO, DVec3::INFINITY, 1.0, "ray.direction"),
        (DVec3::ZERO, DVec3::ZERO, 1.0, "ray.direction.length"),
        (DVec3::ZERO, DVec3::X, -1.0, "reach"),
        (DVec3::ZERO, DVec3::X, f64::NAN, "reach"),
        (DVec3::ZERO, DVec3::X, f64::NEG_INFINITY, "reach"),
    ] {
        let ray = Ray::new(origin, direction);
        refused(world.cast_ray(&ray, reach, &all).map(drop), field);
        refused(world.cast_ray_all(&ray, reach, &all).map(drop), field);
        refused(world.cast_rays(&[ray], reach, &all).map(drop), field);
    }
    assert!(world.cast_ray(&ray, 0.0, &all).is_ok());
    let here = Pose::IDENTITY;
    let turned = Pose::new([0.0; 3], DQuat::from_xyzw(0.0, 0.0, 0.0, 2.0));
    for (pose, motion, field) in [
        (Pose::at(DVec3::NAN), DVec3::X, "pose.position"),
        (turned, DVec3::X, "pose.orientation.length"),
        (here, DVec3::NAN, "motion"),
        (here, DVec3::splat(1e13), "motion"),
        (here, DVec3::ZERO, "motion.length"),
    ] {
        refused(world.cast(&ball, &pose, motion, &all).map(drop), field);
        if !field.starts_with("motion") {
            refused(world.overlaps(&ball, &pose, &all).map(drop), field);
        }
    }
}

#[test]
fn an_empty_world_answers_nothing() {
    let world = CollisionWorld::default();
    let (all, ray) = (QueryFilter::default(), Ray::new([0.0; 3], [1.0, 0.0, 0.0]));
    let ball = Shape::from(Sphere::new(1.0).unwrap());
    assert_eq!(world.cast_ray(&ray, f64::INFINITY, &all), Ok(None));
    assert_eq!(world.cast_rays(&[], 1.0, &all), Ok(Vec::new()));
    assert_eq!(world.overlaps(&ball, &Pose::IDENTITY, &all), Ok(Vec::new()));
    assert_eq!(
        world.cast(&ball, &Pose::IDENTITY, [1.0, 0.0, 0.0], &all),
        Ok(None)
    );
}
