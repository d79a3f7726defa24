//! The frame of a ray, in single precision.

use super::body::Body;
use super::cloud::{Turn, Vector, dot, single};
use super::pair::Pair;
use glam::{DVec3, Vec4};

/// A pair as seen along the ray, in shares of its size.
pub(super) struct Sight {
    frame: Frame,
    /// The ray's place from B's centre.
    pub(super) ray: Vector,
    per_size: f64,
}

impl Sight {
    #[inline(always)]
    pub(super) fn new(pair: &Pair) -> Self {
        let frame = Frame::new(pair.motion);
        let per_size = 1.0 / pair.size;
        Self {
            ray: frame.seen(single(per_size * pair.nearest)),
            frame,
            per_size,
        }
    }

    /// From B's centre across to the ray, along the world's axes, and the square of that.
    #[inline(always)]
    pub(super) fn outwards(&self) -> (Vector, f32) {
        let [right, up, _] = self.frame.0;
        let [x, y, _] = self.ray;
        let axis = |i: usize| x * right[i] + y * up[i];
        ([axis(0), axis(1), axis(2)], x * x + y * y)
    }

    /// A body's radius.
    #[inline(always)]
    pub(super) fn share(&self, body: &Body) -> f32 {
        (body.radius * self.per_size) as f32
    }

    /// A's vertices are turned round as well.
    #[inline(always)]
    pub(super) fn turn_a(&self, pair: &Pair) -> Turn {
        Turn {
            columns: self.columns(&pair.a, -self.share(&pair.a)),
            shift: [0.0; 3],
        }
    }

    /// B's vertices are seen from the ray.
    #[inline(always)]
    pub(super) fn turn_b(&self, pair: &Pair) -> Turn {
        Turn {
            columns: self.columns(&pair.b, self.share(&pair.b)),
            shift: self.ray.map(|x| -x),
        }
    }

    #[inline(always)]
    fn columns(&self, body: &Body, share: f32) -> [Vector; 3] {
        let [p, q, r] = self.frame.0;
        // One of all three axes' coordinates each.
        let axis = |i: usize| share * Vec4::new(p[i], q[i], r[i], 0.0);
        let (x, y, z) = (axis(0), axis(1), axis(2));
        let column = |axis: DVec3| {
            let [a, b, c] = single(axis);
            let [p, q, r, _] = (x * a + y * b + z * c).to_array();
            [p, q, r]
        };
        let rotation = &body.rotation;
        [
            column(rotation.x_axis),
            column(rotation.y_axis),
            column(rotation.z_axis),
        ]
    }
}

/// Axes of which the third is the ray's.
struct Frame([Vector; 3]);

impl Frame {
    /// Source: Duff et al., *Building an Orthonormal Basis, Revisited* (2017).
    #[inline(always)]
    fn new(motion: DVec3) -> Self {
        let along = single(motion);
        let per_length = 1.0 / dot(along, along).sqrt();
        let [x, y, z] = along.map(|x| per_length * x);
        let sign = 1.0_f32.copysign(z);
        let a = -1.0 / (sign + z);
        let b = x * y * a;
        Self([
            [1.0 + sign * x * x * a, sign * b, -sign * x],
            [b, sign + y * y * a, -y],
            [x, y, z],
        ])
    }

    #[inline(always)]
    fn seen(&self, vector: Vector) -> Vector {
        self.0.map(|axis| dot(axis, vector))
    }
}
