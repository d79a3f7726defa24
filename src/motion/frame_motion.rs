//! The motion of one body in one frame.

use crate::curve::Near;
use crate::geometry::Pose;
use crate::motion::journey::{Journey, Waypoint};
use crate::motion::kind::Kind;
use crate::motion::spin;
use crate::motion::{AtEnd, Motion, Turning};
use glam::{DQuat, DVec3};

/// What a body does during one frame; fractions of the frame run over `0..=1`.
///
/// Positions and displacements are those of the carried point (see
/// [`Motion::position_after`]); [`pose_at`](Self::pose_at) alone knows how the
/// body is turned. Everything counts from the frame's start, with the distance
/// flown till then reduced to one lap and the angle to one turn: within a frame an
/// hour's flight behind it costs no digits.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FrameMotion {
    /// Length of the frame in seconds.
    pub(super) duration: f64,
    /// Distance flown as the frame begins, less whole laps.
    pub(super) flown: f64,
    /// How the body has been turned by its spin as the frame begins.
    turned: DQuat,
    /// Where the body is as the frame begins.
    pub(crate) start: DVec3,
    /// From where it starts to where it is as the frame ends.
    pub(crate) displacement: DVec3,
    /// Of a curve that is followed all through the frame, where it ends.
    end: Option<End>,
    /// Of a curve, where it begins.
    pub(super) near: Near,
    /// How far it strays at most from the straight and even motion along `displacement`.
    pub(crate) deviation: f64,
    /// Fraction up to which it rests because it has not set out; 0 if it has.
    pub(super) rests_until: f64,
    /// Fraction from which it rests because its path has ended; 1 or more if it has not.
    pub(super) rests_from: f64,
    /// Whether it follows a curve before it rests.
    pub(crate) curved: bool,
}

/// Where a frame on a curve ends.
#[derive(Debug, Clone, Copy)]
struct End {
    /// Seconds of the motion by then, which tell it from others that came later.
    elapsed: f64,
    /// As by the clock: to the bit what the next frame counts from.
    flown: f64,
    position: DVec3,
    near: Near,
}

impl FrameMotion {
    pub(crate) fn new(motion: &Motion, elapsed: f64, duration: f64) -> Self {
        let Some((start, displacement)) = motion.flight(elapsed, duration) else {
            return Self::begin(motion, elapsed, duration, None);
        };
        Self {
            start,
            displacement,
            ..Self::still(motion, elapsed, duration)
        }
    }

    /// Of a body that stays where it is, which is not yet known.
    #[inline]
    fn still(motion: &Motion, elapsed: f64, duration: f64) -> Self {
        Self {
            duration,
            flown: 0.0,
            turned: match motion.turning() {
                Turning::Spin(spin) => spin.rotation_after(elapsed),
                Turning::Not | Turning::Facing(_) => DQuat::IDENTITY,
            },
            start: DVec3::ZERO,
            displacement: DVec3::ZERO,
            end: None,
            near: Near::default(),
            deviation: 0.0,
            rests_until: 0.0,
            rests_from: f64::INFINITY,
            curved: false,
        }
    }

    /// What [`new`](Self::new) makes, to the bit: the next frame of the same motion, or the first one of another.
    ///
    /// Where the new frame begins as this one ends, only its end need be looked up, and that near by.
    pub(crate) fn renewed(&self, motion: &Motion, elapsed: f64, duration: f64) -> Self {
        Self::begin(motion, elapsed, duration, self.end)
    }

    fn begin(motion: &Motion, elapsed: f64, duration: f64, last: Option<End>) -> Self {
        let mut frame = Self {
            near: last.map_or(Near::default(), |last| last.near),
            ..Self::still(motion, elapsed, duration)
        };
        if let Kind::Along(journey) = motion.kind() {
            frame.flown = journey.flown_after(elapsed);
            let wait = journey.start_time - elapsed;
            if wait > 0.0 {
                // A frame too short for the clock to move on lasts 0 s. Any
                // fraction above 1 will do for a later frame.
                frame.rests_until = (wait / duration).clamp(f64::MIN_POSITIVE, 2.0);
            }
            if journey.is_over(frame.flown) {
                frame.rests_from = 0.0;
            } else {
                if journey.at_end == AtEnd::Rest {
                    let left = journey.path.length() - frame.flown;
                    frame.rests_from = frame.rests_until + left / (journey.speed * duration);
                }
                frame.curved = !journey.path.is_straight();
            }
            if let Some(spline) = journey.path.as_spline()
                && frame.curved
            {
                let look = |flown: f64, near: Near| {
                    let waypoint = journey.waypoint(flown);
                    let ((piece, u), near) = spline.locate_near(waypoint.distance, near);
                    (spline.pieces()[piece].point(u), near)
                };
                (frame.start, frame.near) = match last {
                    Some(last)
                        if elapsed > 0.0
                            && last.elapsed.to_bits() == elapsed.to_bits()
                            && last.flown.to_bits() == frame.flown.to_bits() =>
                    {
                        (last.position, last.near)
                    }
                    _ => look(frame.flown, frame.near),
                };
                let goes_on = frame.rests_until <= 0.0 && frame.rests_from >= 1.0;
                if goes_on {
                    let flown = journey.flown_after(elapsed + duration);
                    let (position, near) = look(flown, frame.near);
                    frame.displacement = position - frame.start;
                    frame.end = Some(End {
                        elapsed: elapsed + duration,
                        flown,
                        position,
                        near,
                    });
                }
            }
        }
        if !frame.curved {
            frame.start = motion.position_after(elapsed);
        }
        if frame.end.is_none() {
            frame.displacement = frame.displacement_between(motion, 0.0, 1.0);
        }
        frame.deviation = frame.deviation_from(motion, frame.displacement, 0.0, 1.0);
        frame
    }

