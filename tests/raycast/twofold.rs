//! Numbers of about 32 digits: the unrounded sum of two `f64`.

use glam::DVec3;
use std::ops::{Add, Div, Mul, Neg, Sub};

#[derive(Debug, Clone, Copy)]
pub(crate) struct Twofold(pub(crate) f64, pub(crate) f64);

fn quick(a: f64, b: f64) -> Twofold {
    let sum = a + b;
    Twofold(sum, b - (sum - a))
}

impl From<f64> for Twofold {
    fn from(value: f64) -> Self {
        Self(value, 0.0)
    }
}

impl Add for Twofold {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let sum = self.0 + other.0;
        let part = sum - self.0;
        let error = (self.0 - (sum - part)) + (other.0 - part);
        quick(sum, error + self.1 + other.1)
    }
}

impl Neg for Twofold {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl Sub for Twofold {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Twofold {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = self.0 * other.0;
        let error = self.0.mul_add(other.0, -product);
        quick(product, error + self.0 * other.1 + self.1 * other.0)
    }
}

impl Div for Twofold {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.0 / other.0;
        let rest = self - Self::from(first) * other;
        let second = rest.0 / other.0;
        let rest = rest - Self::from(second) * other;
        quick(first, second) + Self::from(rest.0 / other.0)
    }
}

impl Twofold {
    pub(crate) const ZERO: Self = Self(0.0, 0.0);

    pub(crate) fn sqrt(self) -> Self {
        if self.0 <= 0.0 {
            return Self::ZERO;
        }
        let root = Self::from(self.0.sqrt());
        root + (self - root * root) / (root + root)
    }

    pub(crate) fn positive(self) -> bool {
        self.0 > 0.0
    }

    pub(crate) fn negative(self) -> bool {
        self.0 < 0.0
    }
}

pub(crate) type Vector = [Twofold; 3];

pub(crate) fn vector(v: DVec3) -> Vector {
    v.to_array().map(Twofold::from)
}

pub(crate) fn sub(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|i| a[i] - b[i])
}

pub(crate) fn dot(a: Vector, b: Vector) -> Twofold {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[test]
fn carries_twice_the_digits() {
    let third = Twofold::from(1.0) / Twofold::from(3.0);
    let rest = third * Twofold::from(3.0) - Twofold::from(1.0);
    assert!(rest.0.abs() < 1e-31, "{rest:?}");
    let root = Twofold::from(2.0).sqrt();
    assert!((root * root - Twofold::from(2.0)).0.abs() < 1e-31);
}
