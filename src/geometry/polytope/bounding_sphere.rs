//! The smallest sphere around points.

use glam::DVec3;

/// More than enough: the sphere grows each time, and settles after some ten.
const ROUNDS: usize = 200;

/// Centre and radius of the smallest sphere around `points`, of which there is
/// at least one.
///
/// Keeps the points that hold the sphere, four at most. As long as a point lies
/// outside, the smallest sphere around those and the farthest one takes over;
/// with five points that is a search over all subsets (after Gärtner, *Fast and
/// Robust Smallest Enclosing Balls*, 1999).
///
/// The centre is good to some 1e-8 of the radius in the worst case and to
/// rounding in the usual one; whatever the centre, no point lies outside the
/// radius.
pub(super) fn bounding_sphere(points: &[DVec3]) -> (DVec3, f64) {
    let Some(&first) = points.first() else {
        return (DVec3::ZERO, 0.0);
    };
    let mut support = vec![first];
    let mut centre = first;
    let mut radius = 0.0;
    for _ in 0..ROUNDS {
        let (far, distance) = farthest(points, centre);
        if distance <= radius * (1.0 + 4.0 * f64::EPSILON) || support.contains(&far) {
            break;
        }
        let Some(next) = smallest_with(&support, far) else {
            break;
        };
        if next.radius <= radius {
            break;
        }
        (centre, radius, support) = (next.centre, next.radius, next.points);
    }
    // The distance has three roundings: 4 ulp keep the farthest point inside.
    let radius = farthest(points, centre).1 * (1.0 + 4.0 * f64::EPSILON);
    (centre, radius)
}

fn farthest(points: &[DVec3], centre: DVec3) -> (DVec3, f64) {
    let mut best = (centre, 0.0);
    for &point in points {
        let squared = point.distance_squared(centre);
        if squared > best.1 {
            best = (point, squared);
        }
    }
    (best.0, best.1.sqrt())
}

struct Ball {
    points: Vec<DVec3>,
    centre: DVec3,
    radius: f64,
}

/// The smallest ball around `support` and `far` that has `far` on its surface.
fn smallest_with(support: &[DVec3], far: DVec3) -> Option<Ball> {
    let mut best: Option<Ball> = None;
    for subset in 1..1_u32 << support.len() {
        if subset.count_ones() > 3 {
            continue;
        }
        let chosen: Vec<DVec3> = (support.iter().enumerate())
            .filter(|(i, _)| subset >> i & 1 == 1)
            .map(|(_, &point)| point)
            .collect();
        let Some(offset) = circumcentre(&chosen, far) else {
            continue;
        };
        let centre = far + offset;
        let radius = offset.length();
        let holds = (support.iter()).all(|p| p.distance(centre) <= radius * (1.0 + 1e-12));
        if holds && best.as_ref().is_none_or(|best| radius < best.radius) {
            let mut points = chosen;
            points.push(far);
            best = Some(Ball {
                points,
                centre,
                radius,
            });
        }
    }
    best
}

/// Centre, seen from `far`, of the smallest sphere through one to three points and `far`.
fn circumcentre(points: &[DVec3], far: DVec3) -> Option<DVec3> {
    let centre = match *points {
        [a] => 0.5 * (a - far),
        [a, b] => {
            let (u, v) = (a - far, b - far);
            let normal = u.cross(v);
            (u.length_squared() * v.cross(normal) + v.length_squared() * normal.cross(u))
                / (2.0 * normal.length_squared())
        }
        [a, b, c] => {
            let (u, v, w) = (a - far, b - far, c - far);
            (u.length_squared() * v.cross(w)
                + v.length_squared() * w.cross(u)
                + w.length_squared() * u.cross(v))
                / (2.0 * u.dot(v.cross(w)))
        }
        _ => return None,
    };
    // Points on a line or plane have none.
    centre.is_finite().then_some(centre)
}
