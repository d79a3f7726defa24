//! Whether a plain feature is what lies farthest along a direction.
//!
//! On a convex body it is if its neighbours lie lower, and lower by more than
//! rounding: what is not plain is left to `snap`.

use super::body::Body;
use super::snap::FEATURE;
use crate::geometry::Shape;
use glam::DVec3;

impl Body<'_> {
    /// Whether a vertex lies farther than all others along a unit vector of the shape's frame.
    #[inline]
    pub(super) fn peaks_at(&self, vertex: u32, direction: DVec3) -> bool {
        let margin = FEATURE * self.radius;
        match self.shape {
            Shape::Sphere(_) => false,
            Shape::Cuboid(cuboid) => {
                (2.0 * cuboid.half_extents() * direction.abs()).min_element() > margin
            }
            Shape::Triangle(triangle) => {
                let vertices = triangle.vertices();
                let [first, second] = others(vertex).map(|other| vertices[other]);
                let here = vertices[vertex as usize % 3];
                let drop = |other: DVec3| direction.dot(here - other);
                drop(first).min(drop(second)) > margin
            }
            Shape::Polytope(polytope) => {
                let vertices = polytope.vertices();
                let here = vertices[vertex as usize];
                let neighbours = polytope.neighbours(vertex);
                let lower = |&other: &u32| direction.dot(here - vertices[other as usize]) > margin;
                !neighbours.is_empty() && neighbours.iter().all(lower)
            }
        }
    }

    /// The edge between two vertices, if it lies farther than all else along a unit vector.
    #[inline]
    pub(super) fn crests_at(&self, ends: [u32; 2], direction: DVec3) -> Option<u32> {
        let margin = FEATURE * self.radius;
        let [from, to] = ends;
        match self.shape {
            Shape::Sphere(_) => None,
            Shape::Cuboid(cuboid) => {
                let drop = 2.0 * cuboid.half_extents() * direction.abs();
                // As `Cuboid::EDGES` has them: four along each axis.
                let (least, edge) = match from ^ to {
                    1 => (drop.y.min(drop.z), from >> 1),
                    2 => (drop.x.min(drop.z), 4 + (from & 1 | from >> 1 & 2)),
                    4 => (drop.x.min(drop.y), 8 + (from & 3)),
                    _ => return None,
                };
                (least > margin).then_some(edge)
            }
            Shape::Triangle(triangle) => {
                let vertices = triangle.vertices();
                let (from, to) = (from as usize, to as usize);
                let third = vertices.get(3_usize.checked_sub(from + to)?)?;
                let drop = direction.dot(*vertices.get(from)? - *third);
                // Edges run from 0 to 1, from 1 to 2 and from 2 to 0.
                let edge = match from + to {
                    1 => 0,
                    3 => 1,
                    _ => 2,
                };
                (drop > margin).then_some(edge)
            }
            Shape::Polytope(polytope) => {
                let vertices = polytope.vertices();
                let edge = polytope.edge_between(from, to)?;
                let lower = |here: u32, there: u32| {
                    let neighbours = polytope.neighbours(here);
                    let here = vertices[here as usize];
                    (neighbours.iter()).all(|&other| {
                        other == there || direction.dot(here - vertices[other as usize]) > margin
                    })
                };
                (lower(from, to) && lower(to, from)).then_some(edge)
            }
        }
    }

    /// The face through three vertices and its outward normal, of those along a direction.
    #[inline]
    pub(super) fn face_through(&self, corners: [u32; 3], direction: DVec3) -> Option<(u32, DVec3)> {
        match self.shape {
            Shape::Sphere(_) => None,
            Shape::Cuboid(_) => {
                let [p, q, r] = corners;
                let face = match !(p ^ q | p ^ r) & 7 {
                    1 => p & 1,
                    2 => 2 | p >> 1 & 1,
                    4 => 4 | p >> 2 & 1,
                    _ => return None,
                };
                Some((face, self.face_normal_local(face)))
            }
            Shape::Triangle(triangle) => {
                let face = u32::from(triangle.normal().dot(direction) < 0.0);
                Some((face, self.face_normal_local(face)))
            }
            Shape::Polytope(polytope) => {
                let around = |corner: &u32| polytope.edge_map().around_vertex(*corner);
                // A cone's tip has many.
                let corner = corners.iter().min_by_key(|corner| around(corner).len())?;
                let normals = polytope.face_normals();
                let mut best = (f64::NEG_INFINITY, 0);
                for &edge in around(corner) {
                    for face in polytope.edges()[edge as usize].faces {
                        let along = normals[face as usize].dot(direction);
                        if along > best.0 {
                            best = (along, face);
                        }
                    }
                }
                let (_, face) = best;
                let normal = *normals.get(face as usize)?;
                let here = polytope.vertices()[corners[0] as usize];
                let level = |&corner: &u32| {
                    let step = polytope.vertices()[corner as usize] - here;
                    normal.dot(step).abs() <= FEATURE * self.radius
                };
                corners.iter().all(level).then_some((face, normal))
            }
        }
    }
}

/// The other two vertices of a triangle.
fn others(vertex: u32) -> [usize; 2] {
    match vertex {
        0 => [1, 2],
        1 => [2, 0],
        _ => [0, 1],
    }
}
