//! The least width of two small hulls, by the faces and edges that can have it.
//!
//! As [`faces`](super::faces), which looks at all of them. Two hulls of 12 points span
//! 900 pairs of edges; all but a few of them face where the pair is wider than some
//! face is. Many times as fast as growing a polytope, and nothing is allocated.

use super::faces::Arc;
use super::hull::Hull;
use super::pair::Pair;
use super::{Width, unit};
use glam::DVec3;

/// Hulls with more edges, faces or vertices are not small: of 18 points and more, or 32 where
/// three edges meet at each.
const EDGES: usize = 48;
const FACES: usize = 32;
const VERTICES: usize = 32;

/// Vertices looked at together.
const LANES: usize = 4;

/// Whether both hulls are solid and small.
pub(super) fn are_few(pair: &Pair) -> bool {
    let is_small = |hull: &Hull| {
        hull.rim_normals().is_none()
            && hull.edges().len() <= EDGES
            && hull.face_count() as usize <= FACES
            && hull.vertex_count() <= VERTICES
    };
    is_small(&pair.a) && is_small(&pair.b)
}

/// A number for each vertex.
type Lanes = [[f64; LANES]; VERTICES / LANES];

/// One hull's part in the Minkowski difference: B as seen from its centre, or A turned round.
struct Side<'a> {
    hull: &'a Hull<'a>,
    /// Vertices, each coordinate of some beside each other; the last fill up with the first.
    lanes: [[[f64; LANES]; 3]; VERTICES / LANES],
    /// How many lanes are in use.
    count: usize,
    /// Normals of its faces.
    normals: [DVec3; FACES],
    /// How far each face lies from its centre, less how far the offset of the two centres
    /// leads along its normal: what the pair is wide there beside the other hull's part.
    beyond: [f64; FACES],
}

impl<'a> Side<'a> {
    fn new(hull: &'a Hull<'a>, sign: f64, offset: DVec3) -> Self {
        let first = sign * hull.turned(0);
        let mut side = Self {
            hull,
            lanes: [first.to_array().map(|coordinate| [coordinate; LANES]); VERTICES / LANES],
            count: hull.vertex_count().div_ceil(LANES),
            normals: [DVec3::ZERO; FACES],
            beyond: [f64::INFINITY; FACES],
        };
        for vertex in 0..hull.vertex_count().min(VERTICES) {
            let point = sign * hull.turned(vertex as u32);
            let lanes = &mut side.lanes[vertex / LANES];
            for (lane, coordinate) in lanes.iter_mut().zip(point.to_array()) {
                lane[vertex % LANES] = coordinate;
            }
        }
        for (face, normal) in (0..hull.face_count()).zip(&mut side.normals) {
            *normal = sign * hull.face_normal(face);
        }
        for edge in hull.edges() {
            let point = side.point(edge.vertices[0]) - offset;
            for face in edge.faces {
                let least = &mut side.beyond[face as usize];
                *least = least.min(point.dot(side.normals[face as usize]));
            }
        }
        side
    }

    fn point(&self, vertex: u32) -> DVec3 {
        let (lanes, lane) = (vertex as usize / LANES, vertex as usize % LANES);
        DVec3::from_array(self.lanes[lanes].map(|coordinates| coordinates[lane]))
    }

    /// How far each vertex lies along `direction` from the centre.
    #[inline]
    fn heights(&self, direction: DVec3, heights: &mut Lanes) {
        for (heights, [x, y, z]) in heights.iter_mut().zip(&self.lanes).take(self.count) {
            for lane in 0..LANES {
                heights[lane] =
                    x[lane] * direction.x + y[lane] * direction.y + z[lane] * direction.z;
            }
        }
    }

    /// The largest of some numbers, one for each vertex.
    #[inline]
    fn top(&self, number: impl Fn(usize, usize) -> f64) -> f64 {
        let mut tops = [f64::NEG_INFINITY; LANES];
        for row in 0..self.count.min(VERTICES / LANES) {
            for (lane, top) in tops.iter_mut().enumerate() {
                let number = number(row, lane);
                *top = if number > *top { number } else { *top };
            }
        }
        tops[0].max(tops[1]).max(tops[2].max(tops[3]))
    }

    /// How far it reaches along `direction` from its centre.
    #[inline]
    fn height(&self, direction: DVec3) -> f64 {
        let mut heights = Lanes::default();
        self.heights(direction, &mut heights);
        self.top(|row, lane| heights[row][lane])
    }

