//! The way of a ball's centre, made fit to compute with.

use super::{Crossing, Touching};
use crate::geometry::Feature;
use crate::raycast::{GRAZE, MAX_ORIGIN};
use glam::{DQuat, DVec3};

/// Motions between these lengths are used as they are.
const PLAIN_LENGTHS: std::ops::RangeInclusive<f64> = 1e-60..=1e60;

/// A line in the frame of the body that stands, with a direction whose square neither
/// overflows nor underflows.
#[derive(Clone, Copy)]
pub(super) struct Line {
    pub(super) origin: DVec3,
    pub(super) direction: DVec3,
    /// That of the direction.
    pub(super) square: f64,
    /// Motions per direction: 1, but for extreme motions a power of two.
    scale: f64,
}

/// What a line does to a rounded shape: fractions in directions, vectors in the shape's frame.
pub(super) struct Touch {
    pub(super) enter: f64,
    pub(super) leave: f64,
    /// The point of the shape that is touched.
    pub(super) foot: DVec3,
    pub(super) normal: DVec3,
    pub(super) feature: Feature,
}

impl Line {
    /// None if a number is not finite, the origin out of all bounds or the motion zero.
    #[inline]
    pub(super) fn new(origin: DVec3, motion: DVec3) -> Option<Self> {
        let (far, reach) = (origin.abs(), motion.abs());
        // A NaN fails these comparisons; `max_element` would pass over it.
        let fit = far.x <= MAX_ORIGIN
            && far.y <= MAX_ORIGIN
            && far.z <= MAX_ORIGIN
            && reach.x <= f64::MAX
            && reach.y <= f64::MAX
            && reach.z <= f64::MAX;
        if !fit {
            return None;
        }
        let longest = reach.max_element();
        if PLAIN_LENGTHS.contains(&longest) {
            return Some(Self {
                origin,
                direction: motion,
                square: motion.length_squared(),
                scale: 1.0,
            });
        }
        Self::rescaled(origin, motion, longest)
    }

    #[cold]
    fn rescaled(origin: DVec3, motion: DVec3, longest: f64) -> Option<Self> {
        if longest <= 0.0 {
            return None;
        }
        // Bits 52 to 62 are the exponent plus 1023; 1000 keeps the scale itself normal.
        let exponent = ((longest.to_bits() >> 52) as i64 - 1023).clamp(-1000, 1000);
        let scale = f64::from_bits(((1023 - exponent) as u64) << 52);
        let direction = motion * scale;
        Some(Self {
            origin,
            direction,
            square: direction.length_squared(),
            scale,
        })
    }

    /// The line with another origin.
    #[inline]
    pub(super) fn begun_at(&self, origin: DVec3) -> Self {
        Self { origin, ..*self }
    }

    /// The line run backwards.
    #[inline]
    pub(super) fn reversed(&self) -> Self {
        Self {
            direction: -self.direction,
            ..*self
        }
    }

    /// How far rounding may carry the line past a shape of this size that it touches.
    #[inline]
    pub(super) fn slack(&self, size: f64) -> f64 {
        GRAZE * (self.origin.abs().max_element() + size)
    }

    /// The line in a frame turned by `turn`.
    #[inline]
    pub(super) fn turned(&self, turn: DQuat) -> Self {
        Self {
            origin: turn * self.origin,
            direction: turn * self.direction,
            ..*self
        }
    }

    /// The touch of a ball and a shape with fractions in motions, if those are finite.
    #[inline]
    pub(super) fn crossing(&self, touch: Touch) -> Option<Crossing> {
        let enter = touch.enter * self.scale;
        let leave = touch.leave * self.scale;
        (enter.is_finite() && leave.is_finite()).then(|| Crossing {
            enter: Touching {
                fraction: enter,
                point: touch.foot,
                normal: touch.normal,
                features: [Feature::Surface, touch.feature],
            },
            // Rounding may have made the ends of a graze change places.
            leave: leave.max(enter),
        })
    }
}
