//! What a step did, and how long it took.

use crate::early_out::RejectionCounts;
use std::time::Duration;

/// Counts and times of the last step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct StepStats {
    /// Bodies in the world.
    pub bodies: usize,
    /// Pairs that the broad phase let through.
    pub pairs: usize,
    /// Pairs rejected by the early-out tests, by name.
    pub rejected: RejectionCounts,
    /// Pairs that the narrow phase examined.
    pub examined: usize,
    /// Stretches of straight relative motion that these fell into and that no
    /// early-out rejected; steps from plane to plane for curved and spinning bodies.
    pub stretches: usize,
    /// Pairs of bodies on curves or in rotation that came or stayed so near to each
    /// other that the search ran out of budget.
    ///
    /// If one overlaps as the frame ends, its touch is told, at the moment until which it is proven
    /// apart, with the point and the normal of that overlap; else a touch in the rest of the frame went unseen, if there was one.
    pub undecided: usize,
    /// Rays cast.
    pub rays: u64,
    /// Contacts found.
    pub contacts: usize,
    /// Time per phase.
    pub times: PhaseTimes,
}

/// How long each phase of a step took.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PhaseTimes {
    /// Every body's motion in the frame.
    pub motions: Duration,
    /// The list of pairs brought up to date.
    pub broad_phase: Duration,
    /// Early-out tests of pairs that have just been found; those of pairs that are kept from frame to
    /// frame are counted with the examination, which follows at once.
    pub early_outs: Duration,
    /// The examination of pairs.
    pub narrow_phase: Duration,
    /// Contacts sorted, bodies advanced.
    pub advance: Duration,
}

impl PhaseTimes {
    /// The whole step.
    #[must_use]
    pub fn total(&self) -> Duration {
        self.motions + self.broad_phase + self.early_outs + self.narrow_phase + self.advance
    }
}

/// A stop watch; stands still where the platform has no clock.
pub(crate) struct Laps {
    #[cfg(not(target_family = "wasm"))]
    last: std::time::Instant,
}

impl Laps {
    pub(crate) fn start() -> Self {
        Self {
            #[cfg(not(target_family = "wasm"))]
            last: std::time::Instant::now(),
        }
    }

    /// Time since the last lap.
    pub(crate) fn lap(&mut self) -> Duration {
        #[cfg(not(target_family = "wasm"))]
        {
            let now = std::time::Instant::now();
            now - std::mem::replace(&mut self.last, now)
        }
        #[cfg(target_family = "wasm")]
        Duration::ZERO
    }
}
