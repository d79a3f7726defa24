//! Along a path, in time.

use crate::error::MotionError;
use crate::math::domain;
use crate::motion::Path;
use crate::motion::spin::product;
use crate::tolerance::{MAX_DISTANCE, MAX_SPEED, MAX_TIME_STEP, MIN_SPEED};

/// What a body does at the end of its path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum AtEnd {
    /// It stays there.
    #[default]
    Rest,
    /// It goes on at the path's start, which is in the same place.
    Loop,
    /// It turns round, and flies to and fro for ever.
    Return,
}

/// A path, and when a body is where on it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Journey {
    pub(crate) path: Path,
    pub(crate) speed: f64,
    pub(crate) at_end: AtEnd,
    /// Distance flown as the motion begins.
    pub(crate) start_distance: f64,
    /// Seconds from when the motion begins to when the body does.
    pub(crate) start_time: f64,
}

/// A place on a path, and whether it is passed towards the path's end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Waypoint {
    pub(crate) distance: f64,
    pub(crate) forward: bool,
}

/// How far a loop's ends may be apart, as a share of their coordinates: rounding.
const CLOSED: f64 = 4.0 * f64::EPSILON;

impl Journey {
    pub(super) fn new(path: Path, speed: f64) -> Self {
        Self {
            path,
            speed,
            at_end: AtEnd::Rest,
            start_distance: 0.0,
            start_time: 0.0,
        }
    }

    pub(super) fn check(&self) -> Result<(), MotionError> {
        domain::within("speed", self.speed, MIN_SPEED, MAX_SPEED)?;
        domain::within("start_distance", self.start_distance, 0.0, MAX_DISTANCE)?;
        domain::within("start_time", self.start_time, 0.0, MAX_TIME_STEP)?;
        if self.at_end == AtEnd::Loop {
            let (start, end) = (self.path.start(), self.path.end());
            let gap = start.distance(end);
            let coordinate = start.abs().max(end.abs()).max_element();
            if gap > CLOSED * coordinate {
                return Err(MotionError::OpenLoop { gap });
            }
        }
        Ok(())
    }

    /// Distance after which everything begins anew; infinite if nothing does.
    fn period(&self) -> f64 {
        match self.at_end {
            AtEnd::Rest => f64::INFINITY,
            AtEnd::Loop => self.path.length(),
            AtEnd::Return => 2.0 * self.path.length(),
        }
    }

    /// Distance flown after `elapsed` seconds, less whole periods.
    ///
    /// After hours of laps too it is exact to rounding in one lap: remainders
    /// are, and what the product drops is added afterwards.
    pub(super) fn flown_after(&self, elapsed: f64) -> f64 {
        let period = self.period();
        let (high, low) = product(self.speed, (elapsed - self.start_time).max(0.0));
        if self.start_distance + high < period {
            return self.start_distance + high;
        }
        let rest = self.start_distance % period + high % period + low;
        // The remainder of a hair less than nothing would be just that.
        if rest < 0.0 { 0.0 } else { rest % period }
    }

    /// The place at which a body is that has flown so far.
    pub(super) fn waypoint(&self, flown: f64) -> Waypoint {
        let length = self.path.length();
        let (distance, forward) = match self.at_end {
            AtEnd::Rest => (flown.min(length), true),
            AtEnd::Loop if flown <= length => (flown, true),
            AtEnd::Loop => (flown % length, true),
            AtEnd::Return => {
                let flown = if flown <= 2.0 * length {
                    flown
                } else {
                    flown % (2.0 * length)
                };
                if flown <= length {
                    (flown, true)
                } else {
                    (2.0 * length - flown, false)
                }
            }
        };
        Waypoint { distance, forward }
    }

    /// The distances along the path between which a body flies that has flown `start` and
    /// goes on to `end`, at most [the next end](Self::next_end) of the path; and
    /// whether towards the path's end.
    ///
    /// Told by the middle: where one lap ends another begins.
    pub(super) fn lap(&self, start: f64, end: f64) -> ([f64; 2], bool) {
        let middle = self.waypoint(0.5 * start + 0.5 * end);
        let half = 0.5 * (end - start);
        let length = self.path.length();
        let [low, high] = [middle.distance - half, middle.distance + half]
            .map(|distance| distance.max(0.0).min(length));
        if middle.forward {
            ([low, high], true)
        } else {
            ([high, low], false)
        }
    }

    /// Whether a body that has flown so far rests for good.
    pub(super) fn is_over(&self, flown: f64) -> bool {
        self.at_end == AtEnd::Rest && flown >= self.path.length()
    }

    /// The next distance beyond `flown` at which an end of the path is reached; infinite
    /// if there is none.
    pub(super) fn next_end(&self, flown: f64) -> f64 {
        let length = self.path.length();
        match self.at_end {
            AtEnd::Rest if flown >= length => f64::INFINITY,
            AtEnd::Rest => length,
            AtEnd::Loop | AtEnd::Return => {
                let laps = (flown / length).floor();
                let end = (laps + 1.0) * length;
                // Where rounding has put the end before the place.
                if end > flown {
                    end
                } else {
                    (laps + 2.0) * length
                }
            }
        }
    }
}
