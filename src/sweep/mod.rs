//! Bounds of a motion: a box around everything a body sweeps through.
//!
//! An oriented box around the *whole* path, made once, for the broad phase
//! before the first frame; an axis-aligned box around one frame for bodies whose
//! path nobody knows in advance. Both are sound: they hold the body's bounding
//! sphere at every point of the path, rounding included.
//!
//! Source: the thesis, §2.3.1.

mod frame;
mod orientation;
mod path;
mod rest;

pub use frame::swept_aabb;
pub use path::{along_line, along_spline};
pub use rest::around_static;
