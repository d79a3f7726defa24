//! Pairs handed out, and kept for as long as their boxes hold.

use super::Bvh;
use super::diverted;
use super::pairs::{Job, across};
use super::portion::{Listed, Order, Portion};
use super::tree::{Mobility, Tree};
use crate::math::radix::sort_by_slots;

/// Pairs are handed out in portions of about so many: few enough that what they
/// name stays in the cache.
pub(super) const PORTION: usize = 1024;

/// Pairs of leaves of two trees, or of one.
#[derive(Debug, Clone, Default)]
pub(super) struct List {
    pub(super) trees: [usize; 2],
    pub(super) pairs: Vec<Listed>,
    /// Whether they are in order of their slots.
    in_order: bool,
    /// Room to sort in, with their slots.
    room: [Vec<(u64, Listed)>; 2],
}

impl List {
    /// Sorts the pairs by the slots of their bodies, in the order in which they are handed
    /// out: once, when they are handed out for the second time.
    ///
    /// What is found of them is then in order too, in every frame. That pays where bodies
    /// are crowded; where they have hardly a pair each, it matters more that pairs lie in
    /// memory as their bodies do.
    pub(super) fn arrange<T: Copy + Sync>(&mut self, trees: &[Tree<T>]) {
        let [Some(a), Some(b)] = self.trees.map(|tree| trees.get(tree)) else {
            return;
        };
        if self.in_order || self.pairs.len() < 2 * (a.live() + b.live()) {
            return;
        }
        self.in_order = true;
        let [keyed, spare] = &mut self.room;
        keyed.clear();
        let of = Order::new(a, b);
        keyed.extend(self.pairs.iter().map(|pair| (of.key(pair), *pair)));
        sort_by_slots((keyed, spare), |&(key, _)| key);
        self.pairs.clear();
        self.pairs.extend(keyed.iter().map(|&(_, pair)| pair));
    }

    /// Closes the gap before a portion's pairs that are left, `from` and so many.
    pub(super) fn close_gap(&mut self, kept: &mut usize, from: usize, left: usize) {
        if *kept != from {
            self.pairs.copy_within(from..from + left, *kept);
        }
        *kept += left;
    }
}

/// A list that is added to, and what of it has been handed out.
struct Told<'a, T, V> {
    trees: &'a [Tree<T>],
    list: &'a mut List,
    visit: &'a mut V,
    /// So many have been.
    count: usize,
}

impl<'a, T: Copy + Sync, V: FnMut(&mut Portion<'_, T>)> Told<'a, T, V> {
    /// All that is in the list already has been.
    fn new(trees: &'a [Tree<T>], list: &'a mut List, visit: &'a mut V) -> Self {
        Self {
            trees,
            count: list.pairs.len(),
            list,
            visit,
        }
    }

    #[inline]
    fn push(&mut self, a: u32, b: u32) {
        self.list.pairs.push(Listed::new(a, b));
        if self.list.pairs.len() >= self.count + PORTION {
            self.tell();
        }
    }

    /// Hands out what is new; leaves it listed if it is to be kept.
    fn tell(&mut self) {
        let new = self.list.pairs.get_mut(self.count..).unwrap_or_default();
        if !new.is_empty()
            && let Some(mut portion) = Portion::new(self.trees, self.list.trees, new, true)
        {
            (self.visit)(&mut portion);
            self.count += portion.len();
        }
        self.list.pairs.truncate(self.count);
    }
}

/// All lists; the first so many are of trees that were there at the last update.
#[derive(Debug, Clone, Default)]
pub(super) struct Lists {
    lists: Vec<List>,
    kept: usize,
    /// Whether the pairs of settled trees are listed.
    complete: bool,
    /// Blocks tested to find them.
    tests: u64,
}

impl Lists {
    /// Forgets all pairs.
    pub(super) fn clear(&mut self) {
        self.kept = 0;
        self.complete = false;
        self.tests = 0;
    }

    /// The pairs that are kept.
    pub(super) fn kept(&mut self) -> &mut [List] {
        self.lists.get_mut(..self.kept).unwrap_or_default()
    }

    /// A list to be filled, which has no pairs yet.
    pub(super) fn take(&mut self, trees: [usize; 2]) -> List {
        if self.lists.len() == self.kept {
            self.lists.push(List::default());
        }
        let mut list = self
            .lists
            .get_mut(self.kept)
            .map(std::mem::take)
            .unwrap_or_default();
        list.trees = trees;
        list.pairs.clear();
        list.in_order = false;
        list
    }

    /// Gives a list back; its pairs are forgotten if it is not to be kept.
    pub(super) fn give(&mut self, list: List, keep: bool) {
        if let Some(place) = self.lists.get_mut(self.kept) {
            *place = list;
            self.kept += usize::from(keep);
        }
    }

