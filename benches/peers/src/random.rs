//! Random numbers that stay the same from release to release.

use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

pub struct Random(ChaCha8Rng);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    pub fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Each coordinate in `low..high`.
    pub fn vector(&mut self, low: f64, high: f64) -> DVec3 {
        DVec3::new(
            self.between(low, high),
            self.between(low, high),
            self.between(low, high),
        )
    }

    /// Evenly over all directions.
    pub fn direction(&mut self) -> DVec3 {
        loop {
            let vector = self.vector(-1.0, 1.0);
            if (0.01..1.0).contains(&vector.length_squared()) {
                return vector.normalize();
            }
        }
    }

    /// Evenly over all orientations.
    pub fn orientation(&mut self) -> DQuat {
        loop {
            let [x, y, z, w] = [(); 4].map(|()| self.between(-1.0, 1.0));
            let quaternion = DQuat::from_xyzw(x, y, z, w);
            if (0.01..1.0).contains(&quaternion.length_squared()) {
                return quaternion.normalize();
            }
        }
    }
}

/// The nearest number that `f32` has as well.
pub fn single(value: f64) -> f64 {
    f64::from(value as f32)
}

/// [`single`], coordinate by coordinate.
pub fn single_vector(vector: DVec3) -> DVec3 {
    vector.as_vec3().as_dvec3()
}
