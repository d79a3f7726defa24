//! A ball cast at every shape, against slow arithmetic of twice the precision.

#![allow(
    clippy::float_cmp,
    reason = "exact answers are asserted where they are due"
)]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "helpers of tests fail and report as tests do"
)]

mod along_edges;
mod check;
mod draw;
mod named;
mod oracle;
mod random;
#[path = "../raycast/twofold.rs"]
mod twofold;
