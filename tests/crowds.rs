//! Worlds of many bodies: no pair is missed, nothing is allocated, and balls are
//! examined as any other pair.

#![allow(
    clippy::unwrap_used,
    reason = "planted input that is refused shall fail the test"
)]

#[path = "crowds/worlds.rs"]
mod worlds;

use feeler::{
    Body, BroadPhase, CollisionWorld, Contact, Cuboid, Groups, Motion, Polytope, Shape, Sphere,
    Triangle, WorldConfig, first_contact,
};
use glam::{DQuat, DVec3};
use worlds::{Crowd, Random};

fn world(broad_phase: BroadPhase) -> CollisionWorld {
    CollisionWorld::new(WorldConfig {
        broad_phase,
        ..WorldConfig::default()
    })
    .unwrap()
}

/// Hierarchies against all pairs, frame by frame, with bodies that come, go, are
/// moved and turned away: the same contacts to the bit, in the same order.
///
/// `WORLDS` sets how many worlds of each kind, `CROWD` names the only kind.
#[test]
fn hierarchies_miss_no_contact_that_all_pairs_have() {
    let rounds: u64 = std::env::var("WORLDS").map_or(6, |worlds| worlds.parse().unwrap());
    let only = std::env::var("CROWD").ok();
    let is_wanted = |crowd: &Crowd| {
        only.as_ref()
            .is_none_or(|name| *name == format!("{crowd:?}"))
    };
    assert!(Crowd::ALL.iter().any(is_wanted), "no such crowd: {only:?}");
    for crowd in Crowd::ALL.into_iter().filter(is_wanted) {
        let (mut told, mut looked) = (0, [0, 0]);
        for round in 0..rounds {
            let mut random = Random::seeded(100 * round + crowd as u64);
            let mut worlds = [BroadPhase::Bvh, BroadPhase::AllPairs].map(world);
            let count = 20 + random.below(150);
            let mut ids = Vec::new();
            for body in crowd.bodies(count, &mut random) {
                let [one, other] = worlds.each_mut().map(|w| w.insert(body.clone()).unwrap());
                assert_eq!(one, other);
                ids.push(one);
            }
            // Some worlds are calm: there pairs are found for several frames at once.
            let calm = round % 2 == 0;
            for frame in 0..if calm { 24 } else { 6 } {
                let dt = match random.below(8) {
                    0 => random.within(0.0, 0.05) + 1e-9,
                    _ => 1.0 / 60.0,
                };
                let by_contact = random.below(4) == 0;
                let found = worlds.each_mut().map(|world| -> Vec<Contact> {
                    if by_contact {
                        world.step_to_contact(dt).unwrap().contacts.to_vec()
                    } else {
                        world.step(dt).unwrap().to_vec()
                    }
                });
                assert_eq!(
                    found[0], found[1],
                    "{crowd:?}, round {round}, frame {frame}"
                );
                told += found[0].len();
                for (looked, world) in looked.iter_mut().zip(&worlds) {
                    *looked += world.stats().pairs;
                }
                let changes = if calm { random.below(4) } else { 8 };
                for new in crowd.bodies(count, &mut random).into_iter().take(changes) {
                    let index = random.below(ids.len());
                    let id = ids[index];
                    match random.below(4) {
                        0 => {
                            for world in &mut worlds {
                                world.remove(id).unwrap();
                            }
                            let again = worlds.each_mut().map(|w| w.insert(new.clone()).unwrap());
                            assert_eq!(again[0], again[1]);
                            ids[index] = again[0];
                        }
                        1 => {
                            for world in &mut worlds {
                                world.set_motion(id, new.motion().clone()).unwrap();
                            }
                        }
                        _ => {
                            let speed = if calm { 60.0 } else { 5.0 };
                            let velocity = speed * random.vector();
                            for world in &mut worlds {
                                world.set_velocity(id, velocity).unwrap();
                            }
                        }
                    }
                }
            }
        }
        println!("{crowd:?}: {told} contacts, {looked:?} pairs looked at");
        assert!(told as u64 > rounds, "lopsided, {crowd:?}: {told} contacts");
        assert!(looked[0] < looked[1], "{crowd:?}: {looked:?}");
    }
}

