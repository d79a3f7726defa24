//! Axis-aligned boxes.

use glam::DVec3;

/// A box along the world's axes. Closed: points on its surface belong to it.
///
/// `min ≤ max` in every component, or else it is empty.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aabb {
    /// The corner with the smallest coordinates, in metres.
    pub min: DVec3,
    /// The corner with the largest coordinates, in metres.
    pub max: DVec3,
}

impl Aabb {
    /// The box that holds nothing.
    pub const EMPTY: Self = Self {
        min: DVec3::INFINITY,
        max: DVec3::NEG_INFINITY,
    };

    /// The box between two opposite corners, in any order.
    #[must_use]
    pub fn new(a: impl Into<DVec3>, b: impl Into<DVec3>) -> Self {
        let (a, b) = (a.into(), b.into());
        Self {
            min: a.min(b),
            max: a.max(b),
        }
    }

    /// The smallest box around `points`; [`EMPTY`](Self::EMPTY) if there are none.
    #[must_use]
    pub fn around(points: impl IntoIterator<Item = DVec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, |aabb, p| Self {
            min: aabb.min.min(p),
            max: aabb.max.max(p),
        })
    }

    /// The box grown by `margin` metres on every side.
    #[must_use]
    pub fn grown(&self, margin: f64) -> Self {
        Self {
            min: self.min - margin,
            max: self.max + margin,
        }
    }

    /// Whether the two boxes share a point. NaN shares nothing.
    #[must_use]
    pub fn overlaps(&self, other: &Self) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }

    /// Whether `point` lies in the box or on its surface.
    #[must_use]
    pub fn contains(&self, point: DVec3) -> bool {
        self.min.cmple(point).all() && point.cmple(self.max).all()
    }

    /// The box's middle.
    #[must_use]
    pub fn centre(&self) -> DVec3 {
        0.5 * self.min + 0.5 * self.max
    }

    /// Half the box's edges.
    #[must_use]
    pub fn half_extents(&self) -> DVec3 {
        0.5 * self.max - 0.5 * self.min
    }
}
