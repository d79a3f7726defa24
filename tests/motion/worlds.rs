//! Spinning, facing and looping bodies in worlds.

use crate::{ring, unit, vector, within};
use feeler::{
    Body, BroadPhase, CollisionWorld, Cuboid, Facing, Method, Motion, RayConfig, Sphere,
    WorldConfig, first_contact,
};
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

fn bar() -> Cuboid {
    Cuboid::new([2.0, 0.05, 0.05]).unwrap()
}

#[test]
fn a_world_knows_how_its_bodies_are_turned() {
    let mut world = CollisionWorld::default();
    let start = DQuat::from_rotation_x(0.3);
    let spun = Motion::fixed([0.0; 3])
        .and_then(|motion| motion.spin_about([2.0, 0.0, 0.0], [0.0, 0.0, 1.0], 3.0))
        .unwrap();
    let id = world
        .insert(Body::moving(bar(), spun.clone()).oriented(start))
        .unwrap();
    for _ in 0..100 {
        world.step(0.1).unwrap();
        let want = spun.pose_after(world.time(), start);
        let got = world.pose(id).unwrap();
        assert!(got.position.distance(want.position) < 1e-14);
        assert!(got.orientation.abs_diff_eq(want.orientation, 1e-15));
    }
    // It spins on from where it is, with another velocity.
    let before = world.pose(id).unwrap();
    let hub = before.point(DVec3::new(2.0, 0.0, 0.0));
    world.set_velocity(id, [0.0, 1.0, 0.0]).unwrap();
    assert!(world.pose(id).unwrap().position.distance(before.position) < 1e-14);
    assert!(
        world
            .pose(id)
            .unwrap()
            .orientation
            .dot(before.orientation)
            .abs()
            > 1.0 - 1e-15
    );
    world.step(1.0).unwrap();
    let after = world.pose(id).unwrap();
    let moved = after.point(DVec3::new(2.0, 0.0, 0.0)) - hub;
    assert!(moved.distance(DVec3::Y) < 1e-13);
    let turned = before.orientation.angle_between(after.orientation);
    assert!((turned - 3.0).abs() < 1e-12, "{turned}");
}

/// What a discrete test at frames' ends lets through.
#[test]
fn a_spinning_bar_does_not_pass_through_a_ball() {
    let about = DVec3::new(1.0, 1.0, 0.0).normalize() * 1.5;
    for rate in [3.0, 6.0, 31.4] {
        let motion = Motion::fixed([0.0; 3]).and_then(|m| m.spin([0.0, 0.0, 1.0], rate));
        let bar = Body::moving(bar(), motion.unwrap());
        let ball = Body::fixed(Sphere::new(0.1).unwrap(), about);
        // asin((0.1 + 0.05)/1.5): where the bar's long side meets the ball.
        let want = (std::f64::consts::FRAC_PI_4 - 0.1_f64.asin()) / rate;
        let rays = Method::Rays(RayConfig::default());
        for method in [Method::Exact, rays] {
            let found = first_contact(&bar, &ball, 1.0, &method).unwrap().unwrap();
            assert!(
                (found.fraction - want).abs() < 2e-2 / rate,
                "{rate}: {found:?}"
            );
            for broad_phase in [BroadPhase::AllPairs, BroadPhase::default()] {
                let config = WorldConfig {
                    method,
                    broad_phase,
                };
                let mut world = CollisionWorld::new(config).unwrap();
                world.insert(ball.clone()).unwrap();
                world.insert(bar.clone()).unwrap();
                let contacts = world.step(1.0).unwrap();
                assert_eq!(contacts.len(), 1, "{rate}, {config:?}");
                assert_eq!(contacts[0].fraction, found.fraction);
            }
        }
    }
}

/// Bodies that overlap at some sampled moment must have been met by then: no broad phase,
/// envelope or early-out may have hidden them.
#[test]
fn no_bound_hides_a_body_that_turns() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut met = 0;
    for case in 0..60 {
        let turn =
            |rng: &mut ChaCha8Rng| DQuat::from_axis_angle(vector(rng).normalize(), unit(rng));
        let path = ring(&mut rng);
        let motion = Motion::along(path.clone(), within(&mut rng, 0.5, 3.0))
            .and_then(Motion::looping)
            .and_then(|motion| motion.starting_at(unit(&mut rng) * path.length()))
            .unwrap();
        let motion = if case % 2 == 0 {
            motion.spin_about(
                vector(&mut rng),
                vector(&mut rng),
                within(&mut rng, -9.0, 9.0),
            )
        } else {
            motion.facing(Facing {
                forward: vector(&mut rng),
                up: vector(&mut rng),
                world_up: vector(&mut rng),
            })
        };
        let half = Cuboid::new([1.0, 0.1, 0.1]).unwrap();
        let a = Body::moving(half, motion.unwrap()).oriented(turn(&mut rng));
        let b = Body::fixed(Sphere::new(0.7).unwrap(), 3.0 * vector(&mut rng));
        let mut world = CollisionWorld::default();
        world.insert(a.clone()).unwrap();
        world.insert(b.clone()).unwrap();
        let first = (0..40)
            .find_map(|_| {
                world
                    .step(0.25)
                    .unwrap()
                    .first()
                    .map(|contact| contact.time)
            })
            .unwrap_or(f64::INFINITY);
        // Distance of the ball's centre to the bar, in the bar's frame.
        let gap = |elapsed: f64| {
            let local = a
                .pose_after(elapsed)
                .local_point(b.pose_after(elapsed).position);
            let outside = (local.abs() - DVec3::new(1.0, 0.1, 0.1)).max(DVec3::ZERO);
            outside.length() - 0.7
        };
        let sampled = (0..20_000)
            .map(|step| 10.0 * f64::from(step) / 20_000.0)
            .find(|&elapsed| gap(elapsed) < 0.0);
        if let Some(sampled) = sampled {
            met += 1;
            assert!(
                first <= sampled + 0.02,
                "case {case}: {first}, not {sampled}"
            );
        }
        if first.is_finite() {
            assert!(
                gap(first) < 0.05,
                "case {case}: ghost at {first}, {}",
                gap(first)
            );
        }
    }
    assert!((15..=55).contains(&met), "lopsided: {met} of 60 meet");
}
