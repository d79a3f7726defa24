//! The bounds of a kept pair.