/// Two balls in a world take a short cut; without a world they do not.
#[test]
fn balls_are_examined_as_any_other_pair() {
    let mut random = Random::seeded(7);
    let (mut touches, mut overlaps) = (0, 0);
    for case in 0..20_000 {
        let scale = 10_f64.powf(random.within(-6.0, 6.0));
        let far = scale * 10_f64.powf(random.within(0.0, 4.0)) * random.vector();
        let radii = [0, 1].map(|_| scale * random.within(0.1, 1.0));
        let direction = random.vector().normalize();
        let apart = match case % 4 {
            0 => radii[0] + radii[1],
            1 => (radii[0] + radii[1]) * (1.0 + random.within(-1e-12, 1e-12)),
            _ => scale * random.within(0.0, 4.0),
        };
        let mut ball = |radius: f64, place: DVec3, fixed: bool| {
            let sphere = Sphere::new(radius).unwrap();
            if fixed {
                Body::fixed(sphere, place)
            } else {
                let velocity = 3.0 * scale * random.vector();
                Body::moving(sphere, Motion::free(place, velocity).unwrap())
            }
        };
        let a = ball(radii[0], far, false);
        let b = ball(radii[1], far + apart * direction, case % 3 == 0);
        let mut world = CollisionWorld::default();
        for body in [&a, &b] {
            world.insert(body.clone()).unwrap();
        }
        let alone = first_contact(&a, &b, 0.5, &world.config().method).unwrap();
        let together = world.step(0.5).unwrap().first().copied();
        assert_eq!(together.is_some(), alone.is_some(), "{a:?} {b:?}");
        if let (Some(one), Some(other)) = (together, alone) {
            assert_eq!(
                (one.fraction, one.point, one.normal, one.kind),
                (other.fraction, other.point, other.normal, other.kind),
                "{a:?} {b:?}"
            );
            if one.is_touch() {
                touches += 1;
            } else {
                overlaps += 1;
            }
        }
    }
    println!("{touches} touches, {overlaps} overlaps");
    assert!(touches > 1_000 && overlaps > 1_000, "{touches} {overlaps}");
}

/// Worlds leave out hulls that surely keep apart before they look at them closely; nobody does
/// without a world.
#[test]
fn hulls_are_examined_as_without_a_world() {
    let mut random = Random::seeded(8);
    let (mut touches, mut overlaps, mut apart) = (0, 0, 0);
    for case in 0..6_000 {
        let scale = 10_f64.powf(random.within(-4.0, 4.0));
        let far = match case % 3 {
            0 => DVec3::ZERO,
            _ => scale * 10_f64.powf(random.within(0.0, 5.0)) * random.vector(),
        };
        let mut hull = || {
            let points = (0..4 + random.below(12)).map(|_| scale * random.vector());
            Polytope::from_points(points.collect::<Vec<_>>()).ok()
        };
        let (Some(hull_a), Some(hull_b)) = (hull(), hull()) else {
            continue;
        };
        let way = random.vector().normalize();
        let turn = DQuat::from_axis_angle(random.vector().normalize(), 3.0);
        // Along the line between their centres, most of them grazing.
        let along = |hull: &Polytope, way: DVec3| {
            let vertices = hull.vertices().iter();
            let heights = vertices.map(|vertex| (turn * (*vertex - hull.centre())).dot(way));
            heights.fold(f64::NEG_INFINITY, f64::max)
        };
        let gap = match case % 4 {
            0 => 0.0,
            1 => scale * random.within(-1e-11, 1e-11),
            _ => scale * random.within(-0.5, 1.0),
        };
        let distance = along(&hull_a, -way) + along(&hull_b, way) + gap;
        let place = far + distance * way - turn * hull_a.centre();
        let closing = match case % 5 {
            0 => 0.0,
            1 => gap,
            _ => scale * random.within(-1.0, 2.0),
        };
        let beside = 0.3 * scale * random.vector();
        let velocity = beside - (closing + beside.dot(way)) * way;
        let motion = Motion::free(place, velocity).unwrap();
        let a = Body::moving(hull_a, motion).oriented(turn);
        let b = Body::fixed(hull_b.clone(), far - turn * hull_b.centre()).oriented(turn);
        let mut world = CollisionWorld::default();
        for body in [&a, &b] {
            world.insert(body.clone()).unwrap();
        }
        let alone = first_contact(&a, &b, 1.0, &world.config().method).unwrap();
        let together = world.step(1.0).unwrap().first().copied();
        assert_eq!(together.is_some(), alone.is_some(), "{case}: {a:?} {b:?}");
        match (together, alone) {
            (Some(one), Some(other)) => {
                assert_eq!(
                    (one.fraction, one.point, one.normal, one.kind),
                    (other.fraction, other.point, other.normal, other.kind),
                    "{case}: {a:?} {b:?}"
                );
                touches += u32::from(one.is_touch());
                overlaps += u32::from(!one.is_touch());
            }
            _ => apart += 1,
        }
    }
    println!("{touches} touches, {overlaps} overlaps, {apart} apart");
    let least = touches.min(overlaps).min(apart);
    assert!(least > 300, "{touches} {overlaps} {apart}");
}