    /// The arcs of edges that may be no wider than `most` somewhere, beside the `other` hull,
    /// whose vertices' heights along the normals of this one's faces are given.
    ///
    /// A point of the edge and a vertex of the other hull make a point of the Minkowski
    /// difference, beyond which the difference reaches all along the arc. On an arc between two unit
    /// vectors p and q lies αp + βq with α and β of one sign and α + β at least 1: if that point
    /// lies farther than `most` along both, it does so along all of the arc.
    fn arcs<'r>(
        &self,
        other: &Self,
        heights: &[Lanes; FACES],
        most: f64,
        arcs: &'r mut [Arc; EDGES],
    ) -> &'r [Arc] {
        let mut count = 0;
        for edge in self.hull.edges() {
            let [left, right] = edge.faces.map(|face| face as usize);
            let [beyond_left, beyond_right] = [left, right].map(|face| self.beyond[face]);
            let [lefts, rights] = [&heights[left], &heights[right]];
            let lower = other.top(|row, lane| {
                let left = beyond_left + lefts[row][lane];
                let right = beyond_right + rights[row][lane];
                if left < right { left } else { right }
            });
            if lower > most {
                continue;
            }
            if let Some(along) = unit(self.hull.edge_vector(edge))
                && let Some(place) = arcs.get_mut(count)
            {
                *place = Arc {
                    point: self.hull.point(edge.vertices[0]),
                    along,
                    ends: [left, right].map(|face| self.normals[face]),
                };
                count += 1;
            }
        }
        arcs.get(..count).unwrap_or_default()
    }
}

/// The least of the widths shown to it; of widths that differ by rounding, the first.
struct Least {
    rounding: f64,
    best: Option<Width>,
    /// Where the pair is wider than this nothing need be looked at.
    most: f64,
}

impl Least {
    fn beats(&self, width: f64) -> bool {
        self.best
            .is_none_or(|best| width < best.width - self.rounding)
    }

    fn show(&mut self, direction: DVec3, width: f64) {
        if self.beats(width) {
            self.best = Some(Width { direction, width });
            self.most = self.most.min(width + 4.0 * self.rounding);
        }
    }
}

/// The least width over all directions, or one of no more than touch if there is such a
/// one; none if rounding left no direction at all.
///
/// What the pair is wide along the normals of faces bounds it along the arcs between them: those
/// that are wider than what has been found, all along, need not be crossed with others.
pub(super) fn least(pair: &Pair) -> Option<Width> {
    // Before anything is made ready: most pairs that are apart are so along this line.
    let between = unit(pair.offset).map(|direction| pair.width(direction));
    let first = between.map_or(f64::INFINITY, |between| between.width);
    if first <= pair.touch {
        // Any direction will do.
        return between;
    }
    let a = Side::new(&pair.a, -1.0, pair.offset);
    let b = Side::new(&pair.b, 1.0, pair.offset);
    let width = |direction: DVec3| {
        let width = b.height(direction) + a.height(direction) - pair.offset.dot(direction);
        Width { direction, width }
    };
    let rounding = pair.rounding();
    let mut least = Least {
        rounding,
        best: None,
        most: first + 4.0 * rounding,
    };
    let mut heights = [[Lanes::default(); FACES]; 2];
    for ((side, other), heights) in [(&a, &b), (&b, &a)].into_iter().zip(&mut heights) {
        for (face, heights) in (0..side.hull.face_count()).zip(heights) {
            let (normal, beyond) = (side.normals[face as usize], side.beyond[face as usize]);
            other.heights(normal, heights);
            let lower = beyond + other.top(|row, lane| heights[row][lane]);
            // A normal that could not be made is zero.
            if lower <= least.most && normal != DVec3::ZERO {
                let shown = width(normal);
                if shown.width <= pair.touch {
                    return Some(shown);
                }
                least.show(normal, shown.width);
            }
        }
    }
    let [beside_a, beside_b] = &heights;
    let (mut arcs_a, mut arcs_b) = ([Arc::default(); EDGES], [Arc::default(); EDGES]);
    let arcs_a = a.arcs(&b, beside_a, least.most, &mut arcs_a);
    let arcs_b = b.arcs(&a, beside_b, least.most, &mut arcs_b);
    for a in arcs_a {
        for b in arcs_b {
            if let Some(direction) = a.crossing(b)
                && least.beats((b.point - a.point).dot(direction))
            {
                least.show(direction, width(direction).width);
            }
        }
    }
    least.best.map(|best| pair.width(best.direction))
}
