//! One hierarchy of boxes.

use super::block::{Block, WIDTH};
use super::bounds::Bounds;
use super::diverted::Marks;
use super::order::{self, Item};
use glam::Vec3;

/// In a leaf whose body has gone.
pub(super) const NOBODY: u32 = u32::MAX;

/// Whether the bodies of a tree move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mobility {
    Fixed,
    Moving,
}

/// Boxes over boxes, eight to a node, without a pointer: node `i` of a level
/// covers nodes `8i..8i + 8` of the level below, of the lowest, leaves.
#[derive(Debug, Clone)]
pub(super) struct Tree<T> {
    pub(super) mobility: Mobility,
    /// Whether it was there at the last update: its pairs are listed, its leaves stay.
    pub(super) settled: bool,
    /// Whose box each leaf holds.
    pub(super) leaves: Vec<u32>,
    /// What is known of each leaf's body: in this order it is read in every frame.
    pub(super) data: Vec<T>,
    /// The lowest first; the last has one node.
    pub(super) levels: Vec<Vec<Block>>,
    /// Leaves of bodies that have another motion since the last update or renewal.
    pub(super) diverted: Marks,
    /// Leaves whose bodies have gone.
    pub(super) vacant: usize,
    /// How much surface there was when the leaves were last arranged.
    pub(super) arranged_surface: f32,
    /// How much there is now.
    pub(super) surface: f32,
    /// What the shape's ageing has cost since, in tests of a block.
    pub(super) debt: f64,
    /// What pairing cost when the leaves were last arranged.
    pub(super) work: f64,
}

impl<T: Copy + Sync> Tree<T> {
    pub(super) fn new(mobility: Mobility) -> Self {
        Self {
            mobility,
            settled: false,
            leaves: Vec::new(),
            data: Vec::new(),
            levels: Vec::new(),
            diverted: Marks::default(),
            vacant: 0,
            arranged_surface: 0.0,
            surface: 0.0,
            debt: 0.0,
            work: 0.0,
        }
    }

    /// Leaves with bodies.
    pub(super) fn live(&self) -> usize {
        self.leaves.len() - self.vacant
    }

    /// The box around everything.
    pub(super) fn bounds(&self) -> Bounds {
        match self.levels.last().and_then(|level| level.first()) {
            Some(root) => root.union(),
            None => Bounds::EMPTY,
        }
    }

    /// Forgets all bodies.
    pub(super) fn clear(&mut self) {
        self.leaves.clear();
        self.data.clear();
        self.vacant = 0;
    }

    /// Adds a body, and an item for it with its `middle`, to be arranged.
    pub(super) fn add(&mut self, (slot, data): (u32, T), middle: Vec3, items: &mut Vec<Item>) {
        items.push((middle, self.leaves.len() as u32));
        self.leaves.push(slot);
        self.data.push(data);
    }

    /// Leaves out vacant leaves; adds an item for each that is left, to be arranged.
    pub(super) fn close_gaps(&mut self, items: &mut Vec<Item>) {
        let mut kept = 0;
        for leaf in 0..self.leaves.len() {
            let slot = self.leaves[leaf];
            if slot != NOBODY {
                items.push((self.leaf(leaf).middle(), kept as u32));
                self.leaves[kept] = slot;
                self.data[kept] = self.data[leaf];
                kept += 1;
            }
        }
        self.leaves.truncate(kept);
        self.data.truncate(kept);
        self.vacant = 0;
    }

    /// Arranges the bodies by their items, which name them by index, and makes nodes whose boxes
    /// are to be fitted.
    pub(super) fn arrange(&mut self, items: &mut [Item]) {
        order::arrange(items);
        // Where they are, without a second list of them: each cycle of changes of place in turn.
        for start in 0..items.len() {
            let (slot, data) = (self.leaves[start], self.data[start]);
            let mut hole = start;
            loop {
                let from = std::mem::replace(&mut items[hole].1, hole as u32) as usize;
                if from == start {
                    break;
                }
                self.leaves[hole] = self.leaves[from];
                self.data[hole] = self.data[from];
                hole = from;
            }
            (self.leaves[hole], self.data[hole]) = (slot, data);
        }
        self.diverted.clear(items.len());
        let mut nodes = items.len();
        let mut level = 0;
        loop {
            nodes = nodes.div_ceil(WIDTH);
            if self.levels.len() == level {
                self.levels.push(Vec::new());
            }
            self.levels[level].clear();
            self.levels[level].resize(nodes, Block::EMPTY);
            level += 1;
            if nodes <= 1 {
                break;
            }
        }
        self.levels.truncate(level);
        (self.arranged_surface, self.debt, self.work) = (0.0, 0.0, 0.0);
    }

