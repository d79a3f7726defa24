//! The box around a body that never moves.

use super::orientation::{around_extents, aside, axes_towards, magnitude, rounding, smaller};
use crate::geometry::{Mesh, Obb, Pose, Shape};
use glam::DVec3;

/// The oriented box around a shape that stands still at `pose`.
///
/// A sphere gets the cube around it, a box gets itself back. Anything else gets
/// the smaller, by surface, of two: the box along the axes of its own frame, and
/// the thesis's, whose first edge runs along the shape's longest edge and whose
/// second points from there to the farthest vertex.
///
/// The box holds the whole shape; rounding grows it by 32 × [`f64::EPSILON`] of
/// the coordinates. Source: the thesis, §2.3.1.1.
///
/// O(vertices + edges).
///
/// ```
/// use feeler::sweep::around_static;
/// use feeler::{Cuboid, Pose, ShapeError};
/// use glam::{DQuat, DVec3};
///
/// let half_extents = DVec3::new(1.0, 2.0, 3.0);
/// let pose = Pose::new([5.0, 0.0, 0.0], DQuat::from_rotation_x(0.7));
/// let obb = around_static(&Cuboid::new(half_extents)?.into(), &pose);
/// assert_eq!(obb.axes[1], pose.direction(DVec3::Y));
/// assert!((obb.half_extents - half_extents).length() < 1e-12);
/// # Ok::<(), ShapeError>(())
/// ```
#[must_use]
pub fn around_static(shape: &Shape, pose: &Pose) -> Obb {
    let own_axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let own = |half_extents: DVec3| Obb {
        centre: DVec3::ZERO,
        axes: own_axes,
        half_extents,
    };
    match shape {
        // Round as it is, the sphere needs no turning, however its body is turned.
        Shape::Sphere(sphere) => {
            let half_extents = DVec3::splat(sphere.radius());
            placed(&own(half_extents), &Pose::at(pose.position))
        }
        Shape::Cuboid(cuboid) => placed(&own(cuboid.half_extents()), pose),
        Shape::Triangle(_) | Shape::Polytope(_) => {
            let Some(mesh) = Mesh::of(shape) else {
                return placed(&own(DVec3::splat(shape.max_dist())), pose);
            };
            let along = |axes| around_extents(axes, |axis| extent(&mesh.vertices, axis), 0.0);
            let aligned = along(own_axes);
            let obb = thesis_axes(&mesh).map_or(aligned, |axes| smaller(aligned, along(axes)));
            placed(&obb, pose)
        }
    }
}

/// Along the longest edge, then towards the vertex farthest from its line.
fn thesis_axes(mesh: &Mesh) -> Option<[DVec3; 3]> {
    let ends = mesh
        .edges
        .iter()
        .map(|edge| edge.vertices.map(|vertex| mesh.vertices[vertex as usize]))
        .max_by(|a, b| a[0].distance(a[1]).total_cmp(&b[0].distance(b[1])))?;
    let axis = (ends[1] - ends[0]).try_normalize()?;
    let farthest = mesh
        .vertices
        .iter()
        .map(|&vertex| aside(axis, vertex - ends[0]))
        .max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))?;
    axes_towards(axis, farthest)
}

fn extent(points: &[DVec3], axis: DVec3) -> (f64, f64) {
    points
        .iter()
        .map(|&point| axis.dot(point))
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(min, max), value| {
            (min.min(value), max.max(value))
        })
}

/// A box of the shape's frame, in the world, rounded outward.
fn placed(local: &Obb, pose: &Pose) -> Obb {
    // The corners' coordinates bound those of everything in the box; twice, since
    // turning them rounds as projecting them did.
    let size = 2.0 * (magnitude(local.centre) + magnitude(local.half_extents));
    Obb {
        centre: pose.point(local.centre),
        axes: local.axes.map(|axis| pose.direction(axis)),
        half_extents: local.half_extents + rounding(magnitude(pose.position) + size),
    }
}
