//! Random bodies and settings.

use feeler::{
    Body, BroadPhase, Chords, Cuboid, Facing, Knots, Method, Motion, Overlaps, Path, Placement,
    Polytope, RayConfig, Refinement, Senders, Shape, Sphere, Triangle, WorldConfig,
};
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;

pub(crate) fn unit(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

/// A size between 1e-6 and 1e6.
fn size(rng: &mut ChaCha8Rng) -> f64 {
    10_f64.powf(12.0 * unit(rng) - 6.0)
}

fn vector(rng: &mut ChaCha8Rng) -> DVec3 {
    DVec3::from_array(std::array::from_fn(|_| 2.0 * unit(rng) - 1.0))
}

fn shape(rng: &mut ChaCha8Rng) -> Shape {
    let size = size(rng);
    match rng.next_u64() % 5 {
        0 => Sphere::new(size).expect("a sphere").into(),
        1 => {
            let half_extents = size * (vector(rng).abs() + 0.01);
            Cuboid::new(half_extents).expect("a box").into()
        }
        2 => {
            let [a, b, c] = std::array::from_fn(|_| size * vector(rng));
            Triangle::new(a, b, c).expect("a triangle").into()
        }
        3 => hull(rng, size).into(),
        _ => {
            // Triangles in another order than the hull's own.
            let hull = hull(rng, size);
            let turned = hull.triangles().iter().rev().map(|&[a, b, c]| [b, c, a]);
            let mesh = Polytope::from_triangles(hull.vertices().iter().copied(), turned);
            mesh.expect("a mesh").into()
        }
    }
}

pub(crate) fn hull(rng: &mut ChaCha8Rng, size: f64) -> Polytope {
    let count = 4 + rng.next_u64() % 40;
    let points: Vec<DVec3> = (0..count).map(|_| size * vector(rng)).collect();
    Polytope::from_points(points).expect("a hull")
}

fn motion(rng: &mut ChaCha8Rng) -> Motion {
    let size = size(rng);
    let count = 2 + (rng.next_u64() % 5) as usize;
    let vectors =
        |rng: &mut ChaCha8Rng| -> Vec<DVec3> { (0..count).map(|_| size * vector(rng)).collect() };
    let path = match rng.next_u64() % 7 {
        0 => {
            let place = Motion::fixed(size * vector(rng));
            return turning(rng, place.expect("a place"));
        }
        1 => {
            let flight = Motion::free(size * vector(rng), vector(rng));
            return turning(rng, flight.expect("a flight"));
        }
        2 => Path::line(size * vector(rng), size * vector(rng)),
        3 => Path::spline(vectors(rng), size * vector(rng), size * vector(rng)),
        4 => Path::catmull_rom(vectors(rng), Knots::Centripetal),
        5 => Path::bezier((0..7).map(|_| size * vector(rng))),
        _ => Path::spline_with_tangents(vectors(rng), vectors(rng)),
    };
    let mut motion =
        Motion::along(path.expect("a path"), size * (unit(rng) + 0.01)).expect("a motion");
    if rng.next_u64().is_multiple_of(2) {
        motion = motion.back_and_forth().expect("a shuttle");
        motion = motion.starting_at(size * unit(rng)).expect("a head start");
    }
    if rng.next_u64().is_multiple_of(2) {
        motion = motion.starting_after(unit(rng)).expect("a late start");
    }
    if rng.next_u64().is_multiple_of(3) {
        let facing = Facing {
            forward: vector(rng),
            up: vector(rng),
            world_up: vector(rng),
        };
        return motion.facing(facing).expect("a facing");
    }
    turning(rng, motion)
}

fn turning(rng: &mut ChaCha8Rng, motion: Motion) -> Motion {
    match rng.next_u64() % 3 {
        0 => motion.spin(vector(rng), unit(rng)).expect("a spin"),
        1 => {
            let spun = motion.spin_about(vector(rng), vector(rng), -unit(rng));
            spun.expect("a spin")
        }
        _ => motion,
    }
}

pub(crate) fn body(rng: &mut ChaCha8Rng) -> Body {
    let turn = DQuat::from_vec4(vector(rng).extend(unit(rng))).normalize();
    let body = Body::moving(shape(rng), motion(rng));
    match rng.next_u64() % 3 {
        0 => body,
        1 => body.oriented(turn),
        // As far from unit length as a body may be.
        _ => body.oriented(turn * 1.0005),
    }
}

pub(crate) fn config(rng: &mut ChaCha8Rng) -> WorldConfig {
    let either = |rng: &mut ChaCha8Rng| rng.next_u64().is_multiple_of(2);
    let mut rays = RayConfig::thesis(1 + rng.next_u32() % RayConfig::MAX_RAYS);
    // TOML's integers end there.
    rays.seed = rng.next_u64() >> 1;
    rays.curve_angle = 3.0 * unit(rng) + 0.1;
    rays.curve_points = 1 + rng.next_u32() % 1000;
    if either(rng) {
        rays.placement = Placement::Even;
    } else if either(rng) {
        rays.placement = Placement::Aimed;
    }
    if either(rng) {
        rays.senders = Senders::Both;
        rays.refinement = Refinement::AroundShortest;
    }
    if either(rng) {
        rays.overlaps = Overlaps::Report;
        rays.chords = Chords::Within(1e-9 + 0.1 * unit(rng));
    }
    WorldConfig {
        method: Method::Rays(rays),
        broad_phase: if either(rng) {
            BroadPhase::AllPairs
        } else {
            BroadPhase::default()
        },
    }
}
