//! The motion of a body over all time.

use crate::error::MotionError;
use crate::geometry::Pose;
use crate::math::domain;
use crate::motion::facing::Attitude;
use crate::motion::journey::Journey;
use crate::motion::{AtEnd, Facing, Path, Spin, Turning};
use crate::tolerance::{MAX_COORDINATE, MAX_SPEED};
use glam::{DQuat, DVec3};

/// How a body moves from the moment it is given this motion.
///
/// A body keeps its orientation while it moves, unless it is told to
/// [`spin`](Self::spin) or to [face its way](Self::facing).
///
/// ```
/// use feeler::{Motion, MotionError, Path};
/// use glam::DVec3;
///
/// let path = Path::line([0.0, 0.0, 0.0], [4.0, 0.0, 0.0])?;
/// let motion = Motion::along(path.clone(), 2.0)?;
/// assert_eq!(motion.position_after(1.0), DVec3::new(2.0, 0.0, 0.0));
/// // At the end of its path the body rests, unless it turns round there.
/// assert_eq!(motion.position_after(9.0), DVec3::new(4.0, 0.0, 0.0));
/// assert_eq!(motion.velocity_after(9.0), DVec3::ZERO);
/// let shuttle = motion.back_and_forth()?.starting_after(1.0)?;
/// assert_eq!(shuttle.position_after(4.0), DVec3::new(2.0, 0.0, 0.0));
///
/// assert!(matches!(Motion::along(path, -1.0), Err(MotionError::Value(_))));
/// // A line does not end where it begins.
/// assert!(matches!(shuttle.looping(), Err(MotionError::OpenLoop { .. })));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "crate::motion::data::MotionData",
        into = "crate::motion::data::MotionData"
    )
)]
pub struct Motion {
    kind: Kind,
    turning: Turning,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Kind {
    Fixed { position: DVec3 },
    Along(Journey),
    Free { position: DVec3, velocity: DVec3 },
}

impl Motion {
    fn unturned(kind: Kind) -> Self {
        Self {
            kind,
            turning: Turning::Not,
        }
    }

    /// Stays at `position` (in metres).
    ///
    /// # Errors
    /// If a coordinate is not finite or beyond [`MAX_COORDINATE`].
    pub fn fixed(position: impl Into<DVec3>) -> Result<Self, MotionError> {
        Self::fixed_unchecked(position.into()).checked()
    }

    /// Follows `path` at a constant `speed` (in metres per second) and rests at its end.
    ///
    /// # Errors
    /// If `speed` is not finite or not within
    /// [`MIN_SPEED`](crate::tolerance::MIN_SPEED)`..=`[`MAX_SPEED`].
    pub fn along(path: Path, speed: f64) -> Result<Self, MotionError> {
        Self::unturned(Kind::Along(Journey::new(path, speed))).checked()
    }

    /// Flies from `position` (in metres) at a constant `velocity` (in metres per
    /// second; may be zero) without end.
    ///
    /// This is the motion for callers who compute the velocity themselves and
    /// set it anew whenever it changes.
    ///
    /// # Errors
    /// If a coordinate is not finite or beyond [`MAX_COORDINATE`], or a
    /// component of the velocity not finite or beyond [`MAX_SPEED`].
    pub fn free(
        position: impl Into<DVec3>,
        velocity: impl Into<DVec3>,
    ) -> Result<Self, MotionError> {
        let kind = Kind::Free {
            position: position.into(),
            velocity: velocity.into(),
        };
        Self::unturned(kind).checked()
    }

    /// The motion with another end: see [`AtEnd`].
    ///
    /// # Errors
    /// If it follows no path, or if it is to loop on a path that does not end
    /// where it begins, but for rounding in the coordinates.
    pub fn at_end(self, at_end: AtEnd) -> Result<Self, MotionError> {
        self.on_journey("what happens at its end", |journey| journey.at_end = at_end)
    }

    /// Begins its path anew at its end: [`AtEnd::Loop`].
    ///
    /// Where the path leaves its start in another direction than it comes in, the
    /// body flies round a corner.
    ///
    /// # Errors
    /// As [`at_end`](Self::at_end).
    pub fn looping(self) -> Result<Self, MotionError> {
        self.at_end(AtEnd::Loop)
    }

