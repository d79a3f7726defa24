//! Pairs of leaves whose boxes overlap.

use super::block::{Block, WIDTH};
use super::bounds::Bounds;
use super::forest::{Leaf, LeafId};
use super::tree::{Mobility, NOBODY, Tree};

/// Some of the pairs that a [`Bvh`](super::Bvh) finds.
#[derive(Debug, Clone, Copy)]
pub struct Portion<'a, T> {
    trees: [&'a Tree<T>; 2],
    numbers: [u32; 2],
    pairs: &'a [(u32, u32)],
}

impl<'a, T: Copy> Portion<'a, T> {
    pub(super) fn new(
        trees: &'a [Tree<T>],
        [a, b]: [usize; 2],
        pairs: &'a [(u32, u32)],
    ) -> Option<Self> {
        Some(Self {
            trees: [trees.get(a)?, trees.get(b)?],
            numbers: [a as u32, b as u32],
            pairs,
        })
    }

    /// How many they are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.pairs.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty()
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
        let Self {
            trees: [tree_a, tree_b],
            numbers,
            pairs,
        } = *self;
        let leaf = |tree: &'a Tree<T>, number: u32, leaf: u32| {
            let slot = *tree.leaves.get(leaf as usize)?;
            // Its body may have gone since the pair was found.
            (slot != NOBODY).then_some(())?;
            Some(Leaf {
                id: LeafId { tree: number, leaf },
                slot,
                data: tree.data.get(leaf as usize)?,
            })
        };
        let both_move = tree_a.mobility == tree_b.mobility;
        let fixed_first = !both_move && tree_a.mobility == Mobility::Fixed;
        pairs.iter().filter_map(move |&(a, b)| {
            let (a, b) = (leaf(tree_a, numbers[0], a)?, leaf(tree_b, numbers[1], b)?);
            let swap = fixed_first || both_move && b.slot < a.slot;
            Some(if swap { (b, a) } else { (a, b) })
        })
    }
}

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
