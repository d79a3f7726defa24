//! Convex polytopes.

mod bounding_sphere;
mod faces;
mod hull;
mod orient;
mod simplex;
mod topology;
mod trim;

use crate::error::ShapeError;
use crate::math::domain;
use crate::tolerance::MAX_LENGTH;
use bounding_sphere::bounding_sphere;
use glam::DVec3;
use hull::{Hull, convex_hull};
use topology::Lists;

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
    /// The face each triangle is part of.
    triangle_faces: Vec<u32>,
    edges: Vec<Edge>,
    normals: Vec<DVec3>,
    offsets: Vec<f64>,
    rims: Lists,
    vertex_neighbours: Lists,
    centre: DVec3,
    max_dist: f64,
}

impl Polytope {
    /// The convex hull of `points`.
    ///
    /// # Errors
    /// See [`ShapeError`].
    pub fn from_points<P: Into<DVec3>>(
        points: impl IntoIterator<Item = P>,
    ) -> Result<Self, ShapeError> {
        let mut given = Vec::new();
        for point in points {
            let point = domain::vector("points", point.into(), MAX_LENGTH)?;
            given.push(orient::tidied(point));
        }
        if given.len() < 4 {
            return Err(ShapeError::TooFewPoints {
                count: given.len(),
                min: 4,
            });
        }
        let mut points = distinct(given);
        loop {
            let hull = convex_hull(&points)?;
            let (tolerance, vertices) = (flatness(&hull, &points), hull.pick(&points));
            let polytope = Self::assemble(vertices, hull.triangles, tolerance);
            let on_edges = polytope.vertices_with_edges();
            if on_edges.len() == polytope.vertices.len() {
                return Ok(polytope);
            }
            points = on_edges;
        }
    }

    fn vertices_with_edges(&self) -> Vec<DVec3> {
        let mut has_edge = vec![false; self.vertices.len()];
        for &vertex in self.edges.iter().flat_map(|edge| &edge.vertices) {
            has_edge[vertex as usize] = true;
        }
        (self.vertices.iter().zip(has_edge))
            .filter_map(|(&vertex, has_edge)| has_edge.then_some(vertex))
            .collect()
    }

    fn assemble(vertices: Vec<DVec3>, triangles: Vec<[u32; 3]>, tolerance: f64) -> Self {
        let neighbours = topology::neighbours(&triangles);
        let faces = faces::merge(&vertices, &triangles, &neighbours, tolerance);
        let (centre, max_dist) = bounding_sphere(&vertices);
        let mut polytope = Self {
            vertex_neighbours: topology::vertex_neighbours(vertices.len(), &triangles),
            vertices,
            triangles,
            triangle_faces: faces.of_triangle,
            edges: faces.edges,
            normals: faces.normals,
            offsets: Vec::new(),
            rims: faces.rims,
            centre,
            max_dist,
        };
        polytope.offsets = (polytope.normals.iter())
            .map(|normal| {
                (polytope.vertices.iter())
                    .map(|v| normal.dot(*v))
                    .fold(f64::NEG_INFINITY, f64::max)
            })
            .collect();
        polytope
    }

    /// The vertices in metres.
    #[must_use]
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// Corners of the triangles, counter-clockwise seen from outside.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The face each triangle is part of.
    #[must_use]
    pub fn triangle_faces(&self) -> &[u32] {
        &self.triangle_faces
    }

    /// The edges.
    #[must_use]
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// The faces, in the order of their numbers.
    pub fn faces(&self) -> impl ExactSizeIterator<Item = Face<'_>> {
        (0..self.rims.len() as u32).map(|face| Face {
            normal: self.normals[face as usize],
            offset: self.offsets[face as usize],
            vertices: self.rims.get(face),
        })
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

    /// The vertices a triangle's edge away from `vertex`.
    #[must_use]
    pub fn neighbours(&self, vertex: u32) -> &[u32] {
        self.vertex_neighbours.get(vertex)
    }
}

impl Hull {
    fn pick(&self, points: &[DVec3]) -> Vec<DVec3> {
        self.vertices.iter().map(|&v| points[v as usize]).collect()
    }
}

/// How far the vertices of one face may lie from its plane, in metres.
fn flatness(hull: &Hull, points: &[DVec3]) -> f64 {
    let largest = (points.iter())
        .map(|point| point.abs().max_element())
        .fold(0.0, f64::max);
    (16.0 * f64::EPSILON * largest).min(1e-3 * hull.thickness)
}

/// The points in their order, each once.
fn distinct(points: Vec<DVec3>) -> Vec<DVec3> {
    let mut seen = std::collections::HashSet::with_capacity(points.len());
    let key = |point: &DVec3| point.to_array().map(f64::to_bits);
    points.into_iter().filter(|p| seen.insert(key(p))).collect()
}
