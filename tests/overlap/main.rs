//! Overlap of two shapes: against an oracle, planted answers, conventions.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "helpers of tests fail as tests do"
)]
#![allow(
    clippy::float_cmp,
    reason = "exchanging the shapes must give the same bits"
)]
#![allow(unreachable_pub, reason = "modules of one test")]

mod case;
mod close;
mod conventions;
mod oracle;
mod planted;
mod random;
mod slivers;
