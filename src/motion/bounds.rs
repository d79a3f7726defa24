//! How much a body cannot turn more, in a part of one frame.
//!
//! One-sided: a body does no more than it says, rounding included.

use crate::motion::kind::Kind;
use crate::motion::leg::Leg;
use crate::motion::{FrameMotion, Motion, Turning};
use glam::DVec3;

/// Tangents that differ by no more meet without a corner: a body that faces its way
/// jumps there by 1e-9 of its size at most.
pub(super) const SMOOTH: f64 = 1e-9;

impl FrameMotion {
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
                // In a corner rounding may have it face as before, and then it jumps at once.
                let facing = self.tangent_at(journey, from);
                let forward = journey.waypoint(start).forward;
                let mut last = Some(if forward { facing } else { -facing });
                let mut most = 0.0_f64;
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
