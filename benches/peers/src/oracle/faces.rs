//! The faces of a hull.

use glam::DVec3;

/// Three corners that span a plane with all others on one side of it or in it.
pub type Triple = [usize; 3];

/// Every supporting triple of `points`, by trying all: O(n⁴).
///
/// A face of more than three corners gives each three of them, which cover it
/// more than once. Nothing is merged that is not coplanar to rounding. A lone
/// triangle is one triple; fewer points have none.
pub fn supporting_triples(points: &[DVec3]) -> Vec<Triple> {
    /// Share of the size that counts as rounding.
    const FLAT: f64 = 1e-13;
    let reach = |point: &DVec3| point.length();
    let tolerance = FLAT * points.iter().map(reach).fold(0.0, f64::max);
    let mut triples = Vec::new();
    for i in 0..points.len() {
        for j in i + 1..points.len() {
            for k in j + 1..points.len() {
                let Some(normal) = plane_normal(points, [i, j, k]) else {
                    continue;
                };
                let (mut above, mut below) = (false, false);
                for &point in points {
                    let height = normal.dot(point - points[i]);
                    above |= height > tolerance;
                    below |= height < -tolerance;
                    if above && below {
                        break;
                    }
                }
                if !(above && below) {
                    triples.push([i, j, k]);
                }
            }
        }
    }
    triples
}

/// Unit normal of the plane through three points, unless they are in line.
pub fn plane_normal(points: &[DVec3], [i, j, k]: Triple) -> Option<DVec3> {
    let (u, v) = (points[j] - points[i], points[k] - points[i]);
    let normal = u.cross(v);
    let length = normal.length();
    (length > 1e-12 * u.length() * v.length()).then(|| normal / length)
}