    /// Fits all boxes to those of the bodies.
    pub(super) fn fit(&mut self, bounds: impl Fn(&T) -> Bounds + Sync) {
        let bodies = (self.leaves.as_slice(), self.data.as_slice());
        self.surface = fit(&mut self.levels, bodies, bounds);
        if self.arranged_surface <= 0.0 {
            self.arranged_surface = self.surface;
        }
    }

    /// Gives a leaf another box, and fits those above.
    pub(super) fn refit(&mut self, leaf: usize, bounds: Bounds) {
        let (mut index, mut bounds) = (leaf, bounds);
        for level in &mut self.levels {
            if let Some(block) = level.get_mut(index / WIDTH) {
                block.set(index % WIDTH, &bounds);
                bounds = block.union();
            }
            index /= WIDTH;
        }
    }

    /// Empties a leaf. The boxes above shrink when they are fitted next.
    pub(super) fn vacate(&mut self, leaf: u32) {
        if let Some(slot) = self.leaves.get_mut(leaf as usize)
            && *slot != NOBODY
        {
            *slot = NOBODY;
            self.vacant += 1;
            let (block, lane) = (leaf as usize / WIDTH, leaf as usize % WIDTH);
            if let Some(block) = self.levels.first_mut().and_then(|low| low.get_mut(block)) {
                block.set(lane, &Bounds::EMPTY);
            }
        }
    }

    /// Fills a vacant leaf, whose box is to be fitted; answers whether it was one.
    pub(super) fn occupy(&mut self, leaf: u32, slot: u32, data: T) -> bool {
        let leaf = leaf as usize;
        match (self.leaves.get_mut(leaf), self.data.get_mut(leaf)) {
            (Some(place), Some(there)) if *place == NOBODY => {
                (*place, *there) = (slot, data);
                self.vacant -= 1;
                true
            }
            _ => false,
        }
    }

    /// The box of a leaf.
    pub(super) fn leaf(&self, leaf: usize) -> Bounds {
        self.levels
            .first()
            .and_then(|lowest| lowest.get(leaf / WIDTH))
            .map_or(Bounds::EMPTY, |block| block.lane(leaf % WIDTH))
    }

    /// Adds up what pairing costs more than when the leaves were arranged.
    pub(super) fn age(&mut self) {
        let growth = f64::from(self.surface) / f64::from(self.arranged_surface) - 1.0;
        // False for a NaN, of a tree without a surface.
        if growth > 0.0 {
            self.debt += growth * self.work;
        }
    }

    /// Takes note of what pairing cost, if the leaves have just been arranged.
    pub(super) fn note_work(&mut self, tests: u64) {
        if self.work <= 0.0 {
            self.work = tests as f64;
        }
    }

    /// Bytes in use.
    pub(super) fn memory(&self) -> usize {
        let blocks: usize = self.levels.iter().map(Vec::capacity).sum();
        blocks * size_of::<Block>()
            + self.diverted.memory()
            + self.leaves.capacity() * size_of::<u32>()
            + self.data.capacity() * size_of::<T>()
    }
}

/// So many blocks of leaves are worth handing to another thread.
#[cfg(feature = "parallel")]
const HANDED: usize = 256;

/// Fits boxes over leaves with these slots and data; answers with the surface of all nodes.
pub(super) fn fit<T: Sync>(
    levels: &mut [Vec<Block>],
    (leaves, data): (&[u32], &[T]),
    bounds: impl Fn(&T) -> Bounds + Sync,
) -> f32 {
    let Some((lowest, upper)) = levels.split_first_mut() else {
        return 0.0;
    };
    let fit_some = |(blocks, (leaves, data)): (&mut [Block], (&[u32], &[T]))| {
        let bodies = leaves.chunks(WIDTH).zip(data.chunks(WIDTH));
        for (block, (leaves, data)) in blocks.iter_mut().zip(bodies) {
            for (lane, (&slot, data)) in leaves.iter().zip(data).enumerate() {
                if slot != NOBODY {
                    block.set(lane, &bounds(data));
                }
            }
        }
    };
    #[cfg(feature = "parallel")]
    if lowest.len() > 2 * HANDED && rayon::current_num_threads() > 1 {
        use rayon::prelude::*;
        let bodies = leaves
            .par_chunks(WIDTH * HANDED)
            .zip(data.par_chunks(WIDTH * HANDED));
        lowest.par_chunks_mut(HANDED).zip(bodies).for_each(fit_some);
    } else {
        fit_some((lowest, (leaves, data)));
    }
    #[cfg(not(feature = "parallel"))]
    fit_some((lowest, (leaves, data)));
    let mut surface = 0.0;
    let mut below = &mut *lowest;
    for level in upper {
        for (block, children) in level.iter_mut().zip(below.chunks(WIDTH)) {
            for (lane, child) in children.iter().enumerate() {
                let bounds = child.union();
                surface += bounds.surface();
                block.set(lane, &bounds);
            }
        }
        below = level;
    }
    surface
}
