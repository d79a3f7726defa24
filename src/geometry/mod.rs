//! Shapes and what they are made of.
//!
//! A shape lives in its own frame of reference: a sphere and a cuboid around
//! the origin, a triangle and a polytope wherever their points were given. A
//! [`Pose`] brings it into the world.

mod aabb;
mod cuboid;
#[cfg(feature = "serde")]
mod data;
mod feature;
mod mesh;
mod obb;
mod polytope;
mod pose;
mod ray;
mod shape;
mod sphere;
mod triangle;

pub use aabb::Aabb;
pub use cuboid::Cuboid;
pub use feature::Feature;
pub use obb::Obb;
pub use polytope::{Edge, Face, Polytope};
pub(crate) use polytope::{Facade, FourTimes, LANES, Lanes, sketch};
pub use pose::Pose;
pub use ray::Ray;
pub use shape::Shape;
pub use sphere::Sphere;
pub use triangle::Triangle;

pub(crate) use mesh::{Mesh, Vertices as MeshVertices};
