//! Boxes around whole paths.

use super::orientation::{around_extents, aside, axes_towards, magnitude, rounding, smaller};
use crate::curve::{CubicBezier, Spline};
use crate::geometry::Obb;
use glam::DVec3;

/// Points looked at on each piece of a spline to find the farthest one.
///
/// They only choose the axes; the extents are exact whatever they are.
const SAMPLES: u32 = 16;

/// The oriented box around a body that flies straight from `from` to `to`.
///
/// `centre_offset` leads from the body's position on the path to the centre of
/// its bounding sphere, `max_dist` is that sphere's radius; all in metres. For a
/// body that spins about its position, take no offset and the largest distance
/// from its position to its surface.
///
/// The first axis runs along the path; a path without length gives a cube along
/// the world's axes. The box holds the sphere at every point of the path; rounding
/// grows it by 32 × [`f64::EPSILON`] of the coordinates. Source: the thesis, §2.3.1.2.1.
///
/// O(1).
///
/// ```
/// use feeler::sweep::along_line;
/// use glam::DVec3;
///
/// let obb = along_line(DVec3::ZERO, DVec3::new(0.0, 8.0, 0.0), DVec3::ZERO, 1.0);
/// assert!(obb.contains(DVec3::new(0.0, 9.0, 0.0)));
/// assert!(!obb.contains(DVec3::new(1.1, 4.0, 0.0)));
/// ```
#[must_use]
pub fn along_line(from: DVec3, to: DVec3, centre_offset: DVec3, max_dist: f64) -> Obb {
    let way = to - from;
    let axes = axes_towards(way, DVec3::ZERO).unwrap_or([DVec3::X, DVec3::Y, DVec3::Z]);
    let growth = max_dist
        + rounding(magnitude(from.abs().max(to.abs())) + magnitude(centre_offset) + max_dist);
    Obb {
        centre: 0.5 * from + 0.5 * to + centre_offset,
        axes,
        half_extents: DVec3::new(0.5 * way.length(), 0.0, 0.0) + growth,
    }
}

/// The oriented box around a body that flies along the whole of `spline`.
///
/// `centre_offset` and `max_dist` are as for [`along_line`].
///
/// The thesis's axes: from start to end, then towards the point farthest from
/// that line. They say little of a path that ends near its start, so the box from
/// the start to the farthest point is made too, and the smaller of both, by
/// surface, is kept. Extents are those of the curve itself, piece by piece, not
/// of samples, which may leave a bend outside.
///
/// The box holds the sphere at every point of the path; rounding grows it by
/// 32 × [`f64::EPSILON`] of the coordinates. Source: the thesis, §2.3.1.2.2.
///
/// O(pieces); does not allocate.
///
/// ```
/// use feeler::sweep::along_spline;
/// use feeler::{PathError, Spline};
/// use glam::DVec3;
///
/// let bend = Spline::through([[0.0; 3], [4.0, 0.0, 0.0]], [0.0, 12.0, 0.0], [0.0, -12.0, 0.0])?;
/// let obb = along_spline(&bend, DVec3::ZERO, 1.0);
/// // The bend is 3 m high, in its middle.
/// assert!(obb.contains(DVec3::new(2.0, 4.0, 0.0)));
/// assert!(!obb.contains(DVec3::new(2.0, 4.000_001, 0.0)));
/// # Ok::<(), PathError>(())
/// ```
#[must_use]
pub fn along_spline(spline: &Spline, centre_offset: DVec3, max_dist: f64) -> Obb {
    let size = spline
        .pieces()
        .iter()
        .flat_map(CubicBezier::control_points)
        .map(magnitude)
        .fold(0.0, f64::max);
    let growth = max_dist + rounding(size + magnitude(centre_offset) + max_dist);
    let extent_along = |axis: DVec3| {
        spline
            .pieces()
            .iter()
            .map(|piece| piece.extent_along(axis))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |all, piece| {
                (all.0.min(piece.0), all.1.max(piece.1))
            })
    };
    let along = |axes| around_extents(axes, extent_along, growth);
    let chord = chord_axes(spline).map(along);
    let widest = widest_axes(spline).map(along);
    let obb = match (chord, widest) {
        (Some(chord), Some(widest)) => smaller(chord, widest),
        (Some(obb), None) | (None, Some(obb)) => obb,
        (None, None) => along([DVec3::X, DVec3::Y, DVec3::Z]),
    };
    Obb {
        centre: obb.centre + centre_offset,
        ..obb
    }
}

/// From the start to the end, then towards the point farthest from that line.
fn chord_axes(spline: &Spline) -> Option<[DVec3; 3]> {
    let end = spline.pieces().last()?.control_points()[3];
    axes_along(spline, end - start(spline)?)
}

/// From the start to the point farthest from it, then towards the point farthest
/// from that line.
fn widest_axes(spline: &Spline) -> Option<[DVec3; 3]> {
    axes_along(spline, farthest(spline, |offset| offset)?)
}

fn axes_along(spline: &Spline, direction: DVec3) -> Option<[DVec3; 3]> {
    let [axis, ..] = axes_towards(direction, DVec3::ZERO)?;
    axes_towards(direction, farthest(spline, |offset| aside(axis, offset))?)
}

fn start(spline: &Spline) -> Option<DVec3> {
    Some(spline.pieces().first()?.control_points()[0])
}

/// The longest `measure` of the vectors from the start to the sampled points.
fn farthest(spline: &Spline, measure: impl Fn(DVec3) -> DVec3) -> Option<DVec3> {
    let start = start(spline)?;
    spline
        .pieces()
        .iter()
        .flat_map(|piece| {
            (1..=SAMPLES).map(|sample| piece.point(f64::from(sample) / f64::from(SAMPLES)))
        })
        .map(|point| measure(point - start))
        .max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))
}