    /// Bytes in use.
    pub(super) fn memory(&self) -> usize {
        let pairs: usize = self.lists.iter().map(|list| list.pairs.capacity()).sum();
        let room = self.lists.iter().flat_map(|list| &list.room);
        pairs * size_of::<Listed>()
            + room.map(Vec::capacity).sum::<usize>() * size_of::<(u64, Listed)>()
            + self.lists.capacity() * size_of::<List>()
    }
}

impl<T: Copy + Sync> Bvh<T> {
    /// Hands out all pairs of bodies whose boxes overlap, in portions, in no
    /// particular order; each pair once.
    ///
    /// O(bodies + pairs) for boxes of like size, O(pairs) for those that were there
    /// already if boxes were [renewed](Self::renew). Does not allocate once there have
    /// been as many pairs.
    pub fn pairs(&mut self, mut visit: impl FnMut(&mut Portion<'_, T>)) {
        for list in self.lists.kept() {
            list.arrange(&self.trees);
            let (mut kept, mut from) = (0, 0);
            while from < list.pairs.len() {
                let until = list.pairs.len().min(from + PORTION);
                let pairs = list.pairs.get_mut(from..until).unwrap_or_default();
                let mut left = 0;
                if let Some(mut portion) = Portion::new(&self.trees, list.trees, pairs, false) {
                    portion.leave_out_diverted();
                    visit(&mut portion);
                    left = portion.len();
                }
                list.close_gap(&mut kept, from, left);
                from = until;
            }
            list.pairs.truncate(kept);
        }
        self.pairs_of_diverted(&mut visit);
        for a in 0..self.trees.len() {
            for b in a..self.trees.len() {
                let Some(start) = self.start(a, b) else {
                    continue;
                };
                let mut list = self.lists.take([a, b]);
                let trees = &self.trees;
                let mut told = Told::new(trees, &mut list, &mut visit);
                let mut pair = |a, b| told.push(a, b);
                let tests = match start.lopsided(trees) {
                    Some((of, false)) => across(of, 0..of[1].leaves.len(), pair),
                    Some((of, true)) => across(of, 0..of[1].leaves.len(), |b, a| pair(a, b)),
                    None => start.run(trees, &mut pair),
                };
                told.tell();
                self.keep(list, tests);
            }
        }
        self.lists_complete();
    }

    /// Hands out the pairs of settled trees with diverted bodies in them, and lists them.
    fn pairs_of_diverted(&mut self, visit: &mut impl FnMut(&mut Portion<'_, T>)) {
        for list in self.lists.kept() {
            let [a, b] = list.trees;
            let (Some(tree_a), Some(tree_b)) = (self.trees.get(a), self.trees.get(b)) else {
                continue;
            };
            let of = ([tree_a, tree_b], a == b);
            let count = diverted::count(of.0, of.1);
            let mut told = Told::new(&self.trees, list, visit);
            diverted::search(of, 0..count, |a, b| told.push(a, b));
            told.tell();
        }
        self.forget_diverted();
    }

    /// The pairs of settled trees are listed.
    pub(super) fn lists_complete(&mut self) {
        self.lists.complete = true;
    }

    /// What it took to find the pairs of bodies that were there at the last update: how
    /// often a box was compared with eight.
    #[must_use]
    pub fn tests(&self) -> u64 {
        self.lists.tests
    }

    /// Whether both trees have been there since the last update.
    fn are_settled(&self, trees: [usize; 2]) -> bool {
        let is_settled = |tree| {
            self.trees
                .get(tree)
                .is_some_and(|tree: &Tree<T>| tree.settled)
        };
        trees.into_iter().all(is_settled)
    }

    /// Keeps the pairs of two trees, if these last; `tests` is what it took to find them.
    pub(super) fn keep(&mut self, list: List, tests: u64) {
        let [a, b] = list.trees;
        let are_settled = self.are_settled([a, b]);
        self.lists.give(list, are_settled);
        self.lists.tests += if are_settled { tests } else { 0 };
        if a == b
            && let Some(tree) = self.trees.get_mut(a)
        {
            tree.note_work(tests);
        }
    }

    /// The first job of two trees, or of one; none if they make no pairs, or if these
    /// are listed.
    pub(super) fn start(&self, a: usize, b: usize) -> Option<Job> {
        let (tree_a, tree_b) = (self.trees.get(a)?, self.trees.get(b)?);
        let are_fixed = tree_a.mobility == Mobility::Fixed && tree_b.mobility == Mobility::Fixed;
        let are_listed = self.lists.complete && self.are_settled([a, b]);
        if are_fixed || are_listed || tree_a.live() == 0 || tree_b.live() == 0 {
            return None;
        }
        Job::new(&self.trees, a, b)
    }
}
