//! Choosing a box's axes, and the box along given axes.

use crate::geometry::Obb;
use crate::math::frame::orthonormal;
use glam::DVec3;

/// A point's distance from a line below which, as a share of its distance from
/// the line's start, its direction is rounding rather than geometry.
const ON_THE_LINE: f64 = 1e-9;

/// How far rounding may carry a point out of a box, as a share of the sizes of
/// the coordinates involved.
///
/// Some 58 errors of 2⁻⁵³ add up: 8 in an extent, 12 in the centre, 32 because
/// the axes are unit and perpendicular to 32 only, 6 in asking whether the box
/// contains a point. 64 are allowed.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

/// What to grow a box by, in metres, whose coordinates add up to `magnitude`.
pub(super) fn rounding(magnitude: f64) -> f64 {
    ROUNDING * magnitude
}

/// Sum of the sizes of a vector's components.
pub(super) fn magnitude(vector: DVec3) -> f64 {
    vector.abs().element_sum()
}

/// Three perpendicular unit axes: the first along `first`, the second towards
/// `second` as far as it can be; none if `first` has no direction.
///
/// If `second` lies on the line of the first axis, or is zero, the other two are
/// arbitrary.
pub(super) fn axes_towards(first: DVec3, second: DVec3) -> Option<[DVec3; 3]> {
    // Scaled first, so that no square over- or underflows.
    let largest = first.abs().max_element();
    let a = (first / largest).try_normalize()?;
    let aside = second - second.dot(a) * a;
    // NaN counts as on the line.
    if aside.length() > ON_THE_LINE * second.length() {
        // Once more, since cancellation may have left a share along `a`.
        let aside = aside / aside.abs().max_element();
        let b = (aside - aside.dot(a) * a).normalize();
        Some([a, b, a.cross(b)])
    } else {
        let (b, c) = orthonormal(a);
        Some([a, b, c])
    }
}

/// The vector from the line through the origin along unit `axis` to `point`.
pub(super) fn aside(axis: DVec3, point: DVec3) -> DVec3 {
    point - point.dot(axis) * axis
}

/// The box along `axes` around whatever has the given extent along each of them,
/// grown by `growth` metres on every side.
pub(super) fn around_extents(
    axes: [DVec3; 3],
    extent_along: impl Fn(DVec3) -> (f64, f64),
    growth: f64,
) -> Obb {
    let extents = axes.map(extent_along);
    let middles = extents.map(|(min, max)| 0.5 * min + 0.5 * max);
    let halves = extents.map(|(min, max)| 0.5 * max - 0.5 * min);
    Obb {
        centre: (0..3).map(|i| middles[i] * axes[i]).sum(),
        axes,
        half_extents: DVec3::from_array(halves) + growth,
    }
}

/// The box with the least surface, the first of equal ones.
///
/// Surface and not volume: boxes around flat bodies have none, and it is the
/// surface that tells how likely another box is met.
pub(super) fn smaller(a: Obb, b: Obb) -> Obb {
    if surface(&b) < surface(&a) { b } else { a }
}

/// An eighth of the box's surface.
fn surface(obb: &Obb) -> f64 {
    let half = obb.half_extents;
    half.x * half.y + half.y * half.z + half.z * half.x
}
