//! Pairs handed out, portion by portion.

use super::forest::{Leaf, LeafId};
use super::tree::{Mobility, NOBODY, Tree};

/// Leaves of two trees, or of one, whose boxes overlap.
#[derive(Debug, Clone, Copy)]
pub(super) struct Listed {
    pub(super) a: u32,
    pub(super) b: u32,
    /// Of no interest before this; see [`Portion::for_each`].
    pub(super) wait: f32,
}

impl Listed {
    pub(super) fn new(a: u32, b: u32) -> Self {
        let wait = f32::NEG_INFINITY;
        Self { a, b, wait }
    }
}

/// Some of the pairs that a [`Bvh`](super::Bvh) finds.
#[derive(Debug)]
pub struct Portion<'a, T> {
    trees: [&'a Tree<T>; 2],
    numbers: [u32; 2],
    pairs: &'a mut [Listed],
    /// So many of them are left.
    len: usize,
    order: Order<'a>,
    is_new: bool,
}

/// So many pairs are read ahead: few enough that their bodies stay in the nearest caches.
const AHEAD: usize = 64;

/// What a pair waits for that is not to be visited again: no number is late enough.
const LEFT_OUT: f32 = f32::NAN;

/// What so few leaves hold stays in the cache from frame to frame, and is not read ahead.
const NEAR: usize = 4096;

/// The body of a leaf; none if it has gone since its pair was found.
#[inline]
fn body<T>(tree: &Tree<T>, number: u32, leaf: u32) -> Option<Leaf<'_, T>> {
    let slot = *tree.leaves.get(leaf as usize)?;
    (slot != NOBODY).then_some(())?;
    Some(Leaf {
        id: LeafId { tree: number, leaf },
        slot,
        data: tree.data.get(leaf as usize)?,
    })
}

/// Which body of a pair of two trees comes first: the moving one, of two moving ones
/// that of the lower slot.
#[derive(Debug)]
pub(super) struct Order<'a> {
    leaves: [&'a [u32]; 2],
    both_move: bool,
    fixed_first: bool,
}

impl<'a> Order<'a> {
    pub(super) fn new<T>(a: &'a Tree<T>, b: &'a Tree<T>) -> Self {
        let both_move = a.mobility == b.mobility;
        Self {
            leaves: [&a.leaves, &b.leaves],
            both_move,
            fixed_first: !both_move && a.mobility == Mobility::Fixed,
        }
    }

    #[inline]
    fn swaps(&self, a: u32, b: u32) -> bool {
        self.fixed_first || self.both_move && b < a
    }

    /// The slots of the bodies of two leaves, as one number to sort by.
    pub(super) fn key(&self, pair: &Listed) -> u64 {
        let slot = |side: usize, leaf: u32| {
            let slot = self.leaves[side].get(leaf as usize);
            slot.copied().unwrap_or(NOBODY)
        };
        let (a, b) = (slot(0, pair.a), slot(1, pair.b));
        let (first, second) = if self.swaps(a, b) { (b, a) } else { (a, b) };
        u64::from(first) << 32 | u64::from(second)
    }
}

impl<'a, T: Copy> Portion<'a, T> {
    pub(super) fn new(
        trees: &'a [Tree<T>],
        [a, b]: [usize; 2],
        pairs: &'a mut [Listed],
        is_new: bool,
    ) -> Option<Self> {
        Some(Self {
            order: Order::new(trees.get(a)?, trees.get(b)?),
            trees: [trees.get(a)?, trees.get(b)?],
            numbers: [a as u32, b as u32],
            len: pairs.len(),
            pairs,
            is_new,
        })
    }

    /// How many they are at most: those that have been left out since may be counted.
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Leaves out those of bodies that have been diverted since they were found.
    pub(super) fn leave_out_diverted(&mut self) {
        let marks = self.trees.map(|tree| &tree.diverted);
        if marks.iter().all(|marks| marks.is_empty()) {
            return;
        }
        for pair in &mut *self.pairs {
            if marks[0].has(pair.a) || marks[1].has(pair.b) {
                pair.wait = LEFT_OUT;
            }
        }
    }

    /// Whether they have been found just now, and are not kept from before.
    #[must_use]
    pub fn is_new(&self) -> bool {
        self.is_new
    }

