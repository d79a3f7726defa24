//! The hierarchies of a world.

use super::bounds::Bounds;
use super::lists::Lists;
use super::order::Item;
use super::tree::{Mobility, NOBODY, Tree};
use crate::geometry::Aabb;
use glam::DVec3;

/// What arranging leaves anew costs, in tests of a block for each leaf and each
/// cut in two. Measured: 12 ns to 17 ns, twice as much. But rays, of which nobody knows how many
/// will come, gain by an order that is new.
const ARRANGING: f64 = 0.8;

/// Where a body is kept, until the next change of a [`Bvh`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LeafId {
    pub(super) tree: u32,
    pub(super) leaf: u32,
}

impl LeafId {
    const NOWHERE: Self = Self {
        tree: u32::MAX,
        leaf: u32::MAX,
    };

    /// Not in a tree yet, but among those that wait.
    pub(super) const WAITING: Self = Self {
        tree: u32::MAX,
        leaf: 0,
    };
}

/// Of no body.
impl Default for LeafId {
    fn default() -> Self {
        Self::NOWHERE
    }
}

/// A body of a [`Bvh`].
#[derive(Debug, Clone, Copy)]
pub struct Leaf<'a, T> {
    /// Where it is kept.
    pub id: LeafId,
    /// Its slot.
    pub slot: u32,
    /// What it was inserted with.
    pub data: &'a T,
}

/// Bounding volume hierarchies: which boxes overlap, which a ray meets, which are near.
///
/// Bodies are named by slot, and carry a `T` from which their boxes follow: the
/// functions that take `bounds` ask it for them. Moving bodies are fitted anew by
/// every [`update`](Self::update), fixed ones only when they come; two fixed ones make
/// no pair.
///
/// A hierarchy has eight children to a node and no pointers: its leaves are sorted
/// so that neighbours in space are neighbours in memory, and every eight make a
/// node. Fitting it is one pass over memory, from the leaves up. The order is kept
/// from frame to frame; as bodies drift, nodes grow, and as soon as that has cost
/// as many tests as sorting anew does, the leaves are sorted anew. Bodies that come are
/// put into a small tree of their own, which is merged with others when it has become
/// an eighth as large, so that the rest is left as it is; those that go leave a
/// vacant leaf. Boxes are kept in `f32`, from an origin amid them, rounded outward.
///
/// ```
/// use feeler::Aabb;
/// use feeler::broad_phase::Bvh;
///
/// let place = |x: &f64| Aabb::new([*x, 0.0, 0.0], [*x + 1.0, 1.0, 1.0]);
/// let mut bvh = Bvh::default();
/// for slot in 0..4 {
///     bvh.insert(slot, slot != 3, 0.8 * f64::from(slot));
/// }
/// bvh.update(place);
/// let mut found = Vec::new();
/// bvh.pairs(|pairs| found.extend(pairs.iter().map(|(a, b)| (a.slot, b.slot))));
/// found.sort();
/// assert_eq!(found, [(0, 1), (1, 2), (2, 3)]);
/// ```
#[derive(Debug, Clone)]
pub struct Bvh<T> {
    /// Boxes are relative to this point.
    pub(super) origin: DVec3,
    /// Trees of moving bodies and of fixed ones; trees without leaves are spare.
    pub(super) trees: Vec<Tree<T>>,
    /// Bodies that are in no tree yet.
    pub(super) waiting: Vec<(Mobility, u32, T)>,
    /// By slot.
    places: Vec<LeafId>,
    /// Moving bodies that were inserted anew since the last update, and the leaves they left with their boxes.
    away: Vec<(u32, LeafId, Bounds)>,
    items: Vec<Item>,
    /// Pairs of the trees there are.
    pub(super) lists: Lists,
}

impl<T> Default for Bvh<T> {
    fn default() -> Self {
        Self {
            origin: DVec3::ZERO,
            trees: Vec::new(),
            waiting: Vec::new(),
            places: Vec::new(),
            away: Vec::new(),
            items: Vec::new(),
            lists: Lists::default(),
        }
    }
}

