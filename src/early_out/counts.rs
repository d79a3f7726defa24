//! How often each test rejected a pair.

use crate::early_out::Rejection;

/// How many pairs each early-out rejected.
///
/// ```
/// use feeler::early_out::{Rejection, RejectionCounts};
///
/// let mut counts = RejectionCounts::default();
/// counts.count(Rejection::PassingBy);
/// assert_eq!((counts.passing_by, counts.total()), (1, 1));
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RejectionCounts {
    /// Pairs rejected as [`Rejection::TooFar`].
    pub too_far: u64,
    /// Pairs rejected as [`Rejection::MovingAway`].
    pub moving_away: u64,
    /// Pairs rejected as [`Rejection::PassingBy`].
    pub passing_by: u64,
}

impl RejectionCounts {
    /// Adds one rejection.
    pub fn count(&mut self, rejection: Rejection) {
        match rejection {
            Rejection::TooFar => self.too_far += 1,
            Rejection::MovingAway => self.moving_away += 1,
            Rejection::PassingBy => self.passing_by += 1,
        }
    }

    /// All rejections together.
    #[must_use]
    pub fn total(&self) -> u64 {
        self.too_far + self.moving_away + self.passing_by
    }
}
