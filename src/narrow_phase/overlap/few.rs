//! The least width of two small hulls, by the faces and edges that can have it.
//!
//! As [`faces`](super::faces), which looks at all of them. Two hulls of 12 points span
//! 900 pairs of edges; all but some dozen of them face where the pair is wider than along
//! the line between the centres. Ten times as fast as growing a polytope, and nothing
//! is allocated.

use super::faces::{Arc, Least};
use super::hull::Hull;
use super::pair::Pair;
use super::{Width, unit};
use glam::DVec3;

/// Hulls with more edges or faces are not small: of 18 points and more.
const EDGES: usize = 48;
const FACES: usize = 32;

/// Whether both hulls are solid and small.
pub(super) fn are_few(pair: &Pair) -> bool {
    let is_small = |hull: &Hull| {
        hull.rim_normals().is_none()
            && hull.edges().len() <= EDGES
            && hull.face_count() as usize <= FACES
    };
    is_small(&pair.a) && is_small(&pair.b)
}

/// One hull's part in the faces of the Minkowski difference.
struct Side<'a> {
    hull: &'a Hull<'a>,
    /// Normals of its faces, of A's turned round.
    normals: [DVec3; FACES],
    /// How far the offset of the two centres leads along each.
    heights: [f64; FACES],
    /// Radius of a ball around its centre that it holds.
    inner: f64,
}

impl<'a> Side<'a> {
    fn new(hull: &'a Hull<'a>, centre: DVec3, sign: f64, offset: DVec3) -> Self {
        let mut side = Self {
            hull,
            normals: [DVec3::ZERO; FACES],
            heights: [f64::NEG_INFINITY; FACES],
            inner: hull.radius,
        };
        let places = side.normals.iter_mut().zip(&mut side.heights);
        for (face, (normal, height)) in (0..hull.face_count()).zip(places) {
            *normal = sign * hull.face_normal(face);
            *height = normal.dot(offset);
        }
        for edge in hull.edges() {
            let point = sign * (hull.point(edge.vertices[0]) - centre);
            for face in edge.faces {
                let distance = point.dot(side.normal(face));
                side.inner = side.inner.min(distance);
            }
        }
        // A centre outside the hull, where distances to planes tell nothing; or a NaN.
        if side.inner < 0.0 || side.inner.is_nan() {
            side.inner = -hull.radius;
        }
        side
    }

    fn normal(&self, face: u32) -> DVec3 {
        self.normals.get(face as usize).copied().unwrap_or_default()
    }

    fn height(&self, face: u32) -> f64 {
        let height = self.heights.get(face as usize);
        height.copied().unwrap_or(f64::INFINITY)
    }

    /// The arcs of edges that may be no wider than `most` somewhere.
    ///
    /// Along an arc the hull's support is a point of its edge, whose distance from `base`
    /// is what the pair is wide beside the ball in the `other` hull.
    fn arcs<'r>(
        &self,
        (sign, base): (f64, DVec3),
        (other, most): (f64, f64),
        arcs: &'r mut [Arc; EDGES],
    ) -> &'r [Arc] {
        let mut count = 0;
        for edge in self.hull.edges() {
            let point = self.hull.point(edge.vertices[0]);
            let [left, right] = edge.faces.map(|face| self.normal(face));
            let from = sign * (point - base);
            let lower = from.dot(left).min(from.dot(right));
            // On the arc between two unit vectors p and q lies αp + βq with α and β of
            // one sign and α + β between 1 and 2/|p + q|.
            let least = if lower < 0.0 {
                lower * 2.0 / (left + right).length()
            } else {
                lower
            };
            if least + other > most {
                continue;
            }
            if let Some(along) = unit(self.hull.edge_vector(edge))
                && let Some(place) = arcs.get_mut(count)
            {
                *place = Arc {
                    point,
                    along,
                    ends: [left, right],
                };
                count += 1;
            }
        }
        arcs.get(..count).unwrap_or_default()
    }
}

/// The least width over all directions, or one of no more than touch if there is such a
/// one; none if rounding left no direction at all.
///
/// Along `d` the pair is at least as wide as the balls in the two hulls are, which is
/// `inner − offset · d`. So `d` need not be looked at where that is more than what has been
/// found, or more than the width along the offset itself; and arcs not where that is so of
/// the edge and the ball in the other hull.
pub(super) fn least(pair: &Pair) -> Option<Width> {
    let between = unit(pair.offset).map(|direction| pair.width(direction));
    let first = between.map_or(f64::INFINITY, |between| between.width);
    if first <= pair.touch {
        // Apart; any direction will do.
        return between;
    }
    let a = Side::new(&pair.a, pair.offset, -1.0, pair.offset);
    let b = Side::new(&pair.b, DVec3::ZERO, 1.0, pair.offset);
    let mut least = Least::new(pair);
    let most = |least: &Least| {
        let best = least.best.map_or(first, |best| best.width.min(first));
        best + 4.0 * pair.rounding()
    };
    let balls = a.inner + b.inner;
    for side in [&a, &b] {
        for face in 0..side.hull.face_count() {
            if balls - side.height(face) <= most(&least) {
                least.show(side.normal(face));
            }
        }
    }
    if least.best.is_some_and(|best| best.width <= pair.touch) {
        return least.best;
    }
    let most = most(&least);
    let (mut arcs_a, mut arcs_b) = ([Arc::default(); EDGES], [Arc::default(); EDGES]);
    let arcs_a = a.arcs((-1.0, DVec3::ZERO), (b.inner, most), &mut arcs_a);
    let arcs_b = b.arcs((1.0, pair.offset), (a.inner, most), &mut arcs_b);
    for a in arcs_a {
        for b in arcs_b {
            if let Some(direction) = a.crossing(b)
                && least.beats((b.point - a.point).dot(direction))
            {
                least.show(direction);
            }
        }
    }
    least.best
}
