//! Bodies.

use crate::error::{BodyError, ValueError};
use crate::geometry::{Pose, Shape};
use crate::motion::{Motion, Turning};
use crate::world::Groups;
use glam::{DQuat, DVec3};

/// A shape that stands or moves in a world.
///
/// ```
/// use feeler::{Body, Cuboid, Motion, Sphere};
/// use glam::DQuat;
///
/// let wall = Body::fixed(Cuboid::new([5.0, 0.1, 3.0])?, [0.0, 0.0, 0.0])
///     .oriented(DQuat::from_rotation_z(0.3));
/// let ball = Body::moving(Sphere::new(0.2)?, Motion::free([0.0, 4.0, 0.0], [0.0, -3.0, 0.0])?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "crate::world::data::BodyData",
        into = "crate::world::data::BodyData"
    )
)]
pub struct Body {
    pub(crate) shape: Shape,
    pub(crate) orientation: DQuat,
    pub(crate) motion: Motion,
    pub(crate) groups: Groups,
}

impl Body {
    /// A body that stands at `position` (in metres).
    ///
    /// The position is checked when the body is inserted into a world.
    #[must_use]
    pub fn fixed(shape: impl Into<Shape>, position: impl Into<DVec3>) -> Self {
        Self::moving(shape, Motion::fixed_unchecked(position.into()))
    }

    /// A body that moves.
    #[must_use]
    pub fn moving(shape: impl Into<Shape>, motion: Motion) -> Self {
        Self {
            shape: shape.into(),
            orientation: DQuat::IDENTITY,
            motion,
            groups: Groups::ALL,
        }
    }

    /// The body turned to `orientation`, a quaternion of unit length, as its motion begins.
    ///
    /// It is checked when the body is inserted into a world.
    #[must_use]
    pub fn oriented(self, orientation: DQuat) -> Self {
        Self {
            orientation,
            ..self
        }
    }

    /// The body as a member of `groups`; it meets only bodies of those it names.
    #[must_use]
    pub fn in_groups(self, groups: Groups) -> Self {
        Self { groups, ..self }
    }

    /// The groups that the body belongs to and meets.
    #[must_use]
    pub fn groups(&self) -> Groups {
        self.groups
    }

    /// The body's shape.
    #[must_use]
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// The body's orientation as its motion begins.
    #[must_use]
    pub fn orientation(&self) -> DQuat {
        self.orientation
    }

    /// The body's motion.
    #[must_use]
    pub fn motion(&self) -> &Motion {
        &self.motion
    }

    /// Where the body is, and how it is turned, after `elapsed` seconds of its motion.
    #[must_use]
    pub fn pose_after(&self, elapsed: f64) -> Pose {
        self.motion.pose_after(elapsed, self.orientation)
    }

    /// A sphere that follows the body's motion without turning, and holds the body
    /// however that is turned meanwhile: from the motion's position to its
    /// centre, and its radius.
    ///
    /// A body that spins keeps its distance to every point of its axis, so
    /// the sphere is that around the axis's point nearest to the middle of the
    /// body. One that faces its way keeps only its origin where it is.
    pub(crate) fn hub(&self) -> (DVec3, f64) {
        self.hub_turned(self.orientation)
    }

    /// The same of the body turned by another orientation.
    #[inline]
    pub(crate) fn hub_turned(&self, orientation: DQuat) -> (DVec3, f64) {
        let (centre, radius) = (self.shape.centre(), self.shape.max_dist());
        // Turning things rounds them by a few ulp of their size.
        let grown = |radius: f64, size: f64| radius + 16.0 * f64::EPSILON * (radius + size);
        match self.motion.turning() {
            // Balls and most boxes are centred: nothing need be turned.
            Turning::Not if centre == DVec3::ZERO => (centre, radius),
            Turning::Not => (orientation * centre, radius),
            Turning::Spin(spin) => {
                let point = orientation * spin.point();
                let arm = orientation * (centre - spin.point());
                let along = arm.dot(spin.axis()) * spin.axis();
                let reach = radius + (arm - along).length();
                let size = spin.point().length() + centre.length();
                (point + along, grown(reach, size))
            }
            Turning::Facing(_) => (DVec3::ZERO, grown(radius + centre.length(), 0.0)),
        }
    }

    /// The body, if all that was left unchecked is in order.
    pub(crate) fn checked(mut self) -> Result<Self, BodyError> {
        self.orientation = self.check()?;
        Ok(self)
    }

    /// What [`checked`](Self::checked) checks; its orientation at unit length.
    #[inline]
    pub(crate) fn check(&self) -> Result<DQuat, BodyError> {
        /// How far a quaternion may be from unit length. Products of many
        /// rotations drift by an ulp each, even in `f32` below this.
        const DRIFT: f64 = 1e-3;
        self.motion.check()?;
        if self.orientation == DQuat::IDENTITY {
            return Ok(self.orientation);
        }
        let length = self.orientation.length();
        let field = "orientation.length";
        if !length.is_finite() {
            return Err(ValueError::NotFinite {
                field,
                value: length,
            }
            .into());
        }
        if length < 1.0 - DRIFT {
            return Err(ValueError::TooSmall {
                field,
                value: length,
                min: 1.0 - DRIFT,
            }
            .into());
        }
        if length > 1.0 + DRIFT {
            return Err(ValueError::TooLarge {
                field,
                value: length,
                max: 1.0 + DRIFT,
            }
            .into());
        }
        Ok(self.orientation.normalize())
    }
}
