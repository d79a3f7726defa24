//! Continuous collision detection by casting rays.

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
pub use curve::{ArcLengthRow, ArcLengthTable, CubicBezier, Spline};
#[cfg(feature = "serde")]
pub use error::SceneError;
pub use error::{
    BodyError, ConfigError, FirstContactError, MotionError, PathError, ShapeError, StepError,
    ValueError,
};
pub use geometry::{
    Aabb, Cuboid, Edge, Face, Feature, Obb, Polytope, Pose, Ray, Shape, Sphere, Triangle,
};
pub use motion::{Motion, Path};
pub use narrow_phase::overlap::{Overlap, overlap};
pub use narrow_phase::rays::{Chords, Overlaps, Placement, RayConfig, Refinement, Senders};
pub use raycast::{RayCast, RayHit, RaySpan, SurfacePoint};
#[cfg(feature = "serde")]
pub use scene::{NamedBody, Scene};
pub use world::{
    Advance, Body, BodyId, CollisionWorld, Contact, ContactKind, Method, PairContact, PhaseTimes,
    StepStats, WorldConfig, first_contact,
};
