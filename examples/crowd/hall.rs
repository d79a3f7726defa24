//! Balls in a box whose walls throw them back.

use feeler::{Body, BodyId, CollisionWorld, Motion, Sphere};
use glam::DVec3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use std::error::Error;
use std::f64::consts::PI;

/// Share of the box that the balls fill.
const FILLED: f64 = 0.05;

/// A world of balls, and what the caller of it keeps to throw them back.
pub(crate) struct Hall {
    pub(crate) world: CollisionWorld,
    /// Half the edge of the box, in metres.
    half: f64,
    balls: Vec<Ball>,
}

struct Ball {
    id: BodyId,
    position: DVec3,
    velocity: DVec3,
}

fn unit(random: &mut ChaCha8Rng) -> f64 {
    (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

/// Evenly in the cube from −1 to 1.
fn vector(random: &mut ChaCha8Rng) -> DVec3 {
    let mut coordinate = || 2.0 * unit(random) - 1.0;
    DVec3::new(coordinate(), coordinate(), coordinate())
}

/// Of unit length, evenly over all directions.
fn direction(random: &mut ChaCha8Rng) -> DVec3 {
    loop {
        let vector = vector(random);
        if (0.1..=1.0).contains(&vector.length()) {
            return vector.normalize();
        }
    }
}

impl Hall {
    /// `count` balls of 0.3 m to 0.7 m, at up to 10 m/s.
    pub(crate) fn new(count: usize) -> Result<Self, Box<dyn Error + Send + Sync>> {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let radii: Vec<f64> = (0..count).map(|_| 0.3 + 0.4 * unit(&mut random)).collect();
        let volume: f64 = radii.iter().map(|r| 4.0 / 3.0 * PI * r.powi(3)).sum();
        let half = 0.5 * (volume / FILLED).cbrt();
        let mut world = CollisionWorld::default();
        let mut balls = Vec::with_capacity(count);
        for radius in radii {
            let position = half * vector(&mut random);
            let velocity = 10.0 * unit(&mut random) * direction(&mut random);
            let motion = Motion::free(position, velocity)?;
            balls.push(Ball {
                id: world.insert(Body::moving(Sphere::new(radius)?, motion))?,
                position,
                velocity,
            });
        }
        Ok(Self { world, half, balls })
    }

    /// Turns round those that have flown out of the box within the last `dt` seconds.
    pub(crate) fn reflect(&mut self, dt: f64) -> Result<(), Box<dyn Error + Send + Sync>> {
        for ball in &mut self.balls {
            ball.position += dt * ball.velocity;
            let outside = ball.position.abs().cmpgt(DVec3::splat(self.half));
            let inwards = DVec3::select(outside, -ball.position.signum(), ball.velocity.signum());
            let velocity = ball.velocity.abs() * inwards;
            if velocity != ball.velocity {
                ball.velocity = velocity;
                self.world.set_velocity(ball.id, velocity)?;
            }
        }
        Ok(())
    }
}
