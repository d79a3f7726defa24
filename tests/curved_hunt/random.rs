//! Random numbers.

use glam::DVec3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

pub(crate) struct Random(ChaCha8Rng);

impl Random {
    pub(crate) fn seeded(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    pub(crate) fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn within(&mut self, min: f64, max: f64) -> f64 {
        min + (max - min) * self.unit()
    }

    /// Log-uniform, between two powers of ten.
    pub(crate) fn decades(&mut self, min: f64, max: f64) -> f64 {
        10_f64.powf(self.within(min, max))
    }

    pub(crate) fn below(&mut self, count: u64) -> u64 {
        self.0.next_u64() % count
    }

    pub(crate) fn one_in(&mut self, count: u64) -> bool {
        self.below(count) == 0
    }

    /// In a cube of half-edge 1.
    pub(crate) fn vector(&mut self) -> DVec3 {
        let mut coordinate = || self.within(-1.0, 1.0);
        DVec3::new(coordinate(), coordinate(), coordinate())
    }

    pub(crate) fn direction(&mut self) -> DVec3 {
        loop {
            let vector = self.vector();
            if (0.1..=1.0).contains(&vector.length()) {
                return vector.normalize();
            }
        }
    }
}
