//! Turning at a constant rate.

use crate::error::MotionError;
use crate::math::domain;
use crate::tolerance::{MAX_LENGTH, MAX_SPIN, MIN_LENGTH};
use glam::{DQuat, DVec3};

/// Turning about a fixed axis at a constant rate: see [`Motion::spin_about`](crate::Motion::spin_about).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spin {
    point: DVec3,
    axis: DVec3,
    rate: f64,
}

impl Spin {
    pub(super) fn new(point: DVec3, axis: DVec3, rate: f64) -> Result<Self, MotionError> {
        domain::vector("spin.point", point, MAX_LENGTH)?;
        domain::within("spin.rate", rate, -MAX_SPIN, MAX_SPIN)?;
        let axis = unit("spin.axis", axis)?;
        Ok(Self { point, axis, rate })
    }

    /// The point of the body that the spin leaves alone, in the body's own frame, in metres.
    #[must_use]
    pub fn point(&self) -> DVec3 {
        self.point
    }

    /// The axis in the world, of unit length.
    #[must_use]
    pub fn axis(&self) -> DVec3 {
        self.axis
    }

    /// Radians per second, counter-clockwise seen against the axis.
    #[must_use]
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// The rotation after `elapsed` seconds.
    ///
    /// From the whole angle, so that nothing adds up: the product of rate and
    /// time is taken with what its rounding drops, and reduced by a multiple of
    /// the circle that is exact enough for any size (Payne and Hanek, in `libm`).
    pub(super) fn rotation_after(&self, elapsed: f64) -> DQuat {
        let (high, low) = product(self.rate, elapsed);
        let rotation = about(self.axis, high);
        // As a rule an hour's angle drops less than 1e-9.
        if low.abs() > 0.0 {
            (about(self.axis, low) * rotation).normalize()
        } else {
            rotation
        }
    }
}

/// `a · b` as rounded, and what the rounding drops.
pub(super) fn product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    (product, a.mul_add(b, -product))
}

/// The rotation by `angle` about a unit axis, with the same sine everywhere.
pub(super) fn about(axis: DVec3, angle: f64) -> DQuat {
    let (sine, cosine) = libm::sincos(0.5 * angle);
    let [x, y, z] = (sine * axis).to_array();
    DQuat::from_xyzw(x, y, z, cosine)
}

/// `vector` over its length, if it has one to speak of.
///
/// A vector that is of unit length but for rounding comes back bit for bit, so
/// that what is written and read again is the same.
pub(super) fn unit(field: &'static str, vector: DVec3) -> Result<DVec3, MotionError> {
    domain::vector(field, vector, MAX_LENGTH)?;
    let length = domain::within(field, vector.length(), MIN_LENGTH, 2.0 * MAX_LENGTH)?;
    Ok(if (length - 1.0).abs() <= 2.0 * f64::EPSILON {
        vector
    } else {
        vector / length
    })
}
