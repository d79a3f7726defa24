//! Any shape.

use crate::geometry::{Aabb, Cuboid, Polytope, Pose, Sphere, Triangle};
use glam::DVec3;
use std::sync::Arc;

/// A shape a body can have.
///
/// Triangles and polytopes are shared: a shape is four words long, and cloning it copies no
/// vertices.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "crate::geometry::data::ShapeData",
        into = "crate::geometry::data::ShapeData"
    )
)]
pub enum Shape {
    /// A solid sphere.
    Sphere(Sphere),
    /// A solid box.
    Cuboid(Cuboid),
    /// A triangle, solid from both sides.
    Triangle(Arc<Triangle>),
    /// A solid convex polytope.
    Polytope(Arc<Polytope>),
}

impl Shape {
    /// Centre of the shape's bounding sphere, in its own frame.
    ///
    /// The thesis asks the caller for a centre; this one is chosen so that
    /// [`max_dist`](Self::max_dist) is small, and need not be the origin.
    #[must_use]
    pub fn centre(&self) -> DVec3 {
        match self {
            Self::Sphere(_) | Self::Cuboid(_) => DVec3::ZERO,
            Self::Triangle(triangle) => triangle.bounding_sphere().0,
            Self::Polytope(polytope) => polytope.centre(),
        }
    }

    /// Largest distance from [`centre`](Self::centre) to the surface, in
    /// metres: the radius of the bounding sphere.
    #[must_use]
    pub fn max_dist(&self) -> f64 {
        match self {
            Self::Sphere(sphere) => sphere.radius(),
            Self::Cuboid(cuboid) => cuboid.half_extents().length(),
            Self::Triangle(triangle) => triangle.bounding_sphere().1,
            Self::Polytope(polytope) => polytope.max_dist(),
        }
    }

    /// Bounds of the shape standing at `pose`.
    ///
    /// Within rounding of the tightest box.
    #[must_use]
    pub fn aabb(&self, pose: &Pose) -> Aabb {
        match self {
            Self::Sphere(sphere) => Aabb::new(pose.position, pose.position).grown(sphere.radius()),
            Self::Cuboid(cuboid) => {
                let half = cuboid.half_extents();
                let reach = (pose.direction(DVec3::X) * half.x).abs()
                    + (pose.direction(DVec3::Y) * half.y).abs()
                    + (pose.direction(DVec3::Z) * half.z).abs();
                Aabb {
                    min: pose.position - reach,
                    max: pose.position + reach,
                }
            }
            Self::Triangle(triangle) => {
                Aabb::around(triangle.vertices().into_iter().map(|v| pose.point(v)))
            }
            Self::Polytope(polytope) => {
                Aabb::around(polytope.vertices().iter().map(|&v| pose.point(v)))
            }
        }
    }
}

impl From<Sphere> for Shape {
    fn from(sphere: Sphere) -> Self {
        Self::Sphere(sphere)
    }
}

impl From<Cuboid> for Shape {
    fn from(cuboid: Cuboid) -> Self {
        Self::Cuboid(cuboid)
    }
}

impl From<Triangle> for Shape {
    fn from(triangle: Triangle) -> Self {
        Self::Triangle(Arc::new(triangle))
    }
}

impl From<Arc<Triangle>> for Shape {
    fn from(triangle: Arc<Triangle>) -> Self {
        Self::Triangle(triangle)
    }
}

impl From<Polytope> for Shape {
    fn from(polytope: Polytope) -> Self {
        Self::Polytope(Arc::new(polytope))
    }
}

impl From<Arc<Polytope>> for Shape {
    fn from(polytope: Arc<Polytope>) -> Self {
        Self::Polytope(polytope)
    }
}
