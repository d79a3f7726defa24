//! What a body cannot do faster, in a part of one frame.
//!
//! Everything here is one-sided: a body does no more than it says, rounding
//! included. With the carried point `c`, a point of the body that is `r` away
//! from it, and a unit vector `n`, between two fractions of the frame
//! `n · (c + r)` grows at most by [`advance_along`](FrameMotion::advance_along) plus
//! the least of `2|r|` and `|r|` times the [turn](FrameMotion::angle_between). For a
//! spin about `e` the rate is less along `n`: `d/dt n·r = n·(ω × r) = r·(n × ω)`,
//! at most `|n × e|·|ω|·|r|`.

use crate::motion::kind::Kind;
use crate::motion::leg::Leg;
use crate::motion::{FrameMotion, Motion, Turning};
use glam::DVec3;

/// Tangents that differ by no more meet without a corner: a body that faces its way
/// jumps there by 1e-9 of its size at most.
const SMOOTH: f64 = 1e-9;

impl FrameMotion {
    /// How far the body moves at most along the unit vector `direction` between
    /// fraction `from` and any fraction up to `to`, in metres; not negative.
    ///
    /// On curves from the control points of the pieces in between, and never
    /// more than is flown.
    pub(crate) fn advance_along(
        &self,
        motion: &Motion,
        direction: DVec3,
        from: f64,
        to: f64,
    ) -> f64 {
        match motion.kind() {
            Kind::Fixed { .. } => 0.0,
            Kind::Free { velocity, .. } => {
                (velocity.dot(direction) * ((to - from) * self.duration)).max(0.0)
            }
            Kind::Along(journey) => {
                let [start, end] = [from, to].map(|fraction| self.flown_at(journey, fraction));
                let (mut at, mut most) = (0.0, 0.0_f64);
                let known = Leg::between(journey, start, end, |leg| {
                    let offsets = leg.control_offsets().map(|offset| offset.dot(direction));
                    most = offsets.into_iter().fold(most, |most, o| most.max(at + o));
                    at += offsets[3];
                });
                let flown = (end - start).max(0.0);
                // Places on a path are exact to rounding of its length.
                let rounding = 16.0 * f64::EPSILON * (journey.path.length() + flown);
                if known && most < flown {
                    most + rounding
                } else {
                    flown
                }
            }
        }
    }

    /// The greatest component of the body's velocity along the unit vector
    /// `direction` between two fractions, in metres per second; may be negative.
    pub(crate) fn speed_along(&self, motion: &Motion, direction: DVec3, from: f64, to: f64) -> f64 {
        match motion.kind() {
            Kind::Fixed { .. } => 0.0,
            Kind::Free { velocity, .. } => velocity.dot(direction),
            Kind::Along(journey) => {
                if to <= self.rests_until || from >= self.rests_from {
                    return 0.0;
                }
                let [start, end] = [from, to].map(|fraction| self.flown_at(journey, fraction));
                let mut most = f64::NEG_INFINITY;
                let known = Leg::between(journey, start, end, |leg| {
                    most = most.max(leg.most_along(direction));
                });
                let most = if known { most } else { 1.0 };
                let rests = from < self.rests_until || to > self.rests_from;
                journey.speed * if rests { most.max(0.0) } else { most }
            }
        }
    }

    /// How fast the body turns at most between two fractions, in radians per
    /// second; infinite where its orientation may jump.
    ///
    /// One that faces its way with `up` upright has as angular velocity the
    /// change of its heading, about up, and that of its climb, about the
    /// horizontal; the tangent's own change is that of the climb and `cos(climb)`
    /// times that of the heading. So it turns at most `1/cos(climb)` times as
    /// fast as its tangent, which turns with speed times curvature.
    pub(crate) fn angular_speed(&self, motion: &Motion, from: f64, to: f64) -> f64 {
        match (motion.turning(), motion.kind()) {
            (Turning::Spin(spin), _) => spin.rate().abs(),
            (Turning::Facing(attitude), Kind::Along(journey)) => {
                if journey.path.is_straight() {
                    return 0.0;
                }
                let [start, end] = [from, to].map(|fraction| self.flown_at(journey, fraction));
                if end <= start {
                    return 0.0;
                }
                let up = attitude.world_up();
                let (mut most, mut last) = (0.0_f64, None);
                let known = Leg::between(journey, start, end, |leg| {
                    let [enter, leave] = leg.end_tangents();
                    let jumps = last.is_some_and(|last: DVec3| last.distance(enter) > SMOOTH);
                    last = Some(leave);
                    most = most.max(if jumps {
                        f64::INFINITY
                    } else {
                        leg.turning(up)
                    });
                });
                // On its way back the body flies backwards and does not jump,
                // but to say so would take more than it is worth.
                if known {
                    journey.speed * most
                } else {
                    f64::INFINITY
                }
            }
            (Turning::Not | Turning::Facing(_), _) => 0.0,
        }
    }

    /// How far the body turns at most between two fractions, in radians; infinite
    /// where its orientation may jump.
    pub(crate) fn angle_between(&self, motion: &Motion, from: f64, to: f64) -> f64 {
        let speed = self.angular_speed(motion, from, to);
        let time = match motion.turning() {
            Turning::Facing(_) => self.flying(from, to),
            Turning::Spin(_) | Turning::Not => (to - from) * self.duration,
        };
        // Not 0 · ∞.
        if speed > 0.0 && time > 0.0 {
            speed * time
        } else {
            0.0
        }
    }
}
