//! How a body's carried point and its turning go on from some moment.

use crate::curve::{Bending, Section, Sway};
use crate::motion::bounds::SMOOTH;
use crate::motion::kind::Kind;
use crate::motion::stretch::{Course, Stretch};
use crate::motion::{FrameMotion, Motion, Turning};
use glam::DVec3;

/// A window of a frame on which a carried point moves nearly straight; time counts in frames.
///
/// At `σ` after its beginning the point is within `½ · bend · σ² + stray · σ`
/// of where `velocity` alone would have brought it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Passage {
    /// Metres per frame.
    pub(crate) velocity: DVec3,
    /// What bounds the acceleration.
    pub(crate) bend: Bend,
    /// Upper bound, in metres per frame: the whole speed where nothing is known of the
    /// direction, beside a cusp.
    pub(crate) stray: f64,
    /// The fraction of the frame at which the window ends.
    pub(crate) to: f64,
}

/// Bounds of an acceleration across the direction of flight.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bend {
    /// Speed squared, in metres per frame.
    square: f64,
    bending: Option<Bending>,
}

impl Bend {
    const NONE: Self = Self {
        square: 0.0,
        bending: None,
    };

    /// Upper bound of the acceleration's share along a vector, in metres per frame and frame and in the
    /// vector's length.
    pub(crate) fn along(&self, direction: DVec3) -> f64 {
        self.bending
            .map_or(0.0, |bending| self.square * bending.along(direction))
    }
}

/// How often a window is halved in search of a bound on its curvature.
const HALVINGS: u32 = 12;

impl FrameMotion {
    /// How the carried point moves from fraction `from`, which lies on `stretch`, up to `to` at
    /// most.
    ///
    /// Windows end where the stretch does, or before a cusp.
    pub(crate) fn passage(
        &self,
        motion: &Motion,
        stretch: &Stretch<'_>,
        from: f64,
        to: f64,
    ) -> Passage {
        let to = to.min(stretch.to);
        let straight = |velocity: DVec3| Passage {
            velocity: self.duration * velocity,
            bend: Bend::NONE,
            stray: 0.0,
            to,
        };
        let curve = match &stretch.course {
            Course::Rest => return straight(DVec3::ZERO),
            Course::Straight(velocity) => return straight(*velocity),
            Course::Curve(curve) => curve,
        };
        let forward = curve.is_forward();
        let u_at = |fraction: f64| curve.u_at(stretch.share_at(fraction));
        let speed = self.highest_speed(motion);
        let start = u_at(from);
        let mut end = to;
        for _ in 0..HALVINGS {
            let leave = u_at(end);
            if (leave - start).abs() <= f64::EPSILON {
                // As short as rounding: halving it would tell no more.
                break;
            }
            let section = Section::of(curve.piece, [start, leave], forward);
            if let Some(bending) = section.bending() {
                let [tangent, _] = section.end_tangents();
                return Passage {
                    velocity: speed * tangent,
                    bend: Bend {
                        square: speed * speed,
                        bending: Some(bending),
                    },
                    stray: 0.0,
                    to: end,
                };
            }
            let middle = from + 0.25 * (end - from);
            if !(from < middle && middle < end) {
                break;
            }
            end = middle;
        }
        Passage {
            velocity: DVec3::ZERO,
            bend: Bend::NONE,
            stray: speed,
            to: end,
        }
    }

    /// How fast the carried point moves at most, in metres per frame.
    pub(crate) fn highest_speed(&self, motion: &Motion) -> f64 {
        self.duration * motion.top_speed()
    }

    /// How a body turns between fraction `from`, which lies on `stretch`, and `to`, no later than the stretch's end.
    pub(crate) fn turning_rate(
        &self,
        motion: &Motion,
        stretch: &Stretch<'_>,
        from: f64,
        to: f64,
    ) -> TurningRate {
        let steady = |spin: DVec3| TurningRate::About {
            spin,
            sway: Sway::NONE,
        };
        match motion.turning() {
            Turning::Not => steady(DVec3::ZERO),
            Turning::Spin(spin) => steady(self.duration * spin.rate() * spin.axis()),
            Turning::Facing(attitude) => {
                let up = attitude.world_up();
                self.heading(motion, stretch, [from, to], up)
                    .unwrap_or_else(|| {
                        let most = self.angular_speed(motion, from, to);
                        TurningRate::AtMost(self.duration * most)
                    })
            }
        }
    }

    /// How a body turns that faces its way with `up` upright, if it follows a curve that is smooth
    /// enough; where it has just turned at once, it does not.
    ///
    /// The heading turns about up and the climb about the level axis to the left.
    fn heading(
        &self,
        motion: &Motion,
        stretch: &Stretch<'_>,
        [from, to]: [f64; 2],
        up: DVec3,
    ) -> Option<TurningRate> {
        let (Course::Curve(curve), Kind::Along(journey)) = (&stretch.course, motion.kind()) else {
            return None;
        };
        let u_at = |fraction: f64| curve.u_at(stretch.share_at(fraction));
        let (enter, leave) = (u_at(from), u_at(to));
        if (leave - enter).abs() <= f64::EPSILON {
            return None;
        }
        let forward = curve.is_forward();
        let speed = self.highest_speed(motion);
        let sway = Section::of(curve.piece, [enter, leave], forward).sway(up)?;
        let (tangent, bend) = curve.piece.heading(enter);
        // The tangent that its pose was made from.
        let facing = self.tangent_at(journey, from);
        let jump = facing.distance(tangent);
        if jump.is_nan() || jump > SMOOTH {
            return None;
        }
        let left = up.cross(tangent);
        let square = left.length_squared();
        let per_metre = (bend.dot(left) * up - bend.dot(up) * left) / square;
        let spin = if forward { speed } else { -speed } * per_metre;
        spin.is_finite().then_some(TurningRate::About {
            spin,
            sway: sway.at_speed(speed),
        })
    }
}

/// How a body turns on a window of a frame.
#[derive(Debug, Clone, Copy)]
pub(crate) enum TurningRate {
    /// At this angular velocity as the window begins, in radians per frame along the world's axes, and
    /// with no more change of it, by time.
    About { spin: DVec3, sway: Sway },
    /// About some axis, not faster than this.
    AtMost(f64),
}
