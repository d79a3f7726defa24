//! Two boxes: fifteen axes.

use super::{Width, unit};
use crate::geometry::{Cuboid, Pose};
use glam::{DMat3, DVec3};

/// The least width of two boxes, or none if it is at most `touch`. `offset` leads
/// from B's centre to A's.
///
/// A box looks the same from both sides, so each axis is good for two
/// directions and the shorter is the one towards A.
pub(super) fn least(
    a: &Cuboid,
    pose_a: &Pose,
    b: &Cuboid,
    pose_b: &Pose,
    offset: DVec3,
    touch: f64,
) -> Option<Width> {
    let (axes_a, axes_b) = (
        DMat3::from_quat(pose_a.orientation),
        DMat3::from_quat(pose_b.orientation),
    );
    let (half_a, half_b) = (a.half_extents(), b.half_extents());
    let reach = |axis: DVec3| {
        (axes_a.transpose() * axis).abs().dot(half_a)
            + (axes_b.transpose() * axis).abs().dot(half_b)
    };
    // Rounding must not make an edge pair beat the face it grazes.
    let margin = 4.0 * f64::EPSILON * (half_a.length() + half_b.length());
    let mut best: Option<Width> = None;
    let mut try_axis = |axis: DVec3| {
        let along = axis.dot(offset);
        let width = reach(axis) - along.abs();
        if best.is_none_or(|best| width < best.width - margin) {
            let direction = if along < 0.0 { -axis } else { axis };
            best = Some(Width { direction, width });
        }
        // NaN counts as apart.
        width > touch
    };
    for axes in [&axes_a, &axes_b] {
        for axis in 0..3 {
            if !try_axis(axes.col(axis)) {
                return None;
            }
        }
    }
    for i in 0..3 {
        for j in 0..3 {
            let cross = axes_a.col(i).cross(axes_b.col(j));
            // Edges closer to parallel make a face thinner than rounding.
            if cross.length_squared() > 1e-28
                && let Some(axis) = unit(cross)
                && !try_axis(axis)
            {
                return None;
            }
        }
    }
    best
}
