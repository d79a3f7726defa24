//! Rays against oriented boxes.

use super::line::Line;
use super::{RayCast, RaySpan, slabs};
use crate::geometry::{Obb, Ray};
use glam::DVec3;

/// Faces are numbered as a cuboid's, along the box's own axes: negative side
/// of axis 0, positive side, and so on. O(1).
impl RayCast for Obb {
    #[inline]
    fn line_span(&self, ray: &Ray) -> Option<RaySpan> {
        let local = Ray {
            origin: self.components(ray.origin - self.centre),
            direction: self.components(ray.direction),
        };
        let half = self.half_extents;
        let far = self.centre.abs().max_element() + ray.origin.abs().max_element();
        slabs::span(&Line::of(&local)?, -half, half, &self.axes, far)
    }

    #[inline]
    fn contains_point(&self, point: DVec3) -> bool {
        self.contains(point)
    }
}

impl Obb {
    #[inline]
    fn components(&self, vector: DVec3) -> DVec3 {
        DVec3::from_array(self.axes.map(|axis| vector.dot(axis)))
    }
}
