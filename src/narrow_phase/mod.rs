//! What exactly happens between two bodies.

pub(crate) mod overlap;
