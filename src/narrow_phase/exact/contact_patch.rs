//! All that two bodies in touch share.

use super::body::Body;
use super::patch;
use super::snap::{FEATURE, WIDE, summit_within};
use crate::geometry::{Pose, Shape};
use crate::math::frame::orthonormal;
use glam::{DVec2, DVec3};

/// The corners of what two shapes in touch share: a point, both ends of a segment, or a polygon
/// counter-clockwise seen against the normal.
///
/// The poses are those at the touch, and the normal is the touch's: out of `b` towards `a`, of unit
/// length, or it is made so; without a direction there are no corners. The corners are offsets in metres from `b`'s position, along the world's
/// axes, and lie on the surface of `b`. What two faces share that meet by less than rounding may
/// be a segment or a point; there is always at least one corner otherwise.
///
/// The parts of both bodies that lie farthest along the normal, to within 1e-12 of their radii, cut
/// with each other (Sutherland & Hodgman, 1974); to within a few billionths where those share nothing.
/// O(n) for n corners of the two parts beside a support of each body.
///
/// ```
/// use feeler::narrow_phase::exact::{contact_patch, touch};
/// use feeler::{Cuboid, Pose, Shape, ShapeError};
/// use glam::DVec3;
///
/// // A box comes down on the corner of another.
/// let cube = Shape::from(Cuboid::new([1.0, 1.0, 1.0])?);
/// let (above, below) = (Pose::at([1.5, 1.0, 5.0]), Pose::IDENTITY);
/// let motion = DVec3::new(0.0, 0.0, -6.0);
/// let found = touch(&cube, &above, &cube, &below, motion).expect("they meet");
/// let landed = Pose::new(above.position + found.fraction * motion, above.orientation);
///
/// let corners = contact_patch(&cube, &landed, &cube, &below, found.normal);
/// assert_eq!(corners.len(), 4);
/// assert!(corners.contains(&DVec3::new(0.5, 0.0, 1.0)));
/// assert!(corners.contains(&DVec3::new(1.0, 1.0, 1.0)));
/// # Ok::<(), ShapeError>(())
/// ```
#[must_use]
pub fn contact_patch(
    a: &Shape,
    pose_a: &Pose,
    b: &Shape,
    pose_b: &Pose,
    normal: DVec3,
) -> Vec<DVec3> {
    let Some(normal) = unit(normal) else {
        return Vec::new();
    };
    let between = pose_a.position - pose_b.position;
    if let Shape::Sphere(ball) = a {
        return vec![between - ball.radius() * normal];
    }
    if let Shape::Sphere(ball) = b {
        return vec![ball.radius() * normal];
    }
    let (Some(body_a), Some(body_b)) = (
        Body::new(a, pose_a.orientation),
        Body::new(b, pose_b.orientation),
    ) else {
        return Vec::new();
    };
    let (on_a, on_b) = (body_a.support(-normal), body_b.support(normal));
    // Seen from one of B's corners: what is far away is rounded.
    let origin = body_b.vertex(on_b);
    let (x, y) = orthonormal(normal);
    let to_a =
        (between - origin) + (body_a.rotation * body_a.centre - body_b.rotation * body_b.centre);
    let tops = |share: f64| {
        let flat = |body: &Body, direction: DVec3, vertex: u32, shift: DVec3| {
            let summit = summit_within(body, direction, [vertex], share);
            let points = summit.corners.iter().map(|&vertex| {
                let point = body.vertex(vertex) + shift;
                DVec2::new(point.dot(x), point.dot(y))
            });
            patch::around(points.collect())
        };
        [
            flat(&body_a, -normal, on_a, to_a),
            flat(&body_b, normal, on_b, -origin),
        ]
    };
    let size = body_a.radius + body_b.radius;
    let shares = |a: &[DVec2], b: &[DVec2]| patch::shared(a, b, size).is_some();
    let [mut top_a, mut top_b] = tops(FEATURE);
    if !shares(&top_a, &top_b) {
        // Level but for a hair: as for the touch itself.
        let mut wider = WIDE.into_iter().map(|wide| tops(wide * FEATURE));
        if let Some(found) = wider.find(|[a, b]| shares(a, b)) {
            [top_a, top_b] = found;
        }
    }
    let shared = patch::corners(&top_a, &top_b, size);
    let centre = body_b.rotation * body_b.centre;
    (shared.iter())
        .map(|point| centre + origin + (point.x * x + point.y * y))
        .collect()
}

/// The same direction at unit length; as it is if it has that already but for rounding.
fn unit(normal: DVec3) -> Option<DVec3> {
    if (normal.length_squared() - 1.0).abs() < 1e-12 {
        return Some(normal);
    }
    let largest = normal.abs().max_element();
    (normal / largest).try_normalize()
}
