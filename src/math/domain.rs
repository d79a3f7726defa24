//! Checks at the doors: is a number inside its domain?

use crate::error::ValueError;
use glam::DVec3;

/// `value` if it is finite and within `min..=max`.
pub(crate) fn within(
    field: &'static str,
    value: f64,
    min: f64,
    max: f64,
) -> Result<f64, ValueError> {
    if !value.is_finite() {
        return Err(ValueError::NotFinite { field, value });
    }
    if value < min {
        return Err(ValueError::TooSmall { field, value, min });
    }
    if value > max {
        return Err(ValueError::TooLarge { field, value, max });
    }
    Ok(value)
}

/// `vector` if every component is finite and at most `max` in size.
#[inline]
pub(crate) fn vector(field: &'static str, vector: DVec3, max: f64) -> Result<DVec3, ValueError> {
    // NaN fails the comparison.
    if vector.abs().cmple(DVec3::splat(max)).all() {
        return Ok(vector);
    }
    refuse(field, vector, max)
}

/// What is wrong with a vector that is not within its domain.
#[cold]
fn refuse(field: &'static str, vector: DVec3, max: f64) -> Result<DVec3, ValueError> {
    for value in vector.to_array() {
        if !value.is_finite() {
            return Err(ValueError::NotFinite { field, value });
        }
    }
    for value in vector.to_array() {
        if value.abs() > max {
            return Err(ValueError::TooLarge { field, value, max });
        }
    }
    Ok(vector)
}
