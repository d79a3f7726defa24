//! Continuous collision detection by casting rays.

pub mod broad_phase;
mod curve;
pub mod early_out;
pub mod error;
pub mod geometry;
mod math;
mod motion;
pub mod sweep;
pub mod tolerance;

pub use curve::{ArcLengthRow, ArcLengthTable, CubicBezier, Spline};
pub use error::{MotionError, PathError, ShapeError, ValueError};
pub use geometry::{
    Aabb, Cuboid, Edge, Face, Feature, Obb, Polytope, Pose, Ray, Shape, Sphere, Triangle,
};
pub use motion::Path;
