//! Random bodies and casts.

use crate::oracle::Hull;
use feeler::{Cuboid, Polytope, Shape, Triangle};
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;

pub(crate) fn unit(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

pub(crate) fn signed(rng: &mut ChaCha8Rng) -> f64 {
    2.0 * unit(rng) - 1.0
}

pub(crate) fn index(rng: &mut ChaCha8Rng, count: usize) -> usize {
    (unit(rng) * count as f64) as usize
}

pub(crate) fn log(rng: &mut ChaCha8Rng, from: f64, to: f64) -> f64 {
    from * (to / from).powf(unit(rng))
}

pub(crate) fn direction(rng: &mut ChaCha8Rng) -> DVec3 {
    loop {
        let v = DVec3::new(signed(rng), signed(rng), signed(rng));
        if (0.1..1.0).contains(&v.length()) {
            return v.normalize();
        }
    }
}

pub(crate) fn turn(rng: &mut ChaCha8Rng) -> DQuat {
    match index(rng, 10) {
        // Many share the upright axis.
        8.. => DQuat::from_rotation_z(3.0 * signed(rng)),
        0..2 => DQuat::IDENTITY,
        2 => DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2),
        3 => DQuat::from_axis_angle(direction(rng), log(rng, 1e-16, 1e-3)),
        _ => DQuat::from_axis_angle(direction(rng), 3.0 * signed(rng)),
    }
}

/// A body both ways.
#[derive(Clone)]
pub(crate) struct Body {
    pub(crate) shape: Shape,
    pub(crate) hull: Hull,
}

pub(crate) fn cuboid(half: DVec3) -> Body {
    let cuboid = Cuboid::new(half).unwrap();
    Body {
        shape: cuboid.into(),
        hull: Hull::new(&cuboid.vertices()),
    }
}

pub(crate) fn triangle(corners: [DVec3; 3]) -> Body {
    let [a, b, c] = corners;
    Body {
        shape: Triangle::new(a, b, c).unwrap().into(),
        hull: Hull::new(&corners),
    }
}

pub(crate) fn polytope(points: &[DVec3]) -> Body {
    let polytope = Polytope::from_points(points.iter().copied()).unwrap();
    let hull = Hull::new(polytope.vertices());
    Body {
        shape: polytope.into(),
        hull,
    }
}

fn sphere_points(rng: &mut ChaCha8Rng, count: usize) -> Vec<DVec3> {
    (0..count).map(|_| direction(rng)).collect()
}

/// Bodies of all sorts, of sizes 0.05 to 3 m times `scale`.
pub(crate) fn random(rng: &mut ChaCha8Rng, scale: f64) -> Body {
    let size = scale * log(rng, 0.05, 3.0);
    match index(rng, 12) {
        0 => cuboid(DVec3::splat(0.5 * size)),
        1 => cuboid(size * DVec3::new(0.3 + unit(rng), 0.3 + unit(rng), 0.3 + unit(rng))),
        2 => cuboid(size * DVec3::new(1.0, unit(rng) + 0.1, 0.01)),
        3 => cuboid(size * DVec3::new(0.01, 0.01, 1.0)),
        4 => triangle([0, 1, 2].map(|_| size * direction(rng))),
        5 => triangle([
            DVec3::ZERO,
            size * DVec3::X,
            size * DVec3::new(0.3 * signed(rng), 1.0, 0.0),
        ]),
        6 => {
            // A box as a polytope.
            let half = 0.5 * size * DVec3::new(1.0, 0.2 + unit(rng), 0.2 + unit(rng));
            polytope(&Cuboid::new(half).unwrap().vertices())
        }
        7 => {
            // A prism: large faces, parallel edges.
            let sides = 3 + index(rng, 4);
            let height = size * log(rng, 0.01, 2.0);
            let points: Vec<DVec3> = (0..2 * sides)
                .map(|i| {
                    let (y, x) =
                        (std::f64::consts::TAU * (i % sides) as f64 / sides as f64).sin_cos();
                    size * DVec3::new(x, y, 0.0) + if i < sides { 0.0 } else { height } * DVec3::Z
                })
                .collect();
            polytope(&points)
        }
        8 => {
            // An octahedron.
            let points = [DVec3::X, DVec3::Y, DVec3::Z].map(|v| [size * v, -size * v]);
            polytope(points.as_flattened())
        }
        9 => {
            // A needle or a sheet.
            let squeeze = DVec3::new(1.0, log(rng, 0.01, 1.0), 0.01);
            let count = 4 + index(rng, 8);
            let points: Vec<DVec3> = sphere_points(rng, count)
                .iter()
                .map(|&p| size * squeeze * p)
                .collect();
            polytope(&points)
        }
        _ => {
            let count = 4 + index(rng, 9);
            let points: Vec<DVec3> = sphere_points(rng, count)
                .iter()
                .map(|&p| size * p)
                .collect();
            polytope(&points)
        }
    }
}
