//! Broad phase: which pairs of bodies are worth a look at all.
//!
//! By default bodies lie in hierarchies of boxes around what they sweep through in
//! the frame at hand ([`Bvh`]), which also answer queries. The thesis's way is there
//! too: every body lies in a [`Volume`] around its whole path; two bodies whose
//! volumes do not overlap can never touch. The overlapping pairs, found once and
//! kept up to date, are the only ones looked at in each frame. Bodies in free
//! flight have no such volume; their pairs are found frame by frame.
//!
//! Source: the thesis, §2.3.2 and §3.12, for the latter.

mod axes;
mod bounds;
mod bvh;
mod config;
mod frame_pairs;
mod pair_list;
mod rays;

pub use axes::obb_overlap_by_axes;
pub use bvh::{Bvh, Leaf, LeafId, Moment, Portion, View};
pub use config::{BroadPhase, ObbTest};
pub use frame_pairs::{Flight, FrameBox, FramePairs};
pub use pair_list::{PairList, Volume};
pub use rays::obb_overlap_by_rays;
