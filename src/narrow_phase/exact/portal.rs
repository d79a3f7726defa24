//! The face of the Minkowski difference that a ray goes through.
//!
//! Seen along the ray, the ray is a point and the difference B ⊕ (−A) a convex
//! shadow. Three of its points around the ray are a portal; pushed out along its
//! normal again and again, a portal becomes the face the ray enters or leaves by.
//! Source: Snethen, *XenoCollide* (2008), with the ray's own direction in place of
//! the one to the origin.

use super::extremes::{Extremes, Few};
use super::pair::Pair;
use glam::{DMat3, DVec3};

/// By how many times its rounding the ray is shifted so that it meets no vertex or
/// edge exactly.
///
/// Shadows and portals are measured with rounding of a few units; nothing that is
/// settled by the shift then still hangs on it. Larger, and grazes are decided
/// more coarsely.
const SHIFT: f64 = 8.0;

/// Which way: any does that is not among a scene's own directions.
const ASIDE: DVec3 = DVec3::new(0.837, -0.547, 0.393);

/// Sine between the ray and a face up to which they are parallel but for rounding.
const PARALLEL: f64 = 1e-13;

/// Support calls before a search gives up. Random hulls of 1000 vertices take about
/// fifteen.
const MAX_STEPS: usize = 100;

/// The point of the difference that two vertices make, seen from the ray's middle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Probe {
    pub(super) vertices: [u32; 2],
    pub(super) point: DVec3,
    /// What of it is across the ray. Where this is short, on a face that the ray glides
    /// along, the point itself would drown it in rounding.
    across: DVec3,
}

/// Where the ray enters: three points around it, and the normal of their plane.
pub(super) struct Portal {
    pub(super) probes: [Probe; 3],
    /// When the ray meets it, in scaled motions from where the bodies are nearest.
    pub(super) time: f64,
    /// Unit vector in B's frame, out of the difference.
    pub(super) normal: DVec3,
    /// Farthest vertices of A against the normal and of B along it.
    pub(super) vertices: [u32; 2],
}

/// What came of a search.
pub(super) enum Found<T> {
    Yes(T),
    /// The ray passes the difference by.
    Miss,
    /// Rounding decides, or out of the budget.
    Unclear,
}

/// The ray and the difference in B's frame.
pub(super) struct Shadow<'a> {
    pub(super) pair: &'a Pair<'a>,
    /// From A's frame to B's.
    pub(super) turn: DMat3,
    /// The scaled motion.
    pub(super) along: DVec3,
    /// One by its length squared.
    per_square: f64,
    /// From B's centre to A's where they are nearest.
    pub(super) nearest: DVec3,
    /// The same, moved aside by a hair.
    ray: DVec3,
    /// Up to this distance in metres what passes by counts as touching.
    shift: f64,
    pub(super) a: Extremes<'a>,
    pub(super) b: Extremes<'a>,
}

impl<'a> Shadow<'a> {
    #[inline(always)]
    pub(super) fn new(pair: &'a Pair, [few_a, few_b]: &'a mut [Few; 2]) -> Self {
        let to_b = pair.b.rotation.transpose();
        let turn = to_b * pair.a.rotation;
        let shift = SHIFT * pair.rounding;
        let nearest = to_b * pair.nearest;
        let along = to_b * pair.motion;
        Self {
            pair,
            turn,
            along,
            per_square: 1.0 / along.length_squared(),
            nearest,
            ray: nearest + 0.25 * shift * ASIDE,
            shift,
            a: Extremes::turned(&pair.a, &turn, few_a),
            b: Extremes::standing(&pair.b, few_b),
        }
    }

    #[inline]
    fn probe(&self, (vertex_a, point_a): (u32, DVec3), (vertex_b, point_b): (u32, DVec3)) -> Probe {
        let point = (point_b - point_a) - self.ray;
        Probe {
            vertices: [vertex_a, vertex_b],
            point,
            across: point - (point.dot(self.along) * self.per_square) * self.along,
        }
    }

    /// The difference's farthest point along a direction of any length.
    #[inline]
    fn support(&mut self, direction: DVec3) -> Probe {
        let (a, b) = (self.a.farthest(-direction), self.b.farthest(direction));
        self.probe(a, b)
    }

    /// The same for a direction near that of the last call.
    #[inline]
    fn support_nearby(&mut self, direction: DVec3) -> Probe {
        let a = self.a.farthest_nearby(-direction);
        let b = self.b.farthest_nearby(direction);
        self.probe(a, b)
    }

