//! Convex polytopes.

use crate::error::ShapeError;
use glam::DVec3;

/// An edge of a polytope, cuboid or triangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Edge {
    /// The two vertices it joins.
    pub vertices: [u32; 2],
    /// The faces on its two sides: seen from outside, running from the first
    /// vertex to the second, the first face lies to the left.
    pub faces: [u32; 2],
}

/// A flat face of a polytope: the half-space `normal · x ≤ offset` holds the whole body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face<'a> {
    /// Unit normal, pointing outwards.
    pub normal: DVec3,
    /// Largest `normal · x` over the vertices, in metres.
    pub offset: f64,
    /// The vertices around it, counter-clockwise seen from outside.
    pub vertices: &'a [u32],
}

/// A solid convex polytope.
#[derive(Debug, Clone, PartialEq)]
pub struct Polytope {
    vertices: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    edges: Vec<Edge>,
    normals: Vec<DVec3>,
    offsets: Vec<f64>,
    centre: DVec3,
    max_dist: f64,
}

impl Polytope {
    /// The convex hull of `points`.
    ///
    /// # Errors
    /// See [`ShapeError`].
    pub fn from_points<P: Into<DVec3>>(
        _points: impl IntoIterator<Item = P>,
    ) -> Result<Self, ShapeError> {
        Err(ShapeError::TooFewPoints { count: 0, min: 4 })
    }

    /// The vertices in metres.
    #[must_use]
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// Corners of the triangles.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The edges.
    #[must_use]
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// Outward unit normals of the faces.
    #[must_use]
    pub fn face_normals(&self) -> &[DVec3] {
        &self.normals
    }

    /// `normal · x` of the faces' planes.
    #[must_use]
    pub fn face_offsets(&self) -> &[f64] {
        &self.offsets
    }

    /// Centre of the bounding sphere.
    #[must_use]
    pub fn centre(&self) -> DVec3 {
        self.centre
    }

    /// Largest distance from the centre to the surface.
    #[must_use]
    pub fn max_dist(&self) -> f64 {
        self.max_dist
    }
}
