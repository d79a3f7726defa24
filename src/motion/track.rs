//! Parts of a frame on which a carried point moves as one formula says, for who looks at few of its places.

use crate::curve::{CubicBezier, Near, Spline};
use crate::motion::journey::Journey;
use crate::motion::kind::Kind;
use crate::motion::{FrameMotion, Motion};
use glam::DVec3;

/// A part of a frame like a [`Stretch`](crate::motion::Stretch), of which nothing is looked up before it is asked.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Track<'a> {
    /// Fractions of the frame between which it lies.
    pub(crate) from: f64,
    pub(crate) to: f64,
    way: Way<'a>,
}

#[derive(Debug, Clone, Copy)]
enum Way<'a> {
    /// Where it is as the track begins, and its velocity in metres per frame.
    Straight(DVec3, DVec3),
    Curve(Rail<'a>),
}

/// One piece of a spline that is run at constant speed.
#[derive(Debug, Clone, Copy)]
struct Rail<'a> {
    spline: &'a Spline,
    piece: &'a CubicBezier,
    index: usize,
    /// The piece's derivative by its parameter, from the constant up.
    derivative: [DVec3; 3],
    /// Distances along the path at the track's start and end.
    start: f64,
    end: f64,
    /// Metres per frame; negative on the way back.
    pace: f64,
}

/// A place on a [`Track`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Whereabouts {
    pub(crate) position: DVec3,
    /// Metres per frame; not finite in a cusp.
    pub(crate) velocity: DVec3,
    pub(crate) milestone: Milestone,
}

/// Where along a path that is.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Milestone {
    distance: f64,
    u: f64,
    near: Near,
}

/// The part of a journey that lies between two ends of its path, from a fraction of a frame on.
pub(super) struct Lap {
    /// Distance flown by then.
    pub(super) flown: f64,
    /// By the end of the frame.
    pub(super) in_all: f64,
    /// Distances along the path.
    pub(super) start: f64,
    pub(super) end: f64,
    /// 1, or −1 on the way back.
    pub(super) sense: f64,
}

impl FrameMotion {
    /// The lap at hand at `from`, to the end of the path or of the frame.
    pub(super) fn lap_at(&self, journey: &Journey, from: f64) -> Lap {
        let flown = self.flown_at(journey, from);
        let in_all = self.flown_at(journey, 1.0);
        let end = in_all.min(self.end_after(journey, from).1);
        let ([start, end], forward) = journey.lap(flown, end.max(flown));
        Lap {
            flown,
            in_all,
            start,
            end,
            sense: if forward { 1.0 } else { -1.0 },
        }
    }

    /// The part of the frame that begins at `from`, and where on its path.
    ///
    /// As [`stretch_at`](Self::stretch_at).
    pub(crate) fn track_at<'a>(&self, motion: &'a Motion, from: f64) -> (Track<'a>, Milestone) {
        let until = |to: f64, way| Track {
            from,
            // NaN, and an end that rounding put behind: on to the next number.
            to: if to > from { to } else { from.next_up() }.min(1.0),
            way,
        };
        let straight = |to: f64, velocity: DVec3| {
            let start = self.position_at(motion, from);
            let way = Way::Straight(start, self.duration * velocity);
            (until(to, way), Milestone::default())
        };
        let journey = match motion.kind() {
            Kind::Fixed { .. } => return straight(1.0, DVec3::ZERO),
            Kind::Free { velocity, .. } => return straight(1.0, *velocity),
            Kind::Along(journey) => journey,
        };
        if from < self.rests_until {
            return straight(self.rests_until, DVec3::ZERO);
        }
        if from >= self.rests_from {
            return straight(1.0, DVec3::ZERO);
        }
        let lap = self.lap_at(journey, from);
        let Lap { start, sense, .. } = lap;
        let Some(spline) = journey.path.as_spline() else {
            let velocity = sense * journey.speed * journey.path.tangent_at(0.0);
            return straight(self.next_break(motion, from), velocity);
        };
        let (mut index, near) = spline.piece_near(start, self.near);
        if sense < 0.0 && index > 0 && start <= spline.joint(index) {
            index -= 1;
        }
        let joint = spline.joint(index + usize::from(sense > 0.0));
        let end = if sense * (joint - lap.end) <= 0.0 {
            joint
        } else {
            lap.end
        };
        let way = sense * (end - start);
        let to = if lap.flown + way >= lap.in_all && 1.0 < self.rests_from {
            1.0
        } else {
            from + way / (journey.speed * self.duration)
        };
        let piece = &spline.pieces()[index];
        let [first, second, third] = piece.velocity();
        let rail = Rail {
            spline,
            piece,
            index,
            derivative: [
                first,
                2.0 * (second - first),
                (third - second) - (second - first),
            ],
            start,
            end,
            pace: sense * journey.speed * self.duration,
        };
        let milestone = Milestone {
            distance: start,
            near,
            ..Milestone::default()
        };
        (until(to, Way::Curve(rail)), milestone)
    }
}

impl Track<'_> {
    /// Where the body is at a fraction of the frame, and how it moves there; `near` is where it is not far from then.
    #[inline]
    pub(crate) fn at(&self, fraction: f64, near: &Milestone) -> Whereabouts {
        match &self.way {
            Way::Straight(start, velocity) => Whereabouts {
                position: *start + (fraction - self.from) * *velocity,
                velocity: *velocity,
                milestone: Milestone::default(),
            },
            Way::Curve(rail) => {
                let distance = if fraction >= self.to {
                    rail.end
                } else {
                    rail.start + (fraction - self.from) * rail.pace
                };
                let (u, near) = rail.spline.seek(rail.index, distance, near.near);
                let [constant, linear, square] = rail.derivative;
                let leading = constant + u * (linear + u * square);
                Whereabouts {
                    position: rail.piece.point(u),
                    velocity: (rail.pace / leading.length()) * leading,
                    milestone: Milestone { distance, u, near },
                }
            }
        }
    }

    /// How the velocity changes in a frame where it was looked up; not finite in a cusp.
    #[inline]
    pub(crate) fn acceleration(&self, at: &Milestone) -> DVec3 {
        let Way::Curve(rail) = &self.way else {
            return DVec3::ZERO;
        };
        let [constant, linear, square] = rail.derivative;
        let first = constant + at.u * (linear + at.u * square);
        let second = linear + (2.0 * at.u) * square;
        let per_square = 1.0 / first.length_squared();
        let bend = second - (first.dot(second) * per_square) * first;
        (rail.pace * rail.pace * per_square) * bend
    }

    /// For how long the way may be followed from a place on so that its fourth derivative by time times that
    /// time's fourth power is no more than `root` is to the fourth; and the most of that derivative.
    #[inline]
    pub(crate) fn smooth_time(&self, from: &Milestone, root: f64) -> (f64, f64) {
        let Way::Curve(rail) = &self.way else {
            return (f64::INFINITY, 0.0);
        };
        let place = (from.near, from.distance);
        let (way, smooth) = (rail.spline).smooth_way(rail.index, place, rail.pace > 0.0, root);
        let speed = rail.pace.abs();
        let rate = speed / smooth;
        (way / speed, (rate * rate) * (rate * rate))
    }
}
