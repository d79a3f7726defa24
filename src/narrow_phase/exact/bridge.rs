//! How one body moves relative to another between two moments, and how far it may be off that.

use super::falling::{after, first_fall};
use super::parting::Parted;
use glam::DVec3;

/// A cubic between two moments that meets place and velocity at both.
///
/// Of a motion whose fourth derivative is at most `J`, it is off by `J/24 · τ²(h − τ)²` at most after `τ` of `h`:
/// by the fourth Bernstein polynomial's middle one, times `J h⁴/144`.
pub(super) struct Bridge {
    /// Bernstein coefficients of the way from B's position to A's.
    pub(super) points: [DVec3; 4],
    /// `J h⁴/144`.
    pub(super) stray: f64,
}

/// What products of coordinates round by, in shares of the largest one.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The error of a bridge's middle, where it is greatest, in shares of `stray`.
const MIDDLE: f64 = 0.375;

/// Share of the error, below which heights above it are not worth looking for.
const CLOSE: f64 = 0.02;

impl Bridge {
    /// Where it is after a share of the time, and the first two derivatives by that.
    #[inline]
    pub(super) fn at(&self, share: f64) -> [DVec3; 3] {
        let rest = 1.0 - share;
        let mix = |[a, b]: [DVec3; 2]| rest * a + share * b;
        let [a, b, c, d] = self.points;
        let [e, f, g] = [[a, b], [b, c], [c, d]].map(mix);
        let [h, i] = [[e, f], [f, g]].map(mix);
        [mix([h, i]), 3.0 * (i - h), 6.0 * ((e - f) + (g - f))]
    }

    /// A share of the time until which two points are farther apart than `distance` for certain; none if they
    /// are so all the time.
    ///
    /// With the bridge `D` and its error `E`, which is no more than `M`, they are where
    /// `D² > R² + (2R + M)·E`: a polynomial of the sixth degree.
    pub(super) fn beyond(&self, distance: f64, close: f64) -> Option<f64> {
        let [a, b, c, d] = self.points;
        let square = distance * distance;
        let error = (2.0 * distance + MIDDLE * self.stray) * self.stray;
        let (first, last) = (a.length_squared(), d.length_squared());
        let (second, third) = (b.length_squared(), c.length_squared());
        let most = first.max(last).max(second).max(third);
        let less = square + ROUNDING * most;
        first_fall(
            [
                first - less,
                a.dot(b) - less,
                0.2 * (2.0 * a.dot(c) + 3.0 * second) - (less + 0.4 * error),
                0.1 * (a.dot(d) + 9.0 * b.dot(c)) - (less + 0.6 * error),
                0.2 * (2.0 * b.dot(d) + 3.0 * third) - (less + 0.4 * error),
                c.dot(d) - less,
                last - less,
            ],
            2.0 * distance * close + CLOSE * error,
        )
    }

    /// A share of the time, `from` on, until which a plane parts two bodies by more than `floor` for certain that
    /// parts them so where they are `at`; none if it does so all the time.
    pub(super) fn above(&self, parted: &Parted, at: DVec3, from: f64, floor: f64) -> Option<f64> {
        let [a, b, c, d] = (self.points).map(|point| parted.normal.dot(point - at));
        let most = a.abs().max(b.abs()).max(c.abs()).max(d.abs());
        let start = parted.gap - floor - ROUNDING * most;
        let heights = [
            start + a,
            start + 0.25 * (a + 3.0 * b),
            start + 0.5 * (b + c) - self.stray,
            start + 0.25 * (3.0 * c + d),
            start + d,
        ];
        let close = 0.5 * floor + CLOSE * self.stray;
        if from <= 0.0 {
            return first_fall(heights, close);
        }
        let rest = after(heights, from);
        first_fall(rest, close).map(|share| from + share * (1.0 - from))
    }
}
