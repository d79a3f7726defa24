//! The three tests.

use glam::DVec3;

/// Why a pair cannot touch within the frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Rejection {
    /// The motion ends before the bodies' bounding spheres meet.
    TooFar,
    /// The distance grows from the start.
    MovingAway,
    /// The bounding spheres miss each other however long the motion lasts.
    PassingBy,
}

/// Relative margin on the square of the reach: see [`reject`]'s derivation.
///
/// Larger, and pairs that pass within a billionth of their reach go to the
/// narrow phase for nothing; below 2⁻⁴⁸ it no longer covers rounding.
const REACH_MARGIN: f64 = 1.0 / (1_u64 << 30) as f64;

/// Margin on the square of the reach, as a share of the squared distance.
///
/// At least `9 · (2⁻⁵³)² · 2 / REACH_MARGIN`, the error of the cross product.
const DISTANCE_MARGIN: f64 = REACH_MARGIN * REACH_MARGIN / (1_u64 << 10) as f64;

/// Share of a sum of products by which its rounding may be off, thrice over.
const PRODUCT_MARGIN: f64 = 8.0 * f64::EPSILON;

/// Squared lengths between which products of four lengths neither overflow nor
/// underflow. The crate's limits leave `1e-48..=1e42`.
const SQUARED_LENGTHS: std::ops::RangeInclusive<f64> = 1e-100..=1e100;

/// Why the bounding spheres of two bodies cannot touch within the frame, if so.
///
/// `between` leads from A's centre to B's at the start of the frame, `motion`
/// is A's motion relative to B during it, both in metres; `reach` is the
/// largest distance between the centres at which the bodies can touch: the sum
/// of both bounding radii, grown where the true motion leaves its chord.
///
/// One-sided: what is rejected cannot touch, rounding included. What overlaps
/// or touches at the start or at the end is never rejected, nor is anything
/// that cannot be decided: a NaN, an infinity, lengths beyond `1e±50`. What
/// misses by more than some 1e-9 of its distance is always rejected. The
/// rounding of `between` itself, of the coordinates it was made from, is the
/// caller's to add to `reach`.
///
/// The most specific reason is named: of pairs that are too far apart to meet,
/// those that move away are [`Rejection::MovingAway`].
///
/// Source: van den Heuvel & Jackson, *Pool Hall Lessons* (2002), as in the
/// thesis, §3.6, eqs. 3.3 and 3.8, without their roots and divisions. Where
/// A stops before it is closest to B, the distance there decides, which the
/// thesis leaves to the rays.
///
/// O(1).
///
/// ```
/// use feeler::early_out::{Rejection, reject};
/// use glam::DVec3;
///
/// let between = DVec3::new(5.0, 0.0, 0.0);
/// assert_eq!(reject(between, DVec3::new(2.0, 0.0, 0.0), 2.0), Some(Rejection::TooFar));
/// assert_eq!(reject(between, DVec3::new(-9.0, 0.0, 0.0), 2.0), Some(Rejection::MovingAway));
/// assert_eq!(reject(between, DVec3::new(9.0, 9.0, 0.0), 2.0), Some(Rejection::PassingBy));
/// assert_eq!(reject(between, DVec3::new(9.0, 0.0, 0.0), 2.0), None);
/// ```
#[must_use]
pub fn reject(between: DVec3, motion: DVec3, reach: f64) -> Option<Rejection> {
    // With m = between, v = motion, R = reach, u = 2⁻⁵³, a sum of three
    // products is off by at most 3u of the sum of their sizes. r² below stands
    // for R², larger by REACH_MARGIN, which covers the few u of every squared
    // length, and by DISTANCE_MARGIN · m², for what is said at each test.
    let distance_squared = between.length_squared();
    let reach_squared = reach * reach * (1.0 + REACH_MARGIN) + DISTANCE_MARGIN * distance_squared;
    let motion_squared = motion.length_squared();
    // Every NaN ends here, since it fails a comparison or lies in no range.
    if !(distance_squared > reach_squared
        && SQUARED_LENGTHS.contains(&distance_squared)
        && motion_squared <= *SQUARED_LENGTHS.end())
    {
        return None;
    }

    // If m·v is negative only by rounding, it is at most 3u|m||v|, and at its
    // closest A is nearer than at the start by 9u²m² of the squared distance.
    let closing = between.dot(motion);
    if closing < 0.0 {
        return Some(Rejection::MovingAway);
    }

    // Eq. 3.3: along m̂ A comes nearer by m·v/|m| at most, so that it stays
    // beyond the plane at distance R from B if (m² − m·v)/|m| > R.
    let rounding = PRODUCT_MARGIN * (distance_squared + between.abs().dot(motion.abs()));
    let left = distance_squared - closing - rounding;
    if left > 0.0 && left * left > reach_squared * distance_squared {
        return Some(Rejection::TooFar);
    }

    // A stops before it is closest to B. If that is so by rounding alone, v² is
    // within 8u|m||v| of m·v, |v| about |m| at most, and the true closest point
    // nearer by 64u²m² of the squared distance.
    if closing >= motion_squared {
        let end_squared = (between - motion).length_squared();
        return (end_squared > reach_squared).then_some(Rejection::TooFar);
    }

    // Eq. 3.8: |m × v|/|v| is how far the line passes B. The cross product is
    // off by 2√2·u|m||v|, thus |f| by 3u|m|, and (R + 3u|m|)² is at most
    // R²(1 + δ) + 9u²m²(1 + 1/δ) for every δ > 0; δ is half of REACH_MARGIN.
    let passing_squared = between.cross(motion).length_squared();
    (SQUARED_LENGTHS.contains(&motion_squared) && passing_squared > reach_squared * motion_squared)
        .then_some(Rejection::PassingBy)
}
