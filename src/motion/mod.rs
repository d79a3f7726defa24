//! How bodies move.
//!
//! A [`Motion`] carries a point of the body: it stays, follows a [`Path`], or flies
//! freely. About that point the body may turn: not at all, at a constant rate
//! ([`Motion::spin`]), or along the path's tangent ([`Motion::facing`]).

mod bounds;
#[cfg(feature = "serde")]
mod data;
mod facing;
mod frame_motion;
mod journey;
mod kind;
mod leg;
mod passage;
mod path;
mod spin;
mod stretch;
#[cfg(test)]
mod tests;
mod track;
mod turning;

pub use facing::Facing;
pub use journey::AtEnd;
pub use kind::Motion;
pub use path::Path;
pub use spin::Spin;

pub(crate) use frame_motion::FrameMotion;
pub(crate) use passage::{Bend, TurningRate};
pub(crate) use stretch::{Course, Spot, Stretch};
pub(crate) use track::{Milestone, Track};
pub(crate) use turning::Turning;
