//! One pair, how to make it at random, and all that must hold of it.

use crate::oracle;
use feeler::narrow_phase::distance::{ClosestPoints, closest_points};
use feeler::{Cuboid, Polytope, Pose, Shape, Sphere, Triangle};
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;

pub fn unit_float(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

pub fn signed(rng: &mut ChaCha8Rng) -> f64 {
    2.0 * unit_float(rng) - 1.0
}

pub fn log_uniform(rng: &mut ChaCha8Rng, from: f64, to: f64) -> f64 {
    from * (to / from).powf(unit_float(rng))
}

pub fn vector(rng: &mut ChaCha8Rng) -> DVec3 {
    DVec3::new(signed(rng), signed(rng), signed(rng))
}

pub fn direction(rng: &mut ChaCha8Rng) -> DVec3 {
    loop {
        let v = vector(rng);
        if (0.1..1.0).contains(&v.length()) {
            return v.normalize();
        }
    }
}

pub fn turn(rng: &mut ChaCha8Rng) -> DQuat {
    DQuat::from_axis_angle(direction(rng), std::f64::consts::TAU * unit_float(rng))
}

pub const KINDS: usize = 4;

/// A shape of some `scale`; `stretch` squeezes it along its axes.
pub fn shape(rng: &mut ChaCha8Rng, kind: usize, scale: f64, stretch: DVec3) -> Shape {
    match kind {
        0 => Sphere::new(scale).unwrap().into(),
        1 => Cuboid::new(scale * stretch * (0.6 + 0.4 * vector(rng).abs()))
            .unwrap()
            .into(),
        2 => loop {
            let corner = |rng: &mut ChaCha8Rng| scale * (stretch * vector(rng));
            if let Ok(triangle) = Triangle::new(corner(rng), corner(rng), corner(rng)) {
                return triangle.into();
            }
        },
        _ => hull(rng, 12, scale, stretch),
    }
}

pub fn hull(rng: &mut ChaCha8Rng, count: usize, scale: f64, stretch: DVec3) -> Shape {
    let points: Vec<DVec3> = (0..count)
        .map(|_| scale * (stretch * direction(rng)))
        .collect();
    Polytope::from_points(points).unwrap().into()
}

/// One pair and its two poses.
pub struct Case {
    pub a: Shape,
    pub pose_a: Pose,
    pub b: Shape,
    pub pose_b: Pose,
}

impl Case {
    pub fn closest(&self) -> Option<ClosestPoints> {
        closest_points(&self.a, &self.pose_a, &self.b, &self.pose_b)
    }

    pub fn size(&self) -> f64 {
        self.a.max_dist() + self.b.max_dist()
    }

    /// What an answer may be off by: rounding in coordinates counts.
    pub fn exact(&self) -> f64 {
        let coordinate = self.pose_a.position.abs().max(self.pose_b.position.abs());
        let local = self.a.centre().abs().max(self.b.centre().abs());
        1e-12 * self.size() + 4.0 * f64::EPSILON * (coordinate + local).max_element()
    }

    pub fn bodies(&self) -> (oracle::Body, oracle::Body) {
        let origin = self.pose_b.position;
        (
            oracle::body(&self.a, &self.pose_a, origin),
            oracle::body(&self.b, &self.pose_b, origin),
        )
    }

    pub fn moved(&self, by: DVec3) -> Self {
        Self {
            a: self.a.clone(),
            pose_a: Pose::new(self.pose_a.position + by, self.pose_a.orientation),
            b: self.b.clone(),
            pose_b: self.pose_b,
        }
    }

    pub fn swapped(&self) -> Self {
        Self {
            a: self.b.clone(),
            pose_a: self.pose_b,
            b: self.a.clone(),
            pose_b: self.pose_a,
        }
    }

    /// The pair, known to be apart, moved together until `gap` is left.
    pub fn with_gap(&self, gap: f64) -> Self {
        let (a, b) = self.bodies();
        let nearest = oracle::nearest(&a, &b);
        let normal = (nearest.on_a - nearest.on_b).normalize();
        self.moved((gap + a.radius + b.radius - nearest.distance) * normal)
    }

    /// Checks everything that can be said of a pair that does not overlap without knowing the answer.
    pub fn check(&self, label: &str) -> Option<ClosestPoints> {
        let (a, b) = self.bodies();
        let exact = self.exact();
        let nearest = oracle::nearest(&a, &b);
        let distance = nearest.distance - a.radius - b.radius;
        let Some(found) = self.closest() else {
            assert!(
                distance <= exact,
                "{label}: {distance:e} apart, but no answer"
            );
            return None;
        };
        assert!(found.distance > 0.0, "{label}: {found:?}");
        assert!(
            (found.distance - distance).abs() <= exact,
            "{label}: distance {:e}, not {distance:e}; off by {:e} of the size",
            found.distance,
            (found.distance - distance).abs() / self.size(),
        );
        let length = found.normal.length();
        assert!(
            (length - 1.0).abs() < 1e-14,
            "{label}: normal of length {length}"
        );
        let gap = oracle::gap(&a, &b, found.normal);
        assert!(
            gap >= distance - exact,
            "{label}: {distance:e} apart, but {gap:e} along the normal, off by {:e} of the size",
            (distance - gap) / self.size(),
        );
        let on_a = (self.pose_a.position - self.pose_b.position) + found.point_a;
        let on_b = found.point_b;
        let off = (on_a - on_b - found.distance * found.normal).length();
        assert!(
            off <= exact,
            "{label}: the points do not span the distance, by {off:e}"
        );
        for (side, body, feature, point, out) in [
            ("a", &a, found.feature_a, on_a, -found.normal),
            ("b", &b, found.feature_b, on_b, found.normal),
        ] {
            let off = oracle::from_surface(point, body);
            assert!(
                off <= exact,
                "{label}: point {side} lies {off:e} off its body"
            );
            let (below, off) = oracle::feature(body, feature, out, point);
            assert!(
                below <= 2.0 * exact && off <= 2.0 * exact,
                "{label}: {feature:?} of {side} is {below:e} too low, {off:e} from the point; {found:?}"
            );
        }
        self.check_swap(label, &found);
        Some(found)
    }

    pub fn check_swap(&self, label: &str, found: &ClosestPoints) {
        let back = self.swapped().closest().unwrap();
        assert!(
            back.distance == found.distance
                && back.normal == -found.normal
                && (back.point_a, back.point_b) == (found.point_b, found.point_a)
                && (back.feature_a, back.feature_b) == (found.feature_b, found.feature_a),
            "{label}: exchanged: {found:?} {back:?}"
        );
    }
}

pub const LABELS: [&str; KINDS] = ["sphere", "cuboid", "triangle", "polytope"];

/// `a` at a random place around `b`, their spheres clear of each other.
pub fn placed(rng: &mut ChaCha8Rng, a: Shape, b: Shape, around: DVec3) -> Case {
    let (turn_a, turn_b) = (turn(rng), turn(rng));
    let size = a.max_dist() + b.max_dist();
    let reach = size * (1.01 + unit_float(rng));
    // Around the middles of the shapes.
    let centres = turn_b * b.centre() - turn_a * a.centre();
    Case {
        pose_a: Pose::new(around + reach * direction(rng) + centres, turn_a),
        pose_b: Pose::new(around, turn_b),
        a,
        b,
    }
}

/// How many random cases of each kind, instead of `default`: as many as the variable `CASTS` says.
pub fn cases(default: u32) -> u32 {
    std::env::var("CASTS")
        .ok()
        .and_then(|count| count.parse().ok())
        .unwrap_or(default)
}
