//! Pairs of leaves whose boxes overlap.

use super::block::{Block, WIDTH};
use super::bounds::Bounds;
use super::forest::Mobility;
use super::tree::Tree;

type Planted = (Mobility, Tree);

/// Two nodes whose leaves are to be compared, each with each; or one, whose leaves
/// are to be compared among themselves.
#[derive(Debug, Clone, Copy)]
pub(super) struct Job {
    /// Tree, level and node.
    a: Node,
    b: Node,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Node {
    tree: u16,
    level: u16,
    index: u32,
}

impl Node {
    fn child(self, lane: u32) -> Self {
        Self {
            level: self.level - 1,
            index: self.index * WIDTH as u32 + lane,
            ..self
        }
    }
}

impl Job {
    /// The leaves of two trees; of one among themselves, if it is named twice.
    pub(super) fn new(trees: &[Planted], a: usize, b: usize) -> Option<Self> {
        Some(Self {
            a: root(trees, a)?,
            b: root(trees, b)?,
        })
    }

    /// Does one step: finds pairs of leaves, or jobs that are left.
    ///
    /// Answers with the number of blocks tested.
    #[inline]
    pub(super) fn step(
        self,
        trees: &[Planted],
        jobs: &mut Vec<Self>,
        mut pair: impl FnMut(u32, u32),
    ) -> u64 {
        let (a, b) = (self.a, self.b);
        let (Some((_, tree_a)), Some((_, tree_b))) =
            (trees.get(a.tree as usize), trees.get(b.tree as usize))
        else {
            return 0;
        };
        let (Some(block_a), Some(block_b)) = (block(tree_a, a), block(tree_b, b)) else {
            return 0;
        };
        if a == b {
            return self.among(tree_a, block_a, jobs, pair);
        }
        // The higher one is opened; of two as high, both.
        if a.level > b.level {
            for lane in lanes(block_a.overlaps(&around(tree_b, b, block_b))) {
                jobs.push(Self {
                    a: a.child(lane),
                    b,
                });
            }
            return 1;
        }
        if b.level > a.level {
            for lane in lanes(block_b.overlaps(&around(tree_a, a, block_a))) {
                jobs.push(Self {
                    a,
                    b: b.child(lane),
                });
            }
            return 1;
        }
        let mut tests = 1;
        for lane_a in lanes(block_a.overlaps(&around(tree_b, b, block_b))) {
            tests += 1;
            for lane_b in lanes(block_b.overlaps(&block_a.lane(lane_a as usize))) {
                if a.level > 0 {
                    jobs.push(Self {
                        a: a.child(lane_a),
                        b: b.child(lane_b),
                    });
                } else {
                    pair(leaf(tree_a, a, lane_a), leaf(tree_b, b, lane_b));
                }
            }
        }
        tests
    }

    #[inline]
    fn among(
        self,
        tree: &Tree,
        block: &Block,
        jobs: &mut Vec<Self>,
        mut pair: impl FnMut(u32, u32),
    ) -> u64 {
        let node = self.a;
        for lane in 0..WIDTH as u32 {
            let later = u32::MAX << 1 << lane;
            for other in lanes(block.overlaps(&block.lane(lane as usize)) & later) {
                if node.level > 0 {
                    jobs.push(Self {
                        a: node.child(lane),
                        b: node.child(other),
                    });
                } else {
                    pair(leaf(tree, node, lane), leaf(tree, node, other));
                }
            }
            if node.level > 0 {
                let child = node.child(lane);
                jobs.push(Self { a: child, b: child });
            }
        }
        WIDTH as u64
    }
}

fn root(trees: &[Planted], tree: usize) -> Option<Node> {
    let height = trees.get(tree)?.1.levels.len();
    Some(Node {
        tree: u16::try_from(tree).ok()?,
        level: u16::try_from(height).ok()?.checked_sub(1)?,
        index: 0,
    })
}

#[inline]
fn block(tree: &Tree, node: Node) -> Option<&Block> {
    tree.levels
        .get(node.level as usize)?
        .get(node.index as usize)
}

/// The box around a node, which the node above it holds.
#[inline]
fn around(tree: &Tree, node: Node, block: &Block) -> Bounds {
    let above = tree.levels.get(node.level as usize + 1);
    match above.and_then(|level| level.get(node.index as usize / WIDTH)) {
        Some(parent) => parent.lane(node.index as usize % WIDTH),
        None => block.union(),
    }
}

#[inline]
fn leaf(tree: &Tree, node: Node, lane: u32) -> u32 {
    let index = node.index as usize * WIDTH + lane as usize;
    tree.leaves
        .get(index)
        .copied()
        .unwrap_or(super::tree::NOBODY)
}

/// The numbers of the bits that are set, ascending.
#[inline]
fn lanes(mut bits: u32) -> impl Iterator<Item = u32> {
    std::iter::from_fn(move || {
        (bits != 0).then(|| {
            let lane = bits.trailing_zeros();
            bits &= bits - 1;
            lane
        })
    })
}
