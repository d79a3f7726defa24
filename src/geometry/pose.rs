//! Position and orientation.

use glam::{DQuat, DVec3};

/// Where a shape stands: first turned, then shifted.
///
/// ```
/// use feeler::Pose;
/// use glam::{DQuat, DVec3};
///
/// let pose = Pose::new([1.0, 0.0, 0.0], DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2));
/// let point = pose.point(DVec3::X);
/// assert!((point - DVec3::new(1.0, 1.0, 0.0)).length() < 1e-15);
/// assert!((pose.local_point(point) - DVec3::X).length() < 1e-15);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Where the shape's own origin lies in the world, in metres.
    pub position: DVec3,
    /// How the shape is turned; of unit length.
    pub orientation: DQuat,
}

impl Pose {
    /// At the world's origin, not turned.
    pub const IDENTITY: Self = Self {
        position: DVec3::ZERO,
        orientation: DQuat::IDENTITY,
    };

    /// At `position`, turned by `orientation` (which should be of unit length).
    #[must_use]
    pub fn new(position: impl Into<DVec3>, orientation: DQuat) -> Self {
        Self {
            position: position.into(),
            orientation,
        }
    }

    /// At `position`, not turned.
    #[must_use]
    pub fn at(position: impl Into<DVec3>) -> Self {
        Self::new(position, DQuat::IDENTITY)
    }

    /// The world's point for a point of the shape's frame.
    #[must_use]
    pub fn point(&self, local: DVec3) -> DVec3 {
        self.position + self.orientation * local
    }

    /// The world's direction for a direction of the shape's frame.
    #[must_use]
    pub fn direction(&self, local: DVec3) -> DVec3 {
        self.orientation * local
    }

    /// The point of the shape's frame for a point of the world.
    #[must_use]
    pub fn local_point(&self, world: DVec3) -> DVec3 {
        self.orientation.conjugate() * (world - self.position)
    }

    /// The direction of the shape's frame for a direction of the world.
    #[must_use]
    pub fn local_direction(&self, world: DVec3) -> DVec3 {
        self.orientation.conjugate() * world
    }
}

impl Default for Pose {
    fn default() -> Self {
        Self::IDENTITY
    }
}
