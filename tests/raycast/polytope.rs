//! Polytopes, once hulls can be built.
