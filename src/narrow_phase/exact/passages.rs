//! How two bodies' hubs go on.

use super::flight::Flight;
use super::window::Parabola;
use crate::curve::Sway;
use crate::motion::{Bend, Stretch, TurningRate};
use glam::DVec3;

/// Share of a frame in which a body that faces its way may turn round unseen, where its path turns
/// in a cusp or goes straight up.
pub(super) const FLIP: f64 = 1e-9;

/// How two hubs go on relative to each other on a window of a frame.
pub(super) struct Passages {
    /// Of A's hub relative to B's, metres per frame.
    pub(super) velocity: DVec3,
    /// What bends their courses.
    pub(super) bends: [Bend; 2],
    /// What else they may do, upper bound, metres per frame.
    pub(super) stray: f64,
    /// How long the window lasts, in frames, and the fraction of the frame at which it ends.
    pub(super) length: f64,
    pub(super) to: f64,
}

impl Passages {
    /// From `from` on, which lies on both stretches, up to `to` at most.
    pub(super) fn between(
        (a, b): (&Flight<'_>, &Flight<'_>),
        [stretch_a, stretch_b]: &[Stretch<'_>; 2],
        [from, to]: [f64; 2],
    ) -> Self {
        // One by one: arrays of what is large are copied about.
        let of_a = a.frame.passage(a.motion, stretch_a, from, to);
        let of_b = b.frame.passage(b.motion, stretch_b, from, to);
        let to = of_a.to.min(of_b.to);
        Self {
            velocity: of_a.velocity - of_b.velocity,
            bends: [of_a.bend, of_b.bend],
            stray: of_a.stray + of_b.stray,
            length: to - from,
            to,
        }
    }

    /// How far the hubs keep apart along a unit vector that are `start` apart along it now.
    pub(super) fn parabola(&self, normal: DVec3, start: f64) -> Parabola {
        Parabola {
            start,
            slope: normal.dot(self.velocity) - self.stray,
            bend: self.bends.iter().map(|bend| bend.along(normal)).sum(),
        }
    }
}

/// How two bodies go on and turn on a window of a frame.
pub(super) struct Rates {
    pub(super) passages: Passages,
    /// Angular velocities as the window begins, radians per frame.
    pub(super) spins: [DVec3; 2],
    /// How much these change at most.
    pub(super) sways: [Sway; 2],
    /// What else turning may do, upper bound, metres per frame.
    pub(super) turning: f64,
}

impl Rates {
    /// From `time` on, for `longest` at most.
    pub(super) fn on(
        (a, b): (&Flight<'_>, &Flight<'_>),
        stretches: &[Stretch<'_>; 2],
        (time, mut longest): (f64, f64),
    ) -> Self {
        loop {
            let to = (time + longest).min(1.0);
            let passages = Passages::between((a, b), stretches, [time, to]);
            let mut turning = 0.0;
            let mut spins = [DVec3::ZERO; 2];
            let mut sways = [Sway::NONE; 2];
            for (side, flight) in [a, b].into_iter().enumerate() {
                if flight.turns() {
                    let (frame, stretch) = (flight.frame, &stretches[side]);
                    let rate = frame.turning_rate(flight.motion, stretch, time, passages.to);
                    match rate {
                        TurningRate::About { spin, sway } => {
                            (spins[side], sways[side]) = (spin, sway);
                        }
                        TurningRate::AtMost(rate) => turning += rate * flight.arm,
                    }
                }
            }
            // Before a cusp, or where a body that faces its way goes straight up, only short windows
            // say how fast it turns.
            if turning.is_infinite() && passages.length > FLIP {
                longest = 0.25 * passages.length;
                continue;
            }
            return Self {
                passages,
                spins,
                sways,
                turning,
            };
        }
    }
}
