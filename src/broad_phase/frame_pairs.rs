//! Pairs of bodies in free flight, frame by frame.

use crate::geometry::Aabb;

/// Where a body can be during one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameBox {
    /// The body.
    pub slot: u32,
    /// The box around all places where it will be.
    pub aabb: Aabb,
    /// How it moves.
    pub flight: Flight,
}

/// How a body moves, as far as pairs are concerned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flight {
    /// Not at all.
    Fixed,
    /// Along a path known in advance.
    Path,
    /// Freely.
    Free,
}

/// The pairs with a body in free flight in them whose boxes overlap in a frame.
///
/// Bodies on paths and fixed ones make no pairs among themselves: a
/// [`PairList`](super::PairList) has those. Sweeps along the axis on which the
/// boxes are spread widest; O(n log n) and the boxes that overlap along this axis.
///
/// ```
/// use feeler::Aabb;
/// use feeler::broad_phase::{Flight, FrameBox, FramePairs};
///
/// let cube = |slot, x, flight| {
///     let aabb = Aabb::new([x, 0.0, 0.0], [x + 1.0, 1.0, 1.0]);
///     FrameBox { slot, aabb, flight }
/// };
/// let mut pairs = FramePairs::default();
/// pairs.update([
///     cube(0, 0.0, Flight::Fixed),
///     cube(1, 0.5, Flight::Free),
///     cube(2, 1.2, Flight::Free),
///     cube(3, 0.2, Flight::Path),
/// ]);
/// let mut found = pairs.pairs().to_vec();
/// found.sort();
/// assert_eq!(found, [(1, 0), (1, 2), (1, 3), (2, 3)]);
/// ```
#[derive(Debug, Clone, Default)]
pub struct FramePairs {
    free: Vec<FrameBox>,
    bound: Vec<FrameBox>,
    pairs: Vec<(u32, u32)>,
}

impl FramePairs {
    /// The pairs of the last update, in no particular order: the moving body
    /// first, of two moving ones the lower slot.
    #[must_use]
    pub fn pairs(&self) -> &[(u32, u32)] {
        &self.pairs
    }

    /// Finds the pairs of a frame. Does not allocate once it has seen as many.
    pub fn update(&mut self, boxes: impl IntoIterator<Item = FrameBox>) {
        let Self { free, bound, pairs } = self;
        free.clear();
        bound.clear();
        pairs.clear();
        for frame_box in boxes {
            match frame_box.flight {
                Flight::Free => free.push(frame_box),
                Flight::Fixed | Flight::Path => bound.push(frame_box),
            }
        }
        if free.is_empty() {
            return;
        }
        let axis = widest_axis(free);
        let low = |frame_box: &FrameBox| frame_box.aabb.min[axis];
        free.sort_unstable_by(|a, b| low(a).total_cmp(&low(b)));
        bound.sort_unstable_by(|a, b| low(a).total_cmp(&low(b)));
        for (index, one) in free.iter().enumerate() {
            sweep(one, &free[index + 1..], axis, pairs);
        }
        // Of two boxes of different kinds the one that begins first finds the other.
        let mut begun = 0;
        for one in free.iter() {
            begun += bound[begun..].partition_point(|other| low(other) < low(one));
            sweep(one, &bound[begun..], axis, pairs);
        }
        let mut begun = 0;
        for one in bound.iter() {
            begun += free[begun..].partition_point(|other| low(other) <= low(one));
            sweep(one, &free[begun..], axis, pairs);
        }
    }
}

/// Pairs `one` with those of `others`, none of which begins before it, that overlap it.
fn sweep(one: &FrameBox, others: &[FrameBox], axis: usize, pairs: &mut Vec<(u32, u32)>) {
    let reached = |other: &&FrameBox| other.aabb.min[axis] <= one.aabb.max[axis];
    for other in others.iter().take_while(reached) {
        if one.aabb.overlaps(&other.aabb) {
            pairs.push(ordered(one, other));
        }
    }
}

fn ordered(a: &FrameBox, b: &FrameBox) -> (u32, u32) {
    let first = match (a.flight, b.flight) {
        (Flight::Fixed, _) => b,
        (_, Flight::Fixed) => a,
        _ if a.slot < b.slot => a,
        _ => b,
    };
    (
        first.slot,
        if first.slot == a.slot { b.slot } else { a.slot },
    )
}

/// The axis along which the boxes' middles vary most.
fn widest_axis(boxes: &[FrameBox]) -> usize {
    let middles = || boxes.iter().map(|frame_box| frame_box.aabb.centre());
    let spread = Aabb::around(middles()).half_extents();
    let count = boxes.len() as f64;
    let mean = middles().sum::<glam::DVec3>() / count;
    let variance = middles()
        .map(|middle| (middle - mean) * (middle - mean))
        .sum::<glam::DVec3>();
    // Far from the origin squares can overflow; the plain spread cannot.
    if variance.is_finite() {
        variance.max_position()
    } else {
        spread.max_position()
    }
}
