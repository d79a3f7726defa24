//! In which order boxes become leaves.

use super::block::WIDTH;
use glam::Vec3;

/// A leaf-to-be: twice its box's middle, and whose box it is.
pub(super) type Item = (Vec3, u32);

/// Sorts `items` so that eight in a row lie close together, and so do eight of
/// these rows, and so on: the leaves of a hierarchy without a gap.
///
/// Cuts in two, across the axis along which the middles are spread widest, as near
/// to the half as whole rows allow, until a row is left. O(n log n), whatever the
/// middles: neither clusters nor far outliers make rows longer.
pub(super) fn arrange(items: &mut [Item]) {
    let rows = items.len().div_ceil(WIDTH);
    if rows <= 1 {
        return;
    }
    // The largest block of rows that is not the whole: a power of the width.
    let mut block = WIDTH;
    while block * WIDTH < items.len() {
        block *= WIDTH;
    }
    let blocks = items.len().div_ceil(block);
    let cut = blocks / 2 * block;
    let axis = widest_axis(items);
    items.select_nth_unstable_by(cut, |(a, one), (b, other)| {
        a[axis].total_cmp(&b[axis]).then(one.cmp(other))
    });
    let (low, high) = items.split_at_mut(cut);
    #[cfg(feature = "parallel")]
    if items_are_many(low) && rayon::current_num_threads() > 1 {
        rayon::join(|| arrange(low), || arrange(high));
        return;
    }
    arrange(low);
    arrange(high);
}

/// Whether they are worth handing to another thread.
#[cfg(feature = "parallel")]
fn items_are_many(items: &[Item]) -> bool {
    items.len() >= 4096
}

fn widest_axis(items: &[Item]) -> usize {
    let mut min = Vec3::INFINITY;
    let mut max = Vec3::NEG_INFINITY;
    for (middle, _) in items {
        min = min.min(*middle);
        max = max.max(*middle);
    }
    (max - min).max_position()
}
