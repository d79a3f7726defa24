//! Distances by trying every pair of vertex, edge and triangle.

use feeler::{Feature, Pose, Shape};
use glam::DVec3;

/// A shape as points and triangles in the frame of the pair, swollen by a radius.
pub struct Body {
    pub points: Vec<DVec3>,
    triangles: Vec<[usize; 3]>,
    edges: Vec<[usize; 2]>,
    /// The edges a caller may name; the others are diagonals.
    named: Vec<[usize; 2]>,
    faces: Vec<Vec<usize>>,
    pub radius: f64,
}

pub fn body(shape: &Shape, pose: &Pose, origin: DVec3) -> Body {
    let place = |p: DVec3| (pose.position - origin) + pose.orientation * p;
    let (mut points, mut radius, mut triangles) = (vec![DVec3::ZERO], 0.0, Vec::new());
    let (mut named, mut faces) = (Vec::new(), Vec::new());
    match shape {
        Shape::Sphere(sphere) => radius = sphere.radius(),
        Shape::Cuboid(cuboid) => {
            points = cuboid.vertices().to_vec();
            // Bits of a number are sides: −x, +x, −y, +y, −z, +z.
            for axis in 0..3 {
                let (u, v) = ([1, 0, 0][axis], [2, 2, 1][axis]);
                for side in 0..2 {
                    let corner = |i: usize, j: usize| side << axis | i << u | j << v;
                    let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                    triangles.extend([[a, b, c], [a, c, d]]);
                    faces.push(vec![a, b, c, d]);
                }
                for (j, i) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    let from = i << u | j << v;
                    named.push([from, from | 1 << axis]);
                }
            }
        }
        Shape::Triangle(triangle) => {
            points = triangle.vertices().to_vec();
            triangles = vec![[0, 1, 2]];
            named = vec![[0, 1], [1, 2], [2, 0]];
            faces = vec![vec![0, 1, 2]; 2];
        }
        Shape::Polytope(polytope) => {
            points = polytope.vertices().to_vec();
            triangles = (polytope.triangles().iter())
                .map(|t| t.map(|v| v as usize))
                .collect();
            named = (polytope.edges().iter())
                .map(|edge| edge.vertices.map(|v| v as usize))
                .collect();
            faces = (polytope.faces())
                .map(|face| face.vertices.iter().map(|&v| v as usize).collect())
                .collect();
        }
    }
    let mut edges = Vec::new();
    for &[i, j, k] in &triangles {
        edges.extend([[i, j], [j, k], [k, i]]);
    }
    Body {
        points: points.into_iter().map(place).collect(),
        triangles,
        edges,
        named,
        faces,
        radius,
    }
}

/// The nearest points of two cores and their distance.
#[derive(Clone, Copy)]
pub struct Nearest {
    pub distance: f64,
    pub on_a: DVec3,
    pub on_b: DVec3,
}

fn on_segment(point: DVec3, from: DVec3, to: DVec3) -> DVec3 {
    let along = to - from;
    let share = (point - from).dot(along) / along.length_squared();
    if share <= 0.0 {
        from
    } else if share >= 1.0 {
        to
    } else {
        // From the nearer end.
        if share < 0.5 {
            from + share * along
        } else {
            to - (1.0 - share) * along
        }
    }
}

