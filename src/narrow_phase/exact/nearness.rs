//! How near two bodies come, and when that is a touch.

use super::flight::Flight;
use crate::tolerance::TOUCH;

/// Metres below which bodies touch.
#[derive(Debug, Clone, Copy)]
pub(super) struct Nearness {
    /// As the frame begins, and as long as they slide in touch since then.
    pub(super) resting: f64,
    /// When they meet: far from the origin, less than that, and still some times what rounding is.
    pub(super) meeting: f64,
}

impl Nearness {
    /// Share of the coordinates: 64 ulp, where a place on a curve is right to a few.
    const MEETING: f64 = 64.0 * f64::EPSILON;

    pub(super) fn of((a, b): (&Flight<'_>, &Flight<'_>), resting: f64) -> Self {
        let coordinate =
            (a.frame.start.abs().max(b.frame.start.abs())).max_element() + (a.speed + b.speed);
        let meeting = TOUCH * (a.reach + b.reach) + Self::MEETING * coordinate;
        Self {
            resting,
            meeting: meeting.min(resting),
        }
    }

    #[inline]
    pub(super) fn at(&self, time: f64) -> f64 {
        if time > 0.0 {
            self.meeting
        } else {
            self.resting
        }
    }
}

/// Whether the spheres around both hubs pass each other by: what each strays from its chord is known.
pub(super) fn passes_by(a: &Flight<'_>, b: &Flight<'_>, touch: f64) -> bool {
    let start = (a.frame.start - b.frame.start) + (a.hub_shift() - b.hub_shift());
    let way = a.frame.displacement - b.frame.displacement;
    let share = (-start.dot(way) / way.length_squared()).clamp(0.0, 1.0);
    // NaN, of no way at all.
    let nearest = if share > 0.0 {
        start + share * way
    } else {
        start
    };
    let reach = (a.reach + b.reach) * (1.0 + 1e-12) + a.frame.deviation + b.frame.deviation;
    nearest.length() > reach + touch
}
