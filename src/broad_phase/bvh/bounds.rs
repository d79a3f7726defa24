//! Boxes in single precision.

use crate::geometry::Aabb;
use glam::{DVec3, Vec3};

/// A box along the axes, in metres from the hierarchy's origin, rounded outward.
///
/// Half the memory of an [`Aabb`], and four of its numbers to a register.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bounds {
    pub(super) min: Vec3,
    pub(super) max: Vec3,
}

/// Share of a number by which it is moved before it is rounded to `f32`.
///
/// Rounding to nearest is off by 2⁻²⁴ at most, the subtraction of the origin and
/// the multiplication by some 2⁻⁵³: 2⁻²³ covers all of it. Cheaper than stepping
/// to the neighbouring float, and no branch.
const ROUNDING: f64 = 1.0 / (1_u64 << 23) as f64;

/// The same in metres where numbers are small; far below the size of any body, and
/// far above where `f32` has no relative precision.
const SMALLEST: f64 = 1e-13;

impl Bounds {
    /// Holds nothing, and overlaps nothing.
    pub(super) const EMPTY: Self = Self {
        min: Vec3::INFINITY,
        max: Vec3::NEG_INFINITY,
    };

    /// Overlaps all but what is empty.
    const EVERYWHERE: Self = Self {
        min: Vec3::NEG_INFINITY,
        max: Vec3::INFINITY,
    };

    /// The box around `aabb`, seen from `origin`; everything if a number of it
    /// is not finite.
    #[inline]
    pub(super) fn around(aabb: &Aabb, origin: DVec3) -> Self {
        let (min, max) = (aabb.min - origin, aabb.max - origin);
        let outward = |corner: DVec3| corner.abs() * ROUNDING + SMALLEST;
        let bounds = Self {
            min: (min - outward(min)).as_vec3(),
            max: (max + outward(max)).as_vec3(),
        };
        // An infinity less an infinity is a NaN, which would overlap nothing.
        if (bounds.max - bounds.min).is_finite() {
            bounds
        } else {
            Self::EVERYWHERE
        }
    }

    pub(super) fn union(&self, other: &Self) -> Self {
        Self {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    /// Whether the two share a point.
    pub(super) fn overlaps(&self, other: &Self) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }

    /// Twice the box's middle; zero for a box that has none.
    pub(super) fn middle(&self) -> Vec3 {
        let middle = self.min + self.max;
        if middle.is_finite() {
            middle
        } else {
            Vec3::ZERO
        }
    }

    /// Half the box's surface: how likely it is met. Zero for the empty box.
    pub(super) fn surface(&self) -> f32 {
        let size = (self.max - self.min).max(Vec3::ZERO);
        size.x * size.y + size.y * size.z + size.z * size.x
    }
}
