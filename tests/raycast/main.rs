//! Rays against every shape: conventions, accuracy against slow arithmetic of
//! twice the precision, and the edges of both.

#![allow(
    clippy::float_cmp,
    reason = "exact answers are asserted where they are due"
)]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "helpers of tests fail as tests do"
)]

mod cases;
mod conventions;
mod glances;
mod oracle;
mod past_edges;
mod polytope;
mod random;
mod twofold;
