//! Frame rates, sizes, and the ends of every domain.

use crate::support::{Kind, Random, flying, free, world_with};
use feeler::{
    Body, BroadPhase, CollisionWorld, Contact, Cuboid, Motion, Path, RayConfig, Sphere, Spline,
};
use glam::DVec3;

#[test]
fn straight_touches_do_not_depend_on_the_frame_rate() {
    let mut random = Random::seeded(21);
    let (mut hits, mut worst) = (0, 0.0_f64);
    for case in 0..120 {
        let kinds = [0, 1].map(|i| Kind::ALL[(case + i * (case / 6)) % 6]);
        let shapes = kinds.map(|kind| random.shape(kind, 1.0));
        let direction = random.direction();
        let start = -3.0 * direction + 0.8 * random.vector();
        let carried = random.vector();
        let bodies = [
            flying(&shapes[0], start, 4.0 * direction + carried).oriented(random.turn()),
            flying(&shapes[1], [0.0; 3], carried).oriented(random.turn()),
        ];
        let first = |rate: u32| -> Option<Contact> {
            let mut world = CollisionWorld::default();
            for body in &bodies {
                world.insert(body.clone()).unwrap();
            }
            (0..rate)
                .flat_map(|_| world.step(1.0 / f64::from(rate)).unwrap().to_vec())
                .find(Contact::is_touch)
        };
        let whole = first(1);
        hits += usize::from(whole.is_some());
        for rate in [24, 1000] {
            match (whole, first(rate)) {
                (Some(whole), Some(cut)) => {
                    let error = (whole.time - cut.time).abs();
                    worst = worst.max(error);
                    assert!(error < 1e-9, "{kinds:?} {rate}: {error:e}");
                    if kinds.contains(&Kind::Ball) {
                        assert!(whole.point.distance(cut.point) < 1e-6, "{kinds:?}");
                    }
                }
                (None, None) => {}
                (whole, cut) => panic!("{kinds:?} {rate}: {whole:?} {cut:?}"),
            }
        }
    }
    println!("{hits} hits, times apart by {worst:e} s at worst");
    assert!((50..=118).contains(&hits), "lopsided: {hits}");
}

/// The same calls give the same bits, and bodies that have nothing to do with a
/// pair change nothing about its contact.
#[test]
fn bystanders_change_nothing() {
    let mut random = Random::seeded(22);
    for case in 0..100 {
        let kinds = [0, 1].map(|i| Kind::ALL[(case + i * (case / 6)) % 6]);
        let shapes = kinds.map(|kind| random.shape(kind, 1.0));
        let direction = random.direction();
        let pair = [
            flying(&shapes[0], -3.0 * direction, 4.0 * direction).oriented(random.turn()),
            Body::fixed(shapes[1].clone(), 0.3 * random.vector()).oriented(random.turn()),
        ];
        let others: Vec<_> = (0..20)
            .map(|_| {
                let kind = Kind::ALL[random.below(6)];
                let place = 1e3 * random.direction();
                flying(&random.shape(kind, 1.0), place, random.vector())
            })
            .collect();
        let run = |before: usize, between: usize| {
            let mut world = CollisionWorld::default();
            let mut insert = |body: &Body| world.insert(body.clone()).unwrap();
            others[..before].iter().for_each(|body| {
                insert(body);
            });
            let a = insert(&pair[0]);
            others[before..between].iter().for_each(|body| {
                insert(body);
            });
            insert(&pair[1]);
            others[between..].iter().rev().for_each(|body| {
                insert(body);
            });
            let mut found = Vec::new();
            for _ in 0..10 {
                world.step(0.1).unwrap();
                found.extend(world.contacts_of(a).map(|c| {
                    let bits = |v: DVec3| v.to_array().map(f64::to_bits);
                    (
                        c.time.to_bits(),
                        bits(c.point),
                        bits(c.normal),
                        c.feature_a,
                        c.feature_b,
                    )
                }));
            }
            found
        };
        let alone = run(0, 0);
        assert!(!alone.is_empty() || case % 6 > 1);
        for (before, between) in [(0, 0), (20, 20), (7, 7), (3, 11)] {
            assert_eq!(run(before, between), alone, "{kinds:?}");
        }
    }
}

/// Allowed, however odd: every number is finite afterwards.
#[test]
fn the_ends_of_the_domains_neither_panic_nor_give_nan() {
    let mut random = Random::seeded(23);
    let mut contacts = 0;
    let rounds = std::env::var("CASTS").map_or(150, |casts| casts.parse().unwrap());
    for _ in 0..rounds {
        let rays = RayConfig {
            rays: 1 + random.below(120) as u32,
            ..RayConfig::default()
        };
        let mut world = world_with(rays, BroadPhase::default());
        let coordinate = [1.0, 1e3, 1e12][random.below(3)];
        let mut ids = Vec::new();
        for _ in 0..10 {
            let size = [1e-9, 1e-3, 1.0, 1e3, 1e9][random.below(5)];
            let place = coordinate * random.vector() * random.decades(-3.0, 0.0);
            let shape = match random.below(4) {
                0 => Sphere::new(size).unwrap().into(),
                1 => Cuboid::new([size, 1e-9, 1e9]).unwrap().into(),
                2 => Cuboid::new(DVec3::splat(size)).unwrap().into(),
                _ => {
                    let kind = Kind::ALL[3 + random.below(3)];
                    random.shape(kind, size.max(1e-6))
                }
            };
            let speed = [0.0, 1e-12, 1.0, 1e4, 1e12][random.below(5)];
            let motion = match random.below(4) {
                0 => Motion::fixed(place).unwrap(),
                1 => free(place, speed * random.vector()),
                2 => {
                    let to = place + coordinate * 1e-3 * random.vector();
                    let path = Path::line(place, to.clamp_length_max(1e12)).unwrap();
                    Motion::along(path, speed.max(1e-12)).unwrap()
                }
                _ => {
                    let points: Vec<_> =
                        (0..4).map(|_| coordinate * random.vector() * 0.5).collect();
                    let tangents: Vec<_> = (0..4)
                        .map(|_| coordinate * random.vector() * random.decades(-9.0, 0.0))
                        .collect();
                    let path = Path::from(Spline::with_tangents(points, tangents).unwrap());
                    Motion::along(path, speed.max(1e-12)).unwrap()
                }
            };
            let body = Body::moving(shape, motion).oriented(random.turn());
            ids.push(world.insert(body).unwrap());
        }
        for _ in 0..4 {
            let dt = [1e-12, 1e-3, 1.0, 1e3, 1e9][random.below(5)];
            if random.below(2) == 0 {
                let _left = world.step(dt).is_err();
            } else {
                let _left = world.step_to_contact(dt).is_err();
            }
            for c in world.contacts() {
                contacts += 1;
                assert!(c.point.is_finite() && c.time.is_finite(), "{c:?}");
                assert!((c.normal.length() - 1.0).abs() < 1e-9, "{c:?}");
                assert!((0.0..=1.0).contains(&c.fraction), "{c:?}");
            }
            for &id in &ids {
                assert!(world.pose(id).unwrap().position.is_finite());
                assert!(world.velocity(id).unwrap().is_finite());
            }
        }
    }
    assert!(contacts > rounds, "{contacts}");
}
