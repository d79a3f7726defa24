//! Two bodies seen along their relative motion.

use crate::geometry::{Feature, Pose, Shape};
use crate::narrow_phase::rays::aim::Aim;
use crate::narrow_phase::rays::crossings::Crossing;
use crate::narrow_phase::rays::shadow::{Shadow, Side, View};
use crate::narrow_phase::rays::starts::{Origin, Outline, Starts};
use crate::sampling::turn_zenith;
use glam::{DVec2, DVec3};

/// A body as a stretch of straight relative motion begins.
#[derive(Clone, Copy)]
pub(crate) struct Standing<'a> {
    pub(crate) shape: &'a Shape,
    pub(crate) pose: &'a Pose,
    /// What [`RayCaster::surface_points`] gave for the shape.
    pub(crate) points: &'a [DVec3],
}

/// The shortest ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RayTouch {
    /// Its length as a share of the relative motion, `0..=1`.
    pub(crate) fraction: f64,
    /// Its end on the second body, from the first body's bounding centre, both
    /// as the stretch begins.
    pub(crate) offset: DVec3,
    /// Unit normal, out of the second body.
    pub(crate) normal: DVec3,
    /// Features of the first and of the second body.
    pub(crate) features: [Feature; 2],
}

/// A ray found to be the shortest so far.
#[derive(Clone, Copy)]
pub(super) struct Shortest {
    pub(super) at: DVec2,
    pub(super) gap: f64,
    pub(super) origin: Origin,
    /// Whether it was sent back by the second body.
    pub(super) behind: bool,
}

/// How much shorter a ray sent back must be to be preferred, as a share of the pair's size.
///
/// Where two edges meet both bodies' rays find the same touch, and rounding
/// would choose between their normals.
pub(super) const PREFERENCE: f64 = 1e-9;

/// Two bodies seen along their relative motion.
pub(super) struct Facing<'a> {
    pub(super) view: View,
    pub(super) shadow_a: &'a Shadow<'a>,
    pub(super) shadow_b: &'a Shadow<'a>,
    pub(super) aim: &'a Aim,
    pub(super) outlines: &'a [Outline<'a>; 2],
    pub(super) touch: f64,
    /// Length of the motion.
    pub(super) longest: f64,
}

