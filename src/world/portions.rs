//! Pairs of the hierarchies, portion by portion.

use crate::broad_phase::{Bvh, Leaf, Portion};
use crate::early_out::Rejection;
use crate::world::finding::Frame;
use crate::world::findings::Findings;
use crate::world::gate::{Gate, Passed};
use crate::world::solver::Solver;
use crate::world::stats::{Laps, PhaseTimes};
use crate::world::tracks::Track;
use crate::world::{Method, balls};

/// So many bodies are worth more than one thread.
#[cfg(feature = "parallel")]
const MANY: usize = 1000;

impl Frame<'_> {
    /// All three phases for all pairs of the hierarchies.
    pub(super) fn examine_portions(
        &self,
        (bvh, gate): (&mut Bvh<Track>, &Gate<'_>),
        (solver, passed, findings): (&mut Solver, &mut Passed, &mut Findings),
        (times, laps): (&mut PhaseTimes, &mut Laps),
    ) {
        #[cfg(feature = "parallel")]
        if rayon::current_num_threads() > 1 && self.slots.len() >= MANY {
            let parts = bvh.pairs_in_parallel(|pairs, found: &mut (Passed, Findings)| {
                found.1 = findings.shared.room();
                let mut solver = Solver::new(self.config.method);
                leave_out(gate, pairs, &mut found.0);
                self.pass(gate, pairs, (&mut found.0, &mut found.1));
                self.examine(&found.0.pairs, |id| pairs.at(id), &mut solver, &mut found.1);
                found.1.close(self.slots.capacity());
            });
            for (more, found) in parts {
                passed.append(&more);
                findings.append(found);
            }
            // All phases at once; their shares cannot be told.
            times.narrow_phase += laps.lap();
            return;
        }
        bvh.pairs(|pairs| {
            times.broad_phase += laps.lap();
            leave_out(gate, pairs, passed);
            times.early_outs += laps.lap();
            self.pass(gate, pairs, (passed, findings));
            self.examine(&passed.pairs, |id| pairs.at(id), solver, findings);
            times.narrow_phase += laps.lap();
        });
        times.broad_phase += laps.lap();
    }

    /// The early-outs of some pairs in the frame: which are left. Balls are examined at once, while they are at hand.
    fn pass(
        &self,
        gate: &Gate<'_>,
        pairs: &mut Portion<'_, Track>,
        (passed, findings): (&mut Passed, &mut Findings),
    ) {
        passed.pairs.clear();
        // A caller's choice is asked about pairs that have passed the early-outs.
        let at_once = self.config.method == Method::Exact && gate.keep.is_none();
        pairs.for_each((Track::touch, gate.now()), |a, b| {
            if at_once && a.data.is_ball && b.data.is_ball {
                self.meet(gate, [&a, &b], (passed, findings))
            } else {
                gate.pass(&a, &b, passed)
            }
        });
    }

    /// All three phases for two balls; answers whether they may still meet in the time ahead.
    #[inline]
    fn meet(
        &self,
        gate: &Gate<'_>,
        [a, b]: [&Leaf<'_, Track>; 2],
        (passed, findings): (&mut Passed, &mut Findings),
    ) -> bool {
        if !a.data.groups.meets(b.data.groups) {
            return false;
        }
        passed.seen += 1;
        match balls::examine(a.data, b.data, self.span) {
            Ok(finding) => {
                passed.count += 1;
                findings.effort.stretches += 1;
                if let Some(finding) = finding {
                    self.note((a.slot, b.slot), finding, findings);
                }
                true
            }
            Err(rejection) => {
                passed.rejected.count(rejection);
                rejection != Rejection::MovingAway || gate.meets_later(a, b)
            }
        }
    }
}

/// Leaves out the pairs that have just been found and cannot meet before pairs are found anew;
/// tells of the others when they may, if that is not in the same frame.
fn leave_out(gate: &Gate<'_>, pairs: &mut Portion<'_, Track>, passed: &mut Passed) {
    if !pairs.is_new() {
        return;
    }
    let looks_ahead = gate.looks_ahead();
    let mut others = Passed::default();
    pairs.retain(
        Track::touch,
        |a, b| gate.may_come_near(a, b, &mut others),
        |a, b| {
            if looks_ahead {
                gate.may_meet(a, b, passed)
            } else {
                Some(f32::NEG_INFINITY)
            }
        },
    );
    passed.append(&others);
}
