//! Every face of the Minkowski difference as a swept separating axis: slow and certain.
//!
//! Each face of B ⊕ (−A) is a face of B, a face of A turned round, or
//! spanned by an edge of each. Seen on the sphere of directions an edge is the
//! arc between the normals of its two faces, and two edges span a face where
//! their arcs cross.

use super::body::Body;
use super::edges::edge_normal;
use super::pair::Pair;
use super::slab::Slabs;
use glam::DVec3;

/// Rounding of the crossing test. More directions than needed may pass, for
/// each is measured; none may be lost.
const CROSSING: f64 = 1e-12;

/// Pairs of edges up to which all are tried, crossing or not: cheaper than the test.
const FEW: usize = 40;

/// The unit normal of the face of B ⊕ (−A) that A runs into, and when, in scaled motions from
/// where the two are nearest.
///
/// Right for flat differences too. O((f + c) · s + e²) for f faces, e edges, c
/// faces spanned by edges, and s for a support.
pub(super) fn entry(pair: &Pair) -> Option<(DVec3, f64)> {
    let mut slabs = Slabs::new();
    for (body, sign) in [(&pair.a, -1.0), (&pair.b, 1.0)] {
        for face in 0..body.face_count() {
            show(pair, &mut slabs, sign * body.face_normal(face as u32));
        }
        for rim in body.rim_normals().into_iter().flatten() {
            show(pair, &mut slabs, sign * rim);
        }
        if slabs.miss() {
            return None;
        }
    }
    let (arcs_a, arcs_b) = (arcs(&pair.a, -1.0)?, arcs(&pair.b, 1.0)?);
    let all = arcs_a.len() * arcs_b.len() <= FEW;
    for a in &arcs_a {
        for b in &arcs_b {
            if !all && !a.may_cross(b) {
                continue;
            }
            let Some(normal) = edge_normal(a.along, b.along) else {
                continue;
            };
            if all {
                show(pair, &mut slabs, normal);
                show(pair, &mut slabs, -normal);
            } else {
                show_edges(pair, &mut slabs, a, b, normal);
            }
        }
    }
    if slabs.miss() {
        return None;
    }
    let normal = slabs.enter_by?;
    let against = -1.0_f64.copysign(normal.dot(pair.motion));
    Some((against * normal, slabs.enter))
}

/// Measures the plane across a direction.
fn show(pair: &Pair, slabs: &mut Slabs<DVec3>, normal: DVec3) {
    if normal == DVec3::ZERO {
        return;
    }
    let [a, b] = pair.supports(normal);
    let depth = normal.dot(pair.b.vertex(b) - pair.a.vertex(a)) - normal.dot(pair.nearest);
    let speed = -normal.dot(pair.motion);
    slabs.half_space(depth, speed, pair.rounding, normal);
}

/// Measures the plane of two edges if it could matter.
fn show_edges(pair: &Pair, slabs: &mut Slabs<DVec3>, a: &Arc, b: &Arc, normal: DVec3) {
    // The difference reaches at least as far as this one point of it.
    let depth = normal.dot(b.point - a.point) - normal.dot(pair.nearest);
    let speed = -normal.dot(pair.motion);
    for (normal, depth, speed) in [(normal, depth, speed), (-normal, -depth, -speed)] {
        let time = -(depth - pair.rounding) / speed;
        let matters = if speed > 0.0 {
            slabs.is_later(time)
        } else if speed < 0.0 {
            slabs.is_earlier(time)
        } else {
            true
        };
        if matters {
            show(pair, slabs, normal);
        }
    }
}

/// An edge, and the arc of directions along which it is the support.
struct Arc {
    /// A point of the edge.
    point: DVec3,
    /// Unit vector along the edge.
    along: DVec3,
    ends: [DVec3; 2],
}

impl Arc {
    /// Whether the arcs may cross, or one the other's mirror image.
    fn may_cross(&self, other: &Self) -> bool {
        let [a, b] = self.ends;
        let [c, d] = other.ends;
        c.dot(self.along) * d.dot(self.along) <= CROSSING
            && a.dot(other.along) * b.dot(other.along) <= CROSSING
    }
}

/// The arcs of a body's edges; `sign` −1 for the body turned round.
fn arcs(body: &Body, sign: f64) -> Option<Vec<Arc>> {
    let mesh = body.mesh()?;
    let rims = body.rim_normals();
    let mut arcs = Vec::with_capacity(2 * mesh.edges.len());
    for (index, edge) in mesh.edges.iter().enumerate() {
        let along = body.edge_direction(edge);
        let point = body.vertex(edge.vertices[0]);
        let [left, right] = edge.faces.map(|face| sign * body.face_normal(face));
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
    Some(arcs)
}
