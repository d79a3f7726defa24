//! First contact of two shapes in straight relative motion, slowly and obviously.
//!
//! Balls: the quadratic. Ball against facets: the distance to all triangles,
//! which is convex in time, so that a ternary search finds the closest moment
//! and bisection the first touch before it. Facets against facets: every vertex
//! against every triangle both ways, and every edge against every edge.

use feeler::{Pose, Shape};
use glam::{DVec2, DVec3};

pub(crate) enum Solid {
    Ball(DVec3, f64),
    Facets {
        points: Vec<DVec3>,
        triangles: Vec<[usize; 3]>,
    },
}

impl Solid {
    pub(crate) fn of(shape: &Shape, pose: &Pose) -> Self {
        match shape {
            Shape::Sphere(sphere) => Self::Ball(pose.position, sphere.radius()),
            Shape::Cuboid(cuboid) => {
                let half = cuboid.half_extents();
                let points = (0..8)
                    .map(|corner: i32| {
                        let sign = |bit: i32| if corner >> bit & 1 == 1 { 1.0 } else { -1.0 };
                        pose.point(half * DVec3::new(sign(0), sign(1), sign(2)))
                    })
                    .collect();
                let quads = [
                    [0, 1, 3, 2],
                    [4, 5, 7, 6],
                    [0, 1, 5, 4],
                    [2, 3, 7, 6],
                    [0, 2, 6, 4],
                    [1, 3, 7, 5],
                ];
                let triangles = quads
                    .iter()
                    .flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]])
                    .collect();
                Self::Facets { points, triangles }
            }
            Shape::Triangle(triangle) => Self::Facets {
                points: triangle.vertices().map(|v| pose.point(v)).to_vec(),
                triangles: vec![[0, 1, 2]],
            },
            Shape::Polytope(polytope) => Self::Facets {
                points: polytope.vertices().iter().map(|&v| pose.point(v)).collect(),
                triangles: polytope
                    .triangles()
                    .iter()
                    .map(|t| t.map(|v| v as usize))
                    .collect(),
            },
        }
    }

    fn radius(&self) -> f64 {
        match self {
            Self::Ball(_, radius) => *radius,
            Self::Facets { .. } => 0.0,
        }
    }

    fn points(&self) -> Vec<DVec3> {
        match self {
            Self::Ball(centre, _) => vec![*centre],
            Self::Facets { points, .. } => points.clone(),
        }
    }

    fn edges(&self) -> Vec<(DVec3, DVec3)> {
        match self {
            Self::Ball(..) => Vec::new(),
            Self::Facets { points, triangles } => triangles
                .iter()
                .flat_map(|t| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])])
                .map(|(i, j)| (points[i], points[j]))
                .collect(),
        }
    }

    fn faces(&self) -> Vec<[DVec3; 3]> {
        match self {
            Self::Ball(..) => Vec::new(),
            Self::Facets { points, triangles } => {
                triangles.iter().map(|t| t.map(|i| points[i])).collect()
            }
        }
    }

    /// Whether a point is behind the planes of all triangles; none is behind a single one.
    fn holds(&self, point: DVec3) -> bool {
        let points = self.points();
        let middle = points.iter().sum::<DVec3>() / points.len() as f64;
        self.faces().len() > 1
            && self.faces().into_iter().all(|[a, b, c]| {
                let normal = (b - a).cross(c - a);
                normal.dot(point - a) * normal.dot(middle - a) > 0.0
            })
    }

    /// Distance of a point from the solid, in metres.
    fn gap(&self, point: DVec3) -> f64 {
        if self.holds(point) {
            0.0
        } else {
            self.distance(point)
        }
    }

    /// Distance of a point from the surface, in metres; of a ball's, with its sign.
    pub(crate) fn distance(&self, point: DVec3) -> f64 {
        match self {
            Self::Ball(centre, radius) => centre.distance(point) - radius,
            Self::Facets { .. } => self
                .faces()
                .into_iter()
                .map(|face| point.distance(closest(face, point)))
                .fold(f64::INFINITY, f64::min),
        }
    }
}

fn closest([a, b, c]: [DVec3; 3], p: DVec3) -> DVec3 {
    let normal = (b - a).cross(c - a).normalize();
    let foot = p - normal * normal.dot(p - a);
    let inside = [(a, b), (b, c), (c, a)]
        .iter()
        .all(|&(from, to)| (to - from).cross(foot - from).dot(normal) >= 0.0);
    if inside {
        return foot;
    }
    [(a, b), (b, c), (c, a)]
        .into_iter()
        .map(|(from, to)| {
            let along = to - from;
            from + ((p - from).dot(along) / along.length_squared()).clamp(0.0, 1.0) * along
        })
        .min_by(|x, y| x.distance(p).total_cmp(&y.distance(p)))
        .unwrap()
}

