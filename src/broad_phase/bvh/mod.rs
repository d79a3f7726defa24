//! Bounding volume hierarchies over boxes that move a little from frame to frame.

mod block;
mod bounds;
mod diverted;
mod forest;
mod lists;
mod moment;
mod order;
mod pairs;
#[cfg(feature = "parallel")]
mod parallel;
mod portion;
mod probe;
mod tree;

pub use forest::{Bvh, Leaf, LeafId};
pub use moment::{Moment, View};
pub use portion::Portion;
