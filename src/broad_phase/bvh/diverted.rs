//! Bodies that have another motion while the boxes of all others hold.

use super::Bvh;
use super::bounds::Bounds;
use super::pairs::below;
use super::tree::{Mobility, NOBODY, Tree};
use crate::geometry::Aabb;
use std::ops::Range;

/// Leaves with a mark.
#[derive(Debug, Clone, Default)]
pub(super) struct Marks {
    /// A bit for each leaf: all of them stay in the nearest cache.
    words: Vec<u64>,
    leaves: Vec<u32>,
}

impl Marks {
    /// No leaf of so many is marked.
    pub(super) fn clear(&mut self, leaves: usize) {
        self.words.clear();
        self.words.resize(leaves.div_ceil(64), 0);
        self.leaves.clear();
    }

    fn add(&mut self, leaf: u32) {
        if let Some(word) = self.words.get_mut(leaf as usize / 64) {
            let bit = 1 << (leaf % 64);
            if *word & bit == 0 {
                *word |= bit;
                self.leaves.push(leaf);
            }
        }
    }

    /// No leaf is marked any more.
    fn forget(&mut self) {
        for leaf in self.leaves.drain(..) {
            if let Some(word) = self.words.get_mut(leaf as usize / 64) {
                *word = 0;
            }
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.leaves.is_empty()
    }

    #[inline]
    pub(super) fn has(&self, leaf: u32) -> bool {
        let word = self.words.get(leaf as usize / 64);
        word.is_some_and(|word| word >> (leaf % 64) & 1 != 0)
    }

    /// Bytes in use.
    pub(super) fn memory(&self) -> usize {
        self.words.capacity() * size_of::<u64>() + self.leaves.capacity() * size_of::<u32>()
    }
}

impl<T: Copy + Sync> Bvh<T> {
    /// Lets the next [`renew`](Self::renew) give the body in `slot` another box where it is kept,
    /// and find its pairs anew; what it carries is changed by [`get_mut`](Self::get_mut).
    ///
    /// It costs less than [`insert`](Self::insert), which is for bodies that are elsewhere.
    /// Answers whether that will do: of fixed bodies, and of those that were not there at the
    /// last [`update`](Self::update), it does not.
    ///
    /// ```
    /// use feeler::Aabb;
    /// use feeler::broad_phase::Bvh;
    ///
    /// let place = |x: &f64| Aabb::new([*x, 0.0, 0.0], [*x + 1.0, 1.0, 1.0]);
    /// let mut bvh = Bvh::default();
    /// for slot in 0..3 {
    ///     bvh.insert(slot, true, 3.0 * f64::from(slot));
    /// }
    /// bvh.update(place);
    /// bvh.pairs(|pairs| assert!(pairs.is_empty()));
    /// if let Some(x) = bvh.get_mut(0) {
    ///     *x = 2.5;
    /// }
    /// assert!(bvh.divert(0));
    /// bvh.renew(place, place);
    /// let mut found = Vec::new();
    /// bvh.pairs(|pairs| found.extend(pairs.iter().map(|(a, b)| (a.slot, b.slot))));
    /// assert_eq!(found, [(0, 1)]);
    /// ```
    pub fn divert(&mut self, slot: u32) -> bool {
        let Some(id) = self.leaf(slot) else {
            return false;
        };
        match self.trees.get_mut(id.tree as usize) {
            Some(tree) if tree.settled && tree.mobility == Mobility::Moving => {
                tree.diverted.add(id.leaf);
                true
            }
            _ => false,
        }
    }

    /// Fits the boxes of diverted bodies.
    pub(super) fn fit_diverted(&mut self, bounds: &impl Fn(&T) -> Aabb) {
        let origin = self.origin;
        for tree in &mut self.trees {
            let mut leaves = std::mem::take(&mut tree.diverted.leaves);
            leaves.sort_unstable();
            for &leaf in &leaves {
                let index = leaf as usize;
                if let (Some(&slot), Some(data)) = (tree.leaves.get(index), tree.data.get(index))
                    && slot != NOBODY
                {
                    let bounds = Bounds::around(&bounds(data), origin);
                    tree.refit(index, bounds);
                }
            }
            tree.diverted.leaves = leaves;
        }
    }

    /// All pairs of diverted bodies have been found.
    pub(super) fn forget_diverted(&mut self) {
        for tree in &mut self.trees {
            tree.diverted.forget();
        }
    }
}

/// How many leaves of two trees, or of one, are to be looked for by [`search`].
pub(super) fn count<T>([a, b]: [&Tree<T>; 2], is_one: bool) -> usize {
    let others = if is_one { 0 } else { b.diverted.leaves.len() };
    a.diverted.leaves.len() + others
}

/// All pairs with some of the diverted bodies of two trees, or of one; each once.
pub(super) fn search<T: Copy + Sync>(
    ([a, b], is_one): ([&Tree<T>; 2], bool),
    some: Range<usize>,
    mut pair: impl FnMut(u32, u32),
) {
    let of_a = &a.diverted.leaves;
    for index in some {
        if let Some(&leaf) = of_a.get(index) {
            all_below(b, &a.leaf(leaf as usize), |other| {
                // Of two of one tree the lower leaf is looked for first.
                let is_known = is_one && (other == leaf || other < leaf && a.diverted.has(other));
                if !is_known {
                    pair(leaf, other);
                }
            });
        } else if let Some(&leaf) = b.diverted.leaves.get(index - of_a.len()) {
            all_below(a, &b.leaf(leaf as usize), |other| {
                if !a.diverted.has(other) {
                    pair(other, leaf);
                }
            });
        }
    }
}

fn all_below<T>(tree: &Tree<T>, bounds: &Bounds, mut found: impl FnMut(u32)) {
    if let Some(level) = tree.levels.len().checked_sub(1) {
        below(tree, level, 0, bounds, &mut found);
    }
}
