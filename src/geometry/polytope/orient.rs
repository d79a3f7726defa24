//! Exact sidedness.

use glam::DVec3;
use robust::{Coord, Coord3D, orient2d, orient3d};

/// Coordinates below this, in metres, count as zero.
///
/// A product of three coordinates then stays above 1e-273, so that the
/// remainders the exact predicates carry (2⁻⁵³ of a factor each) cannot
/// underflow; the largest, (1e9)³, is far from overflow. Raised towards
/// `MIN_LENGTH` it would move vertices; lowered below 1e-90 signs would err.
const ZERO_BELOW: f64 = 1e-75;

/// The point with −0 and coordinates below [`ZERO_BELOW`] replaced by 0.
pub(super) fn tidied(point: DVec3) -> DVec3 {
    DVec3::from_array(
        point
            .to_array()
            .map(|x| if x.abs() < ZERO_BELOW { 0.0 } else { x }),
    )
}

/// Positive if `point` lies on the side of the plane through `a`, `b`, `c` from
/// which they run counter-clockwise, negative on the other side, 0 on the plane.
///
/// The sign is exact; the size is roughly six times the tetrahedron's volume.
/// `robust` counts the other side as positive, hence the exchanged corners.
pub(super) fn side([a, b, c]: [DVec3; 3], point: DVec3) -> f64 {
    let coord = |p: DVec3| Coord3D {
        x: p.x,
        y: p.y,
        z: p.z,
    };
    orient3d(coord(a), coord(c), coord(b), coord(point))
}

/// Whether the three points lie on one line, exactly: all three shadows along
/// the axes do.
pub(super) fn collinear(a: DVec3, b: DVec3, c: DVec3) -> bool {
    let shadow = |i: usize, j: usize| {
        let coord = |p: DVec3| Coord { x: p[i], y: p[j] };
        orient2d(coord(a), coord(b), coord(c))
    };
    [(0, 1), (1, 2), (2, 0)]
        .into_iter()
        .all(|(i, j)| sign(shadow(i, j)) == 0)
}

/// −1, 0 or 1.
pub(super) fn sign(value: f64) -> i8 {
    i8::from(value > 0.0) - i8::from(value < 0.0)
}
