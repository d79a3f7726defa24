//! The thesis's table of arc lengths.

use crate::curve::Spline;
use crate::error::PathError;
use crate::math::domain;

/// Most steps a piece is divided into: finer, and rounding outweighs the gain.
const MAX_STEPS: f64 = 65_536.0;

/// A row of an [`ArcLengthTable`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArcLengthRow {
    /// Index of the piece.
    pub piece: usize,
    /// Parameter on the piece, in `0..=1`.
    pub u: f64,
    /// Accumulated length from the spline's start, in metres.
    pub length: f64,
}

/// A table of accumulated chord lengths at constant steps of the parameter, with
/// linear interpolation between rows.
///
/// How the thesis keeps a body's speed constant (Table 2.1, eqs. 2.19–2.21), for
/// comparison with it. It is an approximation: chords are shorter than the curve,
/// and within a row the parameter is taken as proportional to the length. Both
/// errors fall with the square of the number of steps; with ten steps a piece, as in
/// the thesis, places are off by some per cent of a piece's length.
/// [`Spline::locate`] has neither error and is the one in use.
///
/// O(log rows).
///
/// ```
/// use feeler::{ArcLengthRow, ArcLengthTable, PathError};
///
/// let table = ArcLengthTable::from_rows([
///     ArcLengthRow { piece: 0, u: 0.4, length: 0.502465 },
///     ArcLengthRow { piece: 0, u: 0.5, length: 0.717651 },
/// ])?;
/// let (piece, u) = table.locate(0.61);
/// assert_eq!(piece, 0);
/// assert!((u - 0.449973).abs() < 1e-6);
///
/// // Lengths accumulate: they never fall.
/// let falling = ArcLengthTable::from_rows([
///     ArcLengthRow { piece: 0, u: 0.4, length: 0.7 },
///     ArcLengthRow { piece: 0, u: 0.5, length: 0.5 },
/// ]);
/// assert!(matches!(falling, Err(PathError::TableRow { row: 1 })));
/// # Ok::<(), PathError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ArcLengthTable {
    rows: Vec<ArcLengthRow>,
}

impl ArcLengthTable {
    /// The table of `spline` with `steps` rows a piece.
    ///
    /// # Errors
    /// If `steps` is 0 or above 65 536.
    pub fn from_spline(spline: &Spline, steps: usize) -> Result<Self, PathError> {
        domain::within("steps", steps as f64, 1.0, MAX_STEPS)?;
        let mut length = 0.0;
        let rows = spline
            .pieces()
            .iter()
            .enumerate()
            .flat_map(|(piece, curve)| {
                let mut last = curve.point(0.0);
                (1..=steps).map(move |step| {
                    let u = step as f64 / steps as f64;
                    let point = curve.point(u);
                    let chord = (point - last).length();
                    last = point;
                    (piece, u, chord)
                })
            });
        let rows = rows
            .map(|(piece, u, chord)| {
                length += chord;
                ArcLengthRow { piece, u, length }
            })
            .collect();
        Ok(Self { rows })
    }

    /// The table with the given rows.
    ///
    /// Before the first row stands `u = 0` of its piece at length 0, and where the
    /// piece changes `u = 0` of the new piece at the length reached.
    ///
    /// # Errors
    /// If there is no row, or if a row does not continue the one before: its
    /// length falls, its parameter does not rise on the same piece, its piece is
    /// not the same or the next, or a number is not finite or `u` not within
    /// `0..=1`.
    pub fn from_rows(rows: impl IntoIterator<Item = ArcLengthRow>) -> Result<Self, PathError> {
        let rows: Vec<_> = rows.into_iter().collect();
        let Some(first) = rows.first() else {
            return Err(PathError::TableRow { row: 0 });
        };
        let mut last = ArcLengthRow {
            piece: first.piece,
            u: 0.0,
            length: 0.0,
        };
        for (row, next) in rows.iter().enumerate() {
            let rises = if next.piece == last.piece {
                next.u > last.u
            } else {
                next.piece.checked_sub(last.piece) == Some(1) && next.u > 0.0
            };
            // Every comparison is false for NaN.
            if !(rises && next.u <= 1.0 && next.length >= last.length && next.length.is_finite()) {
                return Err(PathError::TableRow { row });
            }
            last = *next;
        }
        Ok(Self { rows })
    }

    /// The rows, by ascending length.
    #[must_use]
    pub fn rows(&self) -> &[ArcLengthRow] {
        &self.rows
    }

    /// The length of the last row, in metres.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.rows.last().map_or(0.0, |row| row.length)
    }

    /// Index of the piece and parameter `u` on it at `distance`, interpolated.
    ///
    /// Distances are clamped to the table; NaN counts as 0.
    #[must_use]
    pub fn locate(&self, distance: f64) -> (usize, f64) {
        let distance = distance.max(0.0).min(self.length());
        let index = self.rows.partition_point(|row| row.length < distance);
        let above = self.rows[index];
        let below = match index.checked_sub(1).map(|before| self.rows[before]) {
            Some(row) if row.piece == above.piece => row,
            Some(row) => ArcLengthRow {
                piece: above.piece,
                u: 0.0,
                length: row.length,
            },
            None => ArcLengthRow {
                piece: above.piece,
                u: 0.0,
                length: 0.0,
            },
        };
        let rise = above.length - below.length;
        // Rows of equal length only meet at the table's start.
        let share = if rise > 0.0 {
            (distance - below.length) / rise
        } else {
            0.0
        };
        (above.piece, below.u + share * (above.u - below.u))
    }
}
