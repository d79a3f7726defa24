//! Pairs of features in turn, as many as may be the nearest: slow and certain.

use super::frame::Frame;
use super::separator::{Found, Separator};
use super::simplex::{Nearest, Simplex};
use crate::geometry::Mesh;
use glam::DVec3;

/// What of a body may be part of the nearest pair.
struct Near {
    vertices: Vec<u32>,
    edges: Vec<[u32; 2]>,
    triangles: Vec<[u32; 3]>,
}

/// The nearest pair of a vertex of one and a triangle of the other, or of two edges; none if a
/// triangle is pierced, or one body lies in the other.
///
/// The difference's surface is made of such pairs. `found` is where a search ended: along its
/// normal the nearest pair is no farther apart than its distance, and all are at least
/// the gap apart, so that neither body's part of the pair lies deeper than
/// the one less the other. What does is left out. `offset` leads from B's centre to A's.
pub(super) fn nearest(
    pair: &Separator,
    offset: DVec3,
    found: &Found,
    rounding: f64,
) -> Option<(Simplex, Nearest)> {
    let separation = &found.separation;
    let depth = separation.distance - separation.gap + 4.0 * rounding;
    let near_a = Near::new(pair, 0, -separation.normal, depth);
    let near_b = Near::new(pair, 1, separation.normal, depth);
    let reach = separation.distance + pair.radii() + 4.0 * rounding;
    let search = Search {
        pair,
        offset,
        reach,
    };
    if search.contained() || search.pierced(&near_a, &near_b) {
        return None;
    }
    let (simplex, mut nearest) = search.nearest(&near_a, &near_b)?;
    let height = nearest.square.sqrt();
    let proven = pair.gap_at(offset, nearest.point / height);
    if height - pair.radii() - proven > rounding
        && let Some((gap, normal)) = search.parting(&near_a, &near_b)
        && gap > proven
    {
        nearest.point = height * normal;
    }
    Some((simplex, nearest))
}

impl Near {
    /// The features of a body (A is 0, B 1) that reach to within `depth` of its farthest point
    /// along `direction`.
    fn new(pair: &Separator, side: usize, direction: DVec3, depth: f64) -> Self {
        let body = if side == 0 { &pair.a } else { &pair.b };
        let heights: Vec<f64> = (0..body.vertex_count())
            .map(|vertex| body.vertex(vertex).dot(direction))
            .collect();
        let most = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let near = |vertex: &u32| most - heights[*vertex as usize] <= depth;
        let (mut edges, mut triangles) = (Vec::new(), Vec::new());
        if let Some(mesh) = Mesh::of(body.shape) {
            edges.extend(mesh.edges.iter().map(|edge| edge.vertices));
            triangles.extend_from_slice(mesh.triangles);
            edges.retain(|edge| edge.iter().any(near));
            triangles.retain(|triangle| triangle.iter().any(near));
        }
        Self {
            vertices: (0..body.vertex_count()).filter(near).collect(),
            edges,
            triangles,
        }
    }
}

struct Search<'a, 'b> {
    pair: &'a Separator<'b>,
    offset: DVec3,
    /// The nearest points of the cores are no farther apart.
    reach: f64,
}

impl Search<'_, '_> {
    /// Where A's vertex is seen from B's.
    fn point(&self, a: u32, b: u32) -> DVec3 {
        self.pair.probe(self.offset, [a, b]).point
    }

    fn nearest(&self, near_a: &Near, near_b: &Near) -> Option<(Simplex, Nearest)> {
        let mut best: Option<(Simplex, Nearest)> = None;
        let mut show = |corners: &[[u32; 2]]| {
            let mut simplex = Simplex::default();
            for &vertices in corners {
                simplex.push(self.pair.probe(self.offset, vertices));
            }
            if let Some(nearest) = simplex.reduce()
                && (best.as_ref()).is_none_or(|(_, least)| nearest.square < least.square)
            {
                best = Some((simplex, nearest));
            }
        };
        if near_a.triangles.is_empty() && near_b.triangles.is_empty() {
            show(&[[0, 0]]);
        }
        for &[i, j, k] in &near_a.triangles {
            for &b in &near_b.vertices {
                if self.meets([i, j, k].map(|a| self.point(a, b))) {
                    show(&[[i, b], [j, b], [k, b]]);
                }
            }
        }
        for &[i, j, k] in &near_b.triangles {
            for &a in &near_a.vertices {
                if self.meets([i, j, k].map(|b| self.point(a, b))) {
                    show(&[[a, i], [a, j], [a, k]]);
                }
            }
        }
        for &[i, j] in &near_a.edges {
            for &[k, l] in &near_b.edges {
                let corners = [[i, k], [j, k], [j, l], [i, l]];
                if self.meets(corners.map(|[a, b]| self.point(a, b))) {
                    show(&[[i, k], [j, k], [j, l]]);
                    show(&[[i, k], [i, l], [j, l]]);
                }
            }
        }
        best
    }

