//! Pairs found by several threads.

use super::Bvh;
use super::lists::PORTION;
use super::pairs::{Job, Portion};
use rayon::prelude::*;

/// So many jobs are handed out at least, if there are so many: enough that no thread is idle
/// for long when the others have not finished yet.
const JOBS: usize = 256;

/// What was found out, of which pairs, by how many tests.
type Part<S> = (S, Vec<(u32, u32)>, u64);

impl<T: Copy + Send + Sync> Bvh<T> {
    /// As [`pairs`](Self::pairs), with the threads of the rayon pool it is called in.
    ///
    /// `visit` is given some pairs and what is to be found out; the answers are
    /// returned in an order that does not depend on the number of threads.
    pub fn pairs_in_parallel<S: Default + Send>(
        &mut self,
        visit: impl Fn(&Portion<'_, T>, &mut S) + Sync,
    ) -> Vec<S> {
        let mut answers = Vec::new();
        let told = |bvh: &Self, trees: [usize; 2], pairs: &[(u32, u32)]| {
            let mut answer = S::default();
            if let Some(portion) = Portion::new(&bvh.trees, trees, pairs) {
                visit(&portion, &mut answer);
            }
            answer
        };
        for list in self.lists.kept() {
            let parts = list.pairs.par_chunks(PORTION);
            let parts: Vec<S> = parts.map(|pairs| told(self, list.trees, pairs)).collect();
            answers.extend(parts);
        }
        let (mut jobs, mut opened) = (Vec::new(), Vec::new());
        for a in 0..self.trees.len() {
            for b in a..self.trees.len() {
                let Some(start) = self.start(a, b) else {
                    continue;
                };
                // Opened level by level; what is found on the way comes first.
                jobs.clear();
                jobs.push(start);
                let mut list = self.lists.take([a, b]);
                let found = &mut list.pairs;
                let mut tests = 0;
                while !jobs.is_empty() && jobs.len() < JOBS {
                    opened.clear();
                    for job in &jobs {
                        tests += job.step(&self.trees, &mut opened, |a, b| found.push((a, b)));
                    }
                    std::mem::swap(&mut jobs, &mut opened);
                }
                answers.push(told(self, [a, b], found));
                let chunk = jobs.len().div_ceil(JOBS).max(1);
                let parts: Vec<Part<S>> = jobs
                    .par_chunks(chunk)
                    .map(|jobs| {
                        let mut found = Vec::new();
                        let mut pair = |a, b| found.push((a, b));
                        let run = |job: &Job| job.run(&self.trees, &mut pair);
                        let tests = jobs.iter().map(run).sum();
                        (told(self, [a, b], &found), found, tests)
                    })
                    .collect();
                for (answer, more, others) in parts {
                    answers.push(answer);
                    found.extend_from_slice(&more);
                    tests += others;
                }
                self.keep(list, tests);
            }
        }
        self.lists_complete();
        answers
    }
}
