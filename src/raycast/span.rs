//! The piece of a line inside a solid.

use super::{GRAZE, RayHit};
use crate::geometry::{Feature, Pose, Ray};
use glam::DVec3;

/// Where a line meets a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// Where on the ray, in ray directions.
    pub fraction: f64,
    /// Unit normal of the surface, pointing outwards.
    pub normal: DVec3,
    /// The part of the surface.
    pub feature: Feature,
}

impl SurfacePoint {
    pub(super) fn turned(self, pose: &Pose) -> Self {
        Self {
            normal: pose.direction(self.normal),
            ..self
        }
    }
}

/// The piece of a line inside a solid: `enter.fraction ≤ leave.fraction`, both finite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RaySpan {
    /// Where the line goes in.
    pub enter: SurfacePoint,
    /// Where it comes out.
    pub leave: SurfacePoint,
}

impl RaySpan {
    /// A span from the two ends in the line's fractions, if those are finite.
    pub(super) fn new(enter: SurfacePoint, leave: SurfacePoint) -> Option<Self> {
        let finite = enter.fraction.is_finite() && leave.fraction.is_finite();
        debug_assert!(
            !finite || enter.fraction <= leave.fraction,
            "leaves at {} before it enters at {}",
            leave.fraction,
            enter.fraction
        );
        finite.then_some(Self { enter, leave })
    }

    /// Whether both ends are further from the ray's origin than rounding could amount to.
    #[inline]
    pub(super) fn is_clear_of_origin(&self, ray: &Ray) -> bool {
        let (enter, leave) = (self.enter.fraction.abs(), self.leave.fraction.abs());
        let speed = ray.direction.abs().max_element();
        let scale = ray.origin.abs().max_element() + speed * enter.max(leave);
        speed * enter.min(leave) > 4.0 * GRAZE * scale
    }

    /// Whether the line's origin lies between the ends.
    #[inline]
    pub(super) fn holds_origin(&self) -> bool {
        self.enter.fraction <= 0.0 && self.leave.fraction >= 0.0
    }

    /// What the ray meets first, by the signs of the fractions alone.
    #[inline]
    pub(super) fn first_hit(&self) -> Option<RayHit> {
        if self.enter.fraction > 0.0 {
            Some(RayHit::Surface(self.enter))
        } else if self.leave.fraction >= 0.0 {
            Some(RayHit::Inside)
        } else {
            None
        }
    }

    /// What a ray meets first whose origin is in the solid (`contained`), or not though
    /// the fractions may say so.
    pub(super) fn first_hit_from(&self, contained: bool) -> Option<RayHit> {
        let (enter, leave) = (self.enter.fraction, self.leave.fraction);
        if contained {
            Some(RayHit::Inside)
        } else if leave < 0.0 || leave < 1e-9 * -enter {
            // On its way out.
            None
        } else {
            Some(RayHit::Surface(SurfacePoint {
                fraction: enter.max(0.0),
                ..self.enter
            }))
        }
    }
}
