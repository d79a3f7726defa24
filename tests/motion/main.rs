//! Motions: journeys, spin, facing, and what worlds make of them.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "helpers outside the test functions build from input that is fine, or fail the test"
)]
#![allow(clippy::float_cmp, reason = "ends and starts are met bit for bit")]

mod doors;
mod facing;
mod journeys;
mod spin;
mod worlds;

use feeler::{Knots, Path};
use glam::DVec3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;

fn unit(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

fn within(rng: &mut ChaCha8Rng, min: f64, max: f64) -> f64 {
    min + (max - min) * unit(rng)
}

fn vector(rng: &mut ChaCha8Rng) -> DVec3 {
    DVec3::new(
        within(rng, -1.0, 1.0),
        within(rng, -1.0, 1.0),
        within(rng, -1.0, 1.0),
    )
}

/// A closed path of a few metres.
fn ring(rng: &mut ChaCha8Rng) -> Path {
    let mut points: Vec<DVec3> = (0..5).map(|_| 3.0 * vector(rng)).collect();
    points.push(points[0]);
    Path::catmull_rom(points, Knots::Centripetal).unwrap()
}
