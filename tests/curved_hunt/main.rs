//! A hunt for wrong first contacts of bodies on curves and in rotation.
//!
//! The oracle shares no code with the crate: [`route`] measures curves by Simpson's rule, [`course`]
//! moves and turns bodies by the formulas of the thesis, [`solid`] finds the faces of hulls by trying
//! every three points, [`gap`] measures distances feature by feature and axis by axis, and
//! [`look`] bisects time until nothing can hide between two looks.
//!
//! `CASTS` and `SEED` in the environment make it longer and other.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stderr,
    reason = "helpers outside the test functions build from input that is fine, or fail the test"
)]

mod course;
mod draw;
mod found;
mod gap;
mod hunt;
mod look;
mod plan;
mod random;
mod route;
mod solid;
mod verdict;
mod worlds;
