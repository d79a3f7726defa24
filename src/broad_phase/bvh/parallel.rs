//! Pairs found by several threads.

use super::Bvh;
use super::diverted;
use super::lists::{List, PORTION};
use super::pairs::{Job, across};
use super::portion::{Listed, Portion};
use super::tree::Tree;
use rayon::prelude::*;

/// So many jobs are handed out at least, if there are so many: enough that no thread is idle
/// for long when the others have not finished yet.
const JOBS: usize = 256;

/// So many leaves of a small tree are looked for at a time.
const LEAVES: usize = 32;

/// So many diverted bodies are: there are few, and nobody has anything else to do meanwhile.
const DIVERTED: usize = 8;

/// What was found out, of which pairs, by how many tests.
type Part<S> = (S, Vec<Listed>, u64);

/// What is found out of some pairs, and how many of them are left.
fn told<T: Copy, S: Default>(
    (trees, numbers): (&[Tree<T>], [usize; 2]),
    (pairs, is_new): (&mut [Listed], bool),
    visit: impl Fn(&mut Portion<'_, T>, &mut S),
) -> (S, usize) {
    let mut answer = S::default();
    match Portion::new(trees, numbers, pairs, is_new) {
        Some(mut portion) => {
            if !is_new {
                portion.leave_out_diverted();
            }
            visit(&mut portion, &mut answer);
            (answer, portion.len())
        }
        None => (answer, 0),
    }
}

impl<T: Copy + Send + Sync> Bvh<T> {
    /// As [`pairs`](Self::pairs), with the threads of the rayon pool it is called in.
    ///
    /// `visit` is given some pairs and what is to be found out; the answers are
    /// returned in an order that does not depend on the number of threads.
    pub fn pairs_in_parallel<S: Default + Send>(
        &mut self,
        visit: impl Fn(&mut Portion<'_, T>, &mut S) + Sync,
    ) -> Vec<S> {
        let mut answers = Vec::new();
        let trees = &self.trees;
        for list in self.lists.kept() {
            list.arrange(trees);
            let numbers = list.trees;
            let parts: Vec<(S, usize)> = list
                .pairs
                .par_chunks_mut(PORTION)
                .with_max_len(1)
                .map(|pairs| told((trees, numbers), (pairs, false), &visit))
                .collect();
            let mut kept = 0;
            for (index, (answer, left)) in parts.into_iter().enumerate() {
                answers.push(answer);
                list.close_gap(&mut kept, index * PORTION, left);
            }
            list.pairs.truncate(kept);
        }
        self.diverted_in_parallel(&mut answers, &visit);
        let (mut jobs, mut opened) = (Vec::new(), Vec::new());
        for a in 0..self.trees.len() {
            for b in a..self.trees.len() {
                let Some(start) = self.start(a, b) else {
                    continue;
                };
                let of = (self.trees.as_slice(), [a, b]);
                let found_part = |mut found: Vec<Listed>, tests: u64| -> Part<S> {
                    let (answer, left) = told(of, (&mut found, true), &visit);
                    found.truncate(left);
                    (answer, found, tests)
                };
                if let Some((both, turned)) = start.lopsided(&self.trees) {
                    let leaves = both[1].leaves.len();
                    let parts: Vec<Part<S>> = (0..leaves.div_ceil(LEAVES))
                        .into_par_iter()
                        .with_max_len(1)
                        .map(|part| {
                            let some = part * LEAVES..leaves.min((part + 1) * LEAVES);
                            let mut found = Vec::new();
                            let tests = across(both, some, |large, small| {
                                let (a, b) = if turned {
                                    (small, large)
                                } else {
                                    (large, small)
                                };
                                found.push(Listed::new(a, b));
                            });
                            found_part(found, tests)
                        })
                        .collect();
                    let list = self.lists.take([a, b]);
                    self.collect((list, 0), parts, &mut answers);
                    continue;
                }
                // Opened level by level; what is found on the way comes first.
                jobs.clear();
                jobs.push(start);
                let mut list = self.lists.take([a, b]);
                let found = &mut list.pairs;
                let mut tests = 0;
                while !jobs.is_empty() && jobs.len() < JOBS {
                    opened.clear();
                    for job in &jobs {
                        tests += job.step(&self.trees, &mut opened, |a, b| {
                            found.push(Listed::new(a, b));
                        });
                    }
                    std::mem::swap(&mut jobs, &mut opened);
                }
                let (answer, left) = told(of, (found, true), &visit);
                answers.push(answer);
                found.truncate(left);
                let chunk = jobs.len().div_ceil(JOBS).max(1);
                let parts: Vec<Part<S>> = jobs
                    .par_chunks(chunk)
                    .with_max_len(1)
                    .map(|jobs| {
                        let mut found = Vec::new();
                        let mut pair = |a, b| found.push(Listed::new(a, b));
                        let run = |job: &Job| job.run(&self.trees, &mut pair);
                        let tests = jobs.iter().map(run).sum();
                        found_part(found, tests)
                    })
                    .collect();
                self.collect((list, tests), parts, &mut answers);
            }
        }
        self.lists_complete();
        answers
    }

    /// The pairs of settled trees with diverted bodies in them.
    fn diverted_in_parallel<S: Default + Send>(
        &mut self,
        answers: &mut Vec<S>,
        visit: &(impl Fn(&mut Portion<'_, T>, &mut S) + Sync),
    ) {
        let trees = &self.trees;
        for list in self.lists.kept() {
            let [a, b] = list.trees;
            let (Some(tree_a), Some(tree_b)) = (trees.get(a), trees.get(b)) else {
                continue;
            };
            let of = ([tree_a, tree_b], a == b);
            let count = diverted::count(of.0, of.1);
            let parts: Vec<(S, Vec<Listed>)> = (0..count.div_ceil(DIVERTED))
                .into_par_iter()
                .with_max_len(1)
                .map(|part| {
                    let some = part * DIVERTED..count.min((part + 1) * DIVERTED);
                    let mut found = Vec::new();
                    diverted::search(of, some, |a, b| found.push(Listed::new(a, b)));
                    let (answer, left) = told((trees, [a, b]), (&mut found, true), visit);
                    found.truncate(left);
                    (answer, found)
                })
                .collect();
            for (answer, found) in parts {
                answers.push(answer);
                list.pairs.extend_from_slice(&found);
            }
        }
        self.forget_diverted();
    }

    /// Adds what several threads have found to a list and to the answers.
    fn collect<S>(
        &mut self,
        (mut list, mut tests): (List, u64),
        parts: Vec<Part<S>>,
        answers: &mut Vec<S>,
    ) {
        for (answer, more, others) in parts {
            answers.push(answer);
            list.pairs.extend_from_slice(&more);
            tests += others;
        }
        self.keep(list, tests);
    }
}
