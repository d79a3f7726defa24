//! Edges and faces by their corners.

use super::body::Body;
use super::snap::FEATURE;
use crate::geometry::Shape;
use glam::DVec3;

impl Body<'_> {
    /// The edge between two vertices.
    #[inline]
    pub(super) fn edge_between(&self, [from, to]: [u32; 2]) -> Option<u32> {
        match self.shape {
            Shape::Sphere(_) => None,
            // As `Cuboid::EDGES` has them: four along each axis.
            Shape::Cuboid(_) => match from ^ to {
                1 => Some(from >> 1),
                2 => Some(4 + (from & 1 | from >> 1 & 2)),
                4 => Some(8 + (from & 3)),
                _ => None,
            },
            // From 0 to 1, from 1 to 2 and from 2 to 0.
            Shape::Triangle(_) => match from + to {
                1 => Some(0),
                3 => Some(1),
                _ => Some(2),
            },
            Shape::Polytope(polytope) => polytope.edge_between(from, to),
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
                let normals = polytope.face_normals();
                // Most faces are triangles: two of its edges name it.
                let [p, q, r] = corners;
                let map = polytope.edge_map();
                if let (Some(first), Some(second)) = (map.between(p, q), map.between(q, r)) {
                    let (first, second) = (map.line(first).faces, map.line(second).faces);
                    let shared = first.into_iter().find(|face| second.contains(face))?;
                    return Some((shared, *normals.get(shared as usize)?));
                }
                let around = |corner: &u32| polytope.edge_map().around_vertex(*corner);
                // A cone's tip has many.
                let corner = corners.iter().min_by_key(|corner| around(corner).len())?;
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
