//! A shape where it stands, as a convex core and a radius around it.

use super::cloud::{Cloud, FEW};
use crate::geometry::{Polytope, Shape};
use glam::{DMat3, DQuat, DVec3};

/// A shape turned but not shifted: a core with vertices, and a radius around it that only a
/// sphere has.
///
/// Vertices are turned around the shape's centre, so that a shape that lies far
/// from its own origin is moved by rounding, not bent.
#[derive(Clone)]
pub(super) struct Body<'a> {
    pub(super) shape: &'a Shape,
    /// A cuboid's half-extents as vectors, a triangle's corners from its centre, along the
    /// world's axes; the rotation of a polytope.
    axes: DMat3,
    centre: DVec3,
    /// From the shape's position to its centre, along the world's axes.
    pub(super) shift: DVec3,
    /// No point of the shape lies farther from its centre, in metres.
    pub(super) size: f64,
    /// How far the shape reaches beyond its core, in metres.
    pub(super) radius: f64,
    /// The vertices, if there are few.
    cloud: Cloud,
    /// The polytope that has more.
    many: Option<&'a Polytope>,
}

impl<'a> Body<'a> {
    pub(super) fn new(shape: &'a Shape, orientation: DQuat) -> Self {
        let (centre, size) = (shape.centre(), shape.max_dist());
        let mut body = Self {
            shape,
            axes: DMat3::IDENTITY,
            centre,
            shift: DVec3::ZERO,
            size,
            radius: match shape {
                Shape::Sphere(sphere) => sphere.radius(),
                _ => 0.0,
            },
            cloud: Cloud::EMPTY,
            many: match shape {
                Shape::Polytope(polytope) if polytope.vertices().len() > FEW => Some(polytope),
                _ => None,
            },
        };
        body.turn(orientation);
        body
    }

    pub(super) fn turn(&mut self, orientation: DQuat) {
        let rotation = DMat3::from_quat(orientation);
        match self.shape {
            Shape::Sphere(_) => self.cloud.fill(&[DVec3::ZERO], |vertex| vertex),
            Shape::Cuboid(cuboid) => {
                let half = cuboid.half_extents();
                let (x, y, z) = (
                    half.x * rotation.x_axis,
                    half.y * rotation.y_axis,
                    half.z * rotation.z_axis,
                );
                self.axes = DMat3::from_cols(x, y, z);
                let (sum, other) = (x + y, x - y);
                let below = [-sum - z, other - z, -other - z, sum - z];
                let above = [-sum + z, other + z, -other + z, sum + z];
                self.cloud.fill(below.as_slice(), |vertex| vertex);
                self.cloud.extend(above.as_slice(), |vertex| vertex);
            }
            Shape::Triangle(triangle) => {
                let [a, b, c] = triangle.vertices().map(|v| rotation * (v - self.centre));
                self.axes = DMat3::from_cols(a, b, c);
                self.cloud.fill(&[a, b, c], |vertex| vertex);
                self.shift = rotation * self.centre;
            }
            Shape::Polytope(polytope) => {
                self.axes = rotation;
                if self.many.is_none() {
                    let centre = self.centre;
                    (self.cloud).fill(polytope.vertices(), |vertex| rotation * (vertex - centre));
                }
                self.shift = rotation * self.centre;
            }
        }
    }

    /// A direction of the world against the columns of [`axes`](Self::axes): along a polytope's
    /// own axes, or the heights of half-extents or corners.
    #[inline]
    pub(super) fn along_axes(&self, direction: DVec3) -> DVec3 {
        self.axes.transpose() * direction
    }

    /// The other way round: a sum of the columns.
    #[inline]
    pub(super) fn sum_of_axes(&self, shares: DVec3) -> DVec3 {
        self.axes * shares
    }

    /// A vertex of the core as an offset from the centre, along the world's axes.
    #[inline]
    pub(super) fn vertex(&self, index: u32) -> DVec3 {
        match self.many {
            None => self.cloud.vertex(index),
            Some(polytope) => self.axes * (polytope.vertices()[index as usize] - self.centre),
        }
    }

    /// A vertex of the core that lies farthest along a direction of the world, sought from one that
    /// is thought to be `near`.
    #[inline]
    pub(super) fn support(&self, direction: DVec3, near: Option<u32>) -> u32 {
        let Some(polytope) = self.many else {
            return self.cloud.farthest(direction);
        };
        let local = self.along_axes(direction);
        match near {
            Some(near) => polytope.support_near(local, near),
            None => polytope.support(local),
        }
    }

    /// Whether the core holds a point, told from its centre; a triangle holds none.
    pub(super) fn holds(&self, point: DVec3) -> bool {
        match self.shape {
            Shape::Sphere(_) | Shape::Triangle(_) => false,
            Shape::Cuboid(cuboid) => {
                let squares = cuboid.half_extents() * cuboid.half_extents();
                // Columns are as long as half-extents.
                self.along_axes(point).abs().cmplt(squares).all()
            }
            Shape::Polytope(polytope) => {
                let local = self.centre + self.along_axes(point);
                (polytope.face_normals().iter())
                    .zip(polytope.face_offsets())
                    .all(|(normal, &offset)| normal.dot(local) < offset)
            }
        }
    }

    pub(super) fn vertex_count(&self) -> u32 {
        match self.shape {
            Shape::Sphere(_) => 1,
            Shape::Cuboid(_) => 8,
            Shape::Triangle(_) => 3,
            Shape::Polytope(polytope) => polytope.vertices().len() as u32,
        }
    }
}
