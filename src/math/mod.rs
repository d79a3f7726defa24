//! Scalar numerics that know no shapes.

#[cfg(feature = "serde")]
pub(crate) mod data;
pub(crate) mod domain;
pub(crate) mod exact;
pub(crate) mod frame;
pub(crate) mod radix;
pub(crate) mod short_list;
