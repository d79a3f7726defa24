//! The world: bodies in, contacts out.

mod balls;
mod body;
mod collision_world;
mod config;
mod contact;
#[cfg(feature = "serde")]
mod data;
mod finding;
mod gate;
mod groups;
mod id;
mod pair;
mod queries;
mod slots;
mod solver;
mod stats;
mod step;
mod stirred;
mod tracks;
mod volume;

pub use body::Body;
pub use collision_world::CollisionWorld;
pub use config::{Method, WorldConfig};
pub use contact::{Contact, ContactKind};
pub use groups::Groups;
pub use id::BodyId;
pub use pair::{PairContact, first_contact};
pub use queries::{BodyHit, QueryFilter};
pub use stats::{PhaseTimes, StepStats};
pub use step::Advance;

#[cfg(feature = "serde")]
pub(crate) use data::Orientation;
