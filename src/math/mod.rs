//! Scalar numerics that know no shapes.

pub(crate) mod domain;
pub(crate) mod exact;
pub(crate) mod frame;
