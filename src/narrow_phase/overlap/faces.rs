//! Directions from the hulls' own faces and edges.
//!
//! Every face of the Minkowski difference is a face of B, a face of A turned
//! round, or spanned by an edge of each. Seen on the sphere of directions, an
//! edge is the arc between the normals of its two faces; two edges span a face
//! where their arcs cross.

use super::hull::Hull;
use super::pair::Pair;
use super::{Width, unit};
use crate::geometry::Edge;
use crate::math::short_list::ShortList;
use glam::DVec3;

/// Rounding of the crossing test. More directions than needed may pass, for
/// each is measured; none may be lost.
const CROSSING: f64 = 1e-12;

/// Sine of the angle below which two edges count as parallel: the face they
/// span is thinner than rounding.
const PARALLEL: f64 = 1e-14;

/// Sine of the angle below which what rounding does to a product of two edges counts.
const NEARLY: f64 = 1e-2;

/// Share of a hull's radius within which vertices may belong to the feature a
/// growing polytope found.
const NEAR: f64 = 1e-7;

/// Edges of one feature beyond which pairs of them are not looked at.
const MAX_EDGES: usize = 64;

/// The least of the widths shown to it; of widths that differ by rounding, the first.
pub(super) struct Least<'a> {
    pair: &'a Pair<'a>,
    rounding: f64,
    pub(super) best: Option<Width>,
}

impl<'a> Least<'a> {
    pub(super) fn new(pair: &'a Pair<'a>) -> Self {
        Self {
            pair,
            rounding: pair.rounding(),
            best: None,
        }
    }

    pub(super) fn beats(&self, width: f64) -> bool {
        self.best
            .is_none_or(|best| width < best.width - self.rounding)
    }

    pub(super) fn show(&mut self, direction: DVec3) {
        // A normal that could not be made is zero.
        if direction != DVec3::ZERO {
            let shown = self.pair.width(direction);
            if self.beats(shown.width) {
                self.best = Some(shown);
            }
        }
    }
}

/// The least width, by looking at every face of the Minkowski difference.
///
/// Right for flat ones too. O((f + c) · n + e²) for f faces, e edges, n vertices
/// and c faces spanned by edges: for the few cases the growing polytope leaves.
pub(super) fn least(pair: &Pair) -> Option<Width> {
    let mut least = Least::new(pair);
    pair.a.face_normals().for_each(|normal| least.show(-normal));
    pair.b.face_normals().for_each(|normal| least.show(normal));
    for rim in pair.a.rim_normals().into_iter().flatten() {
        least.show(-rim);
    }
    for rim in pair.b.rim_normals().into_iter().flatten() {
        least.show(rim);
    }
    let (arcs_a, arcs_b) = (arcs(&pair.a, -1.0), arcs(&pair.b, 1.0));
    for a in arcs_a.iter() {
        for b in arcs_b.iter() {
            if let Some(direction) = a.crossing(b)
                && least.beats((b.point - a.point).dot(direction))
            {
                least.show(direction);
            }
        }
    }
    least.best
}

/// An edge, and the arc of directions along which it is the support.
#[derive(Clone, Copy, Default)]
pub(super) struct Arc {
    /// A point of the edge.
    pub(super) point: DVec3,
    /// Unit vector along the edge.
    pub(super) along: DVec3,
    pub(super) ends: [DVec3; 2],
}

impl Arc {
    #[inline]
    pub(super) fn crossing(&self, other: &Self) -> Option<DVec3> {
        let [a, b] = self.ends;
        let [c, d] = other.ends;
        // Both ends of each on opposite sides of the other's plane.
        if c.dot(self.along) * d.dot(self.along) > CROSSING
            || a.dot(other.along) * b.dot(other.along) > CROSSING
        {
            return None;
        }
        let direction = square_to(self.along, other.along)?;
        let direction = if direction.dot(c + d) < 0.0 {
            -direction
        } else {
            direction
        };
        // On the same half of the sphere.
        (direction.dot(a + b) >= -CROSSING).then_some(direction)
    }
}

