//! A line's closest approach to a point, and when it comes within a distance of it.

use crate::math::exact;
use glam::DVec3;

/// The closest approach of a moving point to the origin of its coordinates.
#[derive(Clone, Copy)]
pub(super) struct Approach {
    /// When, in directions.
    pub(super) middle: f64,
    /// Where the point is then.
    pub(super) closest: DVec3,
    /// The square of the radius less that of the closest distance.
    pub(super) room: f64,
}

impl Approach {
    /// `square` is that of `direction` and positive.
    #[inline]
    pub(super) fn new(from: DVec3, direction: DVec3, square: f64, radius: f64) -> Self {
        let middle = -from.dot(direction) / square;
        let closest = from + middle * direction;
        Self {
            middle,
            closest,
            room: radius * radius - closest.length_squared(),
        }
    }

    /// Half the time spent within the radius; 0 for a point that passes by.
    #[inline]
    pub(super) fn half(&self, square: f64) -> f64 {
        (self.room.max(0.0) / square).sqrt()
    }
}

/// When a point comes within `radius` of the origin and when it is last.
///
/// The end of the interval that is further off is a sum without cancellation;
/// the nearer one follows from their product. So a start that touches exactly gives
/// exactly 0, and one ulp off gives the right sign.
#[inline]
pub(super) fn ends(
    approach: &Approach,
    half: f64,
    from: DVec3,
    square: f64,
    radius: f64,
) -> (f64, f64) {
    let far = approach.middle + half.copysign(approach.middle);
    let near = if far == 0.0 {
        0.0
    } else {
        power(from, radius) / (square * far)
    };
    (near.min(far), near.max(far))
}

/// `|point|² − radius²`, with the right sign also where the two nearly cancel.
#[inline]
fn power(point: DVec3, radius: f64) -> f64 {
    let power = point.length_squared() - radius * radius;
    if power.abs() > 1e-12 * radius * radius {
        power
    } else {
        exact::sum_of_squares_minus(point.to_array(), radius)
    }
}
