//! The motion of one body in one frame.

use crate::motion::Motion;
use crate::motion::kind::Kind;
use glam::DVec3;

/// What a body does during one frame; fractions of the frame run over `0..=1`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FrameMotion {
    /// Seconds of its motion behind the body as the frame begins.
    elapsed: f64,
    /// Length of the frame in seconds.
    duration: f64,
    /// Where the body is as the frame begins.
    pub(crate) start: DVec3,
    /// From where it starts to where it is as the frame ends.
    pub(crate) displacement: DVec3,
    /// How far it strays at most from the straight and even motion along `displacement`.
    pub(crate) deviation: f64,
    /// Fraction from which it rests because its path has ended; 1 or more if it has not.
    pub(crate) rests_from: f64,
    /// Whether it follows a curve before it rests.
    pub(crate) curved: bool,
}

impl FrameMotion {
    pub(crate) fn new(motion: &Motion, elapsed: f64, duration: f64) -> Self {
        let mut frame = Self {
            elapsed,
            duration,
            start: motion.position_after(elapsed),
            displacement: DVec3::ZERO,
            deviation: 0.0,
            rests_from: f64::INFINITY,
            curved: false,
        };
        if let Kind::Along { path, speed } = motion.kind() {
            let left = (path.length() - speed * elapsed).max(0.0);
            // A frame too short for the clock to move on lasts 0 s.
            frame.rests_from = if left > 0.0 {
                left / (speed * duration)
            } else {
                0.0
            };
            frame.curved = !path.is_straight() && left > 0.0;
        }
        frame.displacement = frame.displacement_between(motion, 0.0, 1.0);
        frame.deviation = frame.deviation_from(motion, frame.displacement, 0.0, 1.0);
        frame
    }

    /// Where the body is at `fraction`.
    pub(crate) fn position_at(&self, motion: &Motion, fraction: f64) -> DVec3 {
        if self.curved {
            motion.position_after(self.elapsed + fraction * self.duration)
        } else {
            self.start + self.displacement_between(motion, 0.0, fraction)
        }
    }

    /// From where the body is at fraction `from` to where it is at fraction `to`.
    pub(crate) fn displacement_between(&self, motion: &Motion, from: f64, to: f64) -> DVec3 {
        // Straight motions multiply velocity by time instead of subtracting
        // positions: far from the origin, the difference of two positions would
        // have lost most of a short displacement.
        match motion.kind() {
            Kind::Fixed { .. } => DVec3::ZERO,
            Kind::Free { velocity, .. } => ((to - from) * self.duration) * *velocity,
            Kind::Along { path, speed } if path.is_straight() => {
                let moving = to.min(self.rests_from) - from.min(self.rests_from);
                (moving * self.duration * speed) * path.tangent_at(0.0)
            }
            Kind::Along { path, speed } => {
                let distance = |fraction: f64| speed * (self.elapsed + fraction * self.duration);
                path.position_at(distance(to)) - path.position_at(distance(from))
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
    /// the sagitta.
    pub(crate) fn deviation_from(&self, motion: &Motion, chord: DVec3, from: f64, to: f64) -> f64 {
        let Kind::Along { path, speed } = motion.kind() else {
            return 0.0;
        };
        let moving = to.min(self.rests_from) - from.min(self.rests_from);
        let arc = moving * self.duration * speed;
        if to > self.rests_from {
            // Partly at rest. A straight path is ahead of even motion, most of
            // all where it ends; a curve no farther from the chord than its length.
            let share = if path.is_straight() {
                (to - self.rests_from) / (to - from)
            } else {
                1.0
            };
            return if arc > 0.0 { arc * share } else { 0.0 };
        }
        if path.is_straight() {
            return 0.0;
        }
        let chord = chord.length();
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
        let Kind::Along { path, speed } = motion.kind() else {
            return 0.0;
        };
        if path.is_straight() {
            return 0.0;
        }
        let distance = speed * (self.elapsed + from * self.duration);
        let tangent = path.position_at(distance + REACH) - path.position_at(distance - REACH);
        let chord = self.displacement_between(motion, from, to);
        if tangent.length_squared() > 0.0 && chord.length_squared() > 0.0 {
            tangent.angle_between(chord)
        } else {
            0.0
        }
    }
}
