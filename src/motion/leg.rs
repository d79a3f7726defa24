//! A journey cut where its path's pieces meet.

use crate::curve::Section;
use crate::motion::journey::Journey;
use glam::DVec3;

/// A part of a journey on one straight line or one piece of a spline.
#[derive(Debug, Clone, Copy)]
pub(super) enum Leg {
    /// The direction of flight.
    Straight(DVec3),
    Curve(Section),
}

/// More pieces than this are not looked at one by one.
const MOST_LEGS: usize = 64;

impl Leg {
    /// Hands over the legs between two distances flown, in order: at least one, the
    /// last without anything beyond a joint that is just reached.
    ///
    /// False if there are more than 64: then not all were.
    pub(super) fn between(
        journey: &Journey,
        start: f64,
        end: f64,
        mut visit: impl FnMut(Self),
    ) -> bool {
        let mut count = 0;
        let mut visit = |leg| {
            count += 1;
            if count <= MOST_LEGS {
                visit(leg);
            }
            count <= MOST_LEGS
        };
        let mut at = start;
        loop {
            let next = journey.next_end(at).min(end).max(at);
            if !Self::one_way(journey, at, next, &mut visit) {
                return false;
            }
            at = next;
            // At rest for good the next end is infinite.
            if at >= end {
                return true;
            }
        }
    }

    /// The same where the journey passes no end of its path.
    fn one_way(
        journey: &Journey,
        start: f64,
        end: f64,
        visit: &mut impl FnMut(Self) -> bool,
    ) -> bool {
        let path = &journey.path;
        let ([from, to], forward) = journey.lap(start, end);
        let Some(spline) = path.as_spline() else {
            let direction = path.tangent_at(0.0);
            let direction = if forward { direction } else { -direction };
            return visit(Self::Straight(direction));
        };
        let pieces = spline.pieces();
        let ((first, u_first), (last, u_last)) = (spline.locate(from), spline.locate(to));
        let mut piece = first;
        loop {
            let enter = match piece == first {
                true => u_first,
                false if forward => 0.0,
                false => 1.0,
            };
            let leave = match piece == last {
                true => u_last,
                false if forward => 1.0,
                false => 0.0,
            };
            let empty = (enter - leave).abs() <= 0.0 && first != last;
            if !empty
                && !visit(Self::Curve(Section::of(
                    &pieces[piece],
                    [enter, leave],
                    forward,
                )))
            {
                return false;
            }
            if piece == last {
                return true;
            }
            piece = if forward { piece + 1 } else { piece - 1 };
        }
    }

    /// An upper bound, per metre, on how fast a body turns that keeps `up` upright: infinite
    /// beside a cusp, and where the leg may go straight up.
    pub(super) fn turning(&self, up: DVec3) -> f64 {
        let Self::Curve(section) = self else {
            return 0.0;
        };
        let aside = section.tangents().map_or(0.0, |cone| cone.least_aside(up));
        let turning = section.curvature() / aside;
        // 0/0: nothing is known of a straight stretch straight up.
        if turning.is_nan() {
            f64::INFINITY
        } else {
            turning
        }
    }

    /// Unit tangents at both ends, in the direction of flight; zero in a cusp.
    pub(super) fn end_tangents(&self) -> [DVec3; 2] {
        match self {
            Self::Straight(direction) => [*direction; 2],
            Self::Curve(section) => section.end_tangents(),
        }
    }
}
