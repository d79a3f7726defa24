//! The same pairs in worlds, in frames of any length.
