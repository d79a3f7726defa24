//! Two oriented boxes, by separating axes.

use crate::geometry::Obb;
use glam::DVec3;

/// Rounding of every quantity compared, as a share of the boxes' sizes and distance.
///
/// With u = 2⁻⁵³ and axes unit and perpendicular to 32u: a cosine is off by 3u, a
/// component of the distance d by 4u|d|; the distance along a cross product of
/// edges by 20u|d|, the boxes' reach along it by 8u of their sizes, both by another
/// 64u because a × b is taken from the cosines. Together 92u at most; 128u allowed.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Whether two oriented boxes overlap: whether no axis separates them.
///
/// Three face normals of each box and nine cross products of their edges decide.
/// Sound: boxes that touch or overlap are never called apart, parallel edges
/// included. Boxes with a gap of less than 1e-13 of their sizes and distance may be
/// called overlapping; where only two edges at a small angle to each other
/// separate them, of less than 1e-13 over its sine, 1e-6 at worst. A NaN overlaps
/// everything. The axes must be unit and perpendicular to 16 × [`f64::EPSILON`].
///
/// Near-parallel edges have a cross product near zero, along which both the
/// distance and the boxes' reach are little more than rounding. Both are taken
/// from the cosines between the axes without normalising, so that their errors
/// stay below the one margin that all 15 comparisons share.
///
/// Source: Gottschalk, Lin & Manocha, *OBBTree* (1996). The thesis names it and
/// takes rays instead: [`obb_overlap_by_rays`](super::obb_overlap_by_rays).
///
/// O(1), at most 15 axes, fewest for boxes far apart.
///
/// ```
/// use feeler::Obb;
/// use feeler::broad_phase::obb_overlap_by_axes;
/// use glam::DVec3;
///
/// let at = |x| Obb {
///     centre: DVec3::new(x, 0.0, 0.0),
///     axes: [DVec3::X, DVec3::Y, DVec3::Z],
///     half_extents: DVec3::ONE,
/// };
/// assert!(obb_overlap_by_axes(&at(0.0), &at(2.0)));
/// assert!(!obb_overlap_by_axes(&at(0.0), &at(2.000_001)));
/// ```
#[must_use]
pub fn obb_overlap_by_axes(a: &Obb, b: &Obb) -> bool {
    let between = b.centre - a.centre;
    let (half_a, half_b) = (a.half_extents, b.half_extents);
    let margin = ROUNDING * (between.abs() + half_a + half_b).element_sum();

    // Written so that a NaN separates nothing.
    let apart = |distance: f64, reach: f64| distance.abs() > reach + margin;

    // A's face normals; `cosines[i]` holds those of A's axis i with B's axes.
    let mut cosines = [DVec3::ZERO; 3];
    let mut sizes = [DVec3::ZERO; 3];
    let mut along_a = DVec3::ZERO;
    for i in 0..3 {
        let axis = a.axes[i];
        cosines[i] = DVec3::new(
            axis.dot(b.axes[0]),
            axis.dot(b.axes[1]),
            axis.dot(b.axes[2]),
        );
        sizes[i] = cosines[i].abs();
        along_a[i] = between.dot(axis);
        if apart(along_a[i], half_a[i] + half_b.dot(sizes[i])) {
            return false;
        }
    }

    // B's face normals, all at once.
    let along_b = along_a.x * cosines[0] + along_a.y * cosines[1] + along_a.z * cosines[2];
    let reach_b = half_a.x * sizes[0] + half_a.y * sizes[1] + half_a.z * sizes[2] + half_b;
    if along_b.abs().cmpgt(reach_b + margin).any() {
        return false;
    }

    // Cross products of A's edge i with B's three edges.
    for i in 0..3 {
        let (next, last) = ((i + 1) % 3, (i + 2) % 3);
        let distances = along_a[last] * cosines[next] - along_a[next] * cosines[last];
        let reach_a = half_a[next] * sizes[last] + half_a[last] * sizes[next];
        let size = sizes[i];
        let reach_b = DVec3::new(
            half_b.y * size.z + half_b.z * size.y,
            half_b.z * size.x + half_b.x * size.z,
            half_b.x * size.y + half_b.y * size.x,
        );
        if distances.abs().cmpgt(reach_a + reach_b + margin).any() {
            return false;
        }
    }
    true
}
