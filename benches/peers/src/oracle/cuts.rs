//! Two hulls of any number of points, by cutting planes.

use super::Truth;
use glam::{DVec2, DVec3};

/// More rounds than any pair of hulls has taken; running out is a fault of this file.
const ROUNDS: usize = 500;

/// A difference of points, one of each hull, as it is seen along the motion:
/// its place across and its height against the motion.
#[derive(Debug, Clone, Copy)]
struct Difference {
    place: DVec2,
    height: f64,
}

/// When the hull of `a` meets that of `b`.
///
/// The ray from the origin against the motion meets the hull of all differences
/// `a − b`. Of these, some are collected: where the ray leaves the collected ones'
/// hull is found by trying every three of them, then the plane through the best
/// three is asked whether any difference lies beyond it; that one is collected next.
/// When none does, the plane supports the whole and the three are the answer.
///
/// # Panics
/// If it does not come to an end.
pub fn truth(a: &[DVec3], b: &[DVec3], motion: DVec3) -> Truth {
    let length = motion.length();
    let up = motion / length;
    let (x, y) = up.any_orthonormal_pair();
    let size = a.iter().chain(b).map(|p| p.length()).fold(0.0, f64::max);
    let farthest = |axis: DVec3| {
        let best = |points: &[DVec3], axis: DVec3| {
            let along = |p: &&DVec3, q: &&DVec3| axis.dot(**p).total_cmp(&axis.dot(**q));
            points.iter().max_by(along).copied().unwrap_or_default()
        };
        let difference = best(a, axis) - best(b, -axis);
        Difference {
            place: DVec2::new(x.dot(difference), y.dot(difference)),
            height: up.dot(difference),
        }
    };
    let mut known: Vec<Difference> = [x, y, -x, -y].map(farthest).to_vec();
    let mut best: Option<Plane> = None;
    let mut done = 0;
    for _ in 0..ROUNDS {
        while done < known.len() {
            for i in 0..done {
                for j in 0..i {
                    let plane = Plane::above_origin([known[j], known[i], known[done]]);
                    if let Some(plane) = plane
                        && best.is_none_or(|best| plane.height > best.height)
                    {
                        best = Some(plane);
                    }
                }
            }
            done += 1;
        }
        let next = if let Some(plane) = best {
            let normal = (up - plane.slope.x * x - plane.slope.y * y).normalize();
            let next = farthest(normal);
            let rise = next.height - (plane.height + plane.slope.dot(next.place));
            // In metres along the motion, at the plane's slope.
            if rise <= 1e-14 * size * (1.0 + plane.slope.length()) {
                return plane.truth(-normal, length);
            }
            next
        } else {
            let nearest = nearest_to_origin(&known);
            let away = nearest.normalize_or_zero();
            let next = farthest(-(away.x * x + away.y * y));
            let apart = away.dot(next.place);
            if apart > 0.0 {
                return Truth::Clear { margin: apart };
            }
            if away == DVec2::ZERO || apart >= nearest.length() - 1e-15 * size {
                return Truth::Clear { margin: 0.0 };
            }
            next
        };
        known.push(next);
    }
    panic!("the cutting planes come to no end");
}

/// The plane through three differences that surround the origin.
#[derive(Debug, Clone, Copy)]
struct Plane {
    /// Over the origin.
    height: f64,
    slope: DVec2,
    /// How far the origin is from the triangle's sides.
    inside: f64,
}

impl Plane {
    fn above_origin(corners: [Difference; 3]) -> Option<Self> {
        let [p, q, r] = corners.map(|corner| corner.place);
        let area = (q - p).perp_dot(r - p);
        let weights = [q.perp_dot(r), r.perp_dot(p), p.perp_dot(q)].map(|part| part / area);
        if area == 0.0
            || weights
                .iter()
                .any(|&weight| weight.is_nan() || weight < 0.0)
        {
            return None;
        }
        let heights = corners.map(|corner| corner.height);
        let (up_q, up_r) = (heights[1] - heights[0], heights[2] - heights[0]);
        let slope = DVec2::new(
            up_q * (r - p).y - up_r * (q - p).y,
            up_r * (q - p).x - up_q * (r - p).x,
        ) / area;
        let sides = [(q, r), (r, p), (p, q)];
        let inside = sides.map(|(from, to)| from.perp_dot(to).abs() / (to - from).length());
        Some(Self {
            height: weights.iter().zip(heights).map(|(w, h)| w * h).sum(),
            slope,
            inside: inside.into_iter().fold(f64::INFINITY, f64::min),
        })
    }

    fn truth(&self, normal: DVec3, length: f64) -> Truth {
        let fraction = -self.height / length;
        if (0.0..=1.0).contains(&fraction) {
            return Truth::Hit {
                fraction,
                normal,
                margin: self.inside.min((1.0 - fraction) * length),
            };
        }
        Truth::Clear {
            margin: ((fraction - 1.0) * length).max(0.0),
        }
    }
}

/// Of the hull of places that do not surround the origin.
fn nearest_to_origin(known: &[Difference]) -> DVec2 {
    let mut nearest = known[0].place;
    for (number, from) in known.iter().enumerate() {
        for to in &known[..number] {
            let side = to.place - from.place;
            let share = -from.place.dot(side) / side.length_squared();
            let share = if share.is_nan() { 0.0 } else { share };
            let point = from.place + share.clamp(0.0, 1.0) * side;
            if point.length_squared() < nearest.length_squared() {
                nearest = point;
            }
        }
    }
    nearest
}