    /// Length of the frame in seconds.
    pub(crate) fn seconds(&self) -> f64 {
        self.duration
    }

    /// Whether it neither sets out nor stops meanwhile, nor turns round.
    pub(crate) fn is_even(&self) -> bool {
        self.deviation <= 0.0
    }

    /// Seconds of flight between two fractions, rests left out.
    pub(super) fn flying(&self, from: f64, to: f64) -> f64 {
        let within = |fraction: f64| fraction.max(self.rests_until).min(self.rests_from);
        (within(to) - within(from)) * self.duration
    }

    /// Distance flown at `fraction`.
    pub(super) fn flown_at(&self, journey: &Journey, fraction: f64) -> f64 {
        if fraction >= self.rests_from {
            // To the bit.
            return self.flown.max(journey.path.length());
        }
        self.flown + journey.speed * self.flying(0.0, fraction)
    }

    /// The unit tangent of the path where the body is at `fraction`.
    pub(super) fn tangent_at(&self, journey: &Journey, fraction: f64) -> DVec3 {
        let waypoint = self.waypoint(journey, fraction);
        journey.path.tangent_at(waypoint.distance)
    }

    fn waypoint(&self, journey: &Journey, fraction: f64) -> Waypoint {
        journey.waypoint(self.flown_at(journey, fraction))
    }

    /// Where the body is at `fraction`.
    pub(crate) fn position_at(&self, motion: &Motion, fraction: f64) -> DVec3 {
        match motion.kind() {
            _ if fraction <= 0.0 => self.start,
            Kind::Along(journey) if self.curved => {
                let distance = self.waypoint(journey, fraction).distance;
                match journey.path.as_spline() {
                    Some(spline) => spline.position_near(distance, self.near),
                    None => journey.path.position_at(distance),
                }
            }
            _ => self.start + self.displacement_between(motion, 0.0, fraction),
        }
    }

    /// Where a body is at `fraction`, and how it is turned, that was turned by
    /// `orientation` as its motion began.
    pub(crate) fn pose_at(&self, motion: &Motion, orientation: DQuat, fraction: f64) -> Pose {
        self.turned_at(
            motion,
            orientation,
            fraction,
            self.position_at(motion, fraction),
        )
    }

    /// The pose of a body that its motion has carried to `position` at `fraction`.
    #[inline]
    pub(crate) fn turned_at(
        &self,
        motion: &Motion,
        orientation: DQuat,
        fraction: f64,
        position: DVec3,
    ) -> Pose {
        let turned = match (motion.turning(), motion.kind()) {
            (Turning::Spin(spin), _) => {
                let angle = spin.rate() * (fraction * self.duration);
                spin::about(spin.axis(), angle) * self.turned
            }
            (Turning::Facing(attitude), Kind::Along(journey)) => {
                attitude.along(self.tangent_at(journey, fraction))
            }
            (Turning::Not | Turning::Facing(_), _) => DQuat::IDENTITY,
        };
        motion.posed(position, turned, orientation)
    }

    /// From where the body is at fraction `from` to where it is at fraction `to`.
    pub(crate) fn displacement_between(&self, motion: &Motion, from: f64, to: f64) -> DVec3 {
        // Straight motions multiply velocity by time instead of subtracting
        // positions: far from the origin, the difference of two positions would
        // have lost most of a short displacement.
        match motion.kind() {
            Kind::Fixed { .. } => DVec3::ZERO,
            Kind::Free { velocity, .. } => ((to - from) * self.duration) * *velocity,
            // One way, and then rest: no laps to be looked at.
            Kind::Along(journey) if journey.path.is_straight() && journey.at_end == AtEnd::Rest => {
                (journey.speed * self.flying(from, to)) * journey.path.tangent_at(0.0)
            }
            Kind::Along(journey) if journey.path.is_straight() => {
                let [start, end] = [from, to].map(|fraction| self.flown_at(journey, fraction));
                let way = if self.end_after(journey, from).0 >= to {
                    let (_, forward) = journey.lap(start, end);
                    let sense = if forward { 1.0 } else { -1.0 };
                    sense * journey.speed * self.flying(from, to)
                } else {
                    journey.waypoint(end).distance - journey.waypoint(start).distance
                };
                way * journey.path.tangent_at(0.0)
            }
            Kind::Along(journey) => {
                let position = |fraction: f64| {
                    if fraction <= 0.0 {
                        return self.start;
                    }
                    let waypoint = self.waypoint(journey, fraction);
                    journey.path.position_at(waypoint.distance)
                };
                position(to) - position(from)
            }
        }
    }

