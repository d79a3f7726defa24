//! How far a step of the search goes.

use super::advance::Search;
use super::flight::Instant;
use super::planes::Planes;
use super::window::{Parabola, Plane, Side, Window};
use crate::motion::Course;
use glam::DVec3;

/// Looks at a plane's gap that it takes to find where it closes; what closes smoothly takes three or four.
const LOOKS: usize = 6;

/// The gap that is looked for, in shares of what counts as touching: bodies touch then, and a plane still parts them.
const AIM: f64 = 0.75;

/// How far a gap may be off that.
const SLACK: f64 = 0.2;

/// A gap that is more than this share of itself where it would close if it went on as it does, does not close soon.
const HALF: f64 = 0.5;

/// What closes is by so much nearer with every look as long as it is looked for.
const NEARER: f64 = 0.25;

impl<P: Planes> Search<'_, '_, P> {
    /// The longest advance of several planes across one normal that turn in different ways; and how the gap changes
    /// now, if one was looked at that turns with its features.
    pub(super) fn plane_advance(
        &self,
        window: &Window<'_, '_>,
        normal: DVec3,
        floor: f64,
    ) -> (f64, f64) {
        let still = Plane {
            normal,
            turn: DVec3::ZERO,
        };
        let turning = window.a.spin.length() + window.b.spin.length();
        if turning + window.turning <= 0.0 {
            return window.clear(&still, floor, window.length);
        }
        let (mut best, mut slope) = (0.0, 0.0);
        if turning > 0.0 {
            let turn = self.planes.turning(window, normal);
            // Over a longer time bounds of higher order weigh too much.
            let length = window.length.min(0.5 / turning.max(turn.length()));
            (best, slope) = window.clear(&Plane { normal, turn }, floor, length);
            // As a rule that is the longest but where it ends with the window.
            if best > 0.0 && best < length {
                return (best, slope);
            }
        }
        best = best.max(window.clear_for(&still, floor, window.length));
        if best < window.length {
            best = best.max(self.turned_all_round(window, normal, floor));
        }
        (best, slope)
    }

    /// How long a plane parts the solids of revolution that spinning bodies fill.
    fn turned_all_round(&self, window: &Window<'_, '_>, normal: DVec3, floor: f64) -> f64 {
        let heights = self.a.lowest_ever(normal) + self.b.lowest_ever(-normal);
        let parabola = Parabola {
            start: normal.dot(window.offset) + heights - window.radii - floor,
            slope: normal.dot(window.velocity) - window.stray,
            bend: window.acceleration(normal),
        };
        if parabola.start > 0.0 {
            parabola.root().min(window.length)
        } else {
            0.0
        }
    }

    /// Leaps to where their plane is about to close, if bodies that move evenly can be proven apart until then: `by`
    /// frames from now they are so; `gap` is what parts them now, and `slope` how that changes.
    ///
    /// Where the gap closes is looked for as a root is, whatever is between; what proves it is the time from there
    /// backwards. In that sense bodies move apart at some rate, and so bounds of the second order prove at once what
    /// takes step after step towards the touch, each leaving the square of what the one before did.
    pub(super) fn leap(&mut self, window: &Window<'_, '_>, gap: f64, slope: f64, by: f64) -> bool {
        let even = |side: &Side<'_, '_>| side.sway.most() <= 0.0;
        let straight = (self.stretches.iter()).all(|one| !matches!(one.course, Course::Curve(_)));
        if !(straight && even(&window.a) && even(&window.b) && window.stray + window.turning <= 0.0)
        {
            return false;
        }
        if gap > self.leap_below {
            return false;
        }
        // Unless the leap succeeds.
        self.leap_below = NEARER * gap;
        let touch = self.touch.meeting;
        let until = self.stretches[0].to.min(self.stretches[1].to);
        let (aim, from) = (AIM * touch, self.time + by);
        // Times and gaps beyond the aim, the last ones last.
        let mut known = [(self.time, gap - aim); 3];
        let mut time = (self.time - gap / slope).max(from);
        for look in 0..LOOKS {
            // False for NaN too.
            let within = time >= from && time <= until;
            if !within {
                return false;
            }
            let a = self.at(0, time, self.carried_at(0, time));
            let b = self.at(1, time, self.carried_at(1, time));
            let between = a.pose.position - b.pose.position;
            let Some(parted) = self.planes.same(&a, &b, between) else {
                return false;
            };
            let height = parted.gap - aim;
            if height.abs() <= SLACK * touch {
                let offset = between + (a.hub_offset() - b.hub_offset());
                let proven =
                    self.is_clear_before([&a, &b], offset, parted.normal, window, time - from);
                if proven {
                    self.time = time;
                    self.leap_below = f64::INFINITY;
                }
                return proven;
            }
            let nearer = if look == 0 { HALF } else { NEARER };
            // False for NaN too.
            let closes = height.abs() < nearer * known[2].1.abs();
            if !closes {
                return false;
            }
            known = [known[1], known[2], (time, height)];
            time = if look == 0 {
                chord_root([known[1], known[2]])
            } else {
                inverse_root(known)
            };
        }
        false
    }

    /// Whether a plane across `normal` parts the bodies all through the last `length` frames that parts them now;
    /// `window` is of the same even motion.
    fn is_clear_before(
        &self,
        [a, b]: [&Instant<'_>; 2],
        offset: DVec3,
        normal: DVec3,
        window: &Window<'_, '_>,
        length: f64,
    ) -> bool {
        let back = Window {
            a: Side {
                instant: a,
                spin: -window.a.spin,
                ..window.a
            },
            b: Side {
                instant: b,
                spin: -window.b.spin,
                ..window.b
            },
            offset,
            velocity: -window.velocity,
            length,
            ..*window
        };
        let turn = self.planes.turning(&back, normal);
        let plane = Plane { normal, turn };
        let floor = 0.5 * self.touch.meeting;
        length <= 0.0 || back.clear_for(&plane, floor, length) >= length
    }
}

/// Where the line through two places comes down to zero.
fn chord_root([(from, high), (to, low)]: [(f64, f64); 2]) -> f64 {
    to + low * ((to - from) / (high - low))
}

/// Where the parabola does that gives times for the heights at three.
fn inverse_root([(first, high), (second, middle), (third, low)]: [(f64, f64); 3]) -> f64 {
    let early = (second - first) / (middle - high);
    let late = (third - second) / (low - middle);
    let bend = (late - early) / (low - high);
    third - low * (late - middle * bend)
}
