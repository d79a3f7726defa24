//! The face of the Minkowski difference that a ray goes through.
//!
//! Seen along the ray, the ray is a point and the difference B ⊕ (−A) a convex
//! shadow. Three of its points around the ray are a portal; pushed out along its
//! normal again and again, a portal becomes the face the ray enters or leaves by.
//! Source: Snethen, *XenoCollide* (2008), with the ray's own direction in place of
//! the one to the origin.

use super::extremes::{Care, Extremes};
use super::pair::Pair;
use glam::{DMat3, DVec2, DVec3};

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
    point: DVec3,
}

impl Probe {
    /// What of it is across the ray.
    #[inline]
    fn across(&self) -> DVec2 {
        self.point.truncate()
    }
}

/// Where the ray enters: three points around it, and the normal of their plane.
pub(super) struct Portal {
    pub(super) probes: [Probe; 3],
    /// When the ray meets it, in scaled motions from where the bodies are nearest.
    pub(super) time: f64,
    /// Unit vector along the world's axes, out of the difference.
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

/// The ray and the difference in a frame whose third axis is the ray's: of a point the first two
/// coordinates lie across it.
pub(super) struct Shadow<'a> {
    pub(super) pair: &'a Pair<'a>,
    /// From the world's axes.
    turn: DMat3,
    /// One by the length of the scaled motion.
    per_length: f64,
    /// From B's centre to A's where they are nearest, moved aside by a hair.
    ray: DVec3,
    /// Up to this distance in metres what passes by counts as touching.
    shift: f64,
    a: Extremes<'a>,
    b: Extremes<'a>,
    care: Care,
}

impl<'a> Shadow<'a> {
    #[inline(always)]
    pub(super) fn new(pair: &'a Pair) -> Self {
        let per_length = pair.motion.length_recip();
        let along = pair.motion * per_length;
        let (left, up) = along.any_orthonormal_pair();
        let turn = DMat3::from_cols(left, up, along).transpose();
        let shift = SHIFT * pair.rounding;
        let (a, b) = (
            Extremes::new(&pair.a, turn * pair.a.rotation),
            Extremes::new(&pair.b, turn * pair.b.rotation),
        );
        Self {
            pair,
            turn,
            per_length,
            ray: turn * pair.nearest + 0.25 * shift * ASIDE,
            shift,
            care: a.least_care().min(b.least_care()),
            a,
            b,
        }
    }

    /// Has farthest vertices sought more closely; false if that cannot be.
    pub(super) fn take_more_care(&mut self) -> bool {
        let next = match self.care {
            Care::Coarse => Care::Close,
            Care::Close => Care::Closest,
            Care::Closest => return false,
        };
        self.care = next;
        true
    }

    /// The difference's farthest point along a direction of any length.
    #[inline]
    fn support(&mut self, direction: DVec3, care: Care) -> Probe {
        let (vertex_a, a) = self.a.farthest(-direction, care);
        let (vertex_b, b) = self.b.farthest(direction, care);
        Probe {
            vertices: [vertex_a, vertex_b],
            point: (b - a) - self.ray,
        }
    }

