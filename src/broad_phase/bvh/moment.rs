//! Boxes of one moment.

use super::Bvh;
use super::block::Block;
use super::bounds::Bounds;
use super::tree;
use crate::geometry::Aabb;

/// The boxes that the bodies of a [`Bvh`] have at one moment, over the same leaves.
///
/// Its own hold for a frame or for several. They are larger than what a ray has to look
/// at: one into 100 000 balls meets twice as many.
#[derive(Debug, Clone, Default)]
pub struct Moment {
    /// By tree, then by level.
    pub(super) trees: Vec<Vec<Vec<Block>>>,
}

impl Moment {
    /// Bytes of memory in use, spare capacity included.
    #[must_use]
    pub fn memory(&self) -> usize {
        let levels = self.trees.iter().flatten();
        levels.map(Vec::capacity).sum::<usize>() * size_of::<Block>()
    }
}

/// What is asked of a [`Bvh`]: by its own boxes, or by those of a [`Moment`].
#[derive(Debug, Clone, Copy)]
pub struct View<'a, T> {
    pub(super) bvh: &'a Bvh<T>,
    pub(super) moment: Option<&'a Moment>,
}

impl<T: Copy + Sync> Bvh<T> {
    /// The boxes that `bounds` tells, of all bodies but those that wait; in the memory of
    /// `room`, an earlier moment that is of no use any more.
    ///
    /// It is of use until the next change of the hierarchies.
    #[must_use]
    pub fn moment(&self, room: Moment, bounds: impl Fn(&T) -> Aabb + Sync) -> Moment {
        let mut moment = room;
        moment.trees.resize(self.trees.len(), Vec::new());
        for (levels, tree) in moment.trees.iter_mut().zip(&self.trees) {
            levels.resize(tree.levels.len(), Vec::new());
            for (level, blocks) in levels.iter_mut().zip(&tree.levels) {
                level.clear();
                level.resize(blocks.len(), Block::EMPTY);
            }
            let bounds = |data: &T| Bounds::around(&bounds(data), self.origin);
            tree::fit(levels, (&tree.leaves, &tree.data), bounds);
        }
        moment
    }

    /// The bodies in their own boxes, or in those of a moment.
    #[must_use]
    pub fn view<'a>(&'a self, moment: Option<&'a Moment>) -> View<'a, T> {
        View { bvh: self, moment }
    }
}