/// The foot of a point on a triangle's plane, if it lies in the triangle.
fn foot_in(point: DVec3, [a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    let normal = (b - a).cross(c - a);
    let unit = normal.normalize();
    let foot = point - unit.dot(point - a) * unit;
    let inside = [(a, b), (b, c), (c, a)]
        .into_iter()
        .all(|(from, to)| normal.dot((to - from).cross(foot - from)) >= 0.0);
    inside.then_some(foot)
}

/// From a point to a body's surface.
pub fn from_surface(point: DVec3, body: &Body) -> f64 {
    let mut least = (body.points.iter())
        .map(|p| (p.distance(point) - body.radius).abs())
        .fold(f64::MAX, f64::min);
    for &[i, j] in &body.edges {
        let foot = on_segment(point, body.points[i], body.points[j]);
        least = least.min(foot.distance(point));
    }
    for triangle in &body.triangles {
        if let Some(foot) = foot_in(point, triangle.map(|i| body.points[i])) {
            least = least.min(foot.distance(point));
        }
    }
    least
}

/// The nearest points of two cores that do not overlap.
pub fn nearest(a: &Body, b: &Body) -> Nearest {
    let mut best = Nearest {
        distance: f64::MAX,
        on_a: DVec3::ZERO,
        on_b: DVec3::ZERO,
    };
    let mut show = |on_a: DVec3, on_b: DVec3| {
        let distance = on_a.distance(on_b);
        if distance < best.distance {
            best = Nearest {
                distance,
                on_a,
                on_b,
            };
        }
    };
    for &p in &a.points {
        for &q in &b.points {
            show(p, q);
        }
        for &[i, j] in &b.edges {
            show(p, on_segment(p, b.points[i], b.points[j]));
        }
        for triangle in &b.triangles {
            if let Some(foot) = foot_in(p, triangle.map(|i| b.points[i])) {
                show(p, foot);
            }
        }
    }
    for &q in &b.points {
        for &[i, j] in &a.edges {
            show(on_segment(q, a.points[i], a.points[j]), q);
        }
        for triangle in &a.triangles {
            if let Some(foot) = foot_in(q, triangle.map(|i| a.points[i])) {
                show(foot, q);
            }
        }
    }
    for &[i, j] in &a.edges {
        for &[k, l] in &b.edges {
            let (p, u) = (a.points[i], a.points[j] - a.points[i]);
            let (q, v) = (b.points[k], b.points[l] - b.points[k]);
            let normal = u.cross(v);
            // Parallel edges are nearest at an end, which was tried.
            if normal.length_squared() < 1e-26 * u.length_squared() * v.length_squared() {
                continue;
            }
            let share = (q - p).cross(v).dot(normal) / normal.length_squared();
            let mut on_a = p + share.clamp(0.0, 1.0) * u;
            let mut on_b = on_segment(on_a, q, q + v);
            for _ in 0..2 {
                on_a = on_segment(on_b, p, p + u);
                on_b = on_segment(on_a, q, q + v);
            }
            show(on_a, on_b);
        }
    }
    best
}

/// How far two bodies are apart along a direction out of `b`, to `a`.
pub fn gap(a: &Body, b: &Body, normal: DVec3) -> f64 {
    let top = b
        .points
        .iter()
        .map(|p| p.dot(normal))
        .fold(f64::MIN, f64::max);
    let bottom = a
        .points
        .iter()
        .map(|p| p.dot(normal))
        .fold(f64::MAX, f64::min);
    bottom - top - a.radius - b.radius
}

/// How far the farthest point along `direction` lies beyond the lowest of a feature's vertices,
/// and how far `point` lies from the feature, if it has no area.
pub fn feature(body: &Body, feature: Feature, direction: DVec3, point: DVec3) -> (f64, f64) {
    let top = body
        .points
        .iter()
        .map(|p| p.dot(direction))
        .fold(f64::MIN, f64::max);
    let below = |vertices: &[usize]| {
        let heights = vertices.iter().map(|&v| body.points[v].dot(direction));
        top - heights.fold(f64::MAX, f64::min)
    };
    match feature {
        Feature::Vertex(v) => {
            let v = v as usize;
            (below(&[v]), body.points[v].distance(point))
        }
        Feature::Edge(edge) => {
            let [i, j] = body.named[edge as usize];
            let foot = on_segment(point, body.points[i], body.points[j]);
            (below(&[i, j]), foot.distance(point))
        }
        Feature::Face(face) => (below(&body.faces[face as usize]), 0.0),
        Feature::Surface => (0.0, (body.points[0].distance(point) - body.radius).abs()),
    }
}