    /// Three points of the difference around the ray, counter-clockwise seen against it.
    ///
    /// Leads a line of two points towards the ray until a third encloses it, as
    /// Gilbert, Johnson and Keerthi do; every support is a test whether
    /// the ray passes by. A ray that touches the shadow to within rounding is
    /// moved in.
    pub(super) fn enclose(&mut self) -> Found<[Probe; 3]> {
        let along = self.along;
        // Across the ray to the left of a step, as long as the step is across the ray.
        let left = |step: DVec3| along.cross(step);
        let across = |direction: DVec3| direction - direction.project_onto(along);
        let mut towards = across(self.ray);
        if towards == DVec3::ZERO {
            towards = across(ASIDE);
        }
        let mut simplex: [Option<Probe>; 2] = [None, None];
        let mut moved = false;
        for _ in 0..MAX_STEPS {
            let probe = self.support(towards);
            let new = probe.across;
            let reach = new.dot(towards);
            if reach < 0.0 {
                let length = towards.length();
                if -reach > self.shift * length {
                    // Moved in, the ray may have gone through a flat shadow and out again.
                    return if moved { Found::Unclear } else { Found::Miss };
                }
                moved = true;
                self.ray -= (2.0 * self.shift / length) * towards;
                simplex = [None, None];
                continue;
            }
            match simplex {
                [Some(from), Some(to)] => {
                    if from.vertices == probe.vertices || to.vertices == probe.vertices {
                        return Found::Unclear;
                    }
                    // The ray lies to the right of the line from p to q, and so does the new point.
                    let (p, q) = (from.across, to.across);
                    let side = left(new);
                    let (before, after) = (-side.dot(p), side.dot(q));
                    if before >= 0.0 && after >= 0.0 && left(q).dot(p) >= 0.0 {
                        return Found::Yes([from, probe, to]);
                    }
                    if before < after {
                        simplex = [Some(from), Some(probe)];
                        towards = -left(new - p);
                    } else {
                        simplex = [Some(probe), Some(to)];
                        towards = -left(q - new);
                    }
                }
                [Some(first), _] => {
                    let old = first.across;
                    let side = left(new - old);
                    // Towards the ray: to the right of the line.
                    if side.dot(old) >= 0.0 {
                        simplex = [Some(first), Some(probe)];
                        towards = -side;
                    } else {
                        simplex = [Some(probe), Some(first)];
                        towards = side;
                    }
                }
                _ => {
                    simplex = [Some(probe), None];
                    towards = -new;
                }
            }
            if towards == DVec3::ZERO {
                return Found::Unclear;
            }
        }
        Found::Unclear
    }

    /// The face that the ray enters by, from three points around it.
    pub(super) fn refine(&mut self, mut probes: [Probe; 3]) -> Option<Portal> {
        let tolerance = 2.0 * self.pair.rounding;
        let along = self.along;
        for _ in 0..MAX_STEPS {
            let [p, q, r] = probes.map(|probe| probe.point);
            let normal = (r - p).cross(q - p);
            let new = self.support_nearby(normal);
            let heights = [normal.dot(p), normal.dot(q), normal.dot(r)];
            let reached = heights[0].max(heights[1]).max(heights[2]);
            let height = normal.dot(new.point);
            let length = normal.length();
            let known = probes.iter().any(|probe| probe.vertices == new.vertices);
            if known || height - reached <= tolerance * length {
                let lowest = heights[0].min(heights[1]).min(heights[2]);
                // Along a face that is parallel to it the ray enters by that face's rim.
                let against = normal.dot(along) < -PARALLEL * length;
                // The normal of a sliver is rounding; NaN gives up too.
                if !(against && height - lowest <= 2.0 * tolerance * length) {
                    return None;
                }
                return Some(Portal {
                    time: time(&probes, along),
                    probes,
                    normal: normal / length,
                    vertices: new.vertices,
                });
            }
            // Which two of the three enclose the ray together with the new point?
            let left = along.cross(new.across);
            let flat = probes.map(|probe| probe.across);
            let sides = flat.map(|point| left.dot(point));
            let mut best = (0.0, 3);
            for (i, j) in [(0, 1), (1, 2), (2, 0)] {
                if sides[i] >= 0.0 && sides[j] <= 0.0 {
                    let edge = along.dot(flat[i].cross(flat[j]));
                    let area = sides[i] - sides[j] + edge;
                    if area > best.0 {
                        best = (area, i);
                    }
                }
            }
            probes = match best.1 {
                0 => [probes[0], probes[1], new],
                1 => [probes[1], probes[2], new],
                2 => [probes[2], probes[0], new],
                _ => return None,
            };
        }
        None
    }
}

/// When the ray goes through the triangle of three points around it.
///
/// On a face that the ray glides along the triangle is a needle, of whose areas little but
/// rounding is left; so the place along its longest edge is a matter of lengths.
fn time(probes: &[Probe; 3], along: DVec3) -> f64 {
    let flat = probes.map(|probe| probe.across);
    let length = |i: usize, j: usize| flat[i].distance_squared(flat[j]);
    let lengths = [length(0, 1), length(1, 2), length(2, 0)];
    let [p, q, r] = if lengths[0] >= lengths[1] && lengths[0] >= lengths[2] {
        [probes[0], probes[1], probes[2]]
    } else if lengths[1] >= lengths[2] {
        [probes[1], probes[2], probes[0]]
    } else {
        [probes[2], probes[0], probes[1]]
    };
    let edge = q.across - p.across;
    let per_square = 1.0 / edge.length_squared();
    let (start, rise) = (p.point.dot(along), (q.point - p.point).dot(along));
    let height = |step: DVec3| start + step.dot(edge) * per_square * rise;
    // The ray's share of the way from the edge to the third point.
    let left = along.cross(edge);
    let third = r.across - p.across;
    let share = -left.dot(p.across) / left.dot(third);
    // Whatever rounding makes of that, the place is in the triangle.
    let (foot, apex) = (
        -p.across.dot(edge) * per_square,
        third.dot(edge) * per_square,
    );
    let most = (foot / apex.max(foot)).min((1.0 - foot) / (1.0 - apex.min(foot)));
    let share = share.min(most).max(0.0);
    let beyond = r.point.dot(along) - height(third);
    (height(-p.across) + share * beyond) / along.length_squared()
}
