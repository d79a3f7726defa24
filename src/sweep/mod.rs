//! Bounds of a motion: a box around everything a body sweeps through.
//!
//! An oriented box around the *whole* path, made once, for the broad phase
//! before the first frame. It is sound: it holds the body's bounding sphere at
//! every point of the path, rounding included.
//!
//! Source: the thesis, §2.3.1.

mod orientation;
mod path;
mod rest;

pub use path::{along_line, along_spline};
pub use rest::around_static;