    /// Reads what is known of the bodies of some pairs, all at once.
    ///
    /// Records lie wherever their bodies do. What looks at one pair after the other waits for
    /// memory twice for each; reads that nothing depends on are waited for together. On
    /// 100 000 balls that makes the early-outs twice as fast.
    #[inline]
    fn read<'p>(&self, pairs: impl Iterator<Item = &'p Listed>, touch: impl Fn(&T) -> f64) {
        if self.trees.iter().all(|tree| tree.leaves.len() < NEAR) {
            return;
        }
        let side = |side: usize, leaf: u32| {
            let data = self.trees[side].data.get(leaf as usize);
            data.map_or(0.0, &touch)
        };
        let read = |sum: f64, pair: &Listed| sum + side(0, pair.a) + side(1, pair.b);
        // So that it is not left out for being of no use.
        std::hint::black_box(pairs.fold(0.0, read));
    }

    /// Leaves out, now and for as long as they would be kept, the pairs that `when` has no
    /// answer for; the others wait for the number it answers with: see
    /// [`for_each`](Self::for_each).
    ///
    /// `touch` reads a little of what is known of a body. `may` is asked first, of pairs in no
    /// particular order: it leaves most out, and had better not branch, since nobody can
    /// predict which.
    #[inline]
    pub fn retain(
        &mut self,
        touch: impl Fn(&T) -> f64,
        mut may: impl FnMut(&T, &T) -> bool,
        mut when: impl FnMut(&Leaf<'a, T>, &Leaf<'a, T>) -> Option<f32>,
    ) {
        let mut kept = 0;
        let mut left = [0_u32; AHEAD];
        for from in (0..self.len).step_by(AHEAD) {
            let until = self.len.min(from + AHEAD);
            let pairs = self.pairs.get(from..until).unwrap_or_default();
            self.read(pairs.iter(), &touch);
            let [a, b] = self.trees.map(|tree| &tree.data);
            let mut count = 0;
            for (index, pair) in (from as u32..).zip(pairs) {
                if let (Some(a), Some(b)) = (a.get(pair.a as usize), b.get(pair.b as usize)) {
                    // Written in any case, and overwritten if it is left out.
                    left[count % AHEAD] = index;
                    count += usize::from(may(a, b));
                }
            }
            for &index in left.get(..count).unwrap_or_default() {
                let index = index as usize;
                if let Some(&pair) = self.pairs.get(index)
                    && let Some((a, b)) = self.leaves(&pair)
                    && let Some(wait) = when(&a, &b)
                    && let Some(place) = self.pairs.get_mut(kept)
                {
                    *place = Listed { wait, ..pair };
                    kept += 1;
                }
            }
        }
        self.len = kept;
    }

    /// The pairs that do not wait for a number beyond `now`, as [`iter`](Self::iter) gives
    /// them; those that `visit` answers false for are not visited again.
    ///
    /// `touch` reads a little of what is known of a body.
    #[inline]
    pub fn for_each(
        &mut self,
        (touch, now): (impl Fn(&T) -> f64, f32),
        mut visit: impl FnMut(Leaf<'a, T>, Leaf<'a, T>) -> bool,
    ) {
        let mut due = [0_u32; AHEAD];
        for from in (0..self.len).step_by(AHEAD) {
            let until = self.len.min(from + AHEAD);
            let mut count = 0;
            for (index, pair) in
                (from as u32..).zip(self.pairs.get(from..until).unwrap_or_default())
            {
                // Written in any case, and overwritten if it is not due: no branch.
                due[count % AHEAD] = index;
                count += usize::from(pair.wait <= now);
            }
            let due = due.get(..count).unwrap_or_default();
            let pairs = due
                .iter()
                .filter_map(|&index| self.pairs.get(index as usize));
            self.read(pairs, &touch);
            for &index in due {
                if let Some(&pair) = self.pairs.get(index as usize)
                    && let Some((a, b)) = self.leaves(&pair)
                    && !visit(a, b)
                    && let Some(pair) = self.pairs.get_mut(index as usize)
                {
                    pair.wait = LEFT_OUT;
                }
            }
        }
    }

    /// The body kept there, if it is of these pairs.
    #[must_use]
    #[inline]
    pub fn at(&self, id: LeafId) -> Option<Leaf<'a, T>> {
        let side = usize::from(id.tree != self.numbers[0]);
        let tree = self.trees[side];
        Some(Leaf {
            id,
            slot: *tree.leaves.get(id.leaf as usize)?,
            data: tree.data.get(id.leaf as usize)?,
        })
    }

    /// The pairs: the moving body first, of two moving ones the lower slot.
    #[inline]
    pub fn iter(&self) -> impl Iterator<Item = (Leaf<'a, T>, Leaf<'a, T>)> {
        let pairs = self.pairs.get(..self.len).unwrap_or_default();
        let pairs = pairs.iter().filter(|pair| !pair.wait.is_nan());
        pairs.filter_map(|pair| self.leaves(pair))
    }

    #[inline]
    fn leaves(&self, pair: &Listed) -> Option<(Leaf<'a, T>, Leaf<'a, T>)> {
        let a = body(self.trees[0], self.numbers[0], pair.a)?;
        let b = body(self.trees[1], self.numbers[1], pair.b)?;
        Some(if self.order.swaps(a.slot, b.slot) {
            (b, a)
        } else {
            (a, b)
        })
    }
}