/// Unit vector square to two unit vectors; none if these are parallel but for rounding.
///
/// Where they are nearly so, rounding of their product leads along both of them as well: a
/// long edge would stick out. That share is taken off; what is left turns about the edges only.
#[inline]
fn square_to(a: DVec3, b: DVec3) -> Option<DVec3> {
    let cross = a.cross(b);
    let square = cross.length_squared();
    if square >= NEARLY * NEARLY {
        return unit(cross);
    }
    let mut direction = (square >= PARALLEL * PARALLEL).then(|| unit(cross))??;
    for _ in 0..2 {
        direction = unit(direction - direction.dot(a) * a)?;
    }
    Some(direction)
}

/// As many as a triangle has lie in place; hulls come here if all else fails.
type Arcs = ShortList<Arc, 8>;

/// The arcs of a hull's edges; `sign` −1 for the hull turned round.
fn arcs(hull: &Hull, sign: f64) -> Arcs {
    let rims = hull.rim_normals();
    let mut arcs = Arcs::new();
    for (index, edge) in hull.edges().iter().enumerate() {
        let Some(along) = unit(hull.edge_vector(edge.vertices)) else {
            continue;
        };
        let point = hull.point(edge.vertices[0]);
        let [left, right] = edge.faces.map(|face| sign * hull.face_normal(face));
        let mut push = |ends| arcs.push(Arc { point, along, ends });
        // A triangle's arc is half a circle, whose ends alone do not tell which half.
        match rims.and_then(|rims| rims.get(index).copied()) {
            Some(rim) => {
                push([left, sign * rim]);
                push([sign * rim, right]);
            }
            None => push([left, right]),
        }
    }
    arcs
}

/// The direction of `near` computed afresh from the faces or edges that lie farthest along it.
///
/// What a growing polytope returns comes from differences of rounded points;
/// this comes from the hulls themselves.
pub(super) fn sharpened(pair: &Pair, near: Width) -> Option<Width> {
    let edges_a = edges_along(&pair.a, -near.direction);
    let edges_b = edges_along(&pair.b, near.direction);
    let mut least = Least::new(pair);
    show_normals(&pair.a, &edges_a, -near.direction, |normal| {
        least.show(-normal);
    });
    show_normals(&pair.b, &edges_b, near.direction, |normal| {
        least.show(normal);
    });
    if edges_a.len() <= MAX_EDGES && edges_b.len() <= MAX_EDGES {
        let along = |hull: &Hull, edge: u32| {
            unit(hull.edge_vector(hull.edges().get(edge as usize)?.vertices))
        };
        for a in edges_a.iter().filter_map(|&edge| along(&pair.a, edge)) {
            for b in edges_b.iter().filter_map(|&edge| along(&pair.b, edge)) {
                if let Some(axis) = square_to(a, b) {
                    let along = axis.dot(near.direction);
                    // Rounding of the points may have turned the direction a little, not more.
                    if along.abs() > 0.5 {
                        least.show(if along < 0.0 { -axis } else { axis });
                    }
                }
            }
        }
    }
    if least.beats(near.width) {
        return Some(near);
    }
    least.best
}

/// Numbers of a few edges or faces.
type Numbers = ShortList<u32, 64>;

fn edges_along(hull: &Hull, direction: DVec3) -> Numbers {
    let near = hull.farthest_within(direction, NEAR * hull.radius);
    let is_near = |edge: &Edge| {
        let mut ends = edge.vertices.iter();
        ends.all(|vertex| near.binary_search(vertex).is_ok())
    };
    let edges = (0..).zip(hull.edges());
    edges
        .filter_map(|(number, edge)| is_near(edge).then_some(number))
        .collect()
}

/// Shows the normals of the faces beside `edges`, of each face once, if they point along `direction`.
fn show_normals(hull: &Hull, edges: &[u32], direction: DVec3, mut show: impl FnMut(DVec3)) {
    let beside = edges
        .iter()
        .filter_map(|&edge| hull.edges().get(edge as usize));
    let mut faces: Numbers = beside.flat_map(|edge| edge.faces).collect();
    faces.sort_unstable();
    let mut last = None;
    for &face in faces.iter() {
        if last.replace(face) != Some(face) {
            let normal = hull.face_normal(face);
            if normal.dot(direction) > 0.5 {
                show(normal);
            }
        }
    }
}
