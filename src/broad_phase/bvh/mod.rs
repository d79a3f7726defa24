//! Bounding volume hierarchies over boxes that move a little from frame to frame.

mod block;
mod bounds;
mod forest;
mod lists;
mod order;
mod pairs;
#[cfg(feature = "parallel")]
mod parallel;
mod probe;
mod tree;

pub use forest::{Bvh, Leaf, LeafId};
pub use pairs::Portion;
