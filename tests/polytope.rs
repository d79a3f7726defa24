//! Polytopes: hulls of points, meshes, faces, supports, bounding spheres.

#[path = "polytope/checks.rs"]
mod checks;
#[path = "polytope/hulls.rs"]
mod hulls;
#[path = "polytope/points.rs"]
mod points;
