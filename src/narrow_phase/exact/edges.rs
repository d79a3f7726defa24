//! The common normal of two edges.

use glam::DVec3;

/// Unit vector across two unit vectors, up to its sign; none if they are parallel to the last bit.
///
/// Of nearly parallel vectors the cross product is mostly rounding. Made
/// perpendicular to the first again, what is left of the error turns it
/// only about the common direction, along which the face that the two
/// span is that much thinner.
pub(super) fn edge_normal(a: DVec3, b: DVec3) -> Option<DVec3> {
    let cross = a.cross(b);
    let normal = cross.try_normalize()?;
    if cross.length_squared() > 1e-4 {
        return Some(normal);
    }
    let normal = (normal - normal.dot(a) * a).try_normalize()?;
    (normal - normal.dot(a) * a).try_normalize()
}
