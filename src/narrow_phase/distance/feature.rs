//! Which part of a body lies farthest along a direction.

use super::body::Body;
use crate::geometry::{Feature, Polytope, Shape};
use glam::DVec3;

/// Share of a body's size within which vertices lie in one feature.
///
/// A normal computed from two features is right to some 1e-15; the margin leaves
/// room for shapes whose own numbers were rounded. Larger, and an edge
/// turned by a hair from a face is taken for part of it.
const LEVEL: f64 = 1e-12;

/// How many times as far below the others a vertex may lie that is known to be of the feature.
///
/// Where bodies all but touch, rounding may take one for a corner of the nearest feature that is
/// none.
const KNOWN: f64 = 1e3;

/// The feature that lies farthest along a unit vector of the world; `known` are vertices of it.
pub(super) fn farthest(body: &Body, direction: DVec3, known: &[u32]) -> Feature {
    let &[first, ref others @ ..] = known else {
        return Feature::Surface;
    };
    let margin = LEVEL * body.size;
    match body.shape {
        Shape::Sphere(_) => Feature::Surface,
        Shape::Cuboid(_) => {
            let differing = others.iter().fold(0, |bits, other| bits | (first ^ other));
            of_cuboid(body.along_axes(direction), margin, first, differing)
        }
        Shape::Triangle(triangle) => {
            let heights = body.along_axes(direction);
            let most = heights.max_element();
            let level = |vertex: u32| {
                let slack = if known.contains(&vertex) {
                    KNOWN * margin
                } else {
                    margin
                };
                heights[vertex as usize] >= most - slack
            };
            match [level(0), level(1), level(2)] {
                [true, true, true] => {
                    let [a, b, c] = [0, 1, 2].map(|vertex| body.vertex(vertex));
                    let normal = (b - a).cross(c - a);
                    debug_assert!(triangle.normal().is_finite(), "a triangle without a side");
                    Feature::Face(u32::from(normal.dot(direction) < 0.0))
                }
                [true, true, false] => Feature::Edge(0),
                [false, true, true] => Feature::Edge(1),
                [true, false, true] => Feature::Edge(2),
                [_, false, false] => Feature::Vertex(0),
                [false, true, false] => Feature::Vertex(1),
                [false, false, true] => Feature::Vertex(2),
            }
        }
        Shape::Polytope(polytope) => {
            of_polytope(polytope, body.along_axes(direction), margin, known)
        }
    }
}

/// Along the axes in which vertices differ or are level, a cuboid's feature extends.
fn of_cuboid(heights: DVec3, margin: f64, vertex: u32, differing: u32) -> Feature {
    let extends =
        |axis: u32| differing >> axis & 1 == 1 || 2.0 * heights[axis as usize].abs() <= margin;
    let side = |axis: u32| vertex >> axis & 1;
    let face = |axis: u32| Feature::Face(2 * axis + side(axis));
    match [extends(0), extends(1), extends(2)] {
        [false, false, false] => Feature::Vertex(vertex),
        [true, false, false] => Feature::Edge(side(1) + 2 * side(2)),
        [false, true, false] => Feature::Edge(4 + side(0) + 2 * side(2)),
        [false, false, true] => Feature::Edge(8 + side(0) + 2 * side(1)),
        [false, true, true] => face(0),
        [true, false, true] => face(1),
        [true, true, false] => face(2),
        // Of a slab so thin that all is level.
        [true, true, true] => face(heights.abs().max_position() as u32),
    }
}

/// Edges of the first known vertex tell what it is part of.
fn of_polytope(polytope: &Polytope, direction: DVec3, margin: f64, known: &[u32]) -> Feature {
    let (vertices, edges) = (polytope.vertices(), polytope.edges());
    let above = |vertex: u32, other: u32| {
        (vertices[vertex as usize] - vertices[other as usize]).dot(direction)
    };
    // One that lies far below another is no part of it.
    let mut first = known.first().copied().unwrap_or_default();
    for &other in known {
        if above(other, first) > KNOWN * margin {
            first = other;
        }
    }
    let is_known = |vertex: u32| known.contains(&vertex) && above(vertex, first) >= -KNOWN * margin;
    let normals = polytope.face_normals();
    let around = polytope.edge_map().around_vertex(first);
    // What the known vertices prove: two are an edge at least, three a face.
    let proven = known.iter().filter(|&&vertex| is_known(vertex)).count();
    let (mut level, mut level_edge) = (0, None);
    let mut best: Option<(u32, f64)> = None;
    for &index in around {
        let edge = &edges[index as usize];
        let [from, to] = edge.vertices;
        let other = if from == first { to } else { from };
        if above(other, first) >= -margin || is_known(other) {
            level += 1;
            level_edge = Some(index);
        } else if proven < 2 {
            continue;
        }
        for face in edge.faces {
            let along = normals[face as usize].dot(direction);
            if best.is_none_or(|(_, most)| along > most) {
                best = Some((face, along));
            }
        }
    }
    if around.is_empty() {
        // A vertex amid a face.
        for (face, normal) in (0..).zip(normals) {
            let along = normal.dot(direction);
            if best.is_none_or(|(_, most)| along > most) {
                best = Some((face, along));
            }
        }
    }
    match (level, level_edge, best) {
        (0, _, _) if proven < 2 && !around.is_empty() => Feature::Vertex(first),
        (1, Some(edge), _) if proven < 3 => Feature::Edge(edge),
        (_, Some(edge), Some((_, most))) if proven < 3 && most < 1.0 - LEVEL => Feature::Edge(edge),
        (_, Some(edge), Some((face, _))) if !is_level(polytope, face, first, direction, margin) => {
            Feature::Edge(edge)
        }
        (_, _, Some((face, _))) => Feature::Face(face),
        _ => Feature::Vertex(first),
    }
}

/// Whether no vertex of a face lies far below `highest`, one of those farthest along a unit vector.
///
/// Two edges that are as good as one line prove no face. What a face is dented by is far less.
fn is_level(polytope: &Polytope, face: u32, highest: u32, direction: DVec3, margin: f64) -> bool {
    let vertices = polytope.vertices();
    let top = vertices[highest as usize];
    let coordinate = polytope.centre().abs().max_element();
    let slack = KNOWN * margin + 256.0 * f64::EPSILON * coordinate;
    (polytope.rim(face).iter())
        .all(|&vertex| (top - vertices[vertex as usize]).dot(direction) <= slack)
}
