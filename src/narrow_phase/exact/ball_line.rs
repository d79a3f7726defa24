//! The way of a ball's centre, made fit to compute with.

use super::{Crossing, Touching};
use crate::geometry::Feature;
use crate::raycast::{GRAZE, scale};
use glam::{DMat3, DVec3};

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

/// What a line first touches of a rounded shape: a fraction in directions, vectors in the
/// shape's frame.
pub(super) struct Touch {
    pub(super) fraction: f64,
    /// The point of the shape that is touched.
    pub(super) foot: DVec3,
    pub(super) normal: DVec3,
    pub(super) feature: Feature,
}

impl Line {
    /// None if a number is not finite, the origin out of all bounds or the motion zero.
    #[inline(always)]
    pub(super) fn new(origin: DVec3, motion: DVec3) -> Option<Self> {
        let scale = scale(origin, motion)?;
        let direction = scale * motion;
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
        slack(self.origin, size)
    }

    /// Whether the line surely stays further than `reach` from a point that its origin is
    /// `offset` away from.
    ///
    /// Compares squares, which are off by a few ulp of that distance's: no division, and in most
    /// misses nothing else need be done.
    #[inline]
    pub(super) fn passes_by(&self, offset: DVec3, reach: f64) -> bool {
        let along = offset.dot(self.direction);
        let distance = offset.length_squared() * (1.0 - 32.0 * f64::EPSILON);
        (distance - reach * reach) * self.square > along * along
    }

    /// Whether the line surely [passes by](passes_by) all that lies within `reach` of the frame's origin.
    #[inline(always)]
    pub(super) fn passes_by_all(&self, reach: f64) -> bool {
        passes_by(self.origin, self.direction, self.square, reach)
    }

    /// The line in the frame that `rotation` leads from.
    #[inline]
    pub(super) fn turned(&self, rotation: &DMat3) -> Self {
        let back = |vector: DVec3| {
            DVec3::new(
                rotation.x_axis.dot(vector),
                rotation.y_axis.dot(vector),
                rotation.z_axis.dot(vector),
            )
        };
        Self {
            origin: back(self.origin),
            direction: back(self.direction),
            ..*self
        }
    }

    /// A ball's touch with its fraction in motions, if that is finite.
    #[inline(always)]
    pub(super) fn touching(&self, touch: Touch) -> Option<Touching> {
        let fraction = touch.fraction * self.scale;
        fraction.is_finite().then_some(touch.at(fraction))
    }

    /// A crossing, from what the line touches first and what it does when run backwards.
    #[inline]
    pub(super) fn crossing(&self, first: Touch, last: Option<Touch>) -> Option<Crossing> {
        let enter = self.touching(first)?;
        // Rounding may find a graze one way only, and make its ends change places.
        let leave = last.map_or(enter.fraction, |last| -last.fraction * self.scale);
        leave.is_finite().then_some(Crossing {
            enter,
            leave: leave.max(enter.fraction),
        })
    }
}

/// Whether a line surely passes by all that lies within `reach` of the origin, with what rounding may carry it;
/// `square` is that of its direction and plain.
///
/// A line that does begins outside that sphere, where the slack is a share of the distance: one factor
/// takes it in. Products that all but underflow have no digits, and tell nothing.
#[inline(always)]
pub(super) fn passes_by(origin: DVec3, direction: DVec3, square: f64, reach: f64) -> bool {
    let along = origin.dot(direction);
    let distance = origin.length_squared() * (1.0 - 512.0 * f64::EPSILON);
    (distance - reach * reach) * square > along * along + 1e-280
}

/// How far rounding may carry a line from `origin` past a shape of this size that it touches.
#[inline]
pub(super) fn slack(origin: DVec3, size: f64) -> f64 {
    GRAZE * (origin.abs().max_element() + size)
}

impl Touch {
    /// As a ball's touch, at this fraction of the motion.
    #[inline(always)]
    pub(super) fn at(self, fraction: f64) -> Touching {
        Touching {
            fraction,
            point: self.foot,
            normal: self.normal,
            features: [Feature::Surface, self.feature],
        }
    }
}