    /// Turns round at both ends of its path: [`AtEnd::Return`].
    ///
    /// # Errors
    /// As [`at_end`](Self::at_end).
    pub fn back_and_forth(self) -> Result<Self, MotionError> {
        self.at_end(AtEnd::Return)
    }

    /// Has flown `distance` metres of its path as it begins.
    ///
    /// On a loop, or to and fro, this may be many lengths of the path. Who has
    /// flown more than a path without either is at its end.
    ///
    /// # Errors
    /// If it follows no path, or if `distance` is not finite, negative or above
    /// [`MAX_DISTANCE`](crate::tolerance::MAX_DISTANCE).
    pub fn starting_at(self, distance: f64) -> Result<Self, MotionError> {
        self.on_journey("a start distance", |journey| {
            journey.start_distance = distance;
        })
    }

    /// Rests for `time` seconds before it sets out on its path.
    ///
    /// A [`spin`](Self::spin) does not wait.
    ///
    /// # Errors
    /// If it follows no path, or if `time` is not finite, negative or above
    /// [`MAX_TIME_STEP`](crate::tolerance::MAX_TIME_STEP).
    pub fn starting_after(self, time: f64) -> Result<Self, MotionError> {
        self.on_journey("a start time", |journey| journey.start_time = time)
    }

    /// Turns about a fixed `axis` of the world through the body's origin, at
    /// `rate` radians per second: [`spin_about`](Self::spin_about) the origin.
    ///
    /// ```
    /// use feeler::{Motion, MotionError};
    /// use glam::{DQuat, DVec3};
    /// use std::f64::consts::PI;
    ///
    /// let rotor = Motion::fixed([0.0, 0.0, 2.0])?.spin([0.0, 0.0, 1.0], PI)?;
    /// let pose = rotor.pose_after(0.5, DQuat::IDENTITY);
    /// assert!((pose.point(DVec3::X) - DVec3::new(0.0, 1.0, 2.0)).length() < 1e-15);
    ///
    /// assert!(rotor.clone().spin([0.0; 3], 1.0).is_err());
    /// assert!(rotor.spin([0.0, 0.0, 1.0], f64::INFINITY).is_err());
    /// # Ok::<(), MotionError>(())
    /// ```
    ///
    /// # Errors
    /// As [`spin_about`](Self::spin_about).
    pub fn spin(self, axis: impl Into<DVec3>, rate: f64) -> Result<Self, MotionError> {
        self.spin_about(DVec3::ZERO, axis, rate)
    }

    /// Turns about an `axis` through a `point` of the body, at `rate` radians per second.
    ///
    /// The axis is fixed in the world and need not be of unit length; seen
    /// against it, a positive rate turns counter-clockwise. The point is in
    /// the body's own frame. It moves as the body would without spin, and the
    /// rest of the body turns about it, from the moment the motion begins. So
    /// the body begins where its motion begins, oriented as it was; its origin,
    /// if it is not the point, leaves the path.
    ///
    /// However long it goes on, the orientation is that of the whole angle,
    /// exact to rounding in the time elapsed: it does not drift.
    ///
    /// Takes the place of any [`facing`](Self::facing).
    ///
    /// # Errors
    /// If a component is not finite or beyond
    /// [`MAX_LENGTH`](crate::tolerance::MAX_LENGTH), the axis shorter than
    /// [`MIN_LENGTH`](crate::tolerance::MIN_LENGTH), or the rate not finite or
    /// beyond [`MAX_SPIN`](crate::tolerance::MAX_SPIN) either way.
    pub fn spin_about(
        self,
        point: impl Into<DVec3>,
        axis: impl Into<DVec3>,
        rate: f64,
    ) -> Result<Self, MotionError> {
        let spin = Spin::new(point.into(), axis.into(), rate)?;
        Ok(Self {
            turning: Turning::Spin(spin),
            ..self
        })
    }

