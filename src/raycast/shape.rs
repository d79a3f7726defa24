//! Rays against any shape.

use super::{RayCast, RayHit, RaySpan, turned_hit};
use crate::geometry::{Pose, Ray, Shape};
use glam::DVec3;

impl RayCast for Shape {
    fn line_span(&self, ray: &Ray) -> Option<RaySpan> {
        match self {
            Self::Sphere(sphere) => sphere.line_span(ray),
            Self::Cuboid(cuboid) => cuboid.line_span(ray),
            Self::Triangle(triangle) => triangle.line_span(ray),
            Self::Polytope(polytope) => polytope.line_span(ray),
        }
    }

    fn contains_point(&self, point: DVec3) -> bool {
        match self {
            Self::Sphere(sphere) => sphere.contains_point(point),
            Self::Cuboid(cuboid) => cuboid.contains_point(point),
            Self::Triangle(triangle) => triangle.contains_point(point),
            Self::Polytope(polytope) => polytope.contains_point(point),
        }
    }

    #[inline]
    fn first_hit(&self, ray: &Ray) -> Option<RayHit> {
        match self {
            Self::Sphere(sphere) => sphere.first_hit(ray),
            Self::Cuboid(cuboid) => cuboid.first_hit(ray),
            Self::Triangle(triangle) => triangle.first_hit(ray),
            Self::Polytope(polytope) => polytope.first_hit(ray),
        }
    }

    #[inline]
    fn first_hit_at(&self, pose: &Pose, ray: &Ray) -> Option<RayHit> {
        match self {
            Self::Polytope(polytope) => polytope.first_hit_at(pose, ray),
            _ => turned_hit(self, pose, ray),
        }
    }
}
