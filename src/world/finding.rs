//! From what the narrow phase finds to the contacts of a frame.

use crate::broad_phase::{Bvh, Leaf, LeafId};
use crate::motion::FrameMotion;
use crate::world::pair::{self, Finding, Mover, PairEffort};
use crate::world::slots::{Resident, Slots};
use crate::world::solver::Solver;
use crate::world::stirred::Stirred;
use crate::world::tracks::{Course, Span, Track};
use crate::world::{Contact, ContactKind, Method, WorldConfig, balls};

/// So many pairs are examined at a time where there are several threads: enough
/// to be worth handing over, few enough that nobody waits long for the last.
#[cfg(feature = "parallel")]
const CHUNK: usize = 512;

/// A pair of slots, the lower one first, as one number to sort by.
pub(super) type PairKey = u64;

/// The key of a pair, in whatever order.
#[inline]
pub(super) fn key(a: u32, b: u32) -> PairKey {
    u64::from(a.min(b)) << 32 | u64::from(a.max(b))
}

/// All that the narrow phase reads.
pub(super) struct Frame<'a> {
    pub(super) config: &'a WorldConfig,
    pub(super) slots: &'a Slots,
    pub(super) stirred: &'a Stirred,
    /// See [`CollisionWorld`](super::CollisionWorld).
    pub(super) touching: &'a [PairKey],
    pub(super) span: Span,
}

/// All that it finds.
#[derive(Debug, Clone, Default)]
pub(super) struct Findings {
    /// Contacts as they were found.
    pub(super) contacts: Vec<Contact>,
    /// For each contact its pair, whether it was put there, and its index.
    pub(super) keys: Vec<Found>,
    /// Pairs that were reported as touching and touch still.
    pub(super) resting: Vec<PairKey>,
    pub(super) effort: PairEffort,
}

/// Which contact is whose.
#[derive(Debug, Clone, Copy)]
pub(super) struct Found {
    pub(super) pair: PairKey,
    pub(super) index: u32,
    /// Whether the pair may have met unseen: it overlaps, and neither body was put where it is.
    pub(super) drifted: bool,
}

impl Findings {
    pub(super) fn clear(&mut self) {
        self.contacts.clear();
        self.keys.clear();
        self.resting.clear();
        self.effort = PairEffort::default();
    }
}

impl Frame<'_> {
    /// The narrow phase: whether, when, where and how pairs meet.
    pub(super) fn examine_all(
        &self,
        (pairs, bvh): (&[(LeafId, LeafId)], &Bvh<Track>),
        solver: &mut Solver,
        findings: &mut Findings,
    ) {
        let at = |id| bvh.at(id);
        #[cfg(feature = "parallel")]
        if rayon::current_num_threads() > 1 && pairs.len() > 2 * CHUNK {
            use rayon::prelude::*;
            let found: Vec<Findings> = pairs
                .par_chunks(CHUNK)
                .map(|pairs| {
                    let mut findings = Findings::default();
                    let mut solver = Solver::new(self.config.method);
                    self.examine(pairs, at, &mut solver, &mut findings);
                    findings
                })
                .collect();
            for chunk in &found {
                findings.append(chunk);
            }
            return;
        }
        self.examine(pairs, at, solver, findings);
    }

    /// The same of some pairs, on this thread.
    pub(super) fn examine<'a>(
        &self,
        pairs: &[(LeafId, LeafId)],
        at: impl Fn(LeafId) -> Option<Leaf<'a, Track>>,
        solver: &mut Solver,
        findings: &mut Findings,
    ) {
        let exact = self.config.method == Method::Exact;
        for &(first, second) in pairs {
            let (Some(a), Some(b)) = (at(first), at(second)) else {
                continue;
            };
            let finding = if exact && a.data.is_ball && b.data.is_ball {
                findings.effort.stretches += 1;
                balls::examine(a.data, b.data, self.span)
            } else {
                self.examine_bodies(&a, &b, solver, &mut findings.effort)
            };
            if let Some(finding) = finding {
                self.note((a.slot, b.slot), finding, findings);
            }
        }
    }

    fn examine_bodies(
        &self,
        a: &Leaf<'_, Track>,
        b: &Leaf<'_, Track>,
        solver: &mut Solver,
        effort: &mut PairEffort,
    ) -> Option<Finding> {
        let (first, second) = (self.slots.at(a.slot)?, self.slots.at(b.slot)?);
        // Straight flight is worked out here, for the few that come near another.
        let motion = |resident: &Resident, track: &Track| {
            if track.course == Course::Path {
                return resident.frame;
            }
            let (elapsed, duration) = self.span.of_motion(resident.since);
            FrameMotion::new(resident.body.motion(), elapsed, duration)
        };
        let (frame_a, frame_b) = (motion(first, a.data), motion(second, b.data));
        let (a, b) = (Mover::new(first, &frame_a), Mover::new(second, &frame_b));
        pair::examine(solver, &a, &b, effort).unwrap_or_else(|undecided| {
            effort.undecided += 1;
            pair::overlap_at_end(&a, &b, undecided)
        })
    }

    fn note(&self, (first, second): (u32, u32), finding: Finding, findings: &mut Findings) {
        let pair = key(first, second);
        let is_any =
            |is: fn(&Stirred, u32) -> bool| is(self.stirred, first) || is(self.stirred, second);
        if finding.resting
            && !is_any(Stirred::is_diverted)
            && self.touching.binary_search(&pair).is_ok()
        {
            // Reported when they met.
            findings.resting.push(pair);
            return;
        }
        let found = finding.contact;
        let overlaps = matches!(found.kind, ContactKind::Overlap { .. });
        findings.keys.push(Found {
            pair,
            index: findings.contacts.len() as u32,
            drifted: overlaps && !is_any(Stirred::is_placed),
        });
        findings.contacts.push(Contact {
            a: self.slots.id(first),
            b: self.slots.id(second),
            time: self.span.time + found.fraction * self.span.dt,
            fraction: found.fraction,
            point: found.point,
            normal: found.normal,
            feature_a: found.features[0],
            feature_b: found.features[1],
            kind: found.kind,
        });
    }
}

