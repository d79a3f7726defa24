//! Spheres.

use crate::error::ShapeError;
use crate::math::domain;
use crate::tolerance::{MAX_LENGTH, MIN_LENGTH};

/// A solid sphere around the origin of its frame. Never triangulated.
///
/// ```
/// use feeler::{ShapeError, Sphere};
///
/// assert_eq!(Sphere::new(0.5)?.radius(), 0.5);
/// assert!(Sphere::new(f64::NAN).is_err());
/// # Ok::<(), ShapeError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "crate::geometry::data::SphereData",
        into = "crate::geometry::data::SphereData"
    )
)]
pub struct Sphere {
    radius: f64,
}

impl Sphere {
    /// A sphere of the given radius in metres.
    ///
    /// # Errors
    /// If `radius` is not finite or not within
    /// [`MIN_LENGTH`]`..=`[`MAX_LENGTH`].
    pub fn new(radius: f64) -> Result<Self, ShapeError> {
        Ok(Self {
            radius: domain::within("radius", radius, MIN_LENGTH, MAX_LENGTH)?,
        })
    }

    /// The radius in metres.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }
}
