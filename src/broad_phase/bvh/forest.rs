//! The hierarchies of a world.

use super::bounds::Bounds;
use super::order::Item;
use super::pairs::Job;
use super::tree::{NOBODY, Tree};
use crate::geometry::Aabb;
use glam::DVec3;

/// Pairs are handed out in portions of about so many: few enough to stay in the cache.
const PORTION: usize = 2048;

/// What arranging leaves anew costs, in tests of a block for each leaf and each
/// cut in two. Measured: 4.4 ns to 6.5 ns. What matters is the order of magnitude.
const ARRANGING: f64 = 0.8;

/// Where a body is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    Nowhere,
    /// Not in a tree yet.
    Waiting,
    Leaf {
        tree: u32,
        leaf: u32,
    },
}

/// Bounding volume hierarchies: which boxes overlap, which a ray meets, which are near.
///
/// Bodies are named by slot. Where they are is asked for when it is needed: the
/// functions that take `bounds` call it for the box of a slot. Moving bodies are
/// fitted anew by every [`update`](Self::update), fixed ones never; two fixed ones
/// make no pair.
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
/// let place = |slot: u32| Aabb::new([0.8 * f64::from(slot), 0.0, 0.0], [0.8 * f64::from(slot) + 1.0, 1.0, 1.0]);
/// let mut bvh = Bvh::default();
/// for slot in 0..4 {
///     bvh.insert(slot, slot != 3);
/// }
/// bvh.update(place);
/// let mut found = Vec::new();
/// bvh.pairs(|pairs| found.extend_from_slice(pairs));
/// found.sort();
/// assert_eq!(found, [(0, 1), (1, 2), (2, 3)]);
/// ```
#[derive(Debug, Clone, Default)]
pub struct Bvh {
    /// Boxes are relative to this point.
    origin: DVec3,
    /// Trees of moving bodies and of fixed ones; trees without leaves are spare.
    trees: Vec<(Mobility, Tree)>,
    /// Bodies that are in no tree yet.
    waiting: Vec<(Mobility, u32)>,
    /// By slot.
    places: Vec<Place>,
    items: Vec<Item>,
    jobs: Vec<Job>,
    portion: Vec<(u32, u32)>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mobility {
    Fixed,
    Moving,
}

impl Bvh {
    /// Adds the body in `slot`, or takes it out and adds it again.
    ///
    /// It is in no pair before the next [`update`](Self::update).
    pub fn insert(&mut self, slot: u32, moving: bool) {
        self.remove(slot);
        if self.places.len() <= slot as usize {
            self.places.resize(slot as usize + 1, Place::Nowhere);
        }
        let mobility = if moving {
            Mobility::Moving
        } else {
            Mobility::Fixed
        };
        self.places[slot as usize] = Place::Waiting;
        self.waiting.push((mobility, slot));
    }

    /// Takes the body in `slot` out, if there is one.
    pub fn remove(&mut self, slot: u32) {
        let Some(place) = self.places.get_mut(slot as usize) else {
            return;
        };
        match std::mem::replace(place, Place::Nowhere) {
            Place::Nowhere => {}
            Place::Waiting => self.waiting.retain(|&(_, other)| other != slot),
            Place::Leaf { tree, leaf } => {
                if let Some((_, tree)) = self.trees.get_mut(tree as usize) {
                    tree.vacate(leaf);
                }
            }
        }
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
        let trees = self.trees.iter().map(|(_, tree)| tree.memory());
        trees.sum::<usize>()
            + self.places.capacity() * size_of::<Place>()
            + self.items.capacity() * size_of::<Item>()
            + self.jobs.capacity() * size_of::<Job>()
            + self.portion.capacity() * size_of::<(u32, u32)>()
            + self.waiting.capacity() * size_of::<(Mobility, u32)>()
    }

