//! A ray made fit to compute with.

use crate::geometry::Ray;
use glam::DVec3;

/// Largest coordinate of a ray's origin, in metres; rays from beyond it hit nothing.
///
/// Squares of it stay far below `f64::MAX`, so no kernel needs to watch for overflow.
pub const MAX_ORIGIN: f64 = 1e100;

/// Directions between these lengths are used as they are.
const PLAIN_LENGTHS: std::ops::RangeInclusive<f64> = 1e-60..=1e60;

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
        let reach = direction.abs();
        // A NaN fails these comparisons; `max_element` would skip it.
        if !(reach.x <= f64::MAX && reach.y <= f64::MAX && reach.z <= f64::MAX) {
            return None;
        }
        let far = origin.abs();
        if !(far.x <= MAX_ORIGIN && far.y <= MAX_ORIGIN && far.z <= MAX_ORIGIN) {
            return None;
        }
        let longest = reach.max_element();
        if PLAIN_LENGTHS.contains(&longest) {
            return Some(Self {
                origin,
                direction,
                scale: 1.0,
            });
        }
        Self::rescaled(origin, direction, longest)
    }

    #[cold]
    fn rescaled(origin: DVec3, direction: DVec3, longest: f64) -> Option<Self> {
        if longest <= 0.0 {
            return None;
        }
        // Bits 52 to 62 are the exponent plus 1023; 1000 keeps the scale itself normal.
        let exponent = ((longest.to_bits() >> 52) as i64 - 1023).clamp(-1000, 1000);
        let scale = f64::from_bits(((1023 - exponent) as u64) << 52);
        Some(Self {
            origin,
            direction: direction * scale,
            scale,
        })
    }

    /// The ray's fraction for one of the line.
    #[inline]
    pub(super) fn ray_fraction(&self, fraction: f64) -> f64 {
        fraction * self.scale
    }

    /// The largest coordinate of the origin: the share of the distance in rounding.
    #[inline]
    pub(super) fn distance(&self) -> f64 {
        self.origin.abs().max_element()
    }
}