    /// Turns with the path: `forward` leads along its tangent, and `up` as nearly
    /// towards `world_up` as that allows.
    ///
    /// The body does not bank: seen along the path its `up` stays upright. Who
    /// wants it to lean gives an `up` that does. Its orientation follows from
    /// the path alone, and what the body was [oriented](crate::Body::oriented) to
    /// counts for nothing. On its way back along a path it flies backwards, like a
    /// shuttle. At rest it keeps the tangent of the path's start or end.
    ///
    /// Where tangents jump, so does the orientation: at corners and cusps,
    /// and where a path goes straight up, which turns the body about itself. There
    /// it is that of the tangent [`Path::tangent_at`] gives; with the tangent
    /// straight up (to 1e-12) its turn about the tangent is arbitrary, but always
    /// the same. For loops in a vertical plane take this plane's normal as up.
    ///
    /// Takes the place of any [`spin`](Self::spin).
    ///
    /// ```
    /// use feeler::{Facing, Motion, Path};
    /// use glam::{DQuat, DVec3};
    ///
    /// let path = Path::line([0.0, 0.0, 9.0], [0.0, 5.0, 9.0])?;
    /// let nose_first = Facing { forward: DVec3::X, up: DVec3::Z, world_up: DVec3::Z };
    /// let plane = Motion::along(path, 1.0)?.facing(nose_first)?;
    /// let pose = plane.pose_after(2.0, DQuat::IDENTITY);
    /// assert!((pose.direction(DVec3::X) - DVec3::Y).length() < 1e-15);
    ///
    /// assert!(plane.facing(Facing { up: DVec3::X, ..nose_first }).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If it follows no path, if a vector's component is not finite or its length
    /// not within
    /// [`MIN_LENGTH`](crate::tolerance::MIN_LENGTH)`..=`[`MAX_LENGTH`](crate::tolerance::MAX_LENGTH),
    /// or if `forward` and `up` are parallel.
    pub fn facing(self, facing: Facing) -> Result<Self, MotionError> {
        if !matches!(self.kind, Kind::Along(_)) {
            return Err(MotionError::NoPath {
                what: "facing its way",
            });
        }
        let turning = Turning::Facing(Attitude::new(facing)?);
        Ok(Self { turning, ..self })
    }

    /// The motion with its journey changed, if it has one and that is in order.
    fn on_journey(
        mut self,
        what: &'static str,
        change: impl FnOnce(&mut Journey),
    ) -> Result<Self, MotionError> {
        let Kind::Along(journey) = &mut self.kind else {
            return Err(MotionError::NoPath { what });
        };
        change(journey);
        self.checked()
    }

    /// Along `path` at one metre per second.
    pub(crate) fn at_unit_speed(path: Path) -> Self {
        Self::unturned(Kind::Along(Journey::new(path, 1.0)))
    }

    /// As [`fixed`](Self::fixed), for doors that check later.
    pub(crate) fn fixed_unchecked(position: DVec3) -> Self {
        Self::unturned(Kind::Fixed { position })
    }

    /// The motion, if all its numbers are within their domains.
    pub(crate) fn checked(self) -> Result<Self, MotionError> {
        self.check()?;
        Ok(self)
    }

    /// What [`checked`](Self::checked) checks.
    #[inline]
    pub(crate) fn check(&self) -> Result<(), MotionError> {
        match &self.kind {
            Kind::Fixed { position } => {
                domain::vector("position", *position, MAX_COORDINATE)?;
            }
            Kind::Along(journey) => journey.check()?,
            Kind::Free { position, velocity } => {
                domain::vector("position", *position, MAX_COORDINATE)?;
                domain::vector("velocity", *velocity, MAX_SPEED)?;
            }
        }
        // Turnings are checked when they are made.
        Ok(())
    }

    /// Whether the body never moves, nor turns.
    #[must_use]
    pub fn is_fixed(&self) -> bool {
        matches!(self.kind, Kind::Fixed { .. }) && !self.turns()
    }

    /// Whether the body flies freely, turning or not.
    #[must_use]
    pub fn is_free(&self) -> bool {
        matches!(self.kind, Kind::Free { .. })
    }

    /// Whether the body may be turned otherwise at one time than at another.
    pub(crate) fn turns(&self) -> bool {
        match &self.turning {
            Turning::Not => false,
            Turning::Spin(spin) => spin.rate() != 0.0,
            Turning::Facing(_) => true,
        }
    }

    /// The path followed, if there is one.
    #[must_use]
    pub fn path(&self) -> Option<&Path> {
        match &self.kind {
            Kind::Along(journey) => Some(&journey.path),
            Kind::Fixed { .. } | Kind::Free { .. } => None,
        }
    }

    /// How the body spins, if it does.
    #[must_use]
    pub fn spinning(&self) -> Option<&Spin> {
        match &self.turning {
            Turning::Spin(spin) => Some(spin),
            Turning::Not | Turning::Facing(_) => None,
        }
    }

