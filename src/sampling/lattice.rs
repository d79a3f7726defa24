//! Points spread evenly over a square.

use crate::sampling::UnitStream;
use glam::DVec2;

/// `count` points spread evenly over the square `[−1, 1)²`, the first in its middle.
///
/// The others follow the R2 sequence, which fills any number of points without
/// gaps or clusters; the seed shifts it as a whole. A longer lattice begins with
/// the shorter one's points.
///
/// Source: Roberts, *The Unreasonable Effectiveness of Quasirandom Sequences*
/// (2018); Cranley and Patterson (1976) for the shift.
///
/// ```
/// use feeler::sampling::square_lattice;
/// use glam::DVec2;
///
/// let points = square_lattice(100, 7);
/// assert_eq!(points[0], DVec2::ZERO);
/// assert_eq!(points[..10], square_lattice(10, 7));
/// ```
#[must_use]
pub fn square_lattice(count: u32, seed: u64) -> Vec<DVec2> {
    /// `1/g` and `1/g²` for the plastic number `g`, the real root of `g³ = g + 1`.
    const STEP: DVec2 = DVec2::new(0.754_877_666_246_692_7, 0.569_840_290_998_053_3);
    let mut stream = UnitStream::new(seed);
    let mut at = DVec2::new(stream.next(), stream.next());
    (0..count)
        .map(|index| {
            if index == 0 {
                return DVec2::ZERO;
            }
            at += STEP;
            at -= at.floor();
            2.0 * at - 1.0
        })
        .collect()
}
