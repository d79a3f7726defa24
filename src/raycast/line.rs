//! A ray made fit to compute with.

use crate::geometry::Ray;
use glam::DVec3;

/// Largest coordinate of a ray's origin, in metres; rays from beyond it hit nothing.
///
/// Squares of it stay far below `f64::MAX`, so no kernel needs to watch for overflow.
pub const MAX_ORIGIN: f64 = 1e100;

/// Directions whose squares lie between these are used as they are.
pub(crate) const PLAIN_SQUARES: std::ops::RangeInclusive<f64> = 1e-100..=1e100;

/// The line through a ray: finite, with a direction whose square neither
/// overflows nor underflows.
pub(super) struct Line {
    pub(super) origin: DVec3,
    pub(super) direction: DVec3,
    /// Ray fractions per line fraction: 1, but for extreme directions, where it is a
    /// power of two, so that rescaling rounds nothing.
    scale: f64,
}

impl Line {
    /// None if a coordinate is not finite, the origin beyond [`MAX_ORIGIN`] or
    /// the direction zero.
    #[inline]
    pub(super) fn of(ray: &Ray) -> Option<Self> {
        let Ray { origin, direction } = *ray;
        let scale = scale(origin, direction)?;
        Some(Self {
            origin,
            direction: scale * direction,
            scale,
        })
    }

    /// The ray's fraction for one of the line.
    #[inline]
    pub(super) fn ray_fraction(&self, fraction: f64) -> f64 {
        fraction * self.scale
    }

    /// Whether the line surely stays further than `reach` from a point that its origin is
    /// `offset` away from.
    ///
    /// Compares squares, which are off by a few ulp of the distance's; the margin is
    /// twice that.
    #[inline]
    pub(super) fn passes_by(&self, offset: DVec3, reach: f64) -> bool {
        let along = offset.dot(self.direction);
        let distance = offset.length_squared() * (1.0 - 32.0 * f64::EPSILON);
        (distance - reach * reach) * self.direction.length_squared() > along * along
    }

    /// The largest coordinate of the origin: the share of the distance in rounding.
    #[inline]
    pub(super) fn distance(&self) -> f64 {
        self.origin.abs().max_element()
    }
}

/// What a ray's direction is to be multiplied by so that its square neither overflows nor
/// underflows: 1, but for extreme directions, where it is a power of two.
///
/// None if a coordinate is not finite, the origin beyond [`MAX_ORIGIN`] or the
/// direction zero.
#[inline(always)]
pub(crate) fn scale(origin: DVec3, direction: DVec3) -> Option<f64> {
    // A NaN fails these comparisons.
    let plain = PLAIN_SQUARES.contains(&direction.length_squared())
        && origin.length_squared() <= MAX_ORIGIN * MAX_ORIGIN;
    // By value: a reference would send the vectors through memory in the usual case as well.
    if plain {
        Some(1.0)
    } else {
        rescaled(origin, direction)
    }
}

#[cold]
fn rescaled(origin: DVec3, direction: DVec3) -> Option<f64> {
    let within = |vector: DVec3, limit: f64| {
        // A NaN fails this; `max_element` would pass over it.
        (vector.abs().to_array().into_iter()).all(|coordinate| coordinate <= limit)
    };
    let longest = direction.abs().max_element();
    if !within(origin, MAX_ORIGIN) || !within(direction, f64::MAX) || longest <= 0.0 {
        return None;
    }
    // Bits 52 to 62 are the exponent plus 1023; 1000 keeps the scale itself normal.
    let exponent = ((longest.to_bits() >> 52) as i64 - 1023).clamp(-1000, 1000);
    Some(f64::from_bits(((1023 - exponent) as u64) << 52))
}
