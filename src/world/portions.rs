//! Pairs of the hierarchies, portion by portion.

use crate::broad_phase::{Bvh, Portion};
use crate::world::finding::Frame;
use crate::world::findings::Findings;
use crate::world::gate::{Gate, Passed};
use crate::world::solver::Solver;
use crate::world::stats::{Laps, PhaseTimes};
use crate::world::tracks::Track;

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
                let mut solver = Solver::new(self.config.method);
                pass(gate, pairs, &mut found.0);
                self.examine(&found.0.pairs, |id| pairs.at(id), &mut solver, &mut found.1);
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
            pass(gate, pairs, passed);
            times.early_outs += laps.lap();
            self.examine(&passed.pairs, |id| pairs.at(id), solver, findings);
            times.narrow_phase += laps.lap();
        });
        times.broad_phase += laps.lap();
    }
}

/// The early-outs of some pairs: which are left.
fn pass(gate: &Gate<'_>, pairs: &mut Portion<'_, Track>, passed: &mut Passed) {
    passed.pairs.clear();
    if pairs.is_new() && gate.looks_ahead() {
        pairs.retain(Track::touch, |a, b| gate.may_meet(a, b, passed));
    }
    pairs.for_each((Track::touch, gate.now()), |a, b| gate.pass(&a, &b, passed));
}
