//! The face of the Minkowski difference that a ray goes through.
//!
//! Seen along the ray, the ray is a point and the difference B ⊕ (−A) a convex
//! shadow. Three of its points around the ray are a portal; pushed out along its
//! normal again and again, a portal becomes the face the ray enters or leaves by.
//! Source: Snethen, *XenoCollide* (2008), with the ray's own direction in place of
//! the one to the origin.

use super::pair::Pair;
use crate::math::frame::orthonormal;
use glam::{DMat3, DVec2, DVec3, Vec3Swizzles};

/// By how many times its rounding the ray is shifted so that it meets no vertex or
/// edge exactly.
///
/// Shadows and portals are measured with rounding of a few units; nothing that is
/// settled by the shift then still hangs on it. Larger, and grazes are decided
/// more coarsely.
const SHIFT: f64 = 8.0;

/// Support calls before a search gives up. Random hulls of 1000 vertices take about
/// fifteen.
const MAX_STEPS: usize = 100;

/// The point of the difference that two vertices make, seen along the ray: the ray
/// is the z axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Probe {
    pub(super) vertices: [u32; 2],
    pub(super) point: DVec3,
}

/// Where the ray enters or leaves: three points around it, and the normal of their plane.
pub(super) struct Portal {
    pub(super) probes: [Probe; 3],
    /// Where the ray meets it, in metres from the middle.
    pub(super) distance: f64,
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

/// The ray and the difference in the ray's frame.
pub(super) struct Shadow<'a> {
    pair: &'a Pair<'a>,
    /// From the ray's frame to the world's axes.
    frame: DMat3,
    /// From the shapes' frames to the ray's.
    from_a: DMat3,
    from_b: DMat3,
    /// Where the ray runs, seen from the difference's middle.
    ray: DVec2,
    /// Up to this distance in metres what passes by counts as touching.
    shift: f64,
}

impl<'a> Shadow<'a> {
    /// None if the motion has no direction.
    pub(super) fn new(pair: &'a Pair) -> Option<Self> {
        let along = pair.motion.try_normalize()?;
        let (x, y) = orthonormal(along);
        let frame = DMat3::from_cols(x, y, along);
        let to_ray = frame.transpose();
        let shift = SHIFT * pair.rounding;
        // Any direction does that is not among a scene's own.
        let ray = (to_ray * pair.nearest).xy() + 0.25 * shift * DVec2::new(0.837, -0.547);
        Some(Self {
            pair,
            from_a: to_ray * pair.a.rotation,
            from_b: to_ray * pair.b.rotation,
            frame,
            ray,
            shift,
        })
    }

    /// The difference's farthest point along a direction of any length.
    #[inline]
    fn support(&self, direction: DVec3) -> Probe {
        let Pair { a, b, .. } = self.pair;
        let vertex_a = a.support_local(self.from_a.transpose() * -direction);
        let vertex_b = b.support_local(self.from_b.transpose() * direction);
        let point = self.from_b * b.local(vertex_b) - self.from_a * a.local(vertex_a);
        Probe {
            vertices: [vertex_a, vertex_b],
            point: point - self.ray.extend(0.0),
        }
    }

    /// Three points of the difference around the ray, counter-clockwise.
    ///
    /// Leads a line of two points towards the ray until a third encloses it, as
    /// Gilbert, Johnson and Keerthi do; every support is a test whether
    /// the ray passes by. A ray that touches the shadow to within rounding is
    /// moved in.
    pub(super) fn enclose(&mut self) -> Found<[Probe; 3]> {
        let mut towards = if self.ray == DVec2::ZERO {
            DVec2::X
        } else {
            self.ray
        };
        let mut simplex: [Option<Probe>; 2] = [None, None];
        for _ in 0..MAX_STEPS {
            let probe = self.support(towards.extend(0.0));
            let reach = probe.point.xy().dot(towards);
            if reach < 0.0 {
                let length = towards.length();
                if -reach > self.shift * length {
                    return Found::Miss;
                }
                self.ray -= (2.0 * self.shift / length) * towards;
                simplex = [None, None];
                continue;
            }
            let new = probe.point.xy();
            match simplex {
                [Some(from), Some(to)] => {
                    let (p, q) = (from.point.xy(), to.point.xy());
                    // The ray lies to the right of the line from p to q, and so does the new point.
                    let (before, after) = (p.perp_dot(new), new.perp_dot(q));
                    if before >= 0.0 && after >= 0.0 && q.perp_dot(p) >= 0.0 {
                        return Found::Yes([from, probe, to]);
                    }
                    if before < after {
                        simplex = [Some(from), Some(probe)];
                        towards = (new - p).perp() * -1.0;
                    } else {
                        simplex = [Some(probe), Some(to)];
                        towards = (q - new).perp() * -1.0;
                    }
                }
                [Some(first), _] => {
                    let old = first.point.xy();
                    let across = (new - old).perp();
                    // Towards the ray: to the right of the line.
                    if across.dot(old) >= 0.0 {
                        simplex = [Some(first), Some(probe)];
                        towards = -across;
                    } else {
                        simplex = [Some(probe), Some(first)];
                        towards = across;
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

    /// The face that the ray enters by (`side` −1) or leaves by (`side` 1), from
    /// three points around it.
    pub(super) fn refine(&self, mut probes: [Probe; 3], side: f64) -> Option<Portal> {
        let tolerance = 2.0 * self.pair.rounding;
        for _ in 0..MAX_STEPS {
            let [p, q, r] = probes.map(|probe| probe.point);
            let normal = side * (q - p).cross(r - p);
            let new = self.support(normal);
            let reached = normal.dot(p).max(normal.dot(q)).max(normal.dot(r));
            let gain = normal.dot(new.point) - reached;
            let known = probes.iter().any(|probe| probe.vertices == new.vertices);
            let length = normal.length();
            if known || gain <= tolerance * length {
                let lowest = normal.dot(p).min(normal.dot(q)).min(normal.dot(r));
                let spread = normal.dot(new.point) - lowest;
                // The normal of a sliver is rounding; NaN gives up too.
                if !(side * normal.z > 0.0 && spread <= 2.0 * tolerance * length) {
                    return None;
                }
                return Some(Portal {
                    distance: depth(&probes),
                    probes,
                    normal: self.frame * (normal / length),
                    vertices: new.vertices,
                });
            }
            // Which two of the three enclose the ray together with the new point?
            let u = new.point.xy();
            let sides = probes.map(|probe| u.perp_dot(probe.point.xy()));
            let mut best = (0.0, 3);
            for i in 0..3 {
                let j = (i + 1) % 3;
                if sides[i] >= 0.0 && sides[j] <= 0.0 {
                    let area =
                        sides[i] - sides[j] + probes[i].point.xy().perp_dot(probes[j].point.xy());
                    if area > best.0 {
                        best = (area, i);
                    }
                }
            }
            let (_, i) = best;
            if i == 3 {
                return None;
            }
            probes = [probes[i], probes[(i + 1) % 3], new];
        }
        None
    }
}

/// Where the ray goes through the triangle of three points around it.
fn depth(probes: &[Probe; 3]) -> f64 {
    let [p, q, r] = probes.map(|probe| probe.point);
    let shares = [(q, r), (r, p), (p, q)].map(|(u, v)| u.xy().perp_dot(v.xy()).max(0.0));
    let whole: f64 = shares.iter().sum();
    (shares[0] * p.z + shares[1] * q.z + shares[2] * r.z) / whole
}
