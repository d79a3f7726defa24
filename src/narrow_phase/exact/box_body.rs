//! A box where it stands, and a touch as seen from it.

use crate::geometry::Feature;
use glam::{DMat3, DQuat, DVec3};

/// A box where it stands.
pub(super) struct Body {
    pub(super) half_extents: DVec3,
    pub(super) radius: f64,
    /// Its axes in the world.
    pub(super) axes: [DVec3; 3],
}

impl Body {
    #[inline(always)]
    pub(super) fn new(half_extents: DVec3, radius: f64, orientation: &DQuat) -> Self {
        let DMat3 {
            x_axis,
            y_axis,
            z_axis,
        } = DMat3::from_quat(*orientation);
        Self {
            half_extents,
            radius,
            axes: [x_axis, y_axis, z_axis],
        }
    }

    /// A direction of the world along the box's axes.
    #[inline(always)]
    pub(super) fn levels(&self, direction: DVec3) -> DVec3 {
        let [x, y, z] = self.axes;
        DVec3::new(direction.dot(x), direction.dot(y), direction.dot(z))
    }

    /// A point of the box from its middle, along the world's axes.
    #[inline(always)]
    pub(super) fn turned(&self, point: DVec3) -> DVec3 {
        let [x, y, z] = self.axes;
        x * point.x + y * point.y + z * point.z
    }
}

/// A touch as seen from the body that the normal leads out of.
pub(super) struct Found {
    pub(super) fraction: f64,
    pub(super) normal: DVec3,
    /// Of that body and of the other.
    pub(super) features: [Feature; 2],
    /// A point of the other body from where it stands.
    pub(super) corner: DVec3,
}

/// The edge along an axis that ends at a corner, as `Cuboid` counts them.
#[inline(always)]
pub(super) fn edge_at(corner: u32, along: usize) -> u32 {
    let edge = [
        corner >> 1,
        4 + (corner & 1 | corner >> 1 & 2),
        8 + (corner & 3),
    ];
    edge[along]
}

/// Of a corner, as `Cuboid` counts them.
#[inline]
pub(super) fn number(corner: DVec3) -> u32 {
    u32::from(corner.x > 0.0) | u32::from(corner.y > 0.0) << 1 | u32::from(corner.z > 0.0) << 2
}
