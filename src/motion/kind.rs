//! The motion of a body over all time.

use crate::error::MotionError;
use crate::math::domain;
use crate::motion::Path;
use crate::tolerance::{MAX_COORDINATE, MAX_SPEED, MIN_SPEED};
use glam::DVec3;

/// How a body moves from the moment it is given this motion.
///
/// A body keeps its orientation while it moves.
///
/// ```
/// use feeler::{Motion, MotionError, Path};
/// use glam::DVec3;
///
/// let path = Path::line([0.0, 0.0, 0.0], [4.0, 0.0, 0.0])?;
/// let motion = Motion::along(path.clone(), 2.0)?;
/// assert_eq!(motion.position_after(1.0), DVec3::new(2.0, 0.0, 0.0));
/// // At the end of its path the body rests.
/// assert_eq!(motion.position_after(9.0), DVec3::new(4.0, 0.0, 0.0));
/// assert_eq!(motion.velocity_after(9.0), DVec3::ZERO);
///
/// assert!(matches!(Motion::along(path, -1.0), Err(MotionError::Value(_))));
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
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Kind {
    Fixed { position: DVec3 },
    Along { path: Path, speed: f64 },
    Free { position: DVec3, velocity: DVec3 },
}

impl Motion {
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
    /// [`MIN_SPEED`]`..=`[`MAX_SPEED`].
    pub fn along(path: Path, speed: f64) -> Result<Self, MotionError> {
        Self {
            kind: Kind::Along { path, speed },
        }
        .checked()
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
        Self { kind }.checked()
    }

    /// As [`fixed`](Self::fixed), for doors that check later.
    pub(crate) fn fixed_unchecked(position: DVec3) -> Self {
        Self {
            kind: Kind::Fixed { position },
        }
    }

    /// The motion, if all its numbers are within their domains.
    pub(crate) fn checked(self) -> Result<Self, MotionError> {
        match &self.kind {
            Kind::Fixed { position } => {
                domain::vector("position", *position, MAX_COORDINATE)?;
            }
            Kind::Along { speed, .. } => {
                domain::within("speed", *speed, MIN_SPEED, MAX_SPEED)?;
            }
            Kind::Free { position, velocity } => {
                domain::vector("position", *position, MAX_COORDINATE)?;
                domain::vector("velocity", *velocity, MAX_SPEED)?;
            }
        }
        Ok(self)
    }

    /// Whether the body never moves.
    #[must_use]
    pub fn is_fixed(&self) -> bool {
        matches!(self.kind, Kind::Fixed { .. })
    }

    /// Whether the body flies freely.
    #[must_use]
    pub fn is_free(&self) -> bool {
        matches!(self.kind, Kind::Free { .. })
    }

    /// The path followed, if there is one.
    #[must_use]
    pub fn path(&self) -> Option<&Path> {
        match &self.kind {
            Kind::Along { path, .. } => Some(path),
            Kind::Fixed { .. } | Kind::Free { .. } => None,
        }
    }

    /// Where the body is after `elapsed` seconds of this motion.
    #[must_use]
    pub fn position_after(&self, elapsed: f64) -> DVec3 {
        match &self.kind {
            Kind::Fixed { position } => *position,
            Kind::Along { path, speed } => path.position_at(speed * elapsed),
            Kind::Free { position, velocity } => *position + elapsed * *velocity,
        }
    }

    /// How fast the body moves, and whereto, after `elapsed` seconds of this
    /// motion, in metres per second. Zero once it rests at the end of its path.
    #[must_use]
    pub fn velocity_after(&self, elapsed: f64) -> DVec3 {
        match &self.kind {
            Kind::Fixed { .. } => DVec3::ZERO,
            Kind::Along { path, speed } if speed * elapsed < path.length() => {
                *speed * path.tangent_at(speed * elapsed)
            }
            Kind::Along { .. } => DVec3::ZERO,
            Kind::Free { velocity, .. } => *velocity,
        }
    }

    pub(crate) fn kind(&self) -> &Kind {
        &self.kind
    }
}
