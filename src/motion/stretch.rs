//! Parts of a frame on which a body moves as one formula says.

use crate::curve::{CubicBezier, Near, Section, Spline};
use crate::motion::kind::Kind;
use crate::motion::track::Lap;
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
    spline: &'a Spline,
    pub(crate) piece: &'a CubicBezier,
    index: usize,
    /// Where it begins.
    start: Near,
    /// Where it was looked for last.
    near: Near,
    /// Parameters of the piece at the stretch's start and end; falling on the way back.
    pub(crate) u: [f64; 2],
    /// Distances of both along the path.
    distances: [f64; 2],
}

/// A place on a [`Curve`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Spot {
    /// The parameter of the piece.
    pub(crate) u: f64,
    /// Along the path.
    distance: f64,
    near: Near,
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
        let Lap {
            flown,
            in_all,
            start,
            end,
            sense,
        } = self.lap_at(journey, from);
        let forward = sense > 0.0;
        let Some(spline) = journey.path.as_spline() else {
            let velocity = sense * journey.speed * journey.path.tangent_at(0.0);
            return until(self.next_break(motion, from), Course::Straight(velocity));
        };
        let ((mut index, mut u), near) = spline.locate_near(start, self.near);
        if !forward && u <= 0.0 && index > 0 {
            (index, u) = (index - 1, 1.0);
        }
        // Or to the joint before that.
        let u_joint = if forward { 1.0 } else { 0.0 };
        let joint = spline.joint(index + usize::from(forward));
        let (end, u_end) = if sense * (joint - end) <= 0.0 {
            (joint, u_joint)
        } else {
            let ((piece, u), _) = spline.locate_near(end, near);
            // By rounding on the next piece.
            (end, if piece == index { u } else { u_joint })
        };
        let way = sense * (end - start);
        let to = if flown + way >= in_all && 1.0 < self.rests_from {
            1.0
        } else {
            from + way / (journey.speed * self.duration)
        };
        until(
            to,
            Course::Curve(Curve {
                spline,
                piece: &spline.pieces()[index],
                index,
                start: near,
                near,
                u: [u, u_end],
                distances: [start, end],
            }),
        )
    }
}

impl Stretch<'_> {
    /// The share of its time that has passed at a fraction of the frame.
    pub(crate) fn share_at(&self, fraction: f64) -> f64 {
        if fraction >= self.to {
            1.0
        } else {
            (fraction - self.from) / (self.to - self.from)
        }
    }
}

impl Curve<'_> {
    /// The parameter of the piece when a share of the stretch's time has passed.
    pub(crate) fn u_at(&self, share: f64) -> f64 {
        if share >= 1.0 {
            return self.u[1];
        }
        self.spot_near(share, self.near).u
    }

    /// The same for who asks again and again, each time not far from the last.
    pub(crate) fn seek(&mut self, share: f64) -> Spot {
        let spot = self.spot_near(share, self.near);
        self.near = spot.near;
        spot
    }

    #[inline]
    fn spot_near(&self, share: f64, near: Near) -> Spot {
        let [first, last] = self.u;
        let [start, end] = self.distances;
        // Both ends to the bit; what is beside them all the same.
        let distance = if share <= 0.0 {
            return Spot {
                u: first,
                distance: start,
                near: self.start,
            };
        } else if share >= 1.0 {
            end
        } else {
            start + share * (end - start)
        };
        let ((piece, u), near) = self.spline.locate_near(distance, near);
        let u = if share >= 1.0 {
            last
        } else if piece == self.index {
            u.clamp(first.min(last), first.max(last))
        } else if (piece > self.index) == (last >= first) {
            last
        } else {
            first
        };
        Spot { u, distance, near }
    }

    /// How far it may be followed from a place on so that its fourth derivative by distance times that way's
    /// fourth power is no more than `root` is to the fourth; and the fourth root of that derivative's inverse.
    /// Nothing beside a cusp.
    #[inline]
    pub(crate) fn smooth_way(&self, from: &Spot, root: f64) -> (f64, f64) {
        let place = (from.near, from.distance);
        self.spline
            .smooth_way(self.index, place, self.is_forward(), root)
    }

    /// An upper bound of the fourth derivative by distance between two places, per cubic metre; infinite beside
    /// a cusp.
    pub(crate) fn jounce(&self, [from, to]: [&Spot; 2]) -> f64 {
        Section::of(self.piece, [from.u, to.u], self.is_forward()).jounce()
    }

    /// The share of the stretch's time that has passed when the piece's parameter is `u`.
    pub(crate) fn share_at(&self, u: f64) -> f64 {
        let [first, last] = self.u;
        let [start, end] = self.distances;
        if (u - last).abs() <= 0.0 {
            return 1.0;
        }
        if (u - first).abs() <= 0.0 {
            return 0.0;
        }
        let share = (self.spline.distance_at(self.index, u) - start) / (end - start);
        // NaN, of a stretch without length, counts as its start.
        if share > 0.0 { share.min(1.0) } else { 0.0 }
    }

    /// Whether it is passed in the sense of its parameter.
    pub(crate) fn is_forward(&self) -> bool {
        self.u[1] >= self.u[0]
    }
}
