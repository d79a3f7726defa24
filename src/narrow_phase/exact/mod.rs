//! First contact by one ray: the path of the first body's origin against the
//! Minkowski difference of the two bodies.
//!
//! Two bodies that move straight touch when the ray from the origin along their
//! relative motion enters `B ⊕ (−A)`, and part when it leaves it. Where closed
//! forms exist they are used; else the portal that the ray enters by is searched
//! for with support functions, and time, point and normal are computed afresh
//! from the features that touch.

mod abreast;
mod advance;
mod aligned;
mod ball_approach;
mod ball_ball;
mod ball_capsule;
mod ball_crossing;
mod ball_cuboid;
mod ball_glance;
mod ball_line;
mod ball_polytope;
mod ball_start;
mod ball_touch;
mod ball_triangle;
mod body;
mod box_body;
mod box_shared;
mod box_slabs;
mod box_touch;
mod boxes;
mod bridge;
mod cast;
mod cloud;
mod contact_patch;
mod corners;
mod crossing;
mod cubic;
mod curved_balls;
mod edges;
mod extremes;
mod faces;
mod falling;
mod flat;
mod flight;
mod gliding;
mod leaping;
mod meeting;
mod nearness;
mod normal_cone;
mod pair;
mod parting;
mod passages;
mod patch;
mod planes;
mod portal;
mod proof;
mod revolved;
mod rough;
mod settle;
mod sextic;
mod sight;
mod slab;
mod snap;
mod turner;
mod turning;
mod window;

pub use ball_ball::ball_ball;
pub(crate) use ball_ball::two_balls;
pub use ball_crossing::ball_crossing;
pub use ball_touch::ball_touch;
pub use cast::{crossing, touch};
pub use contact_patch::contact_patch;
pub use crossing::{Crossing, Touching};
pub use flat::{flat_crossing, flat_touch};
pub use normal_cone::normal_cone;

pub(crate) use advance::{Encounter, encounter};
pub(crate) use flight::Flight;
