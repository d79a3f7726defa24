//! The narrow phase of a frame.

use crate::broad_phase::{Bvh, Leaf, LeafId};
use crate::motion::FrameMotion;
use crate::world::findings::{Findings, PairKey, key};
use crate::world::pair::{self, Finding, Mover, PairEffort};
use crate::world::sifting::SIFTED;
use crate::world::slots::{Resident, Slots};
use crate::world::solver::Solver;
use crate::world::stirred::Stirred;
use crate::world::tracks::{Course, Span, Track};
use crate::world::{Contact, Method, WorldConfig, balls};

/// So many pairs are examined at a time where there are several threads: enough
/// to be worth handing over, few enough that nobody waits long for the last.
#[cfg(feature = "parallel")]
const CHUNK: usize = 512;

/// So few bodies stay in the cache from frame to frame: nothing need be read ahead.
const NEAR: usize = 4096;

/// All that the narrow phase reads.
pub(super) struct Frame<'a> {
    pub(super) config: &'a WorldConfig,
    pub(super) slots: &'a Slots,
    pub(super) stirred: &'a Stirred,
    /// See [`CollisionWorld`](super::CollisionWorld).
    pub(super) touching: &'a [PairKey],
    pub(super) span: Span,
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
                    let mut found = findings.shared.room();
                    let mut solver = Solver::new(self.config.method);
                    self.examine(pairs, at, &mut solver, &mut found);
                    found.close(self.slots.capacity());
                    found
                })
                .collect();
            for chunk in found {
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
        self.read_ahead(pairs, &at);
        let nobody = LeafId::default();
        let mut left = [(nobody, nobody); SIFTED];
        for some in pairs.chunks(SIFTED) {
            let count = self.sift(some, &at, &mut left);
            for &(first, second) in left.iter().take(count) {
                let (Some(a), Some(b)) = (at(first), at(second)) else {
                    continue;
                };
                let finding = if exact && a.data.is_ball && b.data.is_ball {
                    findings.effort.stretches += 1;
                    balls::examine(a.data, b.data, self.span).unwrap_or_default()
                } else {
                    self.examine_bodies(&a, &b, solver, &mut findings.effort)
                };
                if let Some(finding) = finding {
                    self.note((a.slot, b.slot), finding, findings);
                }
            }
        }
    }

    /// Reads what [`note`](Self::note) looks at of all these bodies, most of which meet, all at
    /// once: see [`Portion::for_each`](crate::broad_phase::Portion::for_each).
    fn read_ahead<'a>(
        &self,
        pairs: &[(LeafId, LeafId)],
        at: impl Fn(LeafId) -> Option<Leaf<'a, Track>>,
    ) {
        if self.slots.len() < NEAR {
            return;
        }
        let read = |sum: u32, &(a, b): &(LeafId, LeafId)| {
            let of = |id: LeafId| {
                at(id).map_or(0, |leaf| {
                    let is_placed = self.stirred.is_placed(leaf.slot);
                    self.slots.id(leaf.slot).generation ^ u32::from(is_placed)
                })
            };
            sum ^ of(a) ^ of(b)
        };
        std::hint::black_box(pairs.iter().fold(0, read));
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
        let (mut room_a, mut room_b) = (None, None);
        let frame_a = self.motion(first, a.data, &mut room_a);
        let frame_b = self.motion(second, b.data, &mut room_b);
        let (a, b) = (Mover::new(first, frame_a), Mover::new(second, frame_b));
        pair::examine(solver, &a, &b, effort).unwrap_or_else(|undecided| {
            effort.undecided += 1;
            pair::overlap_at_end(&a, &b, undecided)
        })
    }

    /// The body's motion in the frame: its own, if it was worked out, else put into `room`.
    fn motion<'a>(
        &self,
        resident: &'a Resident,
        track: &Track,
        room: &'a mut Option<FrameMotion>,
    ) -> &'a FrameMotion {
        if track.course == Course::Path
            && let Some(frame) = &resident.frame
        {
            return frame;
        }
        let (elapsed, duration) = self.span.of_motion(resident.since);
        room.insert(FrameMotion::new(resident.body.motion(), elapsed, duration))
    }

    #[inline]
    pub(super) fn note(
        &self,
        (first, second): (u32, u32),
        finding: Finding,
        findings: &mut Findings,
    ) {
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
        let mut found = finding.contact;
        let time = self.span.time + found.fraction * self.span.dt;
        if time <= self.span.time {
            // The clock does not tell the two moments apart; contacts are sorted by it.
            found.fraction = 0.0;
        }
        let contact = Contact {
            a: self.slots.id(first),
            b: self.slots.id(second),
            time,
            fraction: found.fraction,
            point: found.point,
            normal: found.normal,
            feature_a: found.features[0],
            feature_b: found.features[1],
            kind: found.kind,
        };
        findings.push(
            contact,
            is_any(Stirred::is_placed) || self.were_fixed([first, second]),
        );
    }

    /// Whether two bodies were both fixed in the last step, when nobody looked at them.
    fn were_fixed(&self, pair: [u32; 2]) -> bool {
        let body = |slot: u32| self.slots.at(slot);
        (self.stirred).were_fixed(pair, |slot| {
            body(slot).is_some_and(|is| is.body.motion().is_fixed())
        })
    }
}
