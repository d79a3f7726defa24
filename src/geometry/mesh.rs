//! One view of every shape that has vertices, edges and triangles.

use crate::geometry::{Cuboid, Edge, Shape, Triangle};
use glam::DVec3;
use std::ops::Deref;

/// Vertices, edges and triangles of a shape, in its own frame.
///
/// Spheres have none. Rays start from these, whatever shape they belong to.
pub(crate) struct Mesh<'a> {
    pub(crate) vertices: Vertices<'a>,
    pub(crate) edges: &'a [Edge],
    /// Counter-clockwise seen from outside; a triangle's own are both its sides.
    pub(crate) triangles: &'a [[u32; 3]],
}

/// Borrowed from a polytope, or made on the spot for a cuboid or triangle.
pub(crate) enum Vertices<'a> {
    Borrowed(&'a [DVec3]),
    Cuboid([DVec3; 8]),
    Triangle([DVec3; 3]),
}

impl Deref for Vertices<'_> {
    type Target = [DVec3];

    fn deref(&self) -> &[DVec3] {
        match self {
            Self::Borrowed(vertices) => vertices,
            Self::Cuboid(vertices) => vertices,
            Self::Triangle(vertices) => vertices,
        }
    }
}

const TRIANGLE_EDGES: [Edge; 3] = [
    Edge {
        vertices: [0, 1],
        faces: [0, 1],
    },
    Edge {
        vertices: [1, 2],
        faces: [0, 1],
    },
    Edge {
        vertices: [2, 0],
        faces: [0, 1],
    },
];

impl<'a> Mesh<'a> {
    /// The shape's mesh, or none if its surface is smooth.
    pub(crate) fn of(shape: &'a Shape) -> Option<Self> {
        match shape {
            Shape::Sphere(_) => None,
            Shape::Cuboid(cuboid) => Some(Self::of_cuboid(cuboid)),
            Shape::Triangle(triangle) => Some(Self::of_triangle(triangle)),
            Shape::Polytope(polytope) => Some(Self {
                vertices: Vertices::Borrowed(polytope.vertices()),
                edges: polytope.edges(),
                triangles: polytope.triangles(),
            }),
        }
    }

    fn of_cuboid(cuboid: &Cuboid) -> Self {
        Self {
            vertices: Vertices::Cuboid(cuboid.vertices()),
            edges: &Cuboid::EDGES,
            triangles: &Cuboid::TRIANGLES,
        }
    }

    fn of_triangle(triangle: &Triangle) -> Self {
        Self {
            vertices: Vertices::Triangle(triangle.vertices()),
            edges: &TRIANGLE_EDGES,
            triangles: &[[0, 1, 2], [0, 2, 1]],
        }
    }
}
