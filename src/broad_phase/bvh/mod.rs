//! Bounding volume hierarchies over boxes that move a little from frame to frame.

mod block;
mod bounds;
mod forest;
mod order;
mod pairs;
mod tree;

pub use forest::Bvh;
