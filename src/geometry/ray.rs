//! Rays.

use glam::DVec3;

/// A ray `r(f) = origin + f · direction`.
///
/// The direction need not be of unit length; a fraction `f` counts in
/// directions, so with a body's motion of one frame as direction, `f` in
/// `0..=1` is that frame.
///
/// Source: the thesis, eq. 2.11.
///
/// ```
/// use feeler::Ray;
///
/// let ray = Ray::new([1.0, 0.0, 0.0], [0.0, 2.0, 0.0]);
/// assert_eq!(ray.at(0.5), [1.0, 1.0, 0.0].into());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Where the ray starts, in metres.
    pub origin: DVec3,
    /// Where it goes, in metres per unit of fraction.
    pub direction: DVec3,
}

impl Ray {
    /// The ray from `origin` along `direction`.
    #[must_use]
    pub fn new(origin: impl Into<DVec3>, direction: impl Into<DVec3>) -> Self {
        Self {
            origin: origin.into(),
            direction: direction.into(),
        }
    }

    /// The point at `fraction`.
    #[must_use]
    pub fn at(&self, fraction: f64) -> DVec3 {
        self.origin + fraction * self.direction
    }
}
