//! How bodies move.

mod frame_motion;
mod kind;
mod path;

pub use kind::Motion;
pub use path::Path;

pub(crate) use frame_motion::FrameMotion;
