//! Curves, splines and paths against closed forms and a slow oracle.

#![allow(
    clippy::unwrap_used,
    reason = "helpers outside the test functions build from input that is fine"
)]
#![allow(
    clippy::float_cmp,
    reason = "ends and clamped values are met bit for bit"
)]

mod doors;
mod forms;
mod lengths;
mod support;
mod table;
mod walks;
