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
        slabs::span(&Line::of(ray)?, self.min, self.max, &DVec3::AXES)
    }

    #[inline]
    fn contains_point(&self, point: DVec3) -> bool {
        self.contains(point)
    }
}