impl<T: Copy + Sync> Bvh<T> {
    /// Adds the body in `slot`, or takes it out and adds it again.
    ///
    /// It is in no pair before the next [`update`](Self::update).
    pub fn insert(&mut self, slot: u32, moving: bool, data: T) {
        if let Some(&id) = self.places.get(slot as usize)
            && moving
            && let Some(tree) = self.trees.get(id.tree as usize)
            && tree.settled
            && tree.mobility == Mobility::Moving
        {
            self.away.push((slot, id, tree.leaf(id.leaf as usize)));
        }
        self.remove(slot);
        if self.places.len() <= slot as usize {
            self.places.resize(slot as usize + 1, LeafId::NOWHERE);
        }
        let mobility = if moving {
            Mobility::Moving
        } else {
            Mobility::Fixed
        };
        if let Some(place) = self.places.get_mut(slot as usize) {
            *place = LeafId::WAITING;
            self.waiting.push((mobility, slot, data));
        }
    }

    /// Takes the body in `slot` out, if there is one.
    pub fn remove(&mut self, slot: u32) {
        let Some(place) = self.places.get_mut(slot as usize) else {
            return;
        };
        let id = std::mem::replace(place, LeafId::NOWHERE);
        if id == LeafId::WAITING {
            self.waiting.retain(|&(_, other, _)| other != slot);
        } else if let Some(tree) = self.trees.get_mut(id.tree as usize) {
            tree.vacate(id.leaf);
        }
    }

    /// What the body in `slot` carries.
    #[must_use]
    pub fn get(&self, slot: u32) -> Option<&T> {
        let id = *self.places.get(slot as usize)?;
        if id == LeafId::WAITING {
            let waiting = self.waiting.iter();
            let found = waiting.rev().find(|(_, other, _)| *other == slot);
            return found.map(|(_, _, data)| data);
        }
        self.at(id).map(|leaf| leaf.data)
    }

    /// The same, to be changed; the box of a moving body follows with the next
    /// [`update`](Self::update), a static one has to be [inserted](Self::insert) again.
    #[must_use]
    pub fn get_mut(&mut self, slot: u32) -> Option<&mut T> {
        let id = *self.places.get(slot as usize)?;
        if id == LeafId::WAITING {
            let waiting = self.waiting.iter_mut();
            let found = waiting.rev().find(|(_, other, _)| *other == slot);
            return found.map(|(_, _, data)| data);
        }
        let tree = self.trees.get_mut(id.tree as usize)?;
        tree.data.get_mut(id.leaf as usize)
    }

    /// Where the body in `slot` is kept; none if it waits.
    #[must_use]
    pub fn leaf(&self, slot: u32) -> Option<LeafId> {
        let id = *self.places.get(slot as usize)?;
        (id.tree != u32::MAX).then_some(id)
    }

