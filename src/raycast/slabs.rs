//! Rays against boxes along the axes.

use super::line::Line;
use super::{GRAZE, RaySpan, SurfacePoint};
use crate::geometry::Feature;
use glam::DVec3;

/// The part of `line` between the planes `min` and `max` of all three axes.
///
/// Faces are numbered −x, +x, −y, +y, −z, +z. The signs of both fractions are
/// exact, and so is the answer to whether the origin lies in the box. An empty
/// box or a NaN in it gives none.
#[inline]
pub(super) fn span(line: &Line, min: DVec3, max: DVec3, axes: &[DVec3; 3]) -> Option<RaySpan> {
    let mut enters = [f64::NEG_INFINITY; 3];
    let mut leaves = [f64::INFINITY; 3];
    for axis in 0..3 {
        let (origin, direction) = (line.origin[axis], line.direction[axis]);
        let (low, high) = (min[axis] - origin, max[axis] - origin);
        // False for a NaN too.
        let holds_something = low <= high;
        if !holds_something {
            return None;
        }
        if direction > 0.0 {
            (enters[axis], leaves[axis]) = (low / direction, high / direction);
        } else if direction < 0.0 {
            (enters[axis], leaves[axis]) = (high / direction, low / direction);
        } else if !(low <= 0.0 && high >= 0.0) {
            return None;
        }
    }
    let enter = enters[0].max(enters[1]).max(enters[2]);
    let leave = leaves[0].min(leaves[1]).min(leaves[2]);
    // Each is rounded twice; a line through an edge has both equal.
    let slack = GRAZE * enter.abs().max(leave.abs());
    if enter > leave + slack {
        return None;
    }
    // The lowest-numbered axis among those equal to within rounding.
    let axis_of = |fractions: &[f64; 3], fraction: f64| {
        (0..3)
            .find(|&axis| (fractions[axis] - fraction).abs() <= GRAZE * fraction.abs())
            .unwrap_or(0)
    };
    let point = |fraction: f64, axis: usize, inwards: bool| {
        let positive = (line.direction[axis] > 0.0) != inwards;
        let sign = if positive { 1.0 } else { -1.0 };
        SurfacePoint {
            fraction: line.ray_fraction(fraction),
            normal: sign * axes[axis],
            feature: Feature::Face(2 * axis as u32 + u32::from(positive)),
        }
    };
    RaySpan::new(
        point(enter, axis_of(&enters, enter), true),
        point(leave.max(enter), axis_of(&leaves, leave), false),
    )
}
