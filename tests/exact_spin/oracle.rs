//! Whether and when two moving bodies meet, by looking often: slow and obvious.

use feeler::{Body, Shape};
use glam::DVec3;

/// A body's corners, face normals and edges where it stands, seen from some origin.
struct Solid {
    corners: Vec<DVec3>,
    normals: Vec<DVec3>,
    edges: Vec<DVec3>,
    triangles: Vec<[DVec3; 3]>,
    radius: f64,
}

fn solid(body: &Body, time: f64, origin: DVec3) -> Solid {
    let pose = body.pose_after(time);
    let place = |p: DVec3| (pose.position - origin) + pose.orientation * p;
    let (mut corners, mut faces, mut radius) = (vec![DVec3::ZERO], Vec::new(), 0.0);
    match body.shape() {
        Shape::Sphere(sphere) => radius = sphere.radius(),
        Shape::Cuboid(cuboid) => {
            corners = cuboid.vertices().to_vec();
            for [a, b, c, d] in [
                [0, 2, 6, 4],
                [1, 3, 7, 5],
                [0, 1, 5, 4],
                [2, 3, 7, 6],
                [0, 1, 3, 2],
                [4, 5, 7, 6],
            ] {
                faces.extend([[a, b, c], [a, c, d]]);
            }
        }
        Shape::Triangle(triangle) => {
            corners = triangle.vertices().to_vec();
            faces = vec![[0, 1, 2]];
        }
        Shape::Polytope(polytope) => {
            corners = polytope.vertices().to_vec();
            faces = (polytope.triangles().iter())
                .map(|t| t.map(|v| v as usize))
                .collect();
        }
    }
    let corners: Vec<DVec3> = corners.into_iter().map(place).collect();
    let triangles: Vec<[DVec3; 3]> = faces.iter().map(|f| f.map(|v| corners[v])).collect();
    let normals = triangles
        .iter()
        .map(|[a, b, c]| (b - a).cross(c - a).normalize())
        .collect();
    let edges = triangles
        .iter()
        .flat_map(|&[a, b, c]| [b - a, c - b, a - c])
        .map(DVec3::normalize)
        .collect();
    Solid {
        corners,
        normals,
        edges,
        triangles,
        radius,
    }
}

/// How far `a` is above `b` along a unit vector.
fn gap(a: &Solid, b: &Solid, axis: DVec3) -> f64 {
    let low = a
        .corners
        .iter()
        .map(|c| c.dot(axis))
        .fold(f64::MAX, f64::min);
    let high = b
        .corners
        .iter()
        .map(|c| c.dot(axis))
        .fold(f64::MIN, f64::max);
    low - high - a.radius - b.radius
}

fn on_segment(point: DVec3, from: DVec3, to: DVec3) -> f64 {
    let along = to - from;
    let share = (point - from).dot(along) / along.length_squared();
    (from + share.clamp(0.0, 1.0) * along).distance(point)
}

/// From a point to a solid; negative inside.
fn from_point(point: DVec3, body: &Solid) -> f64 {
    if body.triangles.is_empty() {
        return point.distance(body.corners[0]);
    }
    let middle = body.corners.iter().sum::<DVec3>() / body.corners.len() as f64;
    let mut inside = f64::NEG_INFINITY;
    let mut least = f64::MAX;
    for (&[a, b, c], normal) in body.triangles.iter().zip(&body.normals) {
        let side = if normal.dot(a - middle) < 0.0 {
            -1.0
        } else {
            1.0
        };
        let height = normal.dot(point - a);
        inside = inside.max(side * height);
        let over = [(a, b), (b, c), (c, a)]
            .into_iter()
            .all(|(from, to)| normal.dot((to - from).cross(point - from)) >= 0.0);
        if over {
            least = least.min(height.abs());
        }
        for (from, to) in [(a, b), (b, c), (c, a)] {
            least = least.min(on_segment(point, from, to));
        }
    }
    if body.triangles.len() > 1 && inside < 0.0 {
        inside
    } else {
        least
    }
}

