//! Do two bodies in touch part, or slide along each other?

use crate::geometry::{Mesh, Shape};
use crate::narrow_phase::rays::Standing;
use glam::DVec3;

/// Whether a face of one of two bodies keeps them apart while the first moves by
/// `motion`: they part or slide along it.
///
/// Where they touch on whole faces, or along edges of several, a ray knows the
/// normal of one face that meets there, and perhaps not the one between them.
/// `between` leads from the first bounding centre to the second; bodies up to
/// `touch` metres deep in each other count as touching.
///
/// O(faces · vertices), for the few pairs that touch as their motion begins.
pub(crate) fn part(
    (a, b): (Standing<'_>, Standing<'_>),
    between: DVec3,
    motion: DVec3,
    touch: f64,
) -> bool {
    let sliding = 1e-9 * motion.length();
    // `normal` leads out of B.
    let keeps_apart = |normal: DVec3| {
        motion.dot(normal) >= -sliding
            && -between.dot(normal) - support(a, -normal) - support(b, normal) >= -touch
    };
    any_normal(a, |normal| keeps_apart(-normal)) || any_normal(b, keeps_apart)
}

/// Whether the outward unit normal of any face passes.
fn any_normal(body: Standing<'_>, mut pass: impl FnMut(DVec3) -> bool) -> bool {
    let mut either = |local: DVec3| {
        let normal = body.pose.direction(local);
        pass(normal) || pass(-normal)
    };
    match body.shape {
        Shape::Sphere(_) => false,
        Shape::Cuboid(_) => DVec3::AXES.into_iter().any(either),
        Shape::Triangle(triangle) => either(triangle.normal()),
        Shape::Polytope(polytope) => polytope
            .face_normals()
            .iter()
            .any(|&normal| pass(body.pose.direction(normal))),
    }
}

/// How far a body reaches from its bounding centre along a unit vector.
fn support(body: Standing<'_>, direction: DVec3) -> f64 {
    let local = body.pose.local_direction(direction);
    let centre = body.shape.centre();
    Mesh::of(body.shape).map_or(body.shape.max_dist(), |mesh| {
        mesh.vertices
            .iter()
            .map(|&vertex| (vertex - centre).dot(local))
            .fold(f64::NEG_INFINITY, f64::max)
    })
}
