//! The answers by brute force, in numbers of 32 digits.

use crate::twofold::{Twofold, Vector, cross, dot, sub, vector};
use feeler::Ray;
use glam::DVec3;

/// What the whole line does to a solid: fractions in and out.
pub(crate) type Span = Option<(f64, f64)>;

/// `|origin + f · direction|² = radius²`, by the school formula.
pub(crate) fn sphere(ray: &Ray, radius: f64) -> Span {
    let (origin, direction) = (vector(ray.origin), vector(ray.direction));
    let a = dot(direction, direction);
    let b = dot(origin, direction);
    let c = dot(origin, origin) - Twofold::from(radius) * Twofold::from(radius);
    let discriminant = b * b - a * c;
    if discriminant.negative() {
        return None;
    }
    let root = discriminant.sqrt();
    Some((((-b - root) / a).0, ((-b + root) / a).0))
}

/// Every triangle by itself; the line of a closed convex surface enters at the
/// first and leaves at the last. Triangles in the line's plane are left to
/// their neighbours.
pub(crate) fn triangles(ray: &Ray, triangles: impl IntoIterator<Item = [DVec3; 3]>) -> Span {
    triangles
        .into_iter()
        .filter_map(|corners| triangle(ray, corners))
        .fold(None, |span, fraction| match span {
            None => Some((fraction, fraction)),
            Some((enter, leave)) => Some((enter.min(fraction), leave.max(fraction))),
        })
}

fn triangle(ray: &Ray, corners: [DVec3; 3]) -> Option<f64> {
    let (origin, direction) = (vector(ray.origin), vector(ray.direction));
    let [a, b, c]: [Vector; 3] = corners.map(|corner| sub(vector(corner), origin));
    // Six times the volumes of the tetrahedra between the line and each edge.
    let volumes = [(a, b), (b, c), (c, a)].map(|(p, q)| dot(direction, cross(p, q)));
    let inside = volumes.iter().all(|volume| !volume.negative())
        || volumes.iter().all(|volume| !volume.positive());
    let normal = cross(sub(b, a), sub(c, a));
    let rate = dot(normal, direction);
    (inside && (rate.positive() || rate.negative())).then(|| (dot(normal, a) / rate).0)
}

/// The twelve triangles of the box between two corners.
pub(crate) fn box_triangles(min: DVec3, max: DVec3) -> Vec<[DVec3; 3]> {
    let corner = |index: usize| {
        let pick = |axis: usize| {
            if index >> axis & 1 == 1 {
                max[axis]
            } else {
                min[axis]
            }
        };
        DVec3::new(pick(0), pick(1), pick(2))
    };
    let mut all = Vec::new();
    for axis in 0..3 {
        let (u, v) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
        for base in [0, 1 << axis] {
            all.push([base, base + u, base + u + v].map(corner));
            all.push([base, base + u + v, base + v].map(corner));
        }
    }
    all
}
