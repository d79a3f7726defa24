//! Axis-aligned bounds of the volumes: the cheap test before the dear one.

use super::Volume;
use crate::geometry::{Aabb, Obb};
use glam::DVec3;

/// A slot as the pair list remembers it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Slot {
    /// Around the volume; all of space if it is unbounded.
    pub(super) aabb: Aabb,
    pub(super) kind: Kind,
}

/// What is in a slot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Vacant,
    Fixed,
    Moving,
}

impl Slot {
    pub(super) const VACANT: Self = Self {
        aabb: Aabb::EMPTY,
        kind: Kind::Vacant,
    };

    /// The slot of a volume, with its bounds.
    pub(super) fn of(volume: Option<&Volume>) -> Self {
        let slot = Self::unbounded(volume);
        match volume.and_then(|volume| volume.obb.as_ref()) {
            Some(obb) => Self {
                aabb: around(obb),
                ..slot
            },
            None => slot,
        }
    }

    /// The slot of a volume that is taken to be all of space.
    pub(super) fn unbounded(volume: Option<&Volume>) -> Self {
        volume.map_or(Self::VACANT, |volume| Self {
            aabb: EVERYWHERE,
            kind: if volume.moving {
                Kind::Moving
            } else {
                Kind::Fixed
            },
        })
    }

    pub(super) fn is_vacant(&self) -> bool {
        self.kind == Kind::Vacant
    }
}

const EVERYWHERE: Aabb = Aabb {
    min: DVec3::NEG_INFINITY,
    max: DVec3::INFINITY,
};

/// The axis-aligned box around an oriented one, rounded outward.
fn around(obb: &Obb) -> Aabb {
    let half = obb.half_extents;
    let reach =
        half.x * obb.axes[0].abs() + half.y * obb.axes[1].abs() + half.z * obb.axes[2].abs();
    // The sum of three products is off by 3u (u = 2⁻⁵³), each end by one rounding
    // more; two boxes that touch do so to rounding only, with axes unit and
    // perpendicular to 32u: 64u cover all of it.
    let reach = reach + 32.0 * f64::EPSILON * (obb.centre.abs() + reach);
    let aabb = Aabb {
        min: obb.centre - reach,
        max: obb.centre + reach,
    };
    // A NaN would overlap nothing.
    if aabb.min.is_finite() && aabb.max.is_finite() {
        aabb
    } else {
        EVERYWHERE
    }
}