impl Findings {
    /// Adds what was found of other pairs.
    #[cfg(feature = "parallel")]
    pub(super) fn append(&mut self, other: &Self) {
        let before = self.contacts.len() as u32;
        self.contacts.extend_from_slice(&other.contacts);
        self.keys.extend(other.keys.iter().map(|found| Found {
            index: before + found.index,
            ..*found
        }));
        self.resting.extend_from_slice(&other.resting);
        self.effort.stretches += other.effort.stretches;
        self.effort.rays += other.effort.rays;
        self.effort.undecided += other.effort.undecided;
    }

    /// Bytes in use.
    pub(super) fn memory(&self) -> usize {
        self.contacts.capacity() * size_of::<Contact>()
            + self.keys.capacity() * size_of::<Found>()
            + self.resting.capacity() * size_of::<PairKey>()
    }

    /// Sorts the contacts into `sorted`: by time, then by ids.
    ///
    /// `met` are the pairs with a contact in the frame before, sorted.
    pub(super) fn sort_into(&mut self, sorted: &mut Vec<Contact>, met: &[PairKey]) {
        self.keys.sort_unstable_by_key(|found| found.pair);
        // Both lists are sorted: one pass tells which pairs are in both.
        let mut met = met.iter().peekable();
        for found in &self.keys {
            while met.next_if(|&&pair| pair < found.pair).is_some() {}
            let is_new = met.peek().is_none_or(|&&pair| pair != found.pair);
            // Apart a frame ago, and moved into each other since: that they met
            // was overlooked by rounding, or by too few rays, and is told now.
            if found.drifted
                && is_new
                && let Some(contact) = self.contacts.get_mut(found.index as usize)
            {
                contact.kind = ContactKind::Touch;
            }
        }
        // Most contacts of a crowd are overlaps as the frame begins, and in order already.
        let in_order = |found: &Found| self.contacts.get(found.index as usize).copied();
        sorted.clear();
        let contacts = || self.keys.iter().filter_map(in_order);
        sorted.extend(contacts().filter(|contact| contact.fraction <= 0.0));
        let at_start = sorted.len();
        sorted.extend(contacts().filter(|contact| contact.fraction > 0.0));
        if !sorted[..at_start].is_sorted_by_key(|contact| (contact.a, contact.b)) {
            sorted[..at_start].sort_unstable_by_key(|contact| (contact.a, contact.b));
        }
        sorted[at_start..].sort_unstable_by(|a, b| {
            a.time
                .total_cmp(&b.time)
                .then_with(|| (a.a, a.b).cmp(&(b.a, b.b)))
        });
    }

    /// The pairs with a contact at `until` or before, in fractions of the frame,
    /// and those that rest in touch: into `met`, sorted.
    pub(super) fn met_until(&self, until: f64, met: &mut Vec<PairKey>) {
        met.clear();
        let contact = |found: &Found| self.contacts.get(found.index as usize);
        let counts =
            |found: &&Found| contact(found).is_some_and(|contact| contact.fraction <= until);
        met.extend(self.keys.iter().filter(counts).map(|found| found.pair));
        if !self.resting.is_empty() {
            met.extend_from_slice(&self.resting);
            met.sort_unstable();
        }
    }
}
