//! First contact of bodies that turn.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "helpers outside the test functions build from input that is fine, or fail the test"
)]

mod combinations;
mod draw;
mod named;
mod oracle;
mod random;