    /// Where the body is after `elapsed` seconds of this motion.
    ///
    /// Of a body that spins about another point than its origin this is where
    /// its origin would be if it did not spin; see [`pose_after`](Self::pose_after).
    #[must_use]
    #[inline]
    pub fn position_after(&self, elapsed: f64) -> DVec3 {
        match &self.kind {
            Kind::Fixed { position } => *position,
            Kind::Along(journey) => {
                let waypoint = journey.waypoint(journey.flown_after(elapsed));
                journey.path.position_at(waypoint.distance)
            }
            Kind::Free { position, velocity } => *position + elapsed * *velocity,
        }
    }

    /// From where and by how much a body without a path moves in `duration` seconds, after
    /// `elapsed` of this motion.
    #[inline]
    pub(crate) fn flight(&self, elapsed: f64, duration: f64) -> Option<(DVec3, DVec3)> {
        match &self.kind {
            Kind::Fixed { position } => Some((*position, DVec3::ZERO)),
            Kind::Free { position, velocity } => {
                Some((*position + elapsed * *velocity, duration * *velocity))
            }
            Kind::Along(_) => None,
        }
    }

    /// Where the body is, and how it is turned, after `elapsed` seconds of this
    /// motion, if it was turned by `orientation` (of unit length) as it began.
    #[must_use]
    pub fn pose_after(&self, elapsed: f64, orientation: DQuat) -> Pose {
        let turned = match (&self.kind, &self.turning) {
            (_, Turning::Spin(spin)) => spin.rotation_after(elapsed),
            (Kind::Along(journey), Turning::Facing(attitude)) => {
                let waypoint = journey.waypoint(journey.flown_after(elapsed));
                attitude.along(journey.path.tangent_at(waypoint.distance))
            }
            (_, Turning::Not | Turning::Facing(_)) => DQuat::IDENTITY,
        };
        self.posed(self.position_after(elapsed), turned, orientation)
    }

    /// The pose of a body that was turned by `orientation` as it began, with its
    /// carried point at `position` and `turned` since.
    pub(super) fn posed(&self, position: DVec3, turned: DQuat, orientation: DQuat) -> Pose {
        match &self.turning {
            Turning::Not => Pose::new(position, orientation),
            Turning::Facing(_) => Pose::new(position, turned),
            Turning::Spin(spin) => {
                let now = (turned * orientation).normalize();
                if spin.point() == DVec3::ZERO {
                    return Pose::new(position, now);
                }
                let shift = orientation * spin.point() - now * spin.point();
                Pose::new(position + shift, now)
            }
        }
    }

    /// How fast the body moves, and whereto, after `elapsed` seconds of this
    /// motion, in metres per second: of a body that spins, how fast the point
    /// it spins about. Zero before it sets out and once it rests at the end of
    /// its path.
    #[must_use]
    pub fn velocity_after(&self, elapsed: f64) -> DVec3 {
        match &self.kind {
            Kind::Fixed { .. } => DVec3::ZERO,
            Kind::Along(journey) => {
                let flown = journey.flown_after(elapsed);
                if elapsed < journey.start_time || journey.is_over(flown) {
                    return DVec3::ZERO;
                }
                let waypoint = journey.waypoint(flown);
                let velocity = journey.speed * journey.path.tangent_at(waypoint.distance);
                if waypoint.forward {
                    velocity
                } else {
                    -velocity
                }
            }
            Kind::Free { velocity, .. } => *velocity,
        }
    }

    /// The highest speed of the carried point, in metres per second.
    pub(crate) fn top_speed(&self) -> f64 {
        match &self.kind {
            Kind::Fixed { .. } => 0.0,
            Kind::Along(journey) => journey.speed,
            Kind::Free { velocity, .. } => velocity.length(),
        }
    }

    /// The same turning about another course.
    ///
    /// A body that faced its way has none on the new one: it keeps the orientation it has.
    pub(crate) fn turning_as(self, other: &Self) -> Self {
        let turning = match other.turning {
            Turning::Spin(spin) => Turning::Spin(spin),
            Turning::Not | Turning::Facing(_) => Turning::Not,
        };
        Self { turning, ..self }
    }

    pub(crate) fn kind(&self) -> &Kind {
        &self.kind
    }

    pub(crate) fn turning(&self) -> &Turning {
        &self.turning
    }
}
