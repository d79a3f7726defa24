//! From a normal that is right but for rounding to the features that touch, and
//! from them the touch afresh.

use super::body::Body;
use super::edges::edge_normal;
use super::pair::{Pair, STEEP};
use super::patch;
use crate::geometry::{Feature, Polytope, Shape};
use crate::math::frame::orthonormal;
use crate::math::short_list::ShortList;
use glam::{DVec2, DVec3};

/// Share of a body's radius within which vertices lie in one feature.
///
/// A normal computed from two features is right to some 1e-15; the margin leaves
/// room for shapes whose own numbers were rounded. Larger, and an edge
/// turned by a hair from a face is taken for part of it.
pub(super) const FEATURE: f64 = 1e-12;

/// How many times as much where features seem not to meet, one after the other.
pub(super) const WIDE: [f64; 3] = [16.0, 256.0, 4096.0];

/// Up to this many vertices are all looked at; of more, only those around the farthest.
const FEW: usize = 24;

/// How two bodies touch, in scaled motions.
pub(super) struct Touch {
    pub(super) time: f64,
    pub(super) normal: DVec3,
    pub(super) features: [Feature; 2],
    pub(super) point: Place,
    /// Whether the features themselves gave the normal, and the time that was known.
    pub(super) certain: bool,
}

/// A point as an offset from the centre of one of the bodies.
pub(super) enum Place {
    OnA(DVec3),
    OnB(DVec3),
}

/// The part of a body that lies farthest along a direction, and its corners.
pub(super) struct Summit {
    feature: Feature,
    pub(super) corners: ShortList<u32, 32>,
}

