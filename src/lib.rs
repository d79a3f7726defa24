//! Continuous collision detection by casting rays.

mod curve;
pub mod error;
pub mod geometry;
mod math;
mod motion;
mod narrow_phase;
pub mod raycast;
pub mod tolerance;

pub use curve::{ArcLengthRow, ArcLengthTable, CubicBezier, Spline};
pub use error::{MotionError, PathError, ShapeError, ValueError};
pub use geometry::{
    Aabb, Cuboid, Edge, Face, Feature, Obb, Polytope, Pose, Ray, Shape, Sphere, Triangle,
};
pub use motion::Path;
pub use narrow_phase::overlap::{Overlap, overlap};
pub use raycast::{RayCast, RayHit, RaySpan, SurfacePoint};
