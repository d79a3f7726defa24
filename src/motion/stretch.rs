//! Parts of a frame on which a body moves as one formula says.

use crate::curve::CubicBezier;
use crate::motion::kind::Kind;
use crate::motion::{FrameMotion, Motion};
use glam::DVec3;

/// A part of a frame on which a body's carried point rests, moves straight, or follows one
/// piece of a spline.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stretch<'a> {
    /// Fractions of the frame between which it lies.
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) course: Course<'a>,
}

/// How a carried point moves on a [`Stretch`].
#[derive(Debug, Clone, Copy)]
pub(crate) enum Course<'a> {
    Rest,
    /// At a constant velocity, in metres per second.
    Straight(DVec3),
    Curve(Curve<'a>),
}

/// A stretch on one piece of a spline, run at constant speed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Curve<'a> {
    pub(crate) piece: &'a CubicBezier,
    index: usize,
    /// Parameters of the piece at the stretch's start and end; falling on the way back.
    pub(crate) u: [f64; 2],
    /// Distances of both along the path.
    distances: [f64; 2],
}

impl FrameMotion {
    /// The stretch of the frame that begins at `from`.
    ///
    /// The next one begins where it ends, until one ends at 1; none is without length,
    /// but in frames that are. There are as many as pieces passed, laps included.
    pub(crate) fn stretch_at<'a>(&self, motion: &'a Motion, from: f64) -> Stretch<'a> {
        let until = |to: f64, course| Stretch {
            from,
            // NaN, and an end that rounding put behind: on to the next number.
            to: if to > from { to } else { from.next_up() }.min(1.0),
            course,
        };
        let journey = match motion.kind() {
            Kind::Fixed { .. } => return until(1.0, Course::Rest),
            Kind::Free { velocity, .. } => return until(1.0, Course::Straight(*velocity)),
            Kind::Along(journey) => journey,
        };
        if from < self.rests_until {
            return until(self.rests_until, Course::Rest);
        }
        if from >= self.rests_from {
            return until(1.0, Course::Rest);
        }
        let flown = self.flown_at(journey, from);
        // To the end of the path or of the frame.
        let end = self
            .flown_at(journey, 1.0)
            .min(self.end_after(journey, from).1);
        let ([start, end], forward) = journey.lap(flown, end.max(flown));
        let sense = if forward { 1.0 } else { -1.0 };
        let Some(spline) = journey.path.as_spline() else {
            let velocity = sense * journey.speed * journey.path.tangent_at(0.0);
            return until(self.next_break(motion, from), Course::Straight(velocity));
        };
        let (mut index, mut u) = spline.locate(start);
        if !forward && u <= 0.0 && index > 0 {
            (index, u) = (index - 1, 1.0);
        }
        // Or to the joint before that.
        let u_joint = if forward { 1.0 } else { 0.0 };
        let joint = spline.distance_at(index, u_joint);
        let (end, u_end) = if sense * (joint - end) <= 0.0 {
            (joint, u_joint)
        } else {
            let (piece, u) = spline.locate(end);
            // By rounding on the next piece.
            (end, if piece == index { u } else { u_joint })
        };
        let way = sense * (end - start);
        let to = if flown + way >= self.flown_at(journey, 1.0) && 1.0 < self.rests_from {
            1.0
        } else {
            from + way / (journey.speed * self.duration)
        };
        until(
            to,
            Course::Curve(Curve {
                piece: &spline.pieces()[index],
                index,
                u: [u, u_end],
                distances: [start, end],
            }),
        )
    }
}

impl Curve<'_> {
    /// The parameter of the piece when a share of the stretch's time has passed.
    pub(crate) fn u_at(&self, motion: &Motion, share: f64) -> f64 {
        let Some(spline) = motion.path().and_then(|path| path.as_spline()) else {
            return self.u[0];
        };
        let [start, end] = self.distances;
        let (piece, u) = spline.locate(start + share * (end - start));
        let [first, last] = self.u;
        if piece == self.index {
            u.clamp(first.min(last), first.max(last))
        } else if (piece > self.index) == (last >= first) {
            last
        } else {
            first
        }
    }
}
