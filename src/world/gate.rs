//! Which candidate pairs are examined.

use crate::broad_phase::{Leaf, LeafId};
use crate::early_out::{Rejection, RejectionCounts};
use crate::world::BodyId;
use crate::world::findings::{PairKey, key};
use crate::world::slots::Slots;
use crate::world::tracks::{Span, Track};

/// A caller's choice of pairs, if there is one.
pub(super) type Keep<'a> = Option<&'a (dyn Fn(BodyId, BodyId) -> bool + Sync)>;

/// Lets those pairs through that may meet in a frame.
pub(super) struct Gate<'a> {
    pub(super) slots: &'a Slots,
    pub(super) keep: Keep<'a>,
    pub(super) span: Span,
    /// What pairs are found for: the frame, or a longer time that began with it or before.
    pub(super) ahead: Span,
}

/// The pairs that were let through, and what became of the others.
#[derive(Debug, Clone, Default)]
pub(super) struct Passed {
    pub(super) pairs: Vec<(LeafId, LeafId)>,
    /// Those that a caller's choice held back, whatever they do.
    pub(super) held_back: Vec<PairKey>,
    /// How many were, also those that have been dealt with since.
    pub(super) count: usize,
    /// Pairs that came, but for those of groups that do not meet.
    pub(super) seen: usize,
    /// Of these, pairs that will not be seen again before pairs are found anew.
    pub(super) dismissed: usize,
    pub(super) rejected: RejectionCounts,
}

impl Passed {
    pub(super) fn clear(&mut self) {
        self.pairs.clear();
        self.held_back.clear();
        self.count = 0;
        self.seen = 0;
        self.dismissed = 0;
        self.rejected = RejectionCounts::default();
    }

    /// Adds what became of other pairs, which have been dealt with.
    pub(super) fn append(&mut self, other: &Self) {
        self.held_back.extend_from_slice(&other.held_back);
        self.count += other.count;
        self.seen += other.seen;
        self.dismissed += other.dismissed;
        self.rejected.too_far += other.rejected.too_far;
        self.rejected.moving_away += other.rejected.moving_away;
        self.rejected.passing_by += other.rejected.passing_by;
    }
}

impl Gate<'_> {
    /// Whether pairs are found for more than the frame.
    pub(super) fn looks_ahead(&self) -> bool {
        self.ahead.dt > self.span.dt
    }

    /// The end of the frame, as a share of the time ahead, rounded up.
    pub(super) fn now(&self) -> f32 {
        let (begin, end) = (self.ahead.time, self.span.time + self.span.dt);
        // By the clock, of which elapsed times are rounded parts.
        let all = begin + self.ahead.dt - begin;
        let rounding = 1e-6 + 8.0 * f64::EPSILON * end / all;
        let share = ((end - begin) / all + rounding) as f32;
        // A frame too short for the clock.
        if share.is_finite() {
            share
        } else {
            f32::INFINITY
        }
    }

    /// Whether a pair that has just been found may meet before pairs are found anew, as far as
    /// it can be told at once.
    #[inline]
    pub(super) fn may_come_near(&self, a: &Track, b: &Track, passed: &mut Passed) -> bool {
        let off = a.keeps_off(b, self.ahead);
        let meets = a.groups.meets(b.groups);
        let rejected = &mut passed.rejected;
        rejected.too_far += u64::from(off.too_far & meets);
        rejected.moving_away += u64::from(off.moving_away & meets);
        rejected.passing_by += u64::from(off.passing_by & meets);
        let is_off = off.too_far | off.moving_away | off.passing_by;
        passed.seen += usize::from(is_off & meets);
        passed.dismissed += usize::from(is_off & meets);
        !is_off & meets
    }

    /// When a pair that has just been found may meet for the first time before pairs are found
    /// anew, as a share of the time ahead, rounded down.
    #[inline]
    pub(super) fn may_meet(
        &self,
        a: &Leaf<'_, Track>,
        b: &Leaf<'_, Track>,
        passed: &mut Passed,
    ) -> Option<f32> {
        match a.data.meets_ahead(b.data, self.ahead) {
            Ok(fraction) => Some((fraction - 1e-6) as f32),
            Err(rejection) => {
                if a.data.groups.meets(b.data.groups) {
                    passed.seen += 1;
                    passed.dismissed += 1;
                    passed.rejected.count(rejection);
                }
                None
            }
        }
    }

    /// Lets a pair through if it may meet in the frame; answers whether it may still meet in
    /// the time ahead.
    #[inline]
    pub(super) fn pass(
        &self,
        a: &Leaf<'_, Track>,
        b: &Leaf<'_, Track>,
        passed: &mut Passed,
    ) -> bool {
        if !a.data.groups.meets(b.data.groups) {
            return false;
        }
        passed.seen += 1;
        match a.data.reject(b.data, self.span) {
            Some(rejection) => {
                passed.rejected.count(rejection);
                rejection != Rejection::MovingAway || self.meets_later(a, b)
            }
            None => {
                if self.keeps(a.slot, b.slot) {
                    passed.count += 1;
                    passed.pairs.push((a.id, b.id));
                } else {
                    passed.held_back.push(key(a.slot, b.slot));
                }
                true
            }
        }
    }

    /// Whether bodies that part in the frame may meet afterwards, by rounding.
    pub(super) fn meets_later(&self, a: &Leaf<'_, Track>, b: &Leaf<'_, Track>) -> bool {
        let end = self.ahead.time + self.ahead.dt;
        let rest = Span {
            dt: end - self.span.time,
            ..self.span
        };
        rest.dt <= self.span.dt || a.data.meets_ahead(b.data, rest).is_ok()
    }

    #[inline]
    fn keeps(&self, a: u32, b: u32) -> bool {
        self.keep
            .is_none_or(|keep| keep(self.slots.id(a), self.slots.id(b)))
    }
}
