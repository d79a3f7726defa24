//! A first tetrahedron inside the Minkowski difference.

use super::pair::Pair;
use super::unit;
use crate::math::frame::orthonormal;
use glam::DVec3;

/// Share of the pair's size below which the Minkowski difference counts as flat.
///
/// Flat pairs are two triangles almost in one plane; they go the slow way, which
/// needs no volume. Lower it and the tetrahedron's faces have no normals.
const FLAT: f64 = 1e-9;

/// Four points of the Minkowski difference that span a volume; the first three
/// run counter-clockwise seen from outside. None if it is flat.
pub(super) fn tetrahedron(pair: &Pair) -> Option<[DVec3; 4]> {
    let axis = unit(pair.offset).unwrap_or(DVec3::X);
    let (x, y) = orthonormal(axis);
    let first = pair.support(axis);
    let second = farthest(pair, &[axis, x, y], first)?;
    let along = unit(second - first)?;
    let (x, y) = orthonormal(along);
    let third = farthest(pair, &[x, y], first)?;
    let normal = unit((second - first).cross(third - first))?;
    let fourth = farthest(pair, &[normal], first)?;
    if (fourth - first).dot(normal) > 0.0 {
        Some([first, third, second, fourth])
    } else {
        Some([first, second, third, fourth])
    }
}

/// The point of the Minkowski difference farthest from `from` along any of the
/// `axes`, either way.
fn farthest(pair: &Pair, axes: &[DVec3], from: DVec3) -> Option<DVec3> {
    let (mut best, mut reach) = (None, FLAT * pair.size);
    for &axis in axes {
        for direction in [axis, -axis] {
            let point = pair.support(direction);
            let along = (point - from).dot(direction);
            if along > reach {
                (best, reach) = (Some(point), along);
            }
        }
    }
    best
}
