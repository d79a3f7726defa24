//! The world against its enemies: every door, every convention, every scale.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "planted input that is refused shall fail the test"
)]

mod broad;
mod conventions;
mod doors;
mod ends;
mod oracle;
mod random;
mod sampled_error;
mod scale;
mod support;
mod unwatched;
