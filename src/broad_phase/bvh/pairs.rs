//! Pairs of leaves whose boxes overlap.

use super::block::{Block, WIDTH};
use super::bounds::Bounds;
use super::tree::{NOBODY, Tree};

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
    /// The trees it is about, the larger one first, if the other is much smaller; and
    /// whether they are named the other way round.
    pub(super) fn lopsided<T: Copy + Sync>(
        self,
        trees: &[Tree<T>],
    ) -> Option<([&Tree<T>; 2], bool)> {
        /// With less of a difference nodes are compared with nodes.
        const MUCH: usize = 4;
        let (a, b) = (
            trees.get(self.a.tree as usize)?,
            trees.get(self.b.tree as usize)?,
        );
        if MUCH * b.live() <= a.live() {
            Some(([a, b], false))
        } else if MUCH * a.live() <= b.live() {
            Some(([b, a], true))
        } else {
            None
        }
    }

    /// The leaves of two trees; of one among themselves, if it is named twice.
    pub(super) fn new<T: Copy>(trees: &[Tree<T>], a: usize, b: usize) -> Option<Self> {
        Some(Self {
            a: root(trees, a)?,
            b: root(trees, b)?,
        })
    }

    /// Does one step: finds pairs of leaves, or jobs that are left.
    ///
    /// Answers with the number of blocks tested.
    #[cfg(feature = "parallel")]
    #[inline]
    pub(super) fn step<T: Copy>(
        self,
        trees: &[Tree<T>],
        jobs: &mut Vec<Self>,
        mut pair: impl FnMut(u32, u32),
    ) -> u64 {
        let (a, b) = (self.a, self.b);
        let (Some(tree_a), Some(tree_b)) = (trees.get(a.tree as usize), trees.get(b.tree as usize))
        else {
            return 0;
        };
        let (Some(block_a), Some(block_b)) = (block(tree_a, a), block(tree_b, b)) else {
            return 0;
        };
        if a == b {
            return self.among(block_a, jobs, pair);
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
                    pair(leaf(a, lane_a), leaf(b, lane_b));
                }
            }
        }
        tests
    }

    /// Finds all pairs of the two nodes' leaves; answers with the number of blocks tested.
    pub(super) fn run<T: Copy>(self, trees: &[Tree<T>], pair: &mut impl FnMut(u32, u32)) -> u64 {
        let (a, b) = (self.a, self.b);
        let (Some(tree_a), Some(tree_b)) = (trees.get(a.tree as usize), trees.get(b.tree as usize))
        else {
            return 0;
        };
        if a == b {
            return within(tree_a, a.level as usize, a.index as usize, pair);
        }
        let (Some(block_a), Some(block_b)) = (block(tree_a, a), block(tree_b, b)) else {
            return 0;
        };
        let around_b = around(tree_b, b, block_b);
        if a.level == b.level {
            let nodes = [a.index as usize, b.index as usize];
            return between([tree_a, tree_b], a.level as usize, nodes, &around_b, pair);
        }
        // The higher one is opened.
        let mut tests = 1;
        if a.level > b.level {
            for lane in lanes(block_a.overlaps(&around_b)) {
                let a = a.child(lane);
                tests += Self { a, b }.run(trees, pair);
            }
        } else {
            for lane in lanes(block_b.overlaps(&around(tree_a, a, block_a))) {
                let b = b.child(lane);
                tests += Self { a, b }.run(trees, pair);
            }
        }
        tests
    }

    #[cfg(feature = "parallel")]
    #[inline]
    fn among(self, block: &Block, jobs: &mut Vec<Self>, mut pair: impl FnMut(u32, u32)) -> u64 {
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
                    pair(leaf(node, lane), leaf(node, other));
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

/// All pairs of a leaf of one tree with some leaves of another, which is much smaller:
/// `small` tells which, `of` both trees, the larger one first.
///
/// Bodies of a small tree lie far from each other, and the box around eight of them
/// overlaps nearly everything: each is looked for by itself.
pub(super) fn across<T: Copy + Sync>(
    of: [&Tree<T>; 2],
    small: std::ops::Range<usize>,
    mut pair: impl FnMut(u32, u32),
) -> u64 {
    let [large, tree] = of;
    let Some(level) = large.levels.len().checked_sub(1) else {
        return 0;
    };
    let mut tests = 0;
    for leaf in small {
        if tree.leaves.get(leaf).is_some_and(|&slot| slot != NOBODY) {
            let bounds = tree.leaf(leaf);
            tests += below(large, level, 0, &bounds, &mut |found| {
                pair(found, leaf as u32);
            });
        }
    }
    tests
}

/// All leaves below one node whose boxes overlap `bounds`.
pub(super) fn below<T>(
    tree: &Tree<T>,
    level: usize,
    index: usize,
    bounds: &Bounds,
    found: &mut impl FnMut(u32),
) -> u64 {
    let Some(block) = tree.levels.get(level).and_then(|nodes| nodes.get(index)) else {
        return 0;
    };
    let mut tests = 1;
    for lane in lanes(block.overlaps(bounds)) {
        let child = index * WIDTH + lane as usize;
        if level == 0 {
            found(child as u32);
        } else {
            tests += below(tree, level - 1, child, bounds, found);
        }
    }
    tests
}

/// All pairs of leaves below one node.
fn within<T>(tree: &Tree<T>, level: usize, index: usize, pair: &mut impl FnMut(u32, u32)) -> u64 {
    let Some(block) = tree.levels.get(level).and_then(|nodes| nodes.get(index)) else {
        return 0;
    };
    let first = index * WIDTH;
    let mut tests = WIDTH as u64;
    for lane in 0..WIDTH {
        let later = u32::MAX << 1 << lane;
        for other in lanes(block.overlaps(&block.lane(lane)) & later) {
            let other = other as usize;
            if level == 0 {
                pair((first + lane) as u32, (first + other) as u32);
            } else {
                let nodes = [first + lane, first + other];
                tests += between([tree; 2], level - 1, nodes, &block.lane(other), pair);
            }
        }
        if level > 0 {
            tests += within(tree, level - 1, first + lane, pair);
        }
    }
    tests
}

/// All pairs of a leaf below one node and a leaf below another as high.
fn between<T>(
    trees: [&Tree<T>; 2],
    level: usize,
    nodes: [usize; 2],
    around_b: &Bounds,
    pair: &mut impl FnMut(u32, u32),
) -> u64 {
    let block = |side: usize| trees[side].levels.get(level)?.get(nodes[side]);
    let (Some(a), Some(b)) = (block(0), block(1)) else {
        return 0;
    };
    let first = nodes.map(|node| node * WIDTH);
    let mut tests = 1;
    for lane_a in lanes(a.overlaps(around_b)) {
        tests += 1;
        let lane_a = lane_a as usize;
        for lane_b in lanes(b.overlaps(&a.lane(lane_a))) {
            let lane_b = lane_b as usize;
            let [node_a, node_b] = [first[0] + lane_a, first[1] + lane_b];
            if level == 0 {
                pair(node_a as u32, node_b as u32);
            } else {
                let around_b = b.lane(lane_b);
                tests += between(trees, level - 1, [node_a, node_b], &around_b, pair);
            }
        }
    }
    tests
}

fn root<T>(trees: &[Tree<T>], tree: usize) -> Option<Node> {
    let height = trees.get(tree)?.levels.len();
    Some(Node {
        tree: u16::try_from(tree).ok()?,
        level: u16::try_from(height).ok()?.checked_sub(1)?,
        index: 0,
    })
}

#[inline]
fn block<T>(tree: &Tree<T>, node: Node) -> Option<&Block> {
    tree.levels
        .get(node.level as usize)?
        .get(node.index as usize)
}

/// The box around a node, which the node above it holds.
#[inline]
fn around<T>(tree: &Tree<T>, node: Node, block: &Block) -> Bounds {
    let above = tree.levels.get(node.level as usize + 1);
    match above.and_then(|level| level.get(node.index as usize / WIDTH)) {
        Some(parent) => parent.lane(node.index as usize % WIDTH),
        None => block.union(),
    }
}

#[cfg(feature = "parallel")]
#[inline]
fn leaf(node: Node, lane: u32) -> u32 {
    node.index * WIDTH as u32 + lane
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
