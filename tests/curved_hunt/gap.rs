//! How far two solids are apart where they stand.

use crate::course::Stand;
use crate::solid::Solid;
use glam::DVec3;

/// A solid where it stands.
pub(crate) struct Placed<'a> {
    solid: &'a Solid,
    stand: Stand,
    corners: Vec<DVec3>,
}

impl<'a> Placed<'a> {
    pub(crate) fn new(solid: &'a Solid, stand: Stand) -> Self {
        let corners = solid
            .corners
            .iter()
            .map(|corner| stand.point(*corner))
            .collect();
        Self {
            solid,
            stand,
            corners,
        }
    }

    fn low(&self, axis: DVec3) -> f64 {
        self.corners
            .iter()
            .map(|corner| corner.dot(axis))
            .fold(f64::MAX, f64::min)
    }

    fn triangle(&self, triangle: [usize; 3]) -> [DVec3; 3] {
        triangle.map(|corner| self.corners[corner])
    }

    /// The point's nearest one of the core and how far it is; inside, minus the depth and some point.
    fn nearest(&self, point: DVec3) -> (f64, DVec3) {
        if self.solid.is_ball() {
            return (point.distance(self.corners[0]), self.corners[0]);
        }
        let mut best = (f64::MAX, point);
        let mut inside = f64::NEG_INFINITY;
        for &corners in &self.solid.triangles {
            let [a, b, c] = self.triangle(corners);
            let normal = (b - a).cross(c - a).normalize();
            let height = normal.dot(point - a);
            inside = inside.max(height);
            // Of a closed surface only what can be seen from the point is nearest, but for rounding.
            let unseen = !self.solid.is_flat() && height < -1e-9 * self.size();
            if unseen || height.abs() >= best.0 {
                continue;
            }
            let foot = on_triangle(point, [a, b, c], normal);
            let distance = foot.distance(point);
            if distance < best.0 {
                best = (distance, foot);
            }
        }
        if !self.solid.is_flat() && inside <= 0.0 {
            return (inside, point);
        }
        best
    }

    /// From the surface, outwards positive; of a triangle never negative.
    pub(crate) fn height(&self, point: DVec3) -> f64 {
        self.nearest(point).0 - self.solid.radius
    }

    fn size(&self) -> f64 {
        self.solid.reach(DVec3::ZERO)
    }
}

fn on_segment(point: DVec3, from: DVec3, to: DVec3) -> DVec3 {
    let along = to - from;
    let share = (point - from).dot(along) / along.length_squared();
    from + share.clamp(0.0, 1.0) * along
}

fn on_triangle(point: DVec3, [a, b, c]: [DVec3; 3], normal: DVec3) -> DVec3 {
    let edges = [(a, b), (b, c), (c, a)];
    let over = |(from, to): (DVec3, DVec3)| normal.dot((to - from).cross(point - from)) >= 0.0;
    if edges.into_iter().all(over) {
        return point - normal.dot(point - a) * normal;
    }
    let mut best = a;
    for (from, to) in edges {
        let foot = on_segment(point, from, to);
        if foot.distance_squared(point) < best.distance_squared(point) {
            best = foot;
        }
    }
    best
}

/// From the second segment's nearest point to the first's, if both are inside.
fn across([a, b]: [DVec3; 2], [c, d]: [DVec3; 2]) -> Option<DVec3> {
    let (p, q, r) = (b - a, d - c, a - c);
    let (pp, qq, pq) = (p.dot(p), q.dot(q), p.dot(q));
    let (pr, qr) = (p.dot(r), q.dot(r));
    let volume = pp * qq - pq * pq;
    let (s, t) = ((pq * qr - qq * pr) / volume, (pp * qr - pq * pr) / volume);
    let inside = |share: f64| (0.0..=1.0).contains(&share);
    (inside(s) && inside(t)).then(|| r + s * p - t * q)
}

/// How far all of `a` lies above all of `b` along a unit vector.
pub(crate) fn gap(a: &Placed<'_>, b: &Placed<'_>, axis: DVec3) -> f64 {
    a.low(axis) + b.low(-axis) - a.solid.radius - b.solid.radius
}

/// The widest gap along normals of faces and across edges, and along what: as long as it is above
/// zero the two are apart, and else they are not.
pub(crate) fn widest(a: &Placed<'_>, b: &Placed<'_>) -> (f64, DVec3) {
    let mut widest = (f64::NEG_INFINITY, DVec3::X);
    let mut show = |axis: DVec3| {
        for axis in [axis, -axis] {
            let gap = gap(a, b, axis);
            if gap > widest.0 {
                widest = (gap, axis);
            }
        }
    };
    for solid in [a, b] {
        for normal in &solid.solid.normals {
            show(solid.stand.turned * *normal);
        }
    }
    let directions = |solid: &Placed<'_>| -> Vec<DVec3> {
        let turned = solid.stand.turned;
        solid
            .solid
            .directions
            .iter()
            .map(|along| turned * *along)
            .collect()
    };
    let (of_a, of_b) = (directions(a), directions(b));
    for along in &of_a {
        for other in &of_b {
            let axis = along.cross(*other);
            if axis.length() > 1e-9 {
                show(axis.normalize());
            }
        }
    }
    widest
}

/// A lower bound of the distance, as a rule the distance itself, and the direction out of `b`; zero or
/// less if they touch or overlap.
pub(crate) fn apart(a: &Placed<'_>, b: &Placed<'_>) -> (f64, DVec3) {
    if a.solid.is_ball() || b.solid.is_ball() {
        let (ball, other, sign) = if a.solid.is_ball() {
            (a, b, 1.0)
        } else {
            (b, a, -1.0)
        };
        let centre = ball.corners[0];
        let (distance, foot) = other.nearest(centre);
        let normal = (centre - foot).normalize_or(DVec3::X);
        return (
            distance - ball.solid.radius - other.solid.radius,
            sign * normal,
        );
    }
    let mut least = f64::MAX;
    let mut way = DVec3::ZERO;
    for (points, solid, sign) in [(a, b, 1.0), (b, a, -1.0)] {
        for &corner in &points.corners {
            let (distance, foot) = solid.nearest(corner);
            if distance < least {
                (least, way) = (distance, sign * (corner - foot));
            }
        }
    }
    if least > 0.0 {
        for edge in &a.solid.edges {
            let edge = edge.map(|corner| a.corners[corner]);
            let (middle, half) = (0.5 * (edge[0] + edge[1]), 0.5 * edge[0].distance(edge[1]));
            for other in &b.solid.edges {
                let other = other.map(|corner| b.corners[corner]);
                let between = middle.distance(0.5 * (other[0] + other[1]));
                if between - half - 0.5 * other[0].distance(other[1]) >= least {
                    continue;
                }
                if let Some(offset) = across(edge, other)
                    && offset.length() < least
                {
                    (least, way) = (offset.length(), offset);
                }
            }
        }
        // Where they overlap, nothing is above everything along what parts the nearest features.
        let normal = way.normalize_or(DVec3::X);
        let seen = gap(a, b, normal);
        if least > 1e-6 * (a.size() + b.size()) && seen > 0.999 * least {
            return (seen, normal);
        }
    }
    widest(a, b)
}
