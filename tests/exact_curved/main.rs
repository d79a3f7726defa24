//! First contact of bodies on curves.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stderr,
    reason = "helpers outside the test functions build from input that is fine, or fail the test"
)]

mod named;
mod out_of_reach;
mod routes;
mod seams;
mod sliding;
