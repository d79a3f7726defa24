//! Rays against boxes along the axes.

use super::clip::{self, Plane};
use super::line::Line;
use super::{GRAZE, RaySpan, SurfacePoint};
use crate::geometry::Feature;
use glam::DVec3;

/// The part of `line` between the planes `min` and `max` of all three axes.
///
/// Faces are numbered −x, +x, −y, +y, −z, +z; `axes` are their normals. The signs of both
/// fractions are exact, and so is the answer to whether the origin lies in the
/// box. An empty box or a NaN in it gives none.
///
/// `far` is the size of the coordinates that the line's were rounded from.
#[inline]
pub(super) fn span(
    line: &Line,
    min: DVec3,
    max: DVec3,
    axes: &[DVec3; 3],
    far: f64,
) -> Option<RaySpan> {
    let mut enters = [f64::NEG_INFINITY; 3];
    let mut leaves = [f64::INFINITY; 3];
    let mut beside = false;
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
        } else {
            beside |= low > 0.0 || high < 0.0;
        }
    }
    let enter = enters[0].max(enters[1]).max(enters[2]);
    let leave = leaves[0].min(leaves[1]).min(leaves[2]);
    if beside || enter > leave {
        return graze(line, min, max, axes, far, enter - leave);
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
        point(leave, axis_of(&leaves, leave), false),
    )
}

/// A line that by rounding passes the box by, or truly does.
fn graze(
    line: &Line,
    min: DVec3,
    max: DVec3,
    axes: &[DVec3; 3],
    far: f64,
    gap: f64,
) -> Option<RaySpan> {
    let size = min.abs().max(max.abs()).max_element();
    let growth = GRAZE * (far + size);
    // Off by more than growing could bridge: nearly every miss ends here.
    let slowest = line
        .direction
        .abs()
        .to_array()
        .into_iter()
        .filter(|&speed| speed > 0.0)
        .fold(f64::INFINITY, f64::min);
    if gap * slowest > 2.0 * growth {
        return None;
    }
    let planes = (0..6).map(|face| {
        let axis = face / 2;
        let (sign, bound) = if face % 2 == 0 {
            (-1.0, min)
        } else {
            (1.0, max)
        };
        Plane {
            normal: sign * DVec3::AXES[axis],
            offset: sign * bound[axis],
        }
    });
    let mut span = clip::span(line, planes, growth, Feature::Face)?;
    for point in [&mut span.enter, &mut span.leave] {
        let local = point.normal;
        point.normal = local.x * axes[0] + local.y * axes[1] + local.z * axes[2];
    }
    Some(span)
}
