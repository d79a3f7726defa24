//! Polytopes: hulls of points, meshes, faces, supports, bounding spheres.

// Clippy's leave for tests stops at the functions that help them.
#![allow(clippy::unwrap_used, clippy::panic)]

#[path = "polytope/checks.rs"]
mod checks;
#[path = "polytope/hulls.rs"]
mod hulls;
#[path = "polytope/meshes.rs"]
mod meshes;
#[path = "polytope/needles.rs"]
mod needles;
#[path = "polytope/oracle.rs"]
mod oracle;
#[path = "polytope/points.rs"]
mod points;
#[path = "polytope/queries.rs"]
mod queries;