impl Pair<'_> {
    /// The touch whose normal and time are right but for rounding; the `known` vertices of A and
    /// B touch, the first of them lie farthest along the normal.
    pub(super) fn touch<const N: usize>(
        &self,
        near: DVec3,
        near_time: f64,
        known: [[u32; 2]; N],
    ) -> Touch {
        let summit_a = summit(&self.a, -near, known.map(|[a, _]| a));
        let summit_b = summit(&self.b, near, known.map(|[_, b]| b));
        let features = [summit_a.feature, summit_b.feature];
        let (mut normal, mut time, mut certain) = (near, near_time, false);
        if let Some(sharp) = self.normal_of(features, near) {
            let (speed, sharp_speed) = (near.dot(self.motion), sharp.dot(self.motion));
            let sharp_time = self.reach(sharp, &summit_a, &summit_b) / sharp_speed;
            let moved = sharp_time - near_time;
            // Features found a hair off the ray must not move it.
            let error = (moved * speed).abs().max((moved * sharp_speed).abs());
            // A face so small that its tilt does not show may have a large neighbour.
            let all = self.height(sharp, self.supports(sharp));
            let hidden = (all - sharp_time * sharp_speed).abs();
            if sharp_speed <= 0.0 && error <= self.doubt() && hidden <= self.doubt() {
                (normal, certain) = (sharp, true);
                // Of what is nearly along the motion rounding makes long times.
                if sharp_speed.abs() > STEEP {
                    time = sharp_time;
                }
            }
        }
        let point = self.point(normal, time, &summit_a, &summit_b);
        Touch {
            time,
            normal,
            features,
            point,
            certain,
        }
    }

    /// By how much heights that should be equal may differ, in metres.
    pub(super) fn doubt(&self) -> f64 {
        64.0 * (self.rounding + f64::EPSILON * self.offset.abs().max_element())
    }

    /// The unit normal that the features themselves give.
    fn normal_of(&self, [feature_a, feature_b]: [Feature; 2], near: DVec3) -> Option<DVec3> {
        let normal = match (feature_a, feature_b) {
            (_, Feature::Face(face)) => self.b.face_normal(face),
            (Feature::Face(face), _) => -self.a.face_normal(face),
            (Feature::Edge(a), Feature::Edge(b)) => {
                let edge = |body: &Body, edge: u32| {
                    let mesh = body.mesh()?;
                    Some(body.edge_direction(mesh.edges.get(edge as usize)?))
                };
                let (a, b) = (edge(&self.a, a)?, edge(&self.b, b)?);
                // Of parallel edges any normal around them is as good.
                if a.cross(b).length_squared() < 1e-28 {
                    return None;
                }
                let normal = edge_normal(a, b)?;
                normal * normal.dot(near).signum()
            }
            _ => return None,
        };
        (normal.dot(near) > 0.999).then_some(normal)
    }

    fn reach(&self, normal: DVec3, a: &Summit, b: &Summit) -> f64 {
        let heights = |body: &Body, summit: &Summit, normal: DVec3| {
            (summit.corners.iter())
                .map(|&vertex| normal.dot(body.vertex(vertex)))
                .fold(f64::NEG_INFINITY, f64::max)
        };
        heights(&self.a, a, -normal) + heights(&self.b, b, normal) - normal.dot(self.offset)
    }

    fn point(&self, normal: DVec3, time: f64, a: &Summit, b: &Summit) -> Place {
        let first = |summit: &Summit| summit.corners.first().copied().unwrap_or_default();
        let (a0, b0) = (first(a), first(b));
        let to_a = self.nearest + (time - self.nearest_distance) * self.motion;
        if let Feature::Vertex(_) = b.feature {
            let point = self.b.vertex(b0);
            if within(&self.a, a, -normal, point - to_a, self.size) {
                return Place::OnB(point);
            }
        } else if let Feature::Vertex(_) = a.feature {
            let point = self.a.vertex(a0);
            if within(&self.b, b, normal, point + to_a, self.size) {
                return Place::OnA(point);
            }
        }
        // Seen from B's vertex: what is far away is rounded.
        let origin = self.b.vertex(b0);
        let to_a = to_a - origin;
        let (x, y) = orthonormal(normal);
        let flat = |body: &Body, summit: &Summit, shift: DVec3| {
            let points = summit.corners.iter().map(|&vertex| {
                let point = body.vertex(vertex) + shift;
                DVec2::new(point.dot(x), point.dot(y))
            });
            patch::around(points.collect())
        };
        let (top_a, top_b) = (flat(&self.a, a, to_a), flat(&self.b, b, -origin));
        let shared = patch::shared(&top_a, &top_b, self.size).or_else(|| {
            // Of faces that are parallel but for a hair rounding tells which edges meet: what
            // they share is sought among all that is nearly as far along the normal.
            WIDE.into_iter().find_map(|wide| {
                let a = summit_within(&self.a, -normal, [a0], wide * FEATURE);
                let b = summit_within(&self.b, normal, [b0], wide * FEATURE);
                let (a, b) = (flat(&self.a, &a, to_a), flat(&self.b, &b, -origin));
                patch::shared(&a, &b, self.size)
            })
        });
        let shared = shared.unwrap_or_else(|| patch::middle(&top_a, &top_b, self.size));
        Place::OnB(origin + (shared.x * x + shared.y * y))
    }
}

/// Whether a point known to lie level with a triangle, seen along its normal, lies in it; only
/// triangles are looked at.
fn within(body: &Body, summit: &Summit, normal: DVec3, point: DVec3, size: f64) -> bool {
    let [a, b, c] = *summit.corners else {
        return false;
    };
    let [a, b, c] = [a, b, c].map(|vertex| body.vertex(vertex) - point);
    let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(p, q)| normal.dot(p.cross(q)));
    let slack = 16.0 * f64::EPSILON * size * size;
    let (least, most) = (ab.min(bc).min(ca), ab.max(bc).max(ca));
    least >= -slack || most <= slack
}

/// What lies farthest along a direction of the world; `known` are some of its vertices.
pub(super) fn summit<const N: usize>(body: &Body, direction: DVec3, known: [u32; N]) -> Summit {
    summit_within(body, direction, known, FEATURE)
}

