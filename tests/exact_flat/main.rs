//! Straight casts between shapes with flat faces, against brute force.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "the shapes are given here, and a hunt tells what it found"
)]

mod bodies;
mod cases;
mod found;
mod large;
mod oracle;
mod patch;
mod random;
