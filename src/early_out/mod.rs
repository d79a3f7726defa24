//! Early-outs: pairs that cannot touch within the frame.
//!
//! Bounding spheres, three tests, each with a name, so that a caller can count
//! how often which one spared the narrow phase its work.

mod counts;
mod rejection;

pub use counts::RejectionCounts;
pub use rejection::{Rejection, reject};