/// The same to within a share of the body's radius.
pub(super) fn summit_within<const N: usize>(
    body: &Body,
    direction: DVec3,
    known: [u32; N],
    share: f64,
) -> Summit {
    let local = body.rotation.transpose() * direction;
    let margin = share * body.radius;
    let start = known.first().copied().unwrap_or_default();
    let mut corners = ShortList::new();
    corners.push(start);
    for vertex in known {
        if !corners.contains(&vertex) {
            corners.push(vertex);
        }
    }
    let from = body.local(start);
    let level = |vertex: u32| (body.local(vertex) - from).dot(local) >= -margin;
    match body.shape {
        Shape::Polytope(polytope) if body.vertex_count() > FEW => {
            let mut next = 0;
            while let Some(&vertex) = corners.get(next) {
                next += 1;
                for &neighbour in polytope.neighbours(vertex) {
                    if level(neighbour) && !corners.contains(&neighbour) {
                        corners.push(neighbour);
                    }
                }
            }
        }
        _ => {
            for vertex in 0..body.vertex_count() as u32 {
                if level(vertex) && !corners.contains(&vertex) {
                    corners.push(vertex);
                }
            }
        }
    }
    Summit {
        feature: feature(body, local, &corners),
        corners,
    }
}

/// The feature that some vertices make up.
fn feature(body: &Body, direction: DVec3, vertices: &[u32]) -> Feature {
    let &[first, ref others @ ..] = vertices else {
        return Feature::Surface;
    };
    if others.is_empty() {
        return Feature::Vertex(first);
    }
    if let &[second] = others
        && let Some(edge) = edge_between(body, first, second)
    {
        return Feature::Edge(edge);
    }
    match body.shape {
        Shape::Sphere(_) => Feature::Surface,
        Shape::Cuboid(_) => {
            let axis = direction.abs().max_position();
            Feature::Face(2 * axis as u32 + u32::from(direction[axis] > 0.0))
        }
        Shape::Triangle(triangle) => {
            Feature::Face(u32::from(triangle.normal().dot(direction) < 0.0))
        }
        Shape::Polytope(polytope) => of_polytope(polytope, direction, vertices),
    }
}

/// The face, or for vertices in the middle of an edge the edge, that lies farthest along a direction.
fn of_polytope(polytope: &Polytope, direction: DVec3, vertices: &[u32]) -> Feature {
    let normals = polytope.face_normals();
    let along = |face: u32| normals[face as usize].dot(direction);
    let mut best: Option<(u32, f64)> = None;
    let mut show = |face: u32| {
        let along = along(face);
        if best.is_none_or(|(_, most)| along > most) {
            best = Some((face, along));
        }
    };
    let mut edge = None;
    for (index, &from) in vertices.iter().enumerate() {
        for &to in &vertices[index + 1..] {
            if let Some(found) = polytope.edge_between(from, to) {
                polytope.edges()[found as usize]
                    .faces
                    .into_iter()
                    .for_each(&mut show);
                edge = Some(found);
            }
        }
        // Two edges of a face name it.
        if index > 1 && edge.is_some() {
            break;
        }
    }
    if edge.is_none() {
        (0..normals.len() as u32).for_each(show);
    }
    match (best, edge) {
        (Some((_, most)), Some(edge)) if most < 1.0 - 1e-12 => Feature::Edge(edge),
        (Some((face, _)), _) => Feature::Face(face),
        (None, _) => Feature::Surface,
    }
}

fn edge_between(body: &Body, from: u32, to: u32) -> Option<u32> {
    if let Shape::Polytope(polytope) = body.shape {
        return polytope.edge_between(from, to);
    }
    let mesh = body.mesh()?;
    let place = mesh
        .edges
        .iter()
        .position(|edge| edge.vertices == [from, to] || edge.vertices == [to, from])?;
    Some(place as u32)
}
