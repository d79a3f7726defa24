//! Turning with the path.

use crate::error::MotionError;
use crate::math::frame::orthonormal;
use crate::motion::spin::unit;
use glam::{DMat3, DQuat, DVec3};

/// How a body that is turned along its path stands: see [`Motion::facing`](crate::Motion::facing).
///
/// Vectors need not be of unit length, nor `up` perpendicular to `forward`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Facing {
    /// Which way the body looks, in its own frame: this leads along the path's tangent.
    pub forward: DVec3,
    /// Which side of the body is up, in its own frame; not along `forward`.
    pub up: DVec3,
    /// Which way is up in the world: there `up` leads as nearly as `forward` allows.
    pub world_up: DVec3,
}

/// A [`Facing`] that was checked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Attitude {
    facing: Facing,
    /// Of the world, of unit length.
    up: DVec3,
    /// From the body's own frame to (forward, left, up).
    upright: DQuat,
}

/// Least sine of the angle between two axes that say more than their rounding.
const MIN_SINE: f64 = 1e-6;

/// Sine of the angle between tangent and up at which there is no telling left from right.
const VERTICAL: f64 = 1e-12;

impl Attitude {
    pub(super) fn new(facing: Facing) -> Result<Self, MotionError> {
        let forward = unit("facing.forward", facing.forward)?;
        let up = unit("facing.up", facing.up)?;
        let world_up = unit("facing.world_up", facing.world_up)?;
        let sine = forward.cross(up).length();
        if sine < MIN_SINE {
            return Err(MotionError::Parallel {
                a: "facing.forward",
                b: "facing.up",
                sine,
                min: MIN_SINE,
            });
        }
        Ok(Self {
            facing,
            up: world_up,
            upright: frame(forward, up).conjugate(),
        })
    }

    #[cfg(feature = "serde")]
    pub(super) fn facing(&self) -> &Facing {
        &self.facing
    }

    /// The orientation of a body whose path has the unit tangent `tangent`.
    pub(super) fn along(&self, tangent: DVec3) -> DQuat {
        (frame(tangent, self.up) * self.upright).normalize()
    }

    pub(super) fn world_up(&self) -> DVec3 {
        self.up
    }
}

/// The rotation from (x, y, z) to `forward`, left, and `up` but for its share along `forward`.
///
/// Where both are parallel left is arbitrary, but always the same.
fn frame(forward: DVec3, up: DVec3) -> DQuat {
    let left = up.cross(forward);
    let length = left.length();
    let left = if length > VERTICAL {
        left / length
    } else {
        orthonormal(forward).0
    };
    DQuat::from_mat3(&DMat3::from_cols(forward, left, forward.cross(left))).normalize()
}
