//! A shape where it stands, as a convex core and a radius around it.

use crate::geometry::Shape;
use glam::{DMat3, DQuat, DVec3};

/// A polytope farther from its own origin than this many radii is scanned from its centre.
///
/// Heights of vertices from afar are rounded by the share that this is of the shape's size.
const FAR: f64 = 4.0;

/// Vertices up to which [`Polytope::support`](crate::Polytope::support) compares heights above the
/// shape's own origin; with more it climbs, over differences.
const SCANNED: usize = 24;

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
    far: bool,
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
            far: match shape {
                Shape::Polytope(polytope) => {
                    polytope.vertices().len() <= SCANNED && centre.abs().max_element() > FAR * size
                }
                _ => false,
            },
        };
        body.turn(orientation);
        body
    }

    pub(super) fn turn(&mut self, orientation: DQuat) {
        let rotation = DMat3::from_quat(orientation);
        match self.shape {
            Shape::Sphere(_) => {}
            Shape::Cuboid(cuboid) => {
                self.axes = rotation * DMat3::from_diagonal(cuboid.half_extents());
            }
            Shape::Triangle(triangle) => {
                let [a, b, c] = triangle.vertices().map(|v| rotation * (v - self.centre));
                self.axes = DMat3::from_cols(a, b, c);
                self.shift = rotation * self.centre;
            }
            Shape::Polytope(_) => {
                self.axes = rotation;
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

    /// A vertex of the core as an offset from the centre, along the world's axes.
    #[inline]
    pub(super) fn vertex(&self, index: u32) -> DVec3 {
        match self.shape {
            Shape::Sphere(_) => DVec3::ZERO,
            Shape::Cuboid(_) => {
                let side = |bit: u32| 2.0 * f64::from(index >> bit & 1) - 1.0;
                side(0) * self.axes.x_axis + side(1) * self.axes.y_axis + side(2) * self.axes.z_axis
            }
            Shape::Triangle(_) => match index {
                0 => self.axes.x_axis,
                1 => self.axes.y_axis,
                _ => self.axes.z_axis,
            },
            Shape::Polytope(polytope) => {
                self.axes * (polytope.vertices()[index as usize] - self.centre)
            }
        }
    }

    /// A vertex of the core that lies farthest along a direction of the world.
    #[inline]
    pub(super) fn support(&self, direction: DVec3) -> u32 {
        match self.shape {
            Shape::Sphere(_) => 0,
            Shape::Cuboid(_) => {
                let heights = self.along_axes(direction);
                u32::from(heights.x > 0.0)
                    | u32::from(heights.y > 0.0) << 1
                    | u32::from(heights.z > 0.0) << 2
            }
            Shape::Triangle(_) => {
                let heights = self.along_axes(direction);
                let farthest = u32::from(heights.y > heights.x);
                if heights.z > heights.x.max(heights.y) {
                    2
                } else {
                    farthest
                }
            }
            Shape::Polytope(polytope) => {
                let local = self.along_axes(direction);
                if self.far {
                    self.scan(polytope.vertices(), local)
                } else {
                    polytope.support(local)
                }
            }
        }
    }

    fn scan(&self, vertices: &[DVec3], direction: DVec3) -> u32 {
        let (mut most, mut farthest) = (f64::NEG_INFINITY, 0);
        for (index, &vertex) in (0..).zip(vertices) {
            let height = direction.dot(vertex - self.centre);
            if height > most {
                (most, farthest) = (height, index);
            }
        }
        farthest
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
