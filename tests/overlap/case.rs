//! One pair, how to make it at random, and all that must hold of it.

use crate::oracle;
use feeler::{Cuboid, Overlap, Polytope, Pose, Shape, Sphere, Triangle, overlap};
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
    pub fn overlap(&self) -> Option<Overlap> {
        overlap(&self.a, &self.pose_a, &self.b, &self.pose_b)
    }

    pub fn size(&self) -> f64 {
        self.a.max_dist() + self.b.max_dist()
    }

    /// Rounding in coordinates of this pair's place.
    pub fn rounding(&self) -> f64 {
        4.0 * f64::EPSILON
            * self
                .pose_a
                .position
                .abs()
                .max(self.pose_b.position.abs())
                .max_element()
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

    /// Checks everything that can be said of the pair without knowing the answer;
    /// returns whether it overlaps.
    pub fn check(&self, label: &str) -> bool {
        let (a, b) = self.bodies();
        let depth = oracle::depth(&a, &b);
        let exact = 1e-12 * self.size() + self.rounding();
        let Some(found) = self.overlap() else {
            let touch = 1.001e-12 * (self.size() + self.rounding() / (4.0 * f64::EPSILON)) + exact;
            assert!(depth <= touch, "{label}: missed an overlap of {depth:e}");
            return false;
        };
        assert!(
            (found.depth - depth).abs() <= exact,
            "{label}: depth {:e}, not {depth:e}; off by {:e} of the size",
            found.depth,
            (found.depth - depth).abs() / self.size(),
        );
        assert!(
            (found.direction.length() - 1.0).abs() < 1e-14,
            "{label}: {found:?}"
        );
        let along = oracle::width(&a, &b, found.direction);
        assert!(
            (along - depth).abs() <= exact,
            "{label}: the direction needs {along:e} instead of {depth:e}"
        );
        assert!(found.point.is_finite(), "{label}: {found:?}");
        self.check_moves(label, &found);
        self.check_swap(label, &found);
        true
    }

    pub fn check_moves(&self, label: &str, found: &Overlap) {
        let exact = 2e-12 * self.size() + 4.0 * self.rounding();
        let rest = self.moved(found.depth * found.direction).overlap();
        assert!(
            rest.is_none_or(|rest| rest.depth <= exact),
            "{label}: moved out, still overlaps: {rest:?}"
        );
        if 1e-3 * found.depth > 1e-12 * (self.size() + self.pose_a.position.length()) + exact {
            let rest = self.moved(0.999 * found.depth * found.direction).overlap();
            assert!(
                rest.is_some(),
                "{label}: not moved out, yet apart: {found:?}"
            );
        }
    }

    pub fn check_swap(&self, label: &str, found: &Overlap) {
        let back = self.swapped().overlap();
        let same = self.a == self.b && self.pose_a == self.pose_b;
        if let Some(back) = back {
            assert!(
                (back.depth, back.point) == (found.depth, found.point),
                "{label}"
            );
            if !same {
                assert!(
                    back.direction == -found.direction,
                    "{label}: swapped turns otherwise"
                );
                assert!(
                    (back.feature_a, back.feature_b) == (found.feature_b, found.feature_a),
                    "{label}"
                );
            }
        } else {
            panic!("{label}: found one way only");
        }
    }
}

pub const LABELS: [&str; KINDS] = ["sphere", "cuboid", "triangle", "polytope"];

/// `a` at a random place around `b`: from one centre to clear of each other.
pub fn placed(rng: &mut ChaCha8Rng, a: Shape, b: Shape, around: DVec3) -> Case {
    let reach = 1.2 * (a.max_dist() + b.max_dist()) * unit_float(rng).powi(2);
    Case {
        pose_a: Pose::new(around + reach * direction(rng), turn(rng)),
        pose_b: Pose::new(around, turn(rng)),
        a,
        b,
    }
}
