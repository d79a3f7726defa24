//! Rays against each shape.
//!
//! A shape answers rays in its own frame; [`RayCast::first_hit_at`] and
//! [`RayCast::line_span_at`] take a [`Pose`] as well. Fractions count in ray
//! directions, which need not be of unit length: `ray.at(fraction)` is the point.
//!
//! # Conventions, the same for every shape
//!
//! - Solids are closed: their surface belongs to them. A ray that starts inside
//!   or exactly on the surface is [`RayHit::Inside`], wherever it goes. One that
//!   starts outside, be it by one ulp, is not: going in it hits at a tiny fraction
//!   (0 if that is what it rounds to), going out it misses. Spheres, boxes
//!   and triangles tell these apart exactly, a polytope as exactly as its
//!   rounded face planes do, an oriented box as its axes do.
//! - A graze counts as a hit: a tangent of a sphere, a line along a face or an
//!   edge, through an edge or a vertex. Such a hit is never lost to rounding:
//!   what comes closer than some ulp of the coordinates involved, [`GRAZE`] times
//!   size and distance, may hit, what lies further away never does.
//! - Where several faces meet, the lowest-numbered of those that the ray enters
//!   (or leaves) through is reported, with its normal.
//! - A ray without direction is a point: it has no span, and its hit is
//!   [`RayHit::Inside`] or none.
//! - A ray with NaN, an infinity or an origin beyond [`MAX_ORIGIN`] hits
//!   nothing; nor does one whose hit lies at a fraction beyond `f64`. No answer
//!   ever holds NaN. Directions of any length work, down to subnormal ones.
//! - A triangle is hit from either side and is left where it is entered. A line in
//!   its plane enters and leaves through its edges; the normals lie in the plane.
//!
//! # Accuracy
//!
//! The point hit lies within 16 `f64::EPSILON` × (size + distance) of the
//! surface, for all shapes; size being the largest coordinate on the shape,
//! distance that of the ray's origin. Where the ray meets the surface at an angle
//! this holds for the fraction as well; a grazing one is worse by one over the
//! sine of the angle.

mod aabb;
mod clip;
mod cuboid;
mod glance;
mod hit;
mod line;
mod obb;
mod polytope;
mod shape;
mod slabs;
mod span;
mod sphere;
mod triangle;
mod walk;

pub use hit::RayHit;
pub use line::MAX_ORIGIN;
pub(crate) use line::{PLAIN_SQUARES, scale};
pub use span::{RaySpan, SurfacePoint};
pub(crate) use sphere::power;

use crate::geometry::{Pose, Ray};
use glam::DVec3;

/// How near a line must come to count as a graze, as a share of the shape's
/// size and of the distance to the ray's origin.
///
/// Eight ulp: twice what rounding adds up to in the longest of the kernels'
/// sums. Smaller, and a ray aimed at an edge may slip past it.
pub const GRAZE: f64 = 8.0 * f64::EPSILON;

/// What a ray can be cast at, in its own frame.
///
/// Conventions and accuracy: see the [module](self).
///
/// ```
/// use feeler::{Cuboid, Feature, Ray, RayCast, RayHit};
/// use glam::DVec3;
///
/// let cuboid = Cuboid::new([1.0, 1.0, 1.0])?;
///
/// let ray = Ray::new([-3.0, 0.0, 0.0], [0.5, 0.0, 0.0]);
/// let Some(RayHit::Surface(hit)) = cuboid.first_hit(&ray) else { panic!("a miss") };
/// assert_eq!(hit.fraction, 4.0);
/// assert_eq!(hit.normal, DVec3::NEG_X);
/// assert_eq!(hit.feature, Feature::Face(0));
/// assert_eq!(cuboid.line_span(&ray).map(|span| span.leave.fraction), Some(8.0));
///
/// // The box lies behind this one, but on its line.
/// let away = Ray::new([-3.0, 0.0, 0.0], [-0.5, 0.0, 0.0]);
/// assert_eq!(cuboid.first_hit(&away), None);
/// assert_eq!(cuboid.line_span(&away).map(|span| span.enter.fraction), Some(-8.0));
///
/// let start_inside = Ray::new([0.5, 0.0, 0.0], [1.0, 0.0, 0.0]);
/// assert_eq!(cuboid.first_hit(&start_inside), Some(RayHit::Inside));
/// # Ok::<(), feeler::ShapeError>(())
/// ```
pub trait RayCast {
    /// Where the whole line through the ray enters and leaves the solid.
    ///
    /// Fractions may be negative: the solid lies behind the ray's origin then.
    /// The thesis's test of oriented boxes (§2.3.2) needs them.
    #[must_use]
    fn line_span(&self, ray: &Ray) -> Option<RaySpan>;

    /// Whether `point` lies in the solid or on its surface.
    #[must_use]
    fn contains_point(&self, point: DVec3) -> bool;

    /// Where the ray, fractions 0 and up, first meets the solid.
    #[must_use]
    fn first_hit(&self, ray: &Ray) -> Option<RayHit> {
        if ray.direction == DVec3::ZERO {
            return self.contains_point(ray.origin).then_some(RayHit::Inside);
        }
        self.line_span(ray)?
            .first_hit(ray, || self.contains_point(ray.origin))
    }

    /// [`line_span`](Self::line_span) of the solid standing at `pose`.
    #[must_use]
    fn line_span_at(&self, pose: &Pose, ray: &Ray) -> Option<RaySpan> {
        let span = self.line_span(&local(pose, ray))?;
        Some(RaySpan {
            enter: span.enter.turned(pose),
            leave: span.leave.turned(pose),
        })
    }

    /// [`first_hit`](Self::first_hit) of the solid standing at `pose`.
    ///
    /// ```
    /// use feeler::{Pose, Ray, RayCast, RayHit, Shape, Sphere};
    ///
    /// let shape = Shape::from(Sphere::new(1.0)?);
    /// let ray = Ray::new([0.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
    /// let hit = shape.first_hit_at(&Pose::at([5.0, 0.0, 0.0]), &ray);
    /// assert_eq!(hit.and_then(|hit| hit.surface()).map(|point| point.fraction), Some(4.0));
    /// assert_eq!(shape.first_hit_at(&Pose::at([0.0, 5.0, 0.0]), &ray), None);
    /// # Ok::<(), feeler::ShapeError>(())
    /// ```
    #[must_use]
    fn first_hit_at(&self, pose: &Pose, ray: &Ray) -> Option<RayHit> {
        turned_hit(self, pose, ray)
    }
}

/// The first hit of a solid standing at `pose`, found in the solid's frame.
#[inline]
fn turned_hit(solid: &(impl RayCast + ?Sized), pose: &Pose, ray: &Ray) -> Option<RayHit> {
    Some(match solid.first_hit(&local(pose, ray))? {
        RayHit::Surface(point) => RayHit::Surface(point.turned(pose)),
        RayHit::Inside => RayHit::Inside,
    })
}

#[inline]
fn local(pose: &Pose, ray: &Ray) -> Ray {
    Ray {
        origin: pose.local_point(ray.origin),
        direction: pose.local_direction(ray.direction),
    }
}
