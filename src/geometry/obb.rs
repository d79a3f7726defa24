//! Oriented boxes.

use glam::DVec3;

/// A box in any orientation: the bounding volume of a swept body.
///
/// The thesis keeps a corner and three edge vectors (§3.12.1); centre, unit
/// axes and half-widths carry the same and make both overlap tests shorter.
/// Closed: points on its surface belong to it. A half-width may be zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Obb {
    /// The box's middle, in metres.
    pub centre: DVec3,
    /// Unit vectors along its edges, perpendicular to each other.
    pub axes: [DVec3; 3],
    /// Half the length of its edges along each axis, in metres.
    pub half_extents: DVec3,
}

impl Obb {
    /// The eight corners; bit `i` of the index says on which side of axis `i` a corner lies.
    #[must_use]
    pub fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|index| {
            let side = |axis: usize| if index >> axis & 1 == 1 { 1.0 } else { -1.0 };
            self.centre
                + (0..3)
                    .map(|axis| side(axis) * self.half_extents[axis] * self.axes[axis])
                    .sum::<DVec3>()
        })
    }

    /// Whether `point` lies in the box or on its surface.
    #[must_use]
    pub fn contains(&self, point: DVec3) -> bool {
        let offset = point - self.centre;
        (0..3).all(|axis| offset.dot(self.axes[axis]).abs() <= self.half_extents[axis])
    }
}
