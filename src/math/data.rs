//! Vectors as they are written: a list of numbers, and of just as many.

use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::fmt;

/// `N` numbers; integers count as numbers.
///
/// Formats differ in whether they mind a list that goes on after its last
/// expected item. A point with four coordinates is a mistake in any of them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vec<f64>", into = "Vec<f64>")]
pub(crate) struct Numbers<const N: usize>(pub(crate) [f64; N]);

/// A list is too short or too long.
#[derive(Debug)]
pub(crate) struct WrongCount {
    count: usize,
    expected: usize,
}

impl fmt::Display for WrongCount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { count, expected } = self;
        write!(f, "{count} numbers given, {expected} are expected")
    }
}

impl<const N: usize> TryFrom<Vec<f64>> for Numbers<N> {
    type Error = WrongCount;

    fn try_from(numbers: Vec<f64>) -> Result<Self, WrongCount> {
        <[f64; N]>::try_from(numbers)
            .map(Self)
            .map_err(|numbers| WrongCount {
                count: numbers.len(),
                expected: N,
            })
    }
}

impl<const N: usize> From<Numbers<N>> for Vec<f64> {
    fn from(numbers: Numbers<N>) -> Self {
        numbers.0.to_vec()
    }
}

/// A point, direction or velocity.
pub(crate) type Vector = Numbers<3>;

impl From<Vector> for DVec3 {
    fn from(vector: Vector) -> Self {
        vector.0.into()
    }
}

impl From<DVec3> for Vector {
    fn from(vector: DVec3) -> Self {
        Self(vector.to_array())
    }
}
