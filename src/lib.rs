//! Continuous collision detection by casting rays.
//!
//! Bodies that move send rays ahead of themselves, like feelers; the shortest
//! ray tells when, where and with which normal two bodies touch. Nothing is
//! missed because it happens between two frames: a frame may take a
//! millisecond or ten seconds.
//!
//! ```
//! use feeler::{Body, CollisionWorld, Motion, Path, Sphere};
//!
//! let mut world = CollisionWorld::default();
//! world.insert(Body::fixed(Sphere::new(1.0)?, [0.0, 0.0, 0.0]))?;
//! let path = Path::line([3.0, 0.0, 1.0], [0.0, 0.0, 1.0])?;
//! world.insert(Body::moving(Sphere::new(1.0)?, Motion::along(path, 1.0)?))?;
//!
//! let mut touches = 0;
//! for _frame in 0..72 {
//!     for contact in world.step(1.0 / 24.0)? {
//!         touches += usize::from(contact.is_touch());
//!     }
//! }
//! assert_eq!(touches, 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Conventions
//!
//! - Lengths are metres, times seconds, angles radians; all numbers are `f64`,
//!   points are [`glam::DVec3`]. Arguments take `impl Into<DVec3>`: arrays,
//!   tuples and `glam::Vec3` work. Axes are right-handed, with no up.
//! - A *fraction* is a share of a frame or a ray, a *length* or *distance* an
//!   arc length, *u* the parameter of a curve.
//! - A *normal* is of unit length and leads out of the second body of a pair,
//!   towards the first.
//! - Bodies are solid and closed: touching counts as contact, parting and
//!   sliding along do not.
//! - Bad input stops at the door: every call that takes some returns one of
//!   the small errors in [`error`], which names field, value and limit, and
//!   changes nothing. The limits are in [`tolerance`]. Behind the doors nothing
//!   panics and no NaN comes out.
//! - The same calls give the same bits, on every platform.
//!
//! # How a frame goes
//!
//! Bodies and motions → every body's motion in the frame → pairs whose boxes
//! around it overlap ([`broad_phase`]) → pairs that no early-out
//! rejects ([`early_out`]) → first contact of each ([`narrow_phase`]) → contacts
//! sorted → bodies advanced. It is one function of one file, `world/step.rs`,
//! and [`StepStats`] counts and times each phase.
//!
//! # Where things are
//!
//! Modules import only from those further down this list.
//!
//! | module | what it holds |
//! |---|---|
//! | `scene` | whole scenes to be read and written (feature `serde`) |
//! | [`world`] | [`CollisionWorld`], bodies, contacts, settings, one frame |
//! | [`narrow_phase`] | exact casts; the ray method; overlap depths |
//! | [`early_out`] | three tests that reject a pair in a few operations |
//! | [`broad_phase`] | pairs whose boxes overlap: hierarchies, lists, all |
//! | [`sweep`] | boxes around whole paths |
//! | [`motion`] | paths, motions along them, spin |
//! | [`raycast`] | a ray against each shape |
//! | [`sampling`] | where surface rays start |
//! | [`curve`] | Hermite, Bézier and Catmull–Rom curves, splines, arc length |
//! | [`geometry`] | shapes and what they are made of |
//! | [`tolerance`] | every tolerance and limit, and why |
//!
//! # The source
//!
//! The method is that of a German diploma thesis, *Kollisionserkennung mit
//! Raytracing* (collision detection by ray tracing). Docs cite its sections and
//! equations; [`RayConfig::thesis`] sets the method as it was published, and
//! `cargo run --release --example thesis` puts its tables beside ours.

pub mod broad_phase;
pub mod curve;
pub mod early_out;
pub mod error;
pub mod geometry;
mod math;
pub mod motion;
pub mod narrow_phase;
pub mod raycast;
pub mod sampling;
#[cfg(feature = "serde")]
pub mod scene;
pub mod sweep;
pub mod tolerance;
pub mod world;

pub use broad_phase::{BroadPhase, ObbTest};
pub use curve::{ArcLengthRow, ArcLengthTable, CubicBezier, Knots, Spline};
#[cfg(feature = "serde")]
pub use error::SceneError;
pub use error::{
    BodyError, ConfigError, FirstContactError, MotionError, PathError, QueryError, ShapeError,
    StepError, ValueError,
};
pub use geometry::{
    Aabb, Cuboid, Edge, Face, Feature, Obb, Polytope, Pose, Ray, Shape, Sphere, Triangle,
};
pub use motion::{AtEnd, Facing, Motion, Path, Spin};
pub use narrow_phase::distance::{ClosestPoints, closest_points};
pub use narrow_phase::overlap::{Overlap, overlap};
pub use narrow_phase::rays::{Chords, Overlaps, Placement, RayConfig, Refinement, Senders};
pub use raycast::{RayCast, RayHit, RaySpan, SurfacePoint};
#[cfg(feature = "serde")]
pub use scene::{NamedBody, Scene};
pub use world::{
    Advance, Body, BodyHit, BodyId, CollisionWorld, Contact, ContactKind, Groups, Method,
    PairContact, PhaseTimes, QueryFilter, StepStats, WorldConfig, first_contact,
};