impl Facing<'_> {
    /// Starting points on a body's surface, not depending on the other body.
    pub(super) fn push_surface(
        &self,
        starts: &mut Starts,
        body: Standing<'_>,
        hemisphere: &[DVec3],
        centre: DVec3,
        side: f64,
    ) {
        if let Shape::Sphere(sphere) = body.shape {
            let turn = turn_zenith(side * self.view.z);
            for &point in hemisphere {
                let point = self.view.coordinates(sphere.radius() * turn(point));
                starts.push_surface(centre + point);
            }
        }
        let shape_centre = body.shape.centre();
        for &point in body.points {
            let point = self
                .view
                .coordinates(body.pose.direction(point - shape_centre));
            starts.push_surface(centre + point);
        }
    }

    pub(super) fn size(&self) -> f64 {
        self.shadow_a.size + self.shadow_b.size
    }

    /// Differences of gaps below this are rounding.
    pub(super) fn rounding(&self) -> f64 {
        4.0 * f64::EPSILON * (self.size() + self.shadow_b.centre.z.abs())
    }

    /// A gap that a ray can have, or NaN.
    pub(super) fn valid(&self, gap: f64) -> f64 {
        if gap >= -self.touch { gap } else { f64::NAN }
    }

    /// Whether a vertex or a point of an edge, of the second body if `behind`, lies
    /// on the side of its body that the other comes from.
    ///
    /// Rays from the side turned away are longer and do no harm, except where the
    /// two bodies pass each other in touch: then nothing is in these rays' way.
    pub(super) fn is_in_front(&self, behind: bool, point: DVec3) -> bool {
        let tolerance = PREFERENCE * self.size();
        // NaN, beside the body by rounding, fails the comparison.
        let hidden = if behind {
            point.z - self.shadow_b.depth(Side::Near, point.truncate()) > tolerance
        } else {
            self.shadow_a.depth(Side::Far, point.truncate()) - point.z > tolerance
        };
        !hidden
    }

    pub(super) fn keep_shorter(&self, best: &mut Option<Shortest>, found: Shortest) {
        let margin = |best: &Shortest| match (best.behind, found.behind) {
            (false, true) => -PREFERENCE * self.size(),
            (true, false) => PREFERENCE * self.size(),
            _ => 0.0,
        };
        if best
            .as_ref()
            .is_none_or(|best| found.gap < best.gap + margin(best))
        {
            *best = Some(found);
        }
    }

    /// The ray between a ball and the face of the other body that the shortest
    /// ray so far leads to, if it is shorter still.
    ///
    /// The ball touches that face with the point whose normal opposes it. Where
    /// the ball nearly slides along the face, this point lies at the rim of its
    /// shadow, and rays that close in on it from the middle come too slowly.
    pub(super) fn polish(&self, mut best: Shortest, rays: &mut u64) -> Shortest {
        let (ball, behind) = match (self.shadow_a.disc(), self.shadow_b.disc()) {
            (Some(_), None) => (self.shadow_a, false),
            (None, Some(_)) => (self.shadow_b, true),
            _ => return best,
        };
        // A better ray may lead to the face beside; a few are enough.
        for _ in 0..4 {
            let Some((far_a, near_b)) = self.ends(best) else {
                break;
            };
            let (x, y) = (best.at.x, best.at.y);
            let (normal, _) = if behind {
                self.shadow_a.surface_at(x, y, far_a, Side::Far)
            } else {
                self.shadow_b.surface_at(x, y, near_b, Side::Near)
            };
            let start = ball.centre - ball.size * self.view.coordinates(normal);
            let gap = self.valid(if behind {
                start.z - self.shadow_a.depth(Side::Far, start.truncate())
            } else {
                self.shadow_b.depth(Side::Near, start.truncate()) - start.z
            });
            *rays += 1;
            if gap.is_nan() || gap >= best.gap {
                break;
            }
            best = Shortest {
                at: start.truncate(),
                gap,
                origin: Origin::Area,
                behind,
            };
        }
        best
    }

    /// What the shortest ray tells about the touch.
    pub(super) fn touch(&self, best: Shortest) -> Option<RayTouch> {
        let fraction = best.gap.max(0.0) / self.longest;
        // NaN fails the comparison as well.
        if fraction <= 1.0 {
            let (x, y) = (best.at.x, best.at.y);
            let (far_a, near_b) = self.ends(best)?;
            let (normal_a, surface_a) = self.shadow_a.surface_at(x, y, far_a, Side::Far);
            let (normal_b, surface_b) = self.shadow_b.surface_at(x, y, near_b, Side::Near);
            // Where an edge meets an edge a ray knows no better normal than
            // the triangle's that it hits, and the second body's is asked for.
            let on_edges = matches!(best.origin, Origin::Edge { .. })
                && self.shadow_a.leaves_by_edge(x, y, far_a);
            let (normal, features) = if best.behind {
                let normal = if on_edges { normal_b } else { -normal_a };
                (normal, [surface_a, best.origin.feature(surface_b)])
            } else {
                (normal_b, [best.origin.feature(surface_a), surface_b])
            };
            let offset = self.view.vector(DVec3::new(x, y, near_b));
            Some(RayTouch {
                fraction,
                offset,
                normal,
                features,
            })
        } else {
            None
        }
    }

    /// What the shortest ray tells if it runs from edge to edge: the normal is
    /// the triangle's that it hits, as of every ray.
    pub(super) fn touch_of_edges(&self, crossing: &Crossing) -> Option<RayTouch> {
        let fraction = crossing.gap.max(0.0) / self.longest;
        let DVec3 { x, y, z } = crossing.end;
        (fraction <= 1.0).then(|| RayTouch {
            fraction,
            offset: self.view.vector(crossing.end),
            normal: self.shadow_b.surface_at(x, y, z, Side::Near).0,
            features: crossing.edges.map(Feature::Edge),
        })
    }

    /// Depths of the ray's two ends.
    fn ends(&self, best: Shortest) -> Option<(f64, f64)> {
        let (x, y) = (best.at.x, best.at.y);
        if best.behind {
            let (_, far) = self.shadow_a.span(x, y)?;
            Some((far, far + best.gap))
        } else {
            let (near, _) = self.shadow_b.span(x, y)?;
            Some((near - best.gap, near))
        }
    }
}
