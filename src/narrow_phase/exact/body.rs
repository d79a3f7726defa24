//! A shape with flat faces where it stands, seen from its own centre.

use crate::geometry::{Cuboid, Edge, Mesh, Shape};
use glam::{DMat3, DQuat, DVec3};

/// A cuboid, triangle or polytope, turned but not shifted.
///
/// Vertices are turned around the shape's centre, so that a shape that lies
/// far from its own origin is moved by rounding, not bent.
#[derive(Clone, Copy)]
pub(super) struct Body<'a> {
    pub(super) shape: &'a Shape,
    /// From the shape's frame to the world's axes.
    pub(super) rotation: DMat3,
    /// A point amid the shape, in its own frame.
    pub(super) centre: DVec3,
    /// No vertex lies farther from the centre, in metres.
    pub(super) radius: f64,
}

impl<'a> Body<'a> {
    /// None for a sphere.
    pub(super) fn new(shape: &'a Shape, orientation: DQuat) -> Option<Self> {
        let (centre, radius) = match shape {
            Shape::Sphere(_) => return None,
            Shape::Cuboid(cuboid) => (DVec3::ZERO, cuboid.half_extents().length()),
            Shape::Triangle(triangle) => {
                let [a, b, c] = triangle.vertices();
                let centre = a + ((b - a) + (c - a)) / 3.0;
                let farthest = (a.distance_squared(centre))
                    .max(b.distance_squared(centre))
                    .max(c.distance_squared(centre));
                (centre, farthest.sqrt())
            }
            Shape::Polytope(polytope) => (polytope.centre(), polytope.max_dist()),
        };
        Some(Self {
            shape,
            rotation: DMat3::from_quat(orientation),
            centre,
            radius,
        })
    }

    /// Vertices, edges and triangles in the shape's own frame.
    pub(super) fn mesh(&self) -> Option<Mesh<'a>> {
        Mesh::of(self.shape)
    }

    /// A vertex as an offset from the centre, in the shape's own frame.
    #[inline]
    pub(super) fn local(&self, index: u32) -> DVec3 {
        match self.shape {
            Shape::Sphere(_) => DVec3::ZERO,
            Shape::Cuboid(cuboid) => corner(cuboid, index),
            Shape::Triangle(triangle) => triangle.vertices()[index as usize % 3] - self.centre,
            Shape::Polytope(polytope) => polytope.vertices()[index as usize] - self.centre,
        }
    }

    /// A vertex as an offset from the centre, along the world's axes.
    pub(super) fn vertex(&self, index: u32) -> DVec3 {
        self.rotation * self.local(index)
    }

    /// The vertex farthest along a direction of the shape's own frame.
    #[inline]
    pub(super) fn support_local(&self, direction: DVec3) -> u32 {
        match self.shape {
            Shape::Sphere(_) => 0,
            Shape::Cuboid(_) => {
                u32::from(direction.x > 0.0)
                    | u32::from(direction.y > 0.0) << 1
                    | u32::from(direction.z > 0.0) << 2
            }
            Shape::Triangle(triangle) => {
                let [a, b, c] = triangle.vertices();
                let (to_b, to_c) = (direction.dot(b - a), direction.dot(c - a));
                if to_b > 0.0 && to_b >= to_c {
                    1
                } else if to_c > 0.0 {
                    2
                } else {
                    0
                }
            }
            Shape::Polytope(polytope) => polytope.support(direction),
        }
    }

    /// The vertex farthest along a direction of the world.
    pub(super) fn support(&self, direction: DVec3) -> u32 {
        self.support_local(self.rotation.transpose() * direction)
    }

    pub(super) fn vertex_count(&self) -> usize {
        match self.shape {
            Shape::Sphere(_) => 0,
            Shape::Cuboid(_) => 8,
            Shape::Triangle(_) => 3,
            Shape::Polytope(polytope) => polytope.vertices().len(),
        }
    }

    pub(super) fn face_count(&self) -> usize {
        match self.shape {
            Shape::Sphere(_) => 0,
            Shape::Cuboid(_) => 6,
            Shape::Triangle(_) => 2,
            Shape::Polytope(polytope) => polytope.face_normals().len(),
        }
    }

    /// Outward unit normal of a face in the shape's own frame.
    pub(super) fn face_normal_local(&self, face: u32) -> DVec3 {
        let side = if face & 1 == 1 { 1.0 } else { -1.0 };
        match self.shape {
            Shape::Sphere(_) => DVec3::ZERO,
            Shape::Cuboid(_) => side * DVec3::AXES[face as usize / 2 % 3],
            Shape::Triangle(triangle) => -side * triangle.normal(),
            Shape::Polytope(polytope) => polytope.face_normals()[face as usize],
        }
    }

    /// Outward unit normal of a face along the world's axes.
    pub(super) fn face_normal(&self, face: u32) -> DVec3 {
        self.rotation * self.face_normal_local(face)
    }

    /// From an edge's first vertex to its second along the world's axes, of unit length.
    pub(super) fn edge_direction(&self, edge: &Edge) -> DVec3 {
        let [from, to] = edge.vertices;
        (self.rotation * (self.local(to) - self.local(from))).normalize_or_zero()
    }

    /// Outward normals of a triangle's edges, in its plane; none for a solid.
    pub(super) fn rim_normals(&self) -> Option<[DVec3; 3]> {
        let Shape::Triangle(triangle) = self.shape else {
            return None;
        };
        let ([a, b, c], normal) = (triangle.vertices(), triangle.normal());
        Some(
            [b - a, c - b, a - c]
                .map(|edge| self.rotation * edge.cross(normal).normalize_or_zero()),
        )
    }
}

fn corner(cuboid: &Cuboid, index: u32) -> DVec3 {
    let half = cuboid.half_extents();
    let side = |bit: u32, length: f64| {
        if index >> bit & 1 == 1 {
            length
        } else {
            -length
        }
    };
    DVec3::new(side(0, half.x), side(1, half.y), side(2, half.z))
}
