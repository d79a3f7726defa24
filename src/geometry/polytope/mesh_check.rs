//! Is a mesh the surface of a convex body?

use super::hull::{Hull, convex_hull};
use super::orient::{collinear, side};
use super::support::Support;
use super::topology;
use crate::error::ShapeError;
use crate::geometry::Aabb;
use crate::geometry::triangle::normal_and_height;
use glam::DVec3;
use std::collections::HashMap;

/// How far a vertex may lie from the hull's surface, or outside a triangle's
/// plane, as a share of the mesh's size; beside it the rounding of the
/// coordinates, 16 ulp of the largest. Files with 13 digits and bodies turned a
/// few times pass; larger, and dents deeper than the crate's accuracy would.
const CONVEX: f64 = 1e-12;

/// What is known of a mesh that passed.
pub(super) struct Checked {
    pub(super) hull: Hull,
    pub(super) support: Support,
}

/// Checks everything, from the simplest property to the deepest.
pub(super) fn check(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Result<Checked, ShapeError> {
    check_numbers(vertices, triangles)?;
    check_triangles(vertices, triangles)?;
    check_edges(triangles)?;
    check_connected(triangles)?;
    let hull = convex_hull(vertices)?;
    let support = hull.support(vertices);
    let checked = Checked { hull, support };
    checked.check_outward(vertices, triangles)?;
    checked.check_convex(vertices, triangles)?;
    checked.check_single(vertices, triangles)?;
    Ok(checked)
}

/// Every vertex is named, exists, and is like no other.
fn check_numbers(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Result<(), ShapeError> {
    let count = vertices.len();
    let mut used = vec![false; count];
    for (triangle, corners) in triangles.iter().enumerate() {
        for &corner in corners {
            let vertex = corner as usize;
            *(used.get_mut(vertex)).ok_or(ShapeError::NoSuchVertex {
                triangle,
                vertex,
                count,
            })? = true;
        }
    }
    let mut places = HashMap::with_capacity(count);
    for (second, vertex) in vertices.iter().enumerate() {
        if let Some(first) = places.insert(vertex.to_array().map(f64::to_bits), second) {
            return Err(ShapeError::DuplicateVertex { first, second });
        }
    }
    match used.iter().position(|used| !used) {
        Some(vertex) => Err(ShapeError::UnusedVertex { vertex }),
        None => Ok(()),
    }
}

/// No triangle's corners lie on one line. Exact, without a floor on the height:
/// the hull of near neighbours has slivers, and its mesh shall pass.
fn check_triangles(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Result<(), ShapeError> {
    let degenerate = triangles.iter().position(|corners| {
        let [a, b, c] = corners.map(|corner| vertices[corner as usize]);
        collinear(a, b, c)
    });
    match degenerate {
        Some(triangle) => Err(ShapeError::DegenerateTriangle {
            triangle,
            height: 0.0,
            min: f64::MIN_POSITIVE,
        }),
        None => Ok(()),
    }
}

/// Every edge lies between two triangles that run through it in opposite ways.
fn check_edges(triangles: &[[u32; 3]]) -> Result<(), ShapeError> {
    let mut edges = Vec::with_capacity(3 * triangles.len());
    for (triangle, corners) in triangles.iter().enumerate() {
        for slot in 0..3 {
            let (from, to) = (corners[slot], corners[(slot + 1) % 3]);
            edges.push((from.min(to), from.max(to), triangle, from));
        }
    }
    edges.sort_unstable();
    let mut clashes = Vec::new();
    for same in edges.chunk_by(|e, f| (e.0, e.1) == (f.0, f.1)) {
        match *same {
            [(_, _, a, from_a), (_, _, b, from_b)] => {
                if from_a == from_b {
                    clashes.extend([(a, b), (b, a)]);
                }
            }
            [(low, high, triangle, from), ..] => {
                return Err(ShapeError::NotClosed {
                    triangle,
                    from: from as usize,
                    to: (if from == low { high } else { low }) as usize,
                    count: same.len(),
                });
            }
            [] => {}
        }
    }
    // A single triangle the wrong way round clashes with all its neighbours,
    // each of them only with it: name the one that clashes most.
    clashes.sort_unstable();
    let of_one = clashes.chunk_by(|c, d| c.0 == d.0);
    match of_one.rev().max_by_key(|clashes| clashes.len()) {
        Some([(triangle, neighbour), ..]) => Err(ShapeError::InconsistentWinding {
            triangle: *triangle,
            neighbour: *neighbour,
        }),
        _ => Ok(()),
    }
}

/// Every triangle can be reached from the first over edges.
fn check_connected(triangles: &[[u32; 3]]) -> Result<(), ShapeError> {
    let neighbours = topology::neighbours(triangles);
    let mut reached = vec![false; triangles.len()];
    let mut pending = vec![0];
    while let Some(triangle) = pending.pop() {
        let triangle = triangle as usize;
        if reached.get(triangle) == Some(&false) {
            reached[triangle] = true;
            pending.extend(neighbours[triangle]);
        }
    }
    match reached.iter().position(|reached| !reached) {
        Some(triangle) => Err(ShapeError::NotConnected { triangle }),
        None => Ok(()),
    }
}

impl Checked {
    fn check_outward(&self, vertices: &[DVec3], triangles: &[[u32; 3]]) -> Result<(), ShapeError> {
        let middle = self.hull.middle(vertices);
        if volume(vertices, triangles, middle) > 0.0 {
            return Ok(());
        }
        let triangle = (triangles.iter())
            .position(|&triangle| volume(vertices, &[triangle], middle) < 0.0)
            .unwrap_or(0);
        Err(ShapeError::InsideOut { triangle })
    }

    /// No vertex lies outside a triangle's plane, and none deep in the hull.
    ///
    /// A sliver's plane is rounding, so what counts as a vertex's distance from a
    /// triangle is the least height of the tetrahedron of both: how far one of
    /// the four must move to bring all onto one plane. For a small triangle seen
    /// from afar that is lenient, hence the second test.
    fn check_convex(&self, vertices: &[DVec3], triangles: &[[u32; 3]]) -> Result<(), ShapeError> {
        let tolerance = self.tolerance(vertices);
        for (triangle, corners) in triangles.iter().enumerate() {
            let [a, b, c] = corners.map(|corner| vertices[corner as usize]);
            let (normal, _) = normal_and_height([a, b, c]);
            let vertex = self.support.vertex(vertices, normal) as usize;
            let far = vertices[vertex];
            let widest = [[a, b, c], [a, b, far], [b, c, far], [c, a, far]]
                .into_iter()
                .map(|[a, b, c]| (b - a).cross(c - a).length())
                .fold(0.0, f64::max);
            let outside = side([a, b, c], far);
            if outside > tolerance * widest {
                return Err(ShapeError::NotConvex {
                    triangle,
                    vertex,
                    distance: normal.dot(far - a),
                });
            }
        }
        self.check_depth(vertices, triangles, tolerance)
    }

    /// Every vertex that is no corner of the hull lies on the hull's surface.
    fn check_depth(
        &self,
        vertices: &[DVec3],
        triangles: &[[u32; 3]],
        tolerance: f64,
    ) -> Result<(), ShapeError> {
        let mut corner = vec![false; vertices.len()];
        for &vertex in &self.hull.vertices {
            corner[vertex as usize] = true;
        }
        let planes: Vec<(DVec3, DVec3)> = (self.hull.triangles_of_points())
            .map(|triangle| {
                let corners = triangle.map(|corner| vertices[corner as usize]);
                (normal_and_height(corners).0, corners[0])
            })
            .collect();
        for (vertex, _) in corner.iter().enumerate().filter(|(_, corner)| !**corner) {
            let depths = (planes.iter()).map(|(normal, on)| normal.dot(on - vertices[vertex]));
            let mut depth = f64::INFINITY;
            for below in depths {
                depth = depth.min(below);
                if depth <= tolerance {
                    break;
                }
            }
            if depth > tolerance {
                let triangle = (triangles.iter())
                    .position(|corners| corners.contains(&(vertex as u32)))
                    .unwrap_or(0);
                let corners = triangles[triangle].map(|corner| vertices[corner as usize]);
                let outside = (self.support).vertex(vertices, normal_and_height(corners).0);
                return Err(ShapeError::NotConvex {
                    triangle,
                    vertex: outside as usize,
                    distance: depth,
                });
            }
        }
        Ok(())
    }

    /// All triangles lie on the hull and face outwards; they could still go
    /// round it more than once, like the arms of a five-pointed star.
    fn check_single(&self, vertices: &[DVec3], triangles: &[[u32; 3]]) -> Result<(), ShapeError> {
        let middle = self.hull.middle(vertices);
        let hull: Vec<[u32; 3]> = self.hull.triangles_of_points().collect();
        let layers = volume(vertices, triangles, middle) / volume(vertices, &hull, middle);
        if layers < 1.5 {
            Ok(())
        } else {
            Err(ShapeError::Overlapping {
                layers: layers.round() as usize,
            })
        }
    }

    fn tolerance(&self, vertices: &[DVec3]) -> f64 {
        let size = Aabb::around(vertices.iter().copied())
            .half_extents()
            .length();
        (CONVEX * size + self.hull.rounding(vertices)).min(1e-3 * self.hull.thickness)
    }
}

/// Six times the volume between the triangles and a point amid them. Each part has the right sign:
/// that of a needle is lost in the rounding of plain products.
fn volume(vertices: &[DVec3], triangles: &[[u32; 3]], middle: DVec3) -> f64 {
    (triangles.iter())
        .map(|corners| -side(corners.map(|corner| vertices[corner as usize]), middle))
        .sum()
}
