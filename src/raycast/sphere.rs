//! Rays against spheres.

use super::line::Line;
use super::{GRAZE, RayCast, RaySpan, SurfacePoint};
use crate::geometry::{Feature, Ray, Sphere};
use crate::math::exact;
use glam::DVec3;

/// Works from the line's closest point to the centre rather than `b² − 4ac`,
/// which keeps the error near `distance × f64::EPSILON` for far origins.
/// Source: Haines et al., *Ray Tracing Gems* (2019), ch. 7.
///
/// O(1).
impl RayCast for Sphere {
    #[inline]
    fn line_span(&self, ray: &Ray) -> Option<RaySpan> {
        let line = Line::of(ray)?;
        let Line {
            origin, direction, ..
        } = line;
        let radius = self.radius();
        let graze = GRAZE * (line.distance() + radius);
        // Most misses end here, before anything is divided.
        if line.passes_by(origin, radius + 4.0 * graze) {
            return None;
        }
        let square = direction.length_squared();
        let middle = -origin.dot(direction) / square;
        let closest = origin + middle * direction;
        let mut discriminant = radius * radius - closest.length_squared();
        if discriminant < 0.0 {
            // `closest` is rounded by some ulp of the distance.
            if discriminant < -2.0 * radius * graze {
                return None;
            }
            discriminant = 0.0;
        }
        let half = (discriminant / square).sqrt();
        // The root further from the origin is a sum without cancellation, the
        // other follows from their product; its sign, and so which side of the
        // surface the origin lies on, is that of `power`, which is exact.
        let far = middle + half.copysign(middle);
        let near = if far == 0.0 {
            0.0
        } else {
            power(origin, radius) / square / far
        };
        let point = |fraction: f64, offset: f64| SurfacePoint {
            fraction: line.ray_fraction(fraction),
            // From the closest point, as `origin + fraction · direction` would
            // lose the digits of a far origin twice.
            normal: (closest + offset * direction).normalize_or_zero(),
            feature: Feature::Surface,
        };
        RaySpan::new(point(near.min(far), -half), point(near.max(far), half))
    }

    #[inline]
    fn contains_point(&self, point: DVec3) -> bool {
        // NaN compares false.
        power(point, self.radius()) <= 0.0
    }
}

/// `|point|² − radius²`, to full relative accuracy near the surface and with
/// the right sign everywhere.
#[inline]
pub(crate) fn power(point: DVec3, radius: f64) -> f64 {
    let power = point.length_squared() - radius * radius;
    if power.abs() > 1e-12 * (radius * radius) {
        power
    } else {
        near_surface(point, radius)
    }
}

#[cold]
fn near_surface(point: DVec3, radius: f64) -> f64 {
    exact::sum_of_squares_minus(point.to_array(), radius)
}