/// Positive if the two are apart, negative if they overlap, and continuous: of balls the distance, of
/// others the widest gap along the normals of faces and across edges.
fn between(a: &Solid, b: &Solid) -> f64 {
    if a.triangles.is_empty() {
        return from_point(a.corners[0], b) - a.radius - b.radius;
    }
    if b.triangles.is_empty() {
        return from_point(b.corners[0], a) - a.radius - b.radius;
    }
    let mut widest = f64::NEG_INFINITY;
    let mut show = |axis: DVec3| widest = widest.max(gap(a, b, axis)).max(gap(b, a, axis));
    for &normal in a.normals.iter().chain(&b.normals) {
        show(normal);
    }
    for &along in &a.edges {
        for &other in &b.edges {
            let axis = along.cross(other);
            if axis.length() > 1e-6 {
                show(axis.normalize());
            }
        }
    }
    // A triangle lies in a plane: seen edge on it has an outline.
    for (body, flat) in [(a, a.triangles.len() == 1), (b, b.triangles.len() == 1)] {
        if flat {
            for &edge in &body.edges {
                show(edge.cross(body.normals[0]));
            }
        }
    }
    widest
}

/// What `between` says of two bodies at a time.
pub(crate) fn apart(a: &Body, b: &Body, time: f64) -> f64 {
    let origin = b.pose_after(time).position;
    between(&solid(a, time, origin), &solid(b, time, origin))
}

/// How far two bodies are apart along `normal`, and how far a point is from either.
pub(crate) fn witness(
    a: &Body,
    b: &Body,
    time: f64,
    normal: DVec3,
    point: DVec3,
) -> (f64, [f64; 2]) {
    let origin = b.pose_after(time).position;
    let (a, b) = (solid(a, time, origin), solid(b, time, origin));
    let off = |body: &Solid| from_point(point - origin, body) - body.radius;
    (gap(&a, &b, normal), [off(&a), off(&b)])
}

/// The times at which two bodies are nearest, as far as dense samples and what lies about them
/// tell, and the first at which they meet.
pub(crate) struct Look {
    /// The first meeting.
    pub(crate) meets: Option<f64>,
    /// Least of `apart` up to some time.
    samples: Vec<(f64, f64)>,
}

impl Look {
    /// `speed` is an upper bound on how fast points approach each other.
    pub(crate) fn at(a: &Body, b: &Body, horizon: f64, count: usize, speed: f64) -> Self {
        let step = horizon / count as f64;
        let apart = |time: f64| apart(a, b, time);
        let mut samples = Vec::with_capacity(count + 1);
        let mut index = 0;
        while index <= count {
            let time = index as f64 * step;
            let here = apart(time);
            samples.push((time, here));
            // Nothing can happen before this many samples more.
            let skip = (here / (speed * step)).floor() as usize;
            index += if here > 0.0 { skip.max(1) } else { 1 };
            if here <= 0.0 && samples.len() > 1 {
                break;
            }
        }
        // Dips between samples.
        let mut dips = Vec::new();
        for window in samples.windows(2) {
            let [(from, left), (to, right)] = [window[0], window[1]];
            if left > 0.0 && right > 0.0 && left.min(right) < speed * (to - from) {
                dips.push(dip(&apart, from, to));
            }
        }
        for window in samples.windows(3) {
            let (from, to) = (window[0].0, window[2].0);
            if window[1].1 <= window[0].1.min(window[2].1) && to - from < 2.5 * step {
                dips.push(dip(&apart, from, to));
            }
        }
        samples.extend(dips);
        samples.sort_by(|a, b| a.0.total_cmp(&b.0));
        let hit = samples.iter().position(|&(_, apart)| apart <= 0.0);
        let meets = hit.map(|hit| {
            if hit == 0 {
                return 0.0;
            }
            let (mut low, mut high) = (samples[hit - 1].0, samples[hit].0);
            for _ in 0..100 {
                let middle = 0.5 * (low + high);
                if apart(middle) <= 0.0 {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            high
        });
        Self { meets, samples }
    }

    /// The least of `apart` up to a time.
    pub(crate) fn least_until(&self, time: f64) -> f64 {
        let seen = self.samples.iter().filter(|sample| sample.0 <= time);
        seen.map(|sample| sample.1).fold(f64::MAX, f64::min)
    }
}

/// Golden sections.
fn dip(apart: &impl Fn(f64) -> f64, mut from: f64, mut to: f64) -> (f64, f64) {
    const SHARE: f64 = 0.618_033_988_749_894_9;
    let (mut c, mut d) = (to - SHARE * (to - from), from + SHARE * (to - from));
    let (mut at_c, mut at_d) = (apart(c), apart(d));
    for _ in 0..40 {
        if at_c < at_d {
            (to, d, at_d) = (d, c, at_c);
            c = to - SHARE * (to - from);
            at_c = apart(c);
        } else {
            (from, c, at_c) = (c, d, at_d);
            d = from + SHARE * (to - from);
            at_d = apart(d);
        }
    }
    if at_c < at_d { (c, at_c) } else { (d, at_d) }
}