    /// The plane of a triangle or of two edges along which the bodies are farthest apart, and how far.
    ///
    /// Where all but touch the nearest point of such a plane may lie outside of what spans it
    /// but for rounding, and then the vector to the nearest corner or edge is mostly rounding.
    fn parting(&self, near_a: &Near, near_b: &Near) -> Option<(f64, DVec3)> {
        let mut best: Option<(f64, DVec3)> = None;
        let mut show = |normal: DVec3| {
            for normal in [normal, -normal] {
                let gap = self.pair.gap_at(self.offset, normal);
                if best.is_none_or(|(most, _)| gap > most) {
                    best = Some((gap, normal));
                }
            }
        };
        for (body, near) in [(&self.pair.a, near_a), (&self.pair.b, near_b)] {
            for &triangle in &near.triangles {
                let [a, b, c] = triangle.map(|vertex| body.vertex(vertex));
                let frame = if a.distance_squared(b) >= a.distance_squared(c) {
                    Frame::new(b - a, c - a)
                } else {
                    Frame::new(c - a, b - a)
                };
                if let Some(frame) = frame {
                    show(frame.normal);
                }
            }
        }
        for &[i, j] in &near_a.edges {
            let along = self.pair.a.vertex(j) - self.pair.a.vertex(i);
            for &[k, l] in &near_b.edges {
                let other = self.pair.b.vertex(l) - self.pair.b.vertex(k);
                let (long, short) = if along.length_squared() >= other.length_squared() {
                    (along, other)
                } else {
                    (other, along)
                };
                if let Some(frame) = Frame::new(long, short) {
                    show(frame.normal);
                }
            }
        }
        best
    }

    /// Whether the box around points comes as near to the origin as the nearest points are.
    fn meets<const N: usize>(&self, points: [DVec3; N]) -> bool {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for point in points {
            (low, high) = (low.min(point), high.max(point));
        }
        low.max(-high).max_element() <= self.reach
    }

    /// Whether an edge of one runs through a triangle of the other.
    ///
    /// Bodies that share a point but not the inside of such a triangle have vertices or
    /// edges that touch, or one lies in the other.
    fn pierced(&self, near_a: &Near, near_b: &Near) -> bool {
        near_a.triangles.iter().any(|&[i, j, k]| {
            let [second, third] = [j, k].map(|to| self.pair.a.vertex(to) - self.pair.a.vertex(i));
            (near_b.edges.iter())
                .any(|edge| runs_through(edge.map(|b| -self.point(i, b)), second, third))
        }) || near_b.triangles.iter().any(|&[i, j, k]| {
            let [second, third] = [j, k].map(|to| self.pair.b.vertex(to) - self.pair.b.vertex(i));
            (near_a.edges.iter())
                .any(|edge| runs_through(edge.map(|a| self.point(a, i)), second, third))
        })
    }

    /// Whether a vertex of one, and so all of it if nothing is pierced, lies in the other.
    fn contained(&self) -> bool {
        let (a, b) = (&self.pair.a, &self.pair.b);
        // The first vertices, from the other's centre.
        let (first_a, first_b) = (self.offset + a.vertex(0), b.vertex(0) - self.offset);
        a.holds(first_b) || b.holds(first_a)
    }
}

/// Whether a segment crosses the triangle of the corners 0, `second` and `third`.
fn runs_through([from, to]: [DVec3; 2], second: DVec3, third: DVec3) -> bool {
    // Heights over a thin triangle are right where it is: its longest edge is the first axis.
    let across = third - second;
    let (lengths, most) = {
        let lengths = [second, third, across].map(DVec3::length_squared);
        (lengths, lengths[0].max(lengths[1]).max(lengths[2]))
    };
    let (origin, first, other) = if lengths[0] >= most {
        (DVec3::ZERO, second, third)
    } else if lengths[1] >= most {
        (DVec3::ZERO, third, second)
    } else {
        (second, across, -second)
    };
    let Some(frame) = Frame::new(first, other) else {
        return false;
    };
    let (from, to) = (from - origin, to - origin);
    let (start, end) = (from.dot(frame.normal), to.dot(frame.normal));
    // One in the plane touches; that is for distances to tell.
    if start * end >= 0.0 {
        return false;
    }
    let crossing = from + start / (start - end) * (to - from);
    frame.shares(crossing).iter().all(|&share| share > 0.0)
}