    /// Fits the boxes of all moving bodies, and takes in those that wait.
    ///
    /// O(moving bodies); O(n log n) of those n whose leaves are sorted anew. Does not
    /// allocate unless there is more of anything than before.
    pub fn update(&mut self, bounds: impl Fn(u32) -> Aabb) {
        self.settle(&bounds);
        for mobility in [Mobility::Fixed, Mobility::Moving] {
            self.consolidate(mobility, &bounds);
        }
        let origin = self.origin;
        let fitted = |slot| Bounds::around(&bounds(slot), origin);
        for (mobility, tree) in &mut self.trees {
            if *mobility == Mobility::Moving {
                tree.fit(fitted);
                tree.age();
            }
        }
        for index in 0..self.trees.len() {
            let (_, tree) = &self.trees[index];
            let leaves = tree.leaves.len() as f64;
            let dear = tree.debt > ARRANGING * leaves * leaves.max(2.0).log2();
            if dear || 2 * tree.vacant > tree.leaves.len() {
                self.merge(&[index], &bounds);
            }
        }
        self.move_origin(&bounds);
    }

    /// Puts the bodies that wait into trees, so that queries find them there.
    ///
    /// Inserting n bodies and settling whenever so many wait is O(n log² n) in all.
    pub fn settle(&mut self, bounds: impl Fn(u32) -> Aabb) {
        if self.waiting.is_empty() {
            return;
        }
        if self.trees.iter().all(|(_, tree)| tree.live() == 0)
            && let Some(&(_, slot)) = self.waiting.first()
        {
            let middle = bounds(slot).centre();
            self.origin = if middle.is_finite() {
                middle
            } else {
                DVec3::ZERO
            };
        }
        for mobility in [Mobility::Fixed, Mobility::Moving] {
            self.items.clear();
            for &(_, slot) in self.waiting.iter().filter(|(kind, _)| *kind == mobility) {
                let around = Bounds::around(&bounds(slot), self.origin);
                self.items.push((around.middle(), slot));
            }
            if self.items.is_empty() {
                continue;
            }
            let spare = self.trees.iter().position(|(_, tree)| tree.live() == 0);
            let index = spare.unwrap_or(self.trees.len());
            if spare.is_none() {
                self.trees.push((mobility, Tree::default()));
            }
            self.trees[index].0 = mobility;
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
        let (mobility, tree) = &self.trees[index];
        self.trees
            .iter()
            .enumerate()
            .position(|(other, (kind, candidate))| {
                let live = candidate.live();
                other != index && kind == mobility && live > 0 && live <= 2 * tree.live()
            })
    }

    /// Leaves at most two trees, a large one and one an eighth of it at most.
    fn consolidate(&mut self, mobility: Mobility, bounds: &impl Fn(u32) -> Aabb) {
        let of_kind = |this: &Self| {
            let trees = this.trees.iter().enumerate();
            let mut found: Vec<usize> = Vec::new();
            found.extend(
                trees
                    .filter(|(_, (kind, tree))| *kind == mobility && tree.live() > 0)
                    .map(|(index, _)| index),
            );
            found
        };
        let count = self
            .trees
            .iter()
            .filter(|(kind, tree)| *kind == mobility && tree.live() > 0);
        if count.count() < 2 {
            return;
        }
        let mut indices = of_kind(self);
        indices.sort_by_key(|&index| std::cmp::Reverse(self.trees[index].1.live()));
        let live = |index: &usize| self.trees[*index].1.live();
        let small: usize = indices[1..].iter().map(live).sum();
        if 8 * small >= live(&indices[0]) {
            self.merge(&indices, bounds);
        } else if indices.len() > 2 {
            self.merge(&indices[1..], bounds);
        }
    }

    /// Makes one tree of several, in the place of the first.
    fn merge(&mut self, indices: &[usize], bounds: &impl Fn(u32) -> Aabb) {
        self.items.clear();
        for &index in indices {
            let (_, tree) = &mut self.trees[index];
            for (leaf, &slot) in tree.leaves.iter().enumerate() {
                if slot != NOBODY {
                    self.items.push((tree.leaf(leaf).middle(), slot));
                }
            }
            tree.leaves.clear();
            tree.vacant = 0;
            if Some(&index) != indices.first() {
                tree.levels.clear();
            }
        }
        if let Some(&index) = indices.first() {
            self.plant(index, bounds);
        }
    }

    /// Makes a tree of the items at hand.
    fn plant(&mut self, index: usize, bounds: &impl Fn(u32) -> Aabb) {
        let (_, tree) = &mut self.trees[index];
        tree.arrange(&mut self.items);
        tree.fit(|slot| Bounds::around(&bounds(slot), self.origin));
        for (leaf, &slot) in tree.leaves.iter().enumerate() {
            if let Some(place) = self.places.get_mut(slot as usize) {
                *place = Place::Leaf {
                    tree: index as u32,
                    leaf: leaf as u32,
                };
            }
        }
    }

    /// Follows the bodies if they have all gone far from where they were: numbers
    /// far from the origin are coarse.
    fn move_origin(&mut self, bounds: &impl Fn(u32) -> Aabb) {
        let around = self
            .trees
            .iter()
            .fold(Bounds::EMPTY, |all, (_, tree)| all.union(&tree.bounds()));
        let (middle, size) = (0.5 * around.middle(), around.max - around.min);
        if middle.length() > 4.0 * size.length() && size.is_finite() {
            self.origin += middle.as_dvec3();
            for (_, tree) in &mut self.trees {
                tree.fit(|slot| Bounds::around(&bounds(slot), self.origin));
            }
        }
    }

    /// Hands out all pairs of bodies whose boxes overlap, in portions, in no
    /// particular order; each once: the moving body first, of two moving ones the lower slot.
    ///
    /// O(bodies + pairs) for boxes of like size. Does not allocate once there have
    /// been as many pairs.
    pub fn pairs(&mut self, mut visit: impl FnMut(&[(u32, u32)])) {
        let mut jobs = std::mem::take(&mut self.jobs);
        let mut portion = std::mem::take(&mut self.portion);
        portion.clear();
        for a in 0..self.trees.len() {
            for b in a..self.trees.len() {
                let Some((start, order)) = self.start(a, b) else {
                    continue;
                };
                jobs.clear();
                jobs.push(start);
                let mut tests = 0;
                while let Some(job) = jobs.pop() {
                    tests += job.step(&self.trees, &mut jobs, |a, b| portion.push(order(a, b)));
                    if portion.len() >= PORTION {
                        visit(&portion);
                        portion.clear();
                    }
                }
                if a == b {
                    self.trees[a].1.note_work(tests);
                }
            }
        }
        if !portion.is_empty() {
            visit(&portion);
        }
        (self.jobs, self.portion) = (jobs, portion);
    }

    /// The first job of two trees, or of one, and how its pairs are told.
    #[expect(clippy::type_complexity, reason = "a function of two slots")]
    fn start(&self, a: usize, b: usize) -> Option<(Job, fn(u32, u32) -> (u32, u32))> {
        let (kind_a, tree_a) = self.trees.get(a)?;
        let (kind_b, tree_b) = self.trees.get(b)?;
        if tree_a.live() == 0 || tree_b.live() == 0 {
            return None;
        }
        let order: fn(u32, u32) -> (u32, u32) = match (kind_a, kind_b) {
            (Mobility::Fixed, Mobility::Fixed) => return None,
            (Mobility::Moving, Mobility::Moving) => |a, b| (a.min(b), a.max(b)),
            (Mobility::Moving, Mobility::Fixed) => |a, b| (a, b),
            (Mobility::Fixed, Mobility::Moving) => |a, b| (b, a),
        };
        Some((Job::new(&self.trees, a, b)?, order))
    }
}