/// The share of `motion` (of `a`, `b` standing) after which the two touch first;
/// they must be apart as it begins.
pub(crate) fn first_touch(a: &Solid, b: &Solid, motion: DVec3) -> Option<f64> {
    match (a, b) {
        (Solid::Ball(from, ra), Solid::Ball(to, rb)) => balls(*to - *from, motion, ra + rb),
        (Solid::Ball(centre, radius), facets) => ball_facets(*centre, *radius, facets, motion),
        (facets, Solid::Ball(centre, radius)) => ball_facets(*centre, *radius, facets, -motion),
        _ => facets(a, b, motion),
    }
    .filter(|t| (0.0..=1.0).contains(t))
}

fn balls(between: DVec3, motion: DVec3, reach: f64) -> Option<f64> {
    let length = motion.length();
    let ahead = between.dot(motion) / length;
    let aside = between.cross(motion).length() / length;
    if aside > reach {
        return None;
    }
    Some((ahead - ((reach - aside) * (reach + aside)).sqrt()) / length)
}

fn ball_facets(centre: DVec3, radius: f64, facets: &Solid, motion: DVec3) -> Option<f64> {
    let gap = |t: f64| facets.gap(centre + t * motion) - radius;
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..200 {
        let (p, q) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        let (gap_p, gap_q) = (gap(p), gap(q));
        if gap_p <= 0.0 {
            (low, high) = (p, p);
            break;
        }
        if gap_q <= 0.0 {
            (low, high) = (q, q);
            break;
        }
        if gap_p < gap_q {
            high = q;
        } else {
            low = p;
        }
    }
    let touching = 0.5 * (low + high);
    if gap(touching) > 0.0 {
        return None;
    }
    let (mut apart, mut touching) = (0.0, touching);
    for _ in 0..100 {
        let middle = 0.5 * (apart + touching);
        if gap(middle) > 0.0 {
            apart = middle;
        } else {
            touching = middle;
        }
    }
    Some(touching)
}

fn facets(a: &Solid, b: &Solid, motion: DVec3) -> Option<f64> {
    let mut first = f64::INFINITY;
    for (points, faces, motion) in [
        (a.points(), b.faces(), motion),
        (b.points(), a.faces(), -motion),
    ] {
        for &point in &points {
            for face in &faces {
                if let Some(t) = point_face(point, *face, motion) {
                    first = first.min(t);
                }
            }
        }
    }
    for (p, q) in a.edges() {
        for &(r, s) in &b.edges() {
            if let Some(t) = edge_edge((p, q), (r, s), motion) {
                first = first.min(t);
            }
        }
    }
    first.is_finite().then_some(first)
}

fn point_face(point: DVec3, [a, b, c]: [DVec3; 3], motion: DVec3) -> Option<f64> {
    // Signed volumes tell on which side of each edge the line passes.
    let (a, b, c) = (a - point, b - point, c - point);
    let (u, v, w) = (
        c.cross(b).dot(motion),
        a.cross(c).dot(motion),
        b.cross(a).dot(motion),
    );
    let same = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
    let normal = (b - a).cross(c - a);
    let t = a.dot(normal) / motion.dot(normal);
    (same && t >= 0.0).then_some(t)
}

fn edge_edge((p, q): (DVec3, DVec3), (r, s): (DVec3, DVec3), motion: DVec3) -> Option<f64> {
    // p + i (q − p) + t motion = r + j (s − r)
    let (u, v) = (q - p, s - r);
    let determinant = u.cross(v).dot(motion);
    let w = r - p;
    let i = w.cross(v).dot(motion) / determinant;
    let j = w.cross(u).dot(motion) / determinant;
    let t = w.dot(u.cross(v)) / determinant;
    ((0.0..=1.0).contains(&i) && (0.0..=1.0).contains(&j) && t >= 0.0).then_some(t)
}

/// How far, in metres, one of the two must be shifted across the motion for
/// their shadows to part; negative if they are apart by at least so much.
pub(crate) fn shadow_depth(a: &Solid, b: &Solid, motion: DVec3) -> f64 {
    let z = motion.normalize();
    let x = z.any_orthonormal_vector();
    let y = z.cross(x);
    let flat = |p: DVec3| DVec2::new(p.dot(x), p.dot(y));
    let origin = a.points()[0];
    let project = |solid: &Solid| -> Vec<DVec2> {
        solid.points().iter().map(|&p| flat(p - origin)).collect()
    };
    let (points_a, points_b) = (project(a), project(b));
    let mut axes = Vec::new();
    for (p, q) in a.edges().into_iter().chain(b.edges()) {
        axes.push(flat(q - p).perp());
    }
    if a.radius() + b.radius() > 0.0 {
        for p in &points_a {
            axes.extend(points_b.iter().map(|q| *q - *p));
        }
    }
    let reach = a.radius() + b.radius();
    let mut least = f64::INFINITY;
    for axis in axes.into_iter().filter_map(DVec2::try_normalize) {
        let range = |points: &[DVec2]| {
            points
                .iter()
                .map(|p| p.dot(axis))
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| {
                    (low.min(at), high.max(at))
                })
        };
        let ((min_a, max_a), (min_b, max_b)) = (range(&points_a), range(&points_b));
        least = least.min((max_a - min_b).min(max_b - min_a) + reach);
    }
    least
}
