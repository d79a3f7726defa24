//! Seeded point sets.

use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

pub(crate) struct Source(ChaCha8Rng);

impl Source {
    pub(crate) fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    /// Uniform in [0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform in [−1, 1).
    pub(crate) fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }

    pub(crate) fn below(&mut self, bound: u64) -> u64 {
        self.0.next_u64() % bound
    }

    pub(crate) fn in_cube(&mut self) -> DVec3 {
        DVec3::new(self.signed(), self.signed(), self.signed())
    }

    pub(crate) fn on_sphere(&mut self) -> DVec3 {
        loop {
            let point = self.in_cube();
            let length = point.length();
            if length > 0.1 && length < 1.0 {
                return point / length;
            }
        }
    }

    pub(crate) fn rotation(&mut self) -> DQuat {
        DQuat::from_axis_angle(self.on_sphere(), 3.0 * self.unit())
    }

    pub(crate) fn shuffled<T>(&mut self, mut items: Vec<T>) -> Vec<T> {
        for last in (1..items.len()).rev() {
            let other = self.below(last as u64 + 1) as usize;
            items.swap(last, other);
        }
        items
    }
}

pub(crate) fn cube() -> Vec<DVec3> {
    (0..8)
        .map(|i| {
            let side = |axis: u32| if i >> axis & 1 == 1 { 1.0 } else { -1.0 };
            DVec3::new(side(0), side(1), side(2))
        })
        .collect()
}

/// Two rings of `n` points on a cylinder.
pub(crate) fn cylinder(n: u32) -> Vec<DVec3> {
    (0..n)
        .flat_map(|i| {
            let (y, x) = (std::f64::consts::TAU * f64::from(i) / f64::from(n)).sin_cos();
            [DVec3::new(x, y, -1.0), DVec3::new(x, y, 1.0)]
        })
        .collect()
}