#[test]
fn a_settled_frame_allocates_nothing() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1);
    pool.build().unwrap().install(|| {
        for crowd in [Crowd::Balls, Crowd::Boxes, Crowd::Hulls] {
            let mut world = world(BroadPhase::Bvh);
            let mut random = Random::seeded(3);
            for (number, body) in (0..).zip(crowd.bodies(2_000, &mut random)) {
                // Some stand, most as they would in a pile; the others fly where they have
                // flown for a while.
                let place = body.motion().position_after(0.0);
                let body = match number % 4 {
                    0 => Body::fixed(body.shape().clone(), place),
                    1 => body.oriented(DQuat::IDENTITY),
                    _ => body,
                };
                world.insert(body).unwrap();
            }
            // Stacks: faces on faces; some fall before the count begins and some within it.
            let cube = Cuboid::new([0.5, 0.5, 0.5]).unwrap();
            let brick = Polytope::from_points(cube.vertices()).unwrap();
            for number in 0..24 {
                let (x, z) = (
                    1e3 + 10.0 * f64::from(number),
                    if number < 20 { 1.1 } else { 1.7 },
                );
                for (y, shape) in [(0.0, Shape::from(cube)), (10.0, Shape::from(brick.clone()))] {
                    let falling = DVec3::new(0.0, 0.0, -3.0);
                    let falling = Motion::free([x, y + 0.3, z], falling).unwrap();
                    world
                        .insert(Body::fixed(shape.clone(), [x, y, 0.0]))
                        .unwrap();
                    world.insert(Body::moving(shape, falling)).unwrap();
                }
            }
            // Triangles, and hulls of many points, in each other all the time.
            let corners = [[-1.0, -0.6, 0.1], [1.2, 0.0, 0.0], [0.0, 0.9, 0.3]];
            let triangle = Shape::from(Triangle::new(corners[0], corners[1], corners[2]).unwrap());
            let points = (0..60).map(|_| random.vector().normalize());
            let large = Shape::from(Polytope::from_points(points).unwrap());
            for number in 0..24 {
                let x = -1e3 - 10.0 * f64::from(number);
                let turn = DQuat::from_axis_angle(random.vector().normalize(), 2.0);
                for (y, shape) in [(0.0, &triangle), (10.0, &large)] {
                    let place = DVec3::new(x, y, 0.0);
                    let drift = Motion::free(place, 0.1 * random.vector().normalize()).unwrap();
                    let drifting = Body::moving(shape.clone(), drift);
                    world.insert(Body::fixed(shape.clone(), place)).unwrap();
                    world.insert(drifting.oriented(turn)).unwrap();
                }
            }
            let mut contacts = 0;
            for _ in 0..100 {
                world.step(1.0 / 600.0).unwrap();
            }
            let counted = allocation_counter::measure(|| {
                for _ in 0..80 {
                    contacts += world.step(1.0 / 600.0).unwrap().len();
                }
            });
            assert_eq!(counted.count_total, 0, "{crowd:?}: {counted:?}");
            assert!(contacts > 10_000, "{contacts}");
        }
    });
}

#[test]
fn bodies_meet_only_those_of_their_groups() {
    let mut random = Random::seeded(5);
    let groups = |random: &mut Random| Groups::new(random.below(8) as u32, random.below(8) as u32);
    let bodies: Vec<_> = Crowd::Balls.bodies(300, &mut random);
    let bodies: Vec<_> = bodies
        .into_iter()
        .map(|body| body.in_groups(groups(&mut random)))
        .collect();
    let mut grouped = world(BroadPhase::Bvh);
    let mut all = world(BroadPhase::Bvh);
    for body in &bodies {
        grouped.insert(body.clone()).unwrap();
        all.insert(body.clone().in_groups(Groups::ALL)).unwrap();
    }
    let ids: Vec<_> = all.bodies().collect();
    let group = |id| bodies[ids.binary_search(&id).unwrap()].groups();
    let meets = |a, b| group(a).meets(group(b));
    let expected = all.step_where(1.0, meets).unwrap().to_vec();
    assert_eq!(grouped.step(1.0).unwrap(), expected);
    assert!(expected.len() > 50, "{}", expected.len());
    let mut everyone = world(BroadPhase::Bvh);
    for body in bodies {
        everyone.insert(body.in_groups(Groups::ALL)).unwrap();
    }
    let met = everyone.step(1.0).unwrap().len();
    assert!(met > expected.len() + 50, "{met} and {}", expected.len());
}
