//! Random numbers that never change.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// An endless stream of numbers, uniform in `[0, 1)`.
pub(crate) struct UnitStream(ChaCha8Rng);

impl UnitStream {
    pub(crate) fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    /// The next number: the upper 53 bits of a word, so that every value is a
    /// multiple of 2⁻⁵³ and 1 is never reached.
    pub(crate) fn next(&mut self) -> f64 {
        const STEP: f64 = 1.0 / (1_u64 << 53) as f64;
        (self.0.next_u64() >> 11) as f64 * STEP
    }
}
