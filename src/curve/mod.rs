//! Curves a body can follow.

mod bezier;

pub use bezier::CubicBezier;