    /// Three points of the difference around the ray, counter-clockwise seen against it.
    ///
    /// Leads a line of two points towards the ray until a third encloses it, as
    /// Gilbert, Johnson and Keerthi do; every support is a test whether
    /// the ray passes by. A ray that touches the shadow to within rounding is
    /// moved in.
    pub(super) fn enclose(&mut self) -> Found<[Probe; 3]> {
        let mut towards = self.ray.truncate();
        if towards == DVec2::ZERO {
            towards = ASIDE.truncate();
        }
        let mut simplex: [Option<Probe>; 2] = [None, None];
        let mut moved = false;
        for _ in 0..MAX_STEPS {
            let mut probe = self.support(towards.extend(0.0), self.care);
            let mut reach = probe.across().dot(towards);
            if reach < 0.0 && self.care != Care::Closest {
                probe = self.surely(towards, probe);
                reach = probe.across().dot(towards);
            }
            let new = probe.across();
            if reach < 0.0 {
                let length = towards.length();
                if -reach > self.shift * length {
                    // Moved in, the ray may have gone through a flat shadow and out again.
                    return if moved { Found::Unclear } else { Found::Miss };
                }
                moved = true;
                self.ray -= ((2.0 * self.shift / length) * towards).extend(0.0);
                simplex = [None, None];
                continue;
            }
            match simplex {
                [Some(from), Some(to)] => {
                    if from.vertices == probe.vertices || to.vertices == probe.vertices {
                        if self.take_more_care() {
                            continue;
                        }
                        return Found::Unclear;
                    }
                    // The ray lies to the right of the line from p to q, and so does the new point.
                    let (p, q) = (from.across(), to.across());
                    let (before, after) = (-new.perp_dot(p), new.perp_dot(q));
                    if before >= 0.0 && after >= 0.0 && q.perp_dot(p) >= 0.0 {
                        return Found::Yes([from, probe, to]);
                    }
                    if before < after {
                        simplex = [Some(from), Some(probe)];
                        towards = -(new - p).perp();
                    } else {
                        simplex = [Some(probe), Some(to)];
                        towards = -(q - new).perp();
                    }
                }
                [Some(first), _] => {
                    let old = first.across();
                    let side = (new - old).perp();
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
            if towards == DVec2::ZERO {
                return Found::Unclear;
            }
        }
        Found::Unclear
    }

    /// A probe that falls short of the ray, found again with more care unless it does so for certain.
    fn surely(&mut self, towards: DVec2, mut probe: Probe) -> Probe {
        let length = towards.length();
        for (care, next) in [(Care::Coarse, Care::Close), (Care::Close, Care::Closest)] {
            if care < self.care {
                continue;
            }
            let error = self.a.error(care) + self.b.error(care) + self.shift;
            let reach = probe.across().dot(towards);
            if reach >= 0.0 || reach < -error * length {
                break;
            }
            probe = self.support(towards.extend(0.0), next);
            if next == Care::Closest {
                self.care = next;
            }
        }
        probe
    }

    /// The face that the ray enters by, from three points around it, which become those that were
    /// found last.
    pub(super) fn refine(&mut self, probes: &mut [Probe; 3]) -> Option<Portal> {
        let tolerance = 2.0 * self.pair.rounding;
        for _ in 0..MAX_STEPS {
            let [p, q, r] = probes.map(|probe| probe.point);
            let normal = (r - p).cross(q - p);
            let new = self.support(normal, self.care);
            let heights = [normal.dot(p), normal.dot(q), normal.dot(r)];
            let reached = heights[0].max(heights[1]).max(heights[2]);
            let height = normal.dot(new.point);
            let length = normal.length();
            let known = probes.iter().any(|probe| probe.vertices == new.vertices);
            if known || height - reached <= tolerance * length {
                if self.care == Care::Coarse {
                    self.care = Care::Close;
                    continue;
                }
                let lowest = heights[0].min(heights[1]).min(heights[2]);
                // Along a face that is parallel to it the ray enters by that face's rim.
                let against = normal.z < -PARALLEL * length;
                // The normal of a sliver is rounding; NaN gives up too.
                if !(against && height.max(reached) - lowest <= 2.0 * tolerance * length) {
                    return None;
                }
                return Some(Portal {
                    time: self.per_length * time(probes),
                    probes: *probes,
                    normal: self.turn.transpose() * (normal / length),
                    vertices: new.vertices,
                });
            }
            // Which two of the three enclose the ray together with the new point?
            let flat = probes.map(|probe| probe.across());
            let sides = flat.map(|point| new.across().perp_dot(point));
            let mut best = (0.0, 3);
            for (i, j) in [(0, 1), (1, 2), (2, 0)] {
                if sides[i] >= 0.0 && sides[j] <= 0.0 {
                    let area = sides[i] - sides[j] + flat[i].perp_dot(flat[j]);
                    if area > best.0 {
                        best = (area, i);
                    }
                }
            }
            *probes = match best.1 {
                0 => [probes[0], probes[1], new],
                1 => [probes[1], probes[2], new],
                2 => [probes[2], probes[0], new],
                _ => return None,
            };
        }
        None
    }
}

/// Where the ray goes through the triangle of three points around it, in metres along it.
///
/// On a face that the ray glides along the triangle is a needle, of whose areas little but
/// rounding is left; so the place along its longest edge is a matter of lengths.
fn time(probes: &[Probe; 3]) -> f64 {
    let flat = probes.map(|probe| probe.across());
    let length = |i: usize, j: usize| flat[i].distance_squared(flat[j]);
    let lengths = [length(0, 1), length(1, 2), length(2, 0)];
    let [p, q, r] = if lengths[0] >= lengths[1] && lengths[0] >= lengths[2] {
        [probes[0], probes[1], probes[2]]
    } else if lengths[1] >= lengths[2] {
        [probes[1], probes[2], probes[0]]
    } else {
        [probes[2], probes[0], probes[1]]
    };
    let start = p.across();
    let (edge, third) = (q.across() - start, r.across() - start);
    let per_square = 1.0 / edge.length_squared();
    let rise = q.point.z - p.point.z;
    let height = |step: DVec2| p.point.z + step.dot(edge) * per_square * rise;
    // The ray's share of the way from the edge to the third point.
    let share = -edge.perp_dot(start) / edge.perp_dot(third);
    // Whatever rounding makes of that, the place is in the triangle.
    let (foot, apex) = (-start.dot(edge) * per_square, third.dot(edge) * per_square);
    let most = (foot / apex.max(foot)).min((1.0 - foot) / (1.0 - apex.min(foot)));
    let share = share.min(most).max(0.0);
    let beyond = r.point.z - height(third);
    height(-start) + share * beyond
}
