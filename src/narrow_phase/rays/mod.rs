//! The thesis's method: rays from the surface, along the relative motion.
//!
//! The shortest ray tells how far the first body may travel. How close it comes
//! to the truth depends on where the rays start; see [`RayConfig`].

mod aim;
mod caster;
mod config;
mod crossings;
mod facing;
mod parting;
mod refine;
mod shadow;
mod starts;

pub use config::{Chords, Overlaps, Placement, RayConfig, Refinement, Senders};

pub(crate) use caster::RayCaster;
pub(crate) use facing::Standing;
pub(crate) use parting::part;
