//! From points alone to Bézier pieces.

use crate::curve::Knots;
use glam::DVec3;

/// Control points of the pieces between successive points, in a row.
///
/// The Catmull–Rom tangent in `P1`, for knots `d0` apart before it and `d1`
/// after it, is `(P1−P0)/d0 − (P2−P0)/(d0+d1) + (P2−P1)/d1`: that of the parabola
/// through the three points.
pub(crate) fn control_points(points: &[DVec3], knots: Knots) -> Vec<DVec3> {
    let count = points.len();
    let closed = count > 2 && points.first() == points.last();
    // The points before the first and after the last.
    let before = match points {
        [.., back, _] if closed => *back,
        [first, second, ..] => 2.0 * *first - *second,
        _ => return points.to_vec(),
    };
    let after = match points {
        [_, second, ..] if closed => *second,
        [.., back, last] => 2.0 * *last - *back,
        _ => return points.to_vec(),
    };
    let at = |index: usize| match index {
        0 => before,
        index if index > count => after,
        index => points[index - 1],
    };
    let apart = |a: DVec3, b: DVec3| match knots {
        Knots::Uniform => 1.0,
        Knots::Centripetal => a.distance(b).sqrt(),
    };
    let mut control = vec![points[0]];
    for index in 1..count {
        let [p0, p1, p2, p3] = [0, 1, 2, 3].map(|offset| at(index + offset - 1));
        let [d0, d1, d2] = [apart(p0, p1), apart(p1, p2), apart(p2, p3)];
        control.push(p1 + d1 / 3.0 * tangent([p0, p1, p2], [d0, d1]));
        control.push(p2 - d1 / 3.0 * tangent([p1, p2, p3], [d1, d2]));
        control.push(p2);
    }
    control
}

fn tangent([p0, p1, p2]: [DVec3; 3], [d0, d1]: [f64; 2]) -> DVec3 {
    let tangent = (p1 - p0) / d0 - (p2 - p0) / (d0 + d1) + (p2 - p1) / d1;
    // Points that coincide have no tangent; their piece has no length and is refused.
    if tangent.is_finite() {
        tangent
    } else {
        DVec3::ZERO
    }
}
