//! Four points that span a volume.

use super::orient::{collinear, side, sign};
use crate::error::ShapeError;
use crate::tolerance::MIN_LENGTH;
use glam::DVec3;
use std::cmp::Ordering;

/// The tetrahedron a hull grows from.
pub(super) struct Simplex {
    /// The last lies strictly below the triangle of the first three.
    pub(super) corners: [u32; 4],
    /// Height of the last corner over the first three, in metres: no point lies
    /// farther from their plane.
    pub(super) thickness: f64,
}

/// Finds four points far apart from each other.
///
/// The first is the one with the lowest coordinates, the second the farthest
/// from it, the third the farthest from the line of those two, the fourth the
/// farthest from their plane. Ties go to the lowest coordinates, so that the
/// order of the points does not matter.
pub(super) fn simplex(points: &[DVec3]) -> Result<Simplex, ShapeError> {
    let flat = |dimensions| ShapeError::Flat {
        dimensions,
        min_thickness: MIN_LENGTH,
    };
    let Some(a) = (0..points.len()).min_by(|&i, &j| order(points[i], points[j])) else {
        return Err(ShapeError::TooFewPoints { count: 0, min: 4 });
    };
    let origin = points[a];

    let (b, length) = farthest(points, |p| p.distance(origin)).unwrap_or((a, 0.0));
    if length < MIN_LENGTH {
        return Err(flat(0));
    }
    let along = (points[b] - origin) / length;

    let (mut c, distance) =
        farthest(points, |p| (p - origin).cross(along).length()).unwrap_or((a, 0.0));
    if distance < MIN_LENGTH {
        return Err(flat(1));
    }
    // The distances above are rounded: at 1e9 m by 1e-7 m.
    if collinear(origin, points[b], points[c]) {
        c = (0..points.len())
            .find(|&i| !collinear(origin, points[b], points[i]))
            .ok_or_else(|| flat(1))?;
    }

    let normal = along.cross(points[c] - origin).normalize_or_zero();
    let (mut d, thickness) = farthest(points, |p| normal.dot(p - origin).abs()).unwrap_or((a, 0.0));
    if thickness < MIN_LENGTH {
        return Err(flat(2));
    }
    let height = |i: usize| sign(side([origin, points[b], points[c]], points[i]));
    if height(d) == 0 {
        d = (0..points.len())
            .find(|&i| height(i) != 0)
            .ok_or_else(|| flat(2))?;
    }
    let corners = if height(d) < 0 {
        [a, b, c, d]
    } else {
        [a, c, b, d]
    };
    Ok(Simplex {
        corners: corners.map(|i| i as u32),
        thickness,
    })
}

/// The point with the largest measure, and that measure.
fn farthest(points: &[DVec3], measure: impl Fn(DVec3) -> f64) -> Option<(usize, f64)> {
    (0..points.len())
        .map(|i| (i, measure(points[i])))
        .max_by(|(i, x), (j, y)| x.total_cmp(y).then(order(points[*j], points[*i])))
}

/// By x, then y, then z.
pub(super) fn order(a: DVec3, b: DVec3) -> Ordering {
    (a.x.total_cmp(&b.x))
        .then(a.y.total_cmp(&b.y))
        .then(a.z.total_cmp(&b.z))
}
