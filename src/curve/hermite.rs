//! From points and tangents to Bézier pieces.

use glam::DVec3;

/// Control points of the cubic that leaves `from` with velocity `leaving` and
/// reaches `to` with velocity `arriving`, both per unit of the parameter.
///
/// Source: the thesis, eqs. 2.13–2.16.
pub(crate) fn control_points(
    from: DVec3,
    leaving: DVec3,
    to: DVec3,
    arriving: DVec3,
) -> [DVec3; 4] {
    [from, from + leaving / 3.0, to - arriving / 3.0, to]
}

/// A tangent for every point: `start` and `end` at the ends and inside
/// Catmull's, from the point before to the point after.
///
/// Source: the thesis, section 2.2.8.
pub(crate) fn catmull_tangents(points: &[DVec3], start: DVec3, end: DVec3) -> Vec<DVec3> {
    let inside = points.windows(3).map(|three| three[2] - three[0]);
    std::iter::once(start)
        .chain(inside)
        .chain(std::iter::once(end))
        .collect()
}
