//! Where surface rays start.
//!
//! All placements depend on their arguments and the seed alone: the same seed
//! gives the same points, bit for bit, on every platform. Random bits become
//! numbers by code of this crate, angles go through `libm`, because neither
//! `rand`'s distributions nor the platform's `sin` promise that.

mod hemisphere;
mod lattice;
mod seed;
mod triangle;

pub use hemisphere::{hemisphere_even, hemisphere_grid};
pub use lattice::square_lattice;
pub use triangle::{triangle_even, triangle_thesis};

pub(crate) use hemisphere::turn_zenith;
pub(crate) use seed::UnitStream;