    /// How far the body strays between two fractions from the straight and even
    /// motion along the `chord` between them.
    ///
    /// For a curve run at constant speed this needs no knowledge of the curve
    /// but the arc's length `s` and the chord's `c`: at a share `λ` of the arc
    /// the body is at most `λs` from one end and `(1−λ)s` from the other, and
    /// by Stewart's theorem at most `√(λ(1−λ)(s² − c²)) ≤ ½√(s² − c²)` from
    /// where it would be on the chord. For short arcs that is 15 % more than
    /// the sagitta. Corners, laps and turning round change nothing in that.
    pub(crate) fn deviation_from(&self, motion: &Motion, chord: DVec3, from: f64, to: f64) -> f64 {
        let Kind::Along(journey) = motion.kind() else {
            return 0.0;
        };
        let arc = journey.speed * self.flying(from, to);
        if arc <= 0.0 {
            return 0.0;
        }
        // Up to its very end a path is one way.
        let one_way = || journey.at_end == AtEnd::Rest || self.end_after(journey, from).0 >= to;
        let straight = journey.path.is_straight() && one_way();
        if from < self.rests_until || to > self.rests_from {
            // Partly at rest. A straight path is ahead of or behind even
            // motion, most of all where it begins or ends; a curve no farther
            // from the chord than its length.
            let late = (self.rests_until - from).max(0.0);
            let early = (to - self.rests_from).max(0.0);
            return if straight {
                arc * (late.max(early) / (to - from))
            } else {
                arc
            };
        }
        if straight {
            return 0.0;
        }
        // Distances along the path and its points are rounded, and of a short arc far
        // from the origin that may be all of the difference.
        let coordinate = self.start.abs().max_element() + arc + journey.path.length();
        let chord = (chord.length() - 4.0 * f64::EPSILON * coordinate).max(0.0);
        // The few ulp cover the rounding of both lengths where they nearly agree.
        0.5 * (((arc - chord) * (arc + chord)).max(0.0) + 4.0 * f64::EPSILON * arc * arc).sqrt()
    }

    /// Angle between the tangent at fraction `from` and the chord up to `to`, in
    /// radians; 0 for straight motions and where the body rests.
    ///
    /// The tangent is estimated as in the thesis (§3.11), from the path a little
    /// before and after.
    pub(crate) fn turn_between(&self, motion: &Motion, from: f64, to: f64) -> f64 {
        /// Metres before and after; the thesis's value.
        const REACH: f64 = 0.01;
        let Kind::Along(journey) = motion.kind() else {
            return 0.0;
        };
        if journey.path.is_straight() {
            return 0.0;
        }
        let Waypoint { distance, forward } = self.waypoint(journey, from);
        let path = &journey.path;
        let way = path.position_at(distance + REACH) - path.position_at(distance - REACH);
        let tangent = if forward { way } else { -way };
        let chord = self.displacement_between(motion, from, to);
        if tangent.length_squared() > 0.0 && chord.length_squared() > 0.0 {
            tangent.angle_between(chord)
        } else {
            0.0
        }
    }

    /// The next fraction after `from` at which the motion is not smooth, as far as
    /// chords are concerned: where it sets out, turns round or rests; 1 if
    /// there is none.
    pub(crate) fn next_break(&self, motion: &Motion, from: f64) -> f64 {
        let Kind::Along(journey) = motion.kind() else {
            return 1.0;
        };
        if from < self.rests_until {
            return self.rests_until.min(1.0);
        }
        if from >= self.rests_from {
            return 1.0;
        }
        let next = match journey.at_end {
            AtEnd::Rest => self.rests_from,
            AtEnd::Loop | AtEnd::Return => self.end_after(journey, from).0.min(self.rests_from),
        };
        // NaN, of a frame without length, counts as none.
        if next > from { next.min(1.0) } else { 1.0 }
    }

    /// The fraction at which the body next reaches an end of its path, after `from`,
    /// and the distance flown by then; infinite if it does not.
    ///
    /// An end that lies at `from` itself has been passed, whatever side of it
    /// rounding puts the distance flown.
    pub(super) fn end_after(&self, journey: &Journey, from: f64) -> (f64, f64) {
        let fraction =
            |end: f64| self.rests_until + (end - self.flown) / (journey.speed * self.duration);
        let end = journey.next_end(self.flown_at(journey, from));
        if fraction(end) > from {
            return (fraction(end), end);
        }
        let end = journey.next_end(end);
        (fraction(end), end)
    }
}
