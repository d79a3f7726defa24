//! Tiny laps, cusps and fast rotors beside others that they do not reach.

use feeler::{
    Body, CollisionWorld, Cuboid, Facing, Knots, Method, Motion, Path, Sphere, closest_points,
    first_contact,
};
use glam::DVec3;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// How many steps from plane to plane a frame of `dt` seconds takes, and how many contacts it tells.
fn steps(bodies: [Body; 2], dt: f64) -> (usize, usize) {
    let mut world = CollisionWorld::default();
    for body in bodies {
        world.insert(body).unwrap();
    }
    let contacts = world.step(dt).unwrap().len();
    assert_eq!(world.stats().undecided, 0);
    (world.stats().stretches, contacts)
}

fn lap(speed: f64) -> Motion {
    let path = Path::line([0.0; 3], [1e-6, 0.0, 0.0]).unwrap();
    Motion::along(path, speed)
        .unwrap()
        .back_and_forth()
        .unwrap()
}

const NOSE_FIRST: Facing = Facing {
    forward: DVec3::X,
    up: DVec3::Z,
    world_up: DVec3::Z,
};

/// A million laps in the frame, 0.3 m from the other.
#[test]
fn laps_of_a_micrometre_are_passed_over() {
    let cube = Cuboid::new([0.5; 3]).unwrap();
    let turned = lap(2.0).spin([0.0, 0.0, 1.0], 0.2).unwrap();
    let facing = lap(2.0).facing(NOSE_FIRST).unwrap();
    for motion in [lap(2.0), turned, facing] {
        let rotor = Motion::free([0.0, 0.0, 1.3], [1e-3, 0.0, 0.0]).unwrap();
        let rotor = rotor.spin([0.0, 0.0, 1.0], 0.1).unwrap();
        let points = [[0.0, 0.0, 1.3], [0.1, 0.2, 1.4], [0.3, 0.1, 1.3]];
        let curve = Path::catmull_rom(points, Knots::Uniform).unwrap();
        let curve = Motion::along(curve, 0.1).unwrap();
        for other in [rotor, curve] {
            let bodies = [motion.clone(), other].map(|motion| Body::moving(cube, motion));
            let (steps, contacts) = steps(bodies, 1.0);
            assert_eq!(contacts, 0);
            assert!(steps < 100, "{steps}");
        }
    }
}

/// Catmull–Rom splines through points of one line turn round in cusps, or in what rounding makes of them: a body
/// that faces its way turns at once there, or faster than time has digits.
#[test]
fn who_turns_round_in_cusps_is_decided() {
    let bar = Cuboid::new([0.5, 0.02, 0.02]).unwrap();
    let mut rng = ChaCha8Rng::seed_from_u64(11);
    let mut number = |from: f64, to: f64| rng.random_range(from..to);
    for case in 0..400 {
        let way = DVec3::from_array([(); 3].map(|()| number(-1.0, 1.0)));
        let points = [(); 7].map(|()| number(-1.0, 1.0) * way);
        let path = Path::catmull_rom(points, Knots::Uniform).unwrap();
        let facing = Motion::along(path, 2.0)
            .unwrap()
            .facing(NOSE_FIRST)
            .unwrap();
        let beside = [(); 3].map(|()| number(-0.8, 0.8));
        let other = Motion::fixed(beside).unwrap();
        let other = other.spin([0.3, -0.7, -0.6], number(-5.0, 5.0)).unwrap();
        let bodies = [facing, other].map(|motion| Body::moving(bar, motion));
        let found = first_contact(&bodies[0], &bodies[1], 1.5, &Method::Exact);
        assert!(found.is_ok(), "{case}: {found:?}");
    }
}

/// Boxes that spin 16 000 times in the frame beside others that they never reach: a plane beside what they fill says
/// so at once, but where another lies in a hollow of that.
#[test]
fn rotors_are_not_followed_turn_for_turn_where_they_do_not_reach() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let mut number = |from: f64, to: f64| rng.random_range(from..to);
    let (mut unreached, mut quick) = (0, 0);
    for _ in 0..120 {
        let halves = [(); 2].map(|()| Cuboid::new([(); 3].map(|()| number(0.1, 0.6))).unwrap());
        let axis = [(); 3].map(|()| number(-1.0, 1.0));
        let rotor = Motion::fixed([0.0; 3]).unwrap().spin(axis, 1e5).unwrap();
        let rotor = Body::moving(halves[0], rotor);
        let beside = Body::fixed(halves[1], [(); 3].map(|()| number(-1.0, 1.0)));
        let apart = |index: i32| {
            let time = f64::from(index) * 1.01e-6;
            let poses = [&rotor, &beside].map(|body| body.pose_after(time));
            let closest = closest_points(rotor.shape(), &poses[0], beside.shape(), &poses[1]);
            closest.is_some_and(|closest| closest.distance > 0.02)
        };
        if (0..64).all(apart) {
            unreached += 1;
            quick += usize::from(steps([rotor.clone(), beside.clone()], 1.0).0 < 300);
        }
    }
    assert!(unreached > 20, "{unreached}");
    assert!(10 * quick >= 9 * unreached, "{quick} of {unreached}");
}

/// A bar that sweeps through a flat disc, and a ball that comes down on it.
#[test]
fn a_ball_falls_on_a_rotor() {
    let bar = Cuboid::new([1.0, 0.05, 0.05]).unwrap();
    let rotor = Motion::fixed([0.0; 3]).unwrap();
    let rotor = Body::moving(bar, rotor.spin([0.0, 0.0, 1.0], 1e6).unwrap());
    let ball = Sphere::new(0.1).unwrap();
    let fall = Motion::free([0.5, 0.0, 1.0], [0.0, 0.0, -1.0]).unwrap();
    let falling = Body::moving(ball, fall);
    let touch = first_contact(&falling, &rotor, 1.0, &Method::Exact);
    let touch = touch.unwrap().unwrap();
    // The bar comes by every π microseconds.
    let late = touch.fraction - 0.85;
    assert!((-1e-12..4e-6).contains(&late), "{late:e}");
}
