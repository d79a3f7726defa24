//! The axes of a triangle, however thin.

use glam::DVec3;

/// A triangle's own axes, from its first corner.
///
/// The longest edge first, then what of the second is across it: so all three corners lie in the plane
/// to within rounding of their lengths, and the heights of the third is right to that, be the
/// triangle 1e-14 as wide as long. A cross product of the edges would have the plane leave the
/// far corner by as much as rounding is of the width.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    along: DVec3,
    across: DVec3,
    pub(super) normal: DVec3,
    /// Where the second corner lies along, and the third along and across.
    second: f64,
    third: [f64; 2],
}

impl Frame {
    /// Of the corners 0, `second` and `third`, of which `second` lies farther away. None if all lie
    /// on one line.
    pub(super) fn new(second: DVec3, third: DVec3) -> Option<Self> {
        let length = second.length();
        let along = second / length;
        let foot = third.dot(along);
        let rest = third - foot * along;
        // Twice: what rounding left of the long axis is taken off.
        let rest = rest - rest.dot(along) * along;
        let width = rest.length();
        // Also NaN is none.
        if !(width > 0.0 && width < f64::INFINITY) {
            return None;
        }
        let across = rest / width;
        Some(Self {
            along,
            across,
            normal: along.cross(across),
            second: length,
            third: [foot, width],
        })
    }

    /// How much of the first, second and third corner the foot of a point is; in sum 1.
    pub(super) fn shares(&self, point: DVec3) -> [f64; 3] {
        let third = point.dot(self.across) / self.third[1];
        let second = (point.dot(self.along) - third * self.third[0]) / self.second;
        [1.0 - second - third, second, third]
    }
}
