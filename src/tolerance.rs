//! Every tolerance and every limit of the crate: unit, value, why, and what
//! breaks if it moves.
//!
//! Limits bound what the doors let in. Between them every kernel works without
//! overflow, and a length squared or multiplied by a length keeps all its bits.

/// Shortest length of a shape, of a path's piece or of a body's extent, in metres.
///
/// A nanometre. Far above where squares of squares underflow (1e-77), far below
/// anything a simulator calls a body. Lower it and polytopes lose the digits
/// that tell their faces apart.
pub const MIN_LENGTH: f64 = 1e-9;

/// Largest coordinate or length of a shape in its own frame, in metres.
///
/// At 1e9 m neighbouring `f64` are 1e-7 m apart.
pub const MAX_LENGTH: f64 = 1e9;

/// Largest coordinate of a body or of a path's point, in metres.
///
/// Beyond it positions are coarser than 0.1 mm.
pub const MAX_COORDINATE: f64 = 1e12;

/// Lowest speed along a path, in metres per second.
pub const MIN_SPEED: f64 = 1e-12;

/// Highest speed, in metres per second, for each component of a free velocity too.
pub const MAX_SPEED: f64 = 1e12;

/// Fastest spin, in radians per second, either way round.
///
/// A body turns so far within 1e-6 s that a clock of an hour still tells the
/// quarters of a turn apart. Raise it and a late orientation is rounding.
pub const MAX_SPIN: f64 = 1e6;

/// Longest distance that may lie behind a body as its motion begins, in metres.
///
/// A path of ten thousand pieces across the whole domain is not longer.
pub const MAX_DISTANCE: f64 = 1e17;

/// Shortest time step, in seconds.
///
/// Below it the world's clock, after an hour, would not move at all.
pub const MIN_TIME_STEP: f64 = 1e-12;

/// Longest time step, in seconds: some thirty years.
pub const MAX_TIME_STEP: f64 = 1e9;

/// Depth up to which two bodies count as touching and not as overlapping, as a
/// share of the pair's size (the sum of their bounding radii) plus the size of
/// the coordinates involved.
///
/// Bodies that were brought into contact overlap by rounding: some 4 ulp of the
/// coordinates. 1e-12 leaves a margin of a thousand above that. Larger, and
/// shallow overlaps go unreported; smaller, and a body left in touch is
/// reported as overlapping.
pub const TOUCH: f64 = 1e-12;

/// [`TOUCH`] in metres for a pair whose bounding radii add up to `size` and
/// whose coordinates reach `coordinate`.
#[must_use]
pub(crate) fn touch_tolerance(size: f64, coordinate: f64) -> f64 {
    TOUCH * (size + coordinate)
}
