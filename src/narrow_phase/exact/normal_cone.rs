//! All normals that part two bodies in touch.

use super::body::Body;
use super::edges::edge_normal;
use crate::geometry::{Pose, Shape};
use glam::DVec3;

/// Share of a body's radius up to which it counts as reaching a point.
const NEAR: f64 = 1e-9;

/// The corners of the cone of valid normals where two shapes touch: unit vectors, out of `b`
/// towards `a`, of which every other valid normal is a combination with positive weights.
///
/// The poses are those at the touch, and `point` is one they share, as an offset from `b`'s
/// position along the world's axes; what lies within 1e-9 of a body's radius around it counts as
/// in touch. A vertex on a face, two edges that cross, and anything on a ball, have one normal;
/// a vertex on an edge has an arc of them, with two corners; a vertex on a vertex has as many as its faces
/// and edges make. They are in no particular order. Empty if the shapes do not touch there.
///
/// Each corner is the normal of a face at the point, or across an edge of each: all of these are
/// tried. O((f + e²) · v) for f faces and e edges at the point and v vertices.
///
/// ```
/// use feeler::narrow_phase::exact::normal_cone;
/// use feeler::{Cuboid, Pose, Shape, ShapeError};
/// use glam::DVec3;
///
/// // Two boxes that touch along an edge of each: every normal between their faces' will do.
/// let cube = Shape::from(Cuboid::new([1.0, 1.0, 1.0])?);
/// let (a, b) = (Pose::at([2.0, 2.0, 0.0]), Pose::IDENTITY);
/// let corners = normal_cone(&cube, &a, &cube, &b, DVec3::new(1.0, 1.0, 0.0));
/// assert_eq!(corners.len(), 2);
/// assert!(corners.contains(&DVec3::X) && corners.contains(&DVec3::Y));
/// # Ok::<(), ShapeError>(())
/// ```
#[must_use]
pub fn normal_cone(a: &Shape, pose_a: &Pose, b: &Shape, pose_b: &Pose, point: DVec3) -> Vec<DVec3> {
    let to_a = point - (pose_a.position - pose_b.position);
    let (Some(a), Some(b)) = (
        Side::new(a, pose_a, to_a, -1.0),
        Side::new(b, pose_b, point, 1.0),
    ) else {
        return Vec::new();
    };
    let mut corners: Vec<DVec3> = Vec::new();
    let mut show = |normal: DVec3| {
        let known = |corner: &DVec3| corner.distance_squared(normal) < NEAR * NEAR;
        if a.allows(normal) && b.allows(normal) && !corners.iter().any(known) {
            corners.push(normal);
        }
    };
    a.normals.iter().chain(&b.normals).for_each(|&n| show(n));
    for &edge_a in &a.edges {
        for &edge_b in &b.edges {
            if let Some(normal) = edge_normal(edge_a, edge_b) {
                show(normal);
                show(-normal);
            }
        }
    }
    corners
}

/// One of the bodies around the point.
struct Side {
    /// Normals of the faces there, turned out of B.
    normals: Vec<DVec3>,
    /// Unit vectors along the edges there.
    edges: Vec<DVec3>,
    /// From the point to all vertices, turned out of B.
    vertices: Vec<DVec3>,
    slack: f64,
}

impl Side {
    /// `sign` is −1 for A, whose normals lead into B; none if the body is not near the point.
    fn new(shape: &Shape, pose: &Pose, point: DVec3, sign: f64) -> Option<Self> {
        if let Shape::Sphere(ball) = shape {
            let radius = ball.radius();
            let on_surface = (point.length() - radius).abs() <= NEAR * radius;
            return on_surface.then(|| Self {
                normals: vec![sign * point.normalize_or(DVec3::X)],
                edges: Vec::new(),
                vertices: Vec::new(),
                slack: NEAR * radius,
            });
        }
        let body = Body::new(shape, pose.orientation)?;
        let point = point - body.rotation * body.centre;
        let slack = NEAR * body.radius;
        let count = body.vertex_count() as u32;
        let vertices: Vec<DVec3> = (0..count).map(|v| body.vertex(v) - point).collect();
        let top = |normal: DVec3| {
            let heights = vertices.iter().map(|&vertex| normal.dot(vertex));
            heights.fold(f64::NEG_INFINITY, f64::max)
        };
        let faces = (0..body.face_count() as u32).map(|face| body.face_normal(face));
        let rims = body.rim_normals().into_iter().flatten();
        let all: Vec<DVec3> = faces.chain(rims).collect();
        if all.iter().any(|&normal| top(normal) < -slack) {
            return None;
        }
        let there = |normal: &&DVec3| top(**normal) <= slack;
        let normals: Vec<DVec3> = all.iter().filter(there).map(|&n| sign * n).collect();
        let mesh = body.mesh()?;
        let edges = (mesh.edges.iter())
            .filter(|edge| {
                let [from, to] = edge.vertices.map(|vertex| vertices[vertex as usize]);
                let along = to - from;
                let share = (-from.dot(along) / along.length_squared()).clamp(0.0, 1.0);
                (from + share * along).length() <= slack
            })
            .map(|edge| body.edge_direction(edge))
            .collect();
        Some(Self {
            normals,
            edges,
            vertices: vertices.iter().map(|&vertex| sign * vertex).collect(),
            slack,
        })
    }

    /// Whether the body keeps behind the plane across a normal through the point.
    fn allows(&self, normal: DVec3) -> bool {
        if self.vertices.is_empty() {
            return self.normals.iter().all(|own| own.dot(normal) > 1.0 - NEAR);
        }
        self.vertices
            .iter()
            .all(|&vertex| normal.dot(vertex) <= self.slack)
    }
}
