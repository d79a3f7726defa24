//! Which candidate pairs are examined.

use crate::broad_phase::{Bvh, Leaf, LeafId};
use crate::early_out::RejectionCounts;
use crate::world::BodyId;
use crate::world::slots::Slots;
use crate::world::tracks::{Span, Track};

/// So many bodies are worth more than one thread.
#[cfg(feature = "parallel")]
const MANY: usize = 1000;

/// A caller's choice of pairs, if there is one.
pub(super) type Keep<'a> = Option<&'a (dyn Fn(BodyId, BodyId) -> bool + Sync)>;

/// Lets those pairs through that may meet in a frame.
pub(super) struct Gate<'a> {
    pub(super) slots: &'a Slots,
    pub(super) keep: Keep<'a>,
    pub(super) span: Span,
}

/// The pairs that were let through, and what became of the others.
#[derive(Debug, Clone, Default)]
pub(super) struct Passed {
    pub(super) pairs: Vec<(LeafId, LeafId)>,
    /// Pairs that came, but for those of groups that do not meet.
    pub(super) seen: usize,
    pub(super) rejected: RejectionCounts,
}

/// What has just been done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Phase {
    Broad,
    EarlyOuts,
}

impl Passed {
    pub(super) fn clear(&mut self) {
        self.pairs.clear();
        self.seen = 0;
        self.rejected = RejectionCounts::default();
    }

    /// Adds what became of other pairs.
    #[cfg(feature = "parallel")]
    fn append(&mut self, other: &Self) {
        self.pairs.extend_from_slice(&other.pairs);
        self.seen += other.seen;
        self.rejected.too_far += other.rejected.too_far;
        self.rejected.moving_away += other.rejected.moving_away;
        self.rejected.passing_by += other.rejected.passing_by;
    }
}

impl Gate<'_> {
    /// The pairs of the hierarchies; `done` is called after each piece of work.
    pub(super) fn pass_all(
        &self,
        bvh: &mut Bvh<Track>,
        passed: &mut Passed,
        mut done: impl FnMut(Phase),
    ) {
        #[cfg(feature = "parallel")]
        if rayon::current_num_threads() > 1 && self.slots.len() >= MANY {
            let parts = bvh.pairs_in_parallel(|pairs, passed: &mut Passed| {
                for (a, b) in pairs.iter() {
                    self.pass(&a, &b, passed);
                }
            });
            for part in &parts {
                passed.append(part);
            }
            // Both phases at once; their share cannot be told.
            done(Phase::Broad);
            return;
        }
        bvh.pairs(|pairs| {
            done(Phase::Broad);
            for (a, b) in pairs.iter() {
                self.pass(&a, &b, passed);
            }
            done(Phase::EarlyOuts);
        });
        done(Phase::Broad);
    }

    #[inline]
    pub(super) fn pass(&self, a: &Leaf<'_, Track>, b: &Leaf<'_, Track>, passed: &mut Passed) {
        if !a.data.groups.meets(b.data.groups) {
            return;
        }
        passed.seen += 1;
        match a.data.reject(b.data, self.span) {
            Some(rejection) => passed.rejected.count(rejection),
            None if self.keeps(a.slot, b.slot) => passed.pairs.push((a.id, b.id)),
            None => {}
        }
    }

    #[inline]
    fn keeps(&self, a: u32, b: u32) -> bool {
        self.keep
            .is_none_or(|keep| keep(self.slots.id(a), self.slots.id(b)))
    }
}
