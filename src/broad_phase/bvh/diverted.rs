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

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may fail")]
mod tests {
    use super::*;

    /// Bodies are balls of 1 m in a row, 3 m apart, told by where they are.
    fn place(x: &f64) -> Aabb {
        Aabb::new([*x - 1.0, -1.0, -1.0], [*x + 1.0, 1.0, 1.0])
    }

    /// All pairs that are handed out, and whose boxes overlap.
    fn pairs(bvh: &mut Bvh<f64>) -> Vec<(u32, u32)> {
        let mut found = Vec::new();
        bvh.pairs(|pairs| {
            let boxes = |(a, b): &(super::super::Leaf<'_, f64>, super::super::Leaf<'_, f64>)| {
                place(a.data).overlaps(&place(b.data))
            };
            let slots = pairs.iter().filter(boxes).map(|(a, b)| (a.slot, b.slot));
            found.extend(slots.map(|(a, b)| (a.min(b), a.max(b))));
        });
        found.sort_unstable();
        found
    }

    #[test]
    fn the_diverted_find_all_they_meet_once_and_the_others_keep_theirs() {
        for count in [3, 8, 65, 300] {
            let mut bvh = Bvh::default();
            for slot in 0..count {
                // Every fifth one stands; the last two overlap from the beginning.
                let x = if slot == count - 1 {
                    f64::from(slot) - 1.0
                } else {
                    f64::from(slot)
                };
                bvh.insert(
                    slot,
                    slot % 5 != 4,
                    3.0 * x + 0.5 * f64::from(slot / (count - 1)),
                );
            }
            bvh.update(place);
            let before = pairs(&mut bvh);
            assert_eq!(before, [(count - 2, count - 1)]);
            // Two fly to where others are, one of them to the other.
            for (slot, x) in [(0, 3.5), (2, 4.0)] {
                *bvh.get_mut(slot).unwrap() = x;
                assert!(bvh.divert(slot) || slot % 5 == 4);
                assert!(bvh.divert(slot), "a second time changes nothing");
            }
            let standing = (0..count).find(|slot| slot % 5 == 4);
            assert!(standing.is_none_or(|slot| !bvh.divert(slot)));
            assert!(!bvh.divert(count), "nobody is there");
            bvh.renew(place, place);
            let mut wanted = vec![(0, 1), (0, 2), (1, 2)];
            if count > 3 {
                wanted.push((count - 2, count - 1));
            }
            assert_eq!(pairs(&mut bvh), wanted, "{count}");
            // Who is not diverted again keeps what was found.
            bvh.renew(place, place);
            assert_eq!(pairs(&mut bvh), wanted, "{count}, later");
        }
    }
}
