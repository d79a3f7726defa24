//! How bodies move.

#[cfg(feature = "serde")]
mod data;
mod frame_motion;
mod kind;
mod path;

pub use kind::Motion;
pub use path::Path;

pub(crate) use frame_motion::FrameMotion;
