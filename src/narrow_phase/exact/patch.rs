//! What two flat features share where they touch, seen along the normal.

use crate::narrow_phase::overlap::witness;
use glam::DVec2;

pub(super) use witness::around;

/// Distance, as a share of the pair's size, up to which a point counts as in a feature.
const SLACK: f64 = 1e-14;

/// Corners nearer to each other than this share of the pair's size are one.
const DOUBLE: f64 = 1e-12;

/// A point in the middle of what two points, segments or polygons share; of the
/// larger one the nearest to the other where rounding keeps them apart.
pub(super) fn middle(a: &[DVec2], b: &[DVec2], size: f64) -> DVec2 {
    if let Some(shared) = shared(a, b, size) {
        return shared;
    }
    let middle = witness::middle(a, b);
    // They touch in an edge or corner of both, or one is turned by a hair from a face that
    // reaches further: where a corner of one is nearest to the other.
    let mut best = (f64::INFINITY, middle);
    let lone = |polygon: &[DVec2]| polygon.len() == 1;
    for (corners, polygon) in [(a, b), (b, a)] {
        if lone(polygon) && !lone(corners) {
            continue;
        }
        for &corner in corners {
            let foot = nearest(polygon, corner);
            let distance = foot.distance_squared(corner);
            if distance < best.0 {
                best = (distance, foot);
            }
        }
    }
    best.1
}

/// The same where they do share a point.
pub(super) fn shared(a: &[DVec2], b: &[DVec2], size: f64) -> Option<DVec2> {
    let middle = witness::middle(a, b);
    let near = |polygon: &[DVec2]| nearest(polygon, middle).distance(middle) <= SLACK * size;
    (near(a) && near(b)).then_some(middle)
}

/// The corners of what two points, segments or polygons share, counter-clockwise, each once; at
/// least one point, where rounding keeps them apart.
pub(super) fn corners(a: &[DVec2], b: &[DVec2], size: f64) -> Vec<DVec2> {
    let (subject, clip) = if a.len() <= b.len() { (a, b) } else { (b, a) };
    let mut shared = match (subject, clip) {
        ([_, _], [_, _]) => common_ends(subject, clip, size),
        ([_, _, ..], [_, _, ..]) => witness::clipped(subject, clip).to_vec(),
        _ => Vec::new(),
    };
    let near = |p: &DVec2, q: &DVec2| p.distance(*q) <= DOUBLE * size;
    shared.dedup_by(|later, first| near(later, first));
    while let [first, .., last] = shared[..]
        && near(&first, &last)
    {
        shared.pop();
    }
    if shared.is_empty() {
        shared.push(middle(a, b, size));
    }
    shared
}

/// Ends of two segments that lie on the other one: of parallel ones both ends of what they share.
fn common_ends(a: &[DVec2], b: &[DVec2], size: f64) -> Vec<DVec2> {
    let mut ends: Vec<DVec2> = Vec::new();
    for (segment, points) in [(a, b), (b, a)] {
        for &point in points {
            let on = nearest(segment, point).distance(point) <= SLACK * size;
            if on && ends.iter().all(|end| end.distance(point) > DOUBLE * size) {
                ends.push(point);
            }
        }
    }
    ends
}

/// The polygon's point nearest to `point`.
fn nearest(polygon: &[DVec2], point: DVec2) -> DVec2 {
    let mut best = (f64::INFINITY, point);
    let mut inside = polygon.len() > 2;
    for (index, &from) in polygon.iter().enumerate() {
        let along = polygon[(index + 1) % polygon.len()] - from;
        let offset = point - from;
        inside &= along.perp_dot(offset) >= 0.0;
        let share = offset.dot(along) / along.length_squared();
        // Of an edge without length the share is NaN.
        let share = if share > 0.0 { share.min(1.0) } else { 0.0 };
        let foot = from + share * along;
        let distance = foot.distance_squared(point);
        if distance < best.0 {
            best = (distance, foot);
        }
    }
    if inside { point } else { best.1 }
}
