//! The world: bodies in, contacts out.
//!
//! # Many bodies
//!
//! A frame costs time for every moving body and for every pair that comes near each
//! other; bodies that stand cost nothing. What all frames read of a body is its
//! track, some hundred bytes, kept in the order of the broad phase; the rest of it is read when
//! it comes near another. All in all a body takes some seven hundred bytes,
//! [`CollisionWorld::memory`] says how much; a million fit in one gigabyte. A frame in which there is no more of anything
//! than before allocates nothing, on one thread.
//!
//! With the feature `parallel` a step and a batch of rays use the threads of the
//! rayon pool they are called in: `pool.install(|| world.step(dt))`. Everything
//! that is told is the same, to the bit and in the same order, on any number of threads.
//!
//! # Worlds beyond one machine
//!
//! One world lives in one process. A larger one can be cut in three ways, and what
//! a world promises makes each of them sound:
//!
//! - *By space.* Each machine has the bodies of one region and, as guests, those of its
//!   neighbours whose motion in the frame reaches within the largest body's
//!   size of the border. A contact belongs to the region that holds its point. It
//!   does not matter who reports it: a contact depends on the two bodies and the frame
//!   alone, to the bit, whoever else is there and in whichever order they came.
//!   Between two frames the bodies that crossed the border change hands, as
//!   [`remove`](CollisionWorld::remove) on one side and
//!   [`insert`](CollisionWorld::insert) on the other; ten thousand in a frame do not
//!   disturb the rest. Static bodies are given to every region they reach once and for all.
//! - *By time.* Contacts are exact however long the frame, so that scripted motion
//!   (paths) can be handed out by intervals: a machine starts from the scene as it is at the
//!   beginning of its interval and reports what touches in it. A pair that
//!   touches across the seam is told by both, and one of them is dropped: the later one
//!   reports an overlap, or a touch at fraction 0. Where contacts change motions, time cannot
//!   be cut; there [`step_to_contact`](CollisionWorld::step_to_contact) goes from one to the next.
//! - *By scene.* A study of many scenes, variants of a plan or samples of an
//!   uncertainty, is cut by itself. A scene is a text file (`Scene`, feature `serde`) in which everything is, seeds included,
//!   so that a queue of files and a program that runs one are all it takes: any
//!   batch scheduler, or a data-flow engine that maps a function over a table of scenes,
//!   runs it, repeats what failed, and gets the same answer from whichever machine.

mod balls;
mod body;
mod collision_world;
mod config;
mod contact;
#[cfg(feature = "serde")]
mod data;
mod finding;
mod findings;
mod first_contact;
mod gate;
mod groups;
mod horizon;
mod id;
mod looks;
mod pair;
mod portions;
mod queries;
#[cfg(feature = "parallel")]
mod shared;
mod sifting;
mod skew;
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
pub use first_contact::{PairContact, first_contact};
pub use groups::Groups;
pub use id::BodyId;
pub use queries::{BodyHit, QueryFilter};
pub use stats::{PhaseTimes, StepStats};
pub use step::Advance;

#[cfg(feature = "serde")]
pub(crate) use data::Orientation;
