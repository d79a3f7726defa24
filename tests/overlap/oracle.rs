//! The least width of a pair by trying every direction that may count.

use feeler::{Pose, Shape};
use glam::DVec3;

/// A shape as points in the frame of the pair, swollen by a radius.
pub struct Body {
    pub points: Vec<DVec3>,
    pub radius: f64,
}

pub fn body(shape: &Shape, pose: &Pose, origin: DVec3) -> Body {
    let place = |p: DVec3| (pose.position - origin) + pose.orientation * p;
    let (points, radius) = match shape {
        Shape::Sphere(sphere) => (vec![DVec3::ZERO], sphere.radius()),
        Shape::Cuboid(cuboid) => (cuboid.vertices().to_vec(), 0.0),
        Shape::Triangle(triangle) => (triangle.vertices().to_vec(), 0.0),
        Shape::Polytope(polytope) => (polytope.vertices().to_vec(), 0.0),
    };
    Body {
        points: points.into_iter().map(place).collect(),
        radius,
    }
}

/// How far `a` must move along `d` to be parted from `b`.
pub fn width(a: &Body, b: &Body, d: DVec3) -> f64 {
    let top = b.points.iter().map(|p| p.dot(d)).fold(f64::MIN, f64::max);
    let bottom = a.points.iter().map(|p| p.dot(d)).fold(f64::MAX, f64::min);
    top - bottom + a.radius + b.radius
}

fn differences(body: &Body) -> Vec<DVec3> {
    let mut all = Vec::new();
    for (i, p) in body.points.iter().enumerate() {
        for q in &body.points[..i] {
            all.push(p - q);
        }
    }
    all
}

/// The least width over every direction that may be the normal of a face, a
/// rounded edge or a rounded vertex of the Minkowski difference.
pub fn depth(a: &Body, b: &Body) -> f64 {
    let mut least = f64::MAX;
    let mut show = |d: DVec3| {
        let scale = d.abs().max_element();
        if scale > 0.0 {
            let d = (d / scale).normalize();
            least = least.min(width(a, b, d)).min(width(a, b, -d));
        }
    };
    let (edges_a, edges_b) = (differences(a), differences(b));
    for edges in [&edges_a, &edges_b] {
        for (i, e) in edges.iter().enumerate() {
            for f in &edges[..i] {
                show(e.cross(*f));
            }
        }
    }
    for e in &edges_a {
        for f in &edges_b {
            show(e.cross(*f));
        }
    }
    if a.radius + b.radius > 0.0 {
        show(DVec3::X);
        for p in &a.points {
            for q in &b.points {
                show(p - q);
            }
        }
        for (from, edges, to) in [(a, &edges_a, b), (b, &edges_b, a)] {
            for p in &from.points {
                for q in &to.points {
                    for e in edges {
                        show(e.cross((p - q).cross(*e)));
                    }
                }
            }
        }
    }
    least
}
