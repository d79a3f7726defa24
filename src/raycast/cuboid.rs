//! Rays against boxes.

use super::line::Line;
use super::{RayCast, RaySpan, slabs};
use crate::geometry::{Cuboid, Ray};
use glam::DVec3;

/// Between three pairs of planes (Kay & Kajiya 1986). O(1).
impl RayCast for Cuboid {
    #[inline]
    fn line_span(&self, ray: &Ray) -> Option<RaySpan> {
        let half = self.half_extents();
        let line = Line::of(ray)?;
        slabs::span(&line, -half, half, &DVec3::AXES, line.distance())
    }

    #[inline]
    fn contains_point(&self, point: DVec3) -> bool {
        // NaN compares false.
        point.abs().cmple(self.half_extents()).all()
    }
}
