//! Continuous collision detection by casting rays.

mod broad_phase;
mod curve;
pub mod early_out;
pub mod error;
pub mod geometry;
mod math;
mod narrow_phase;
pub mod tolerance;
mod world;

pub use broad_phase::BroadPhase;
pub use curve::{ArcLengthRow, ArcLengthTable, CubicBezier, Spline};
pub use error::{
    BodyError, ConfigError, FirstContactError, MotionError, PathError, ShapeError, StepError,
    ValueError,
};
pub use geometry::{
    Aabb, Cuboid, Edge, Face, Feature, Obb, Polytope, Pose, Ray, Shape, Sphere, Triangle,
};
pub use narrow_phase::overlap::{Overlap, overlap};
