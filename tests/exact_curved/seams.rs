//! However long frames are, contacts are the same.

use feeler::{Body, CollisionWorld, Cuboid, Knots, Motion, Path, Sphere};
use glam::DVec3;

fn world(seed: u32) -> CollisionWorld {
    let mut world = CollisionWorld::default();
    let mut state = seed;
    let mut next = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state >> 8) / f64::from(1 << 24)
    };
    for index in 0..8 {
        let mut vector = || DVec3::new(next() - 0.5, next() - 0.5, next() - 0.5);
        let points: Vec<DVec3> = (0..4).map(|_| 6.0 * vector()).collect();
        let axis = vector();
        let path = Path::catmull_rom(points, Knots::Centripetal).unwrap();
        let motion = Motion::along(path, 2.0).unwrap().back_and_forth().unwrap();
        let body = if index % 2 == 0 {
            let motion = motion.spin(axis, 2.5).unwrap();
            Body::moving(Cuboid::new([0.6, 0.2, 0.1]).unwrap(), motion)
        } else {
            Body::moving(Sphere::new(0.3).unwrap(), motion)
        };
        world.insert(body).unwrap();
    }
    world
}

/// Times, places and normals of touches of pairs that were apart a moment before.
fn touches(seed: u32, dt: f64, frames: usize) -> Vec<(f64, DVec3, DVec3)> {
    let mut world = world(seed);
    let mut seen = Vec::new();
    for _ in 0..frames {
        let contacts = world.step(dt).unwrap();
        let told = contacts.iter().filter(|c| c.is_touch());
        seen.extend(told.map(|c| (c.time, c.point, c.normal)));
    }
    seen
}

#[test]
fn frames_of_any_length_tell_the_same_contacts() {
    let mut count = 0;
    for seed in 0..4 {
        // A long frame tells only the first of a pair; the short ones come to it too.
        let long = touches(seed, 4.0, 1);
        for rate in [24, 1000] {
            let short = touches(seed, 1.0 / f64::from(rate), 4 * rate as usize);
            for &(time, point, normal) in &long {
                let same = short.iter().any(|&(t, p, n)| {
                    (t - time).abs() < 1e-9 && p.distance(point) < 1e-7 && n.distance(normal) < 1e-6
                });
                assert!(same, "{seed} at {rate} Hz: {time} {point} of {short:?}");
            }
        }
        count += long.len();
    }
    assert!(count > 8, "{count}");
}
