//! Rays against polytopes.

use super::clip::{self, Plane};
use super::line::Line;
use super::{GRAZE, RayCast, RayHit, RaySpan};
use crate::geometry::{Feature, Polytope, Ray};
use glam::DVec3;

/// Clips the line by the planes of all faces. O(faces).
impl RayCast for Polytope {
    fn line_span(&self, ray: &Ray) -> Option<RaySpan> {
        let line = Line::of(ray)?;
        let growth = GRAZE * (line.distance() + self.size());
        clip::span(&line, self.planes(), growth, Feature::Face)
    }

    fn first_hit(&self, ray: &Ray) -> Option<RayHit> {
        if ray.direction == DVec3::ZERO {
            return self.contains_point(ray.origin).then_some(RayHit::Inside);
        }
        let span = self.line_span(ray)?;
        if span.is_clear_of_origin(ray) {
            span.first_hit()
        } else {
            span.first_hit_from(self.contains_point(ray.origin))
        }
    }

    fn contains_point(&self, point: DVec3) -> bool {
        // NaN compares false.
        self.planes()
            .all(|plane| plane.normal.dot(point) <= plane.offset)
    }
}

impl Polytope {
    fn planes(&self) -> impl Iterator<Item = Plane> + Clone {
        self.face_normals()
            .iter()
            .zip(self.face_offsets())
            .map(|(&normal, &offset)| Plane { normal, offset })
    }

    /// A bound on the coordinates of the surface.
    fn size(&self) -> f64 {
        self.centre().abs().max_element() + self.max_dist()
    }
}