    /// The body kept there.
    #[must_use]
    #[inline]
    pub fn at(&self, id: LeafId) -> Option<Leaf<'_, T>> {
        let tree = self.trees.get(id.tree as usize)?;
        Some(Leaf {
            id,
            slot: *tree.leaves.get(id.leaf as usize)?,
            data: tree.data.get(id.leaf as usize)?,
        })
    }

    /// All bodies, in no particular order.
    pub fn iter(&self) -> impl Iterator<Item = (u32, &T)> {
        let planted = self.trees.iter().flat_map(|tree| {
            let leaves = tree.leaves.iter().copied().zip(&tree.data);
            leaves.filter(|&(slot, _)| slot != NOBODY)
        });
        planted.chain(self.waiting.iter().map(|(_, slot, data)| (*slot, data)))
    }

    /// How many bodies wait for the next [`update`](Self::update) or
    /// [`settle`](Self::settle).
    #[must_use]
    pub fn waiting(&self) -> usize {
        self.waiting.len()
    }

    /// Bytes of memory in use, spare capacity included.
    #[must_use]
    pub fn memory(&self) -> usize {
        self.trees.iter().map(Tree::memory).sum::<usize>()
            + self.places.capacity() * size_of::<LeafId>()
            + self.away.capacity() * size_of::<(u32, LeafId, Bounds)>()
            + self.items.capacity() * size_of::<Item>()
            + self.lists.memory()
            + self.waiting.capacity() * size_of::<(Mobility, u32, T)>()
    }

    /// Fits the boxes of all moving bodies, and takes in those that wait.
    ///
    /// O(moving bodies); O(n log n) of those n whose leaves are sorted anew. Does not
    /// allocate unless there is more of anything than before.
    pub fn update(&mut self, bounds: impl Fn(&T) -> Aabb + Sync) {
        self.lists.clear();
        self.forget_diverted();
        for tree in &mut self.trees {
            tree.settled = false;
        }
        self.return_home(&bounds);
        self.settle(&bounds);
        for mobility in [Mobility::Fixed, Mobility::Moving] {
            self.consolidate(mobility, &bounds);
        }
        self.fit_unsettled(&bounds);
        for index in 0..self.trees.len() {
            let tree = &mut self.trees[index];
            tree.age();
            let leaves = tree.leaves.len() as f64;
            let dear = tree.debt > ARRANGING * leaves * leaves.max(2.0).log2();
            if dear || 2 * tree.vacant > tree.leaves.len() {
                self.merge(&[index], &bounds);
            }
        }
        self.move_origin(&bounds);
        for tree in &mut self.trees {
            // Without bodies it is spare.
            tree.settled = tree.live() > 0;
        }
    }

    /// Puts moving bodies that were inserted anew back into the leaves they left.
    ///
    /// Most have another velocity and are where they were: nothing is out of order, and no trees
    /// have to be merged for their sake. Who is elsewhere now is sorted in there: in the old leaf it would
    /// stretch the boxes above. All boxes are about to be fitted.
    fn return_home(&mut self, bounds: &impl Fn(&T) -> Aabb) {
        let Self {
            trees,
            waiting,
            places,
            away,
            origin,
            ..
        } = self;
        let is_near =
            |data: &T, home: &Bounds| Bounds::around(&bounds(data), *origin).overlaps(home);
        away.sort_unstable_by_key(|&(slot, ..)| slot);
        waiting.retain(|&(mobility, slot, data)| {
            let found = away.binary_search_by_key(&slot, |&(slot, ..)| slot);
            let Some(&(_, home, near)) = found.ok().and_then(|index| away.get(index)) else {
                return true;
            };
            if mobility != Mobility::Moving || !is_near(&data, &near) {
                return true;
            }
            let tree = trees.get_mut(home.tree as usize);
            let (Some(tree), Some(place)) = (tree, places.get_mut(slot as usize)) else {
                return true;
            };
            if !tree.occupy(home.leaf, slot, data) {
                return true;
            }
            *place = home;
            false
        });
        for &(slot, home, near) in &*away {
            let Some(place) = places.get_mut(slot as usize) else {
                continue;
            };
            // It may have come home already, still wait, or be gone.
            let Some(tree) = trees.get(place.tree as usize) else {
                continue;
            };
            if *place == home || tree.mobility != Mobility::Moving {
                continue;
            }
            if let Some(&data) = tree.data.get(place.leaf as usize)
                && is_near(&data, &near)
                && let Some(tree) = trees.get_mut(home.tree as usize)
                && tree.occupy(home.leaf, slot, data)
            {
                let left = std::mem::replace(place, home);
                if let Some(tree) = trees.get_mut(left.tree as usize) {
                    tree.vacate(left.leaf);
                }
            }
        }
        away.clear();
    }

    /// As [`update`](Self::update), but for the boxes of bodies that were there at the
    /// last one: they are left as they are, and so are the pairs among these bodies.
    ///
    /// The caller sees to it that bodies stay within the boxes they were given then:
    /// one whose motion has changed has to be [diverted](Self::divert), or
    /// [inserted](Self::insert) again. `lasting` tells the boxes of the former, for as long as the
    /// others hold.
    ///
    /// O(bodies that are new since the last update or diverted since the last renewal).
    pub fn renew(
        &mut self,
        bounds: impl Fn(&T) -> Aabb + Sync,
        lasting: impl Fn(&T) -> Aabb + Sync,
    ) {
        self.fit_diverted(&lasting);
        self.settle(&bounds);
        self.fit_unsettled(&bounds);
    }

    fn fit_unsettled(&mut self, bounds: &(impl Fn(&T) -> Aabb + Sync)) {
        for tree in &mut self.trees {
            if tree.mobility == Mobility::Moving && !tree.settled {
                tree.fit(|data| Bounds::around(&bounds(data), self.origin));
            }
        }
    }

    /// Puts the bodies that wait into trees, so that queries find them there.
    ///
    /// Inserting n bodies and settling whenever so many wait is O(n log² n) in all.
    pub fn settle(&mut self, bounds: impl Fn(&T) -> Aabb + Sync) {
        if self.waiting.is_empty() {
            return;
        }
        if self.trees.iter().all(|tree| tree.live() == 0)
            && let Some((_, _, data)) = self.waiting.first()
        {
            let middle = bounds(data).centre();
            self.origin = if middle.is_finite() {
                middle
            } else {
                DVec3::ZERO
            };
        }
        for mobility in [Mobility::Fixed, Mobility::Moving] {
            if !self.waiting.iter().any(|(kind, ..)| *kind == mobility) {
                continue;
            }
            let is_spare = |tree: &Tree<T>| tree.live() == 0 && !tree.settled;
            let spare = self.trees.iter().position(is_spare);
            let index = spare.unwrap_or(self.trees.len());
            if spare.is_none() {
                self.trees.push(Tree::new(mobility));
            }
            let tree = &mut self.trees[index];
            tree.mobility = mobility;
            tree.clear();
            self.items.clear();
            for &(_, slot, data) in self.waiting.iter().filter(|(kind, ..)| *kind == mobility) {
                let around = Bounds::around(&bounds(&data), self.origin);
                tree.add((slot, data), around.middle(), &mut self.items);
            }
            self.plant(index, &bounds);
            // Of trees that are about as large, one is made, so that there are few.
            while let Some(other) = self.as_large(index) {
                self.merge(&[index, other], &bounds);
            }
        }
        self.waiting.clear();
    }

    /// Another tree of the same bodies, at most twice as large.
    fn as_large(&self, index: usize) -> Option<usize> {
        let tree = &self.trees[index];
        self.trees
            .iter()
            .enumerate()
            .position(|(other, candidate)| {
                let live = candidate.live();
                other != index
                    && candidate.mobility == tree.mobility
                    && !candidate.settled
                    && live > 0
                    && live <= 2 * tree.live()
            })
    }

    /// Leaves at most two trees, a large one and one an eighth of it at most.
    fn consolidate(&mut self, mobility: Mobility, bounds: &(impl Fn(&T) -> Aabb + Sync)) {
        let is_used = |tree: &Tree<T>| tree.mobility == mobility && tree.live() > 0;
        if self.trees.iter().filter(|tree| is_used(tree)).count() < 2 {
            return;
        }
        let mut indices: Vec<usize> = (0..self.trees.len())
            .filter(|&index| is_used(&self.trees[index]))
            .collect();
        let live = |index: usize| self.trees[index].live();
        indices.sort_by_key(|&index| std::cmp::Reverse(live(index)));
        let small: usize = indices[1..].iter().map(|&index| live(index)).sum();
        if 8 * small >= live(indices[0]) {
            self.merge(&indices, bounds);
        } else if indices.len() > 2 {
            self.merge(&indices[1..], bounds);
        }
    }

    /// Makes one tree of several, in the place of the first.
    fn merge(&mut self, indices: &[usize], bounds: &(impl Fn(&T) -> Aabb + Sync)) {
        let Some((&first, others)) = indices.split_first() else {
            return;
        };
        self.items.clear();
        let mobility = self.trees[first].mobility;
        let mut whole = std::mem::replace(&mut self.trees[first], Tree::new(mobility));
        whole.close_gaps(&mut self.items);
        let more = others.iter().map(|&index| self.trees[index].live()).sum();
        whole.leaves.reserve_exact(more);
        whole.data.reserve_exact(more);
        for &index in others {
            let tree = std::mem::replace(&mut self.trees[index], Tree::new(mobility));
            for (leaf, (&slot, &data)) in tree.leaves.iter().zip(&tree.data).enumerate() {
                if slot != NOBODY {
                    whole.add((slot, data), tree.leaf(leaf).middle(), &mut self.items);
                }
            }
        }
        self.trees[first] = whole;
        self.plant(first, bounds);
    }

    /// Makes a tree of the bodies in it, which are in any order, each with an item.
    fn plant(&mut self, index: usize, bounds: &(impl Fn(&T) -> Aabb + Sync)) {
        let tree = &mut self.trees[index];
        tree.arrange(&mut self.items);
        tree.fit(|data| Bounds::around(&bounds(data), self.origin));
        for (leaf, &slot) in tree.leaves.iter().enumerate() {
            if let Some(place) = self.places.get_mut(slot as usize) {
                *place = LeafId {
                    tree: index as u32,
                    leaf: leaf as u32,
                };
            }
        }
    }

    /// Follows the bodies if they have all gone far from where they were: numbers
    /// far from the origin are coarse.
    fn move_origin(&mut self, bounds: &(impl Fn(&T) -> Aabb + Sync)) {
        let around = self
            .trees
            .iter()
            .fold(Bounds::EMPTY, |all, tree| all.union(&tree.bounds()));
        let (middle, size) = (0.5 * around.middle(), around.max - around.min);
        if middle.length() > 4.0 * size.length() && size.is_finite() {
            self.origin += middle.as_dvec3();
            for tree in &mut self.trees {
                tree.fit(|data| Bounds::around(&bounds(data), self.origin));
            }
        }
    }
}
