//! Random numbers that never change.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

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

/// The `srand` and `rand` that the thesis's program was compiled with: 15 bits
/// of a linear congruential generator, of Microsoft's C runtime.
///
/// The thesis does not name it; the points it prints do: its first point with
/// seed 10 lies at 71/32767 and 16899/32767, this generator's first numbers.
pub(crate) struct ThesisStream(u32);

impl ThesisStream {
    pub(crate) fn new(seed: u64) -> Self {
        // `srand` takes an `unsigned int`.
        Self(seed as u32)
    }

    /// The next number, in `[0, 1]`.
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(214_013).wrapping_add(2_531_011);
        f64::from(self.0 >> 16 & 0x7fff) / f64::from(0x7fff)
    }
}
