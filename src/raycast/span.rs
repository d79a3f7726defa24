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
    #[inline]
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

    /// As [`new`](Self::new), for ends that rounding may have made change places.
    pub(super) fn ordered(enter: SurfacePoint, leave: SurfacePoint) -> Option<Self> {
        let fraction = leave.fraction.max(enter.fraction);
        Self::new(enter, SurfacePoint { fraction, ..leave })
    }

    /// What the ray meets first.
    ///
    /// Where the origin lies between the ends or within rounding of one, `contained` has the last
    /// word: neither rounding nor a graze may carry the origin through the surface.
    #[inline]
    pub(super) fn first_hit(&self, ray: &Ray, contained: impl Fn() -> bool) -> Option<RayHit> {
        let (enter, leave) = (self.enter.fraction, self.leave.fraction);
        let speed = ray.direction.abs().max_element();
        let scale = ray.origin.abs().max_element() + speed * enter.abs().max(leave.abs());
        let at_surface = speed * enter.abs().min(leave.abs()) <= 4.0 * GRAZE * scale;
        if !at_surface && enter > 0.0 {
            Some(RayHit::Surface(self.enter))
        } else if !at_surface && leave < 0.0 {
            None
        } else if contained() {
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
