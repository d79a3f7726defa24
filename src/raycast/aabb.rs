//! Rays against axis-aligned boxes.

use super::line::Line;
use super::{RayCast, RaySpan, slabs};
use crate::geometry::{Aabb, Ray};
use glam::DVec3;

/// Faces are numbered −x, +x, −y, +y, −z, +z. An empty box is never hit, one
/// without thickness can be. O(1).
impl RayCast for Aabb {
    #[inline]
    fn line_span(&self, ray: &Ray) -> Option<RaySpan> {
        let line = Line::of(ray)?;
        slabs::span(&line, self.min, self.max, &DVec3::AXES, line.distance())
    }

    #[inline]
    fn contains_point(&self, point: DVec3) -> bool {
        self.contains(point)
    }
}
