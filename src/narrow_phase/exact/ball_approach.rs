//! A line's closest approach to a point, and when it comes within a distance of it.

use crate::raycast::power;
use glam::DVec3;

/// The closest approach of a moving point to the origin of its coordinates.
#[derive(Clone, Copy)]
pub(super) struct Approach {
    /// When, in directions.
    pub(super) middle: f64,
    /// The same times the direction's square: what has not been divided.
    along: f64,
    /// Where the point is then.
    pub(super) closest: DVec3,
    /// The square of the radius less that of the closest distance.
    pub(super) room: f64,
}

impl Approach {
    /// `square` is that of `direction` and positive.
    #[inline]
    pub(super) fn new(from: DVec3, direction: DVec3, square: f64, radius: f64) -> Self {
        let along = -from.dot(direction);
        let middle = along / square;
        let closest = from + middle * direction;
        Self {
            middle,
            along,
            closest,
            room: radius * radius - closest.length_squared(),
        }
    }

    /// Half the time spent within the radius, 0 for a point that passes by, times the square.
    #[inline]
    fn root(&self, square: f64) -> f64 {
        (self.room.max(0.0) * square).sqrt()
    }

    /// Half the time spent within the radius; 0 for a point that passes by.
    #[inline]
    pub(super) fn half(&self, square: f64) -> f64 {
        self.root(square) / square
    }

    /// When the point that sets out at `from` comes within the radius.
    #[inline]
    pub(super) fn enter(&self, from: DVec3, square: f64, radius: f64) -> f64 {
        enter(from, self.along, self.root(square), square, radius)
    }
}

/// When the point that sets out at `from` comes within the radius: `along` is its closest approach
/// and `half` half the time within, both times the direction's square.
///
/// Neither way is there a difference of like numbers: what lies ahead is nearer than the middle
/// and follows from the product of both ends. So a start that touches exactly gives
/// exactly 0, and one ulp off gives the right sign.
#[inline]
pub(super) fn enter(from: DVec3, along: f64, half: f64, square: f64, radius: f64) -> f64 {
    if along > 0.0 {
        // Of a graze from touch both terms are rounding; it is no later than the middle.
        let (soon, middle) = (power(from, radius) / (along + half), along / square);
        // Unlike `f64::min` this need not look for NaN, of which there is none.
        if middle < soon { middle } else { soon }
    } else {
        (along - half) / square
    }
}

/// `away` at unit length, which is about `radius` long as a rule.
///
/// One of Newton's steps instead of a root: off by the square of what the length is off.
#[inline]
pub(super) fn normal(away: DVec3, radius: f64) -> DVec3 {
    // The quotient is ready before `away` is, which has waited for a root.
    let rough = away * (1.0 / radius);
    let square = rough.length_squared();
    // False for NaN too.
    if (square - 1.0).abs() < 1e-8 {
        rough * (1.5 - 0.5 * square)
    } else {
        from_afar(away)
    }
}

/// Where the distance flown has rounded the length away.
#[cold]
fn from_afar(away: DVec3) -> DVec3 {
    away.normalize_or(DVec3::X)
}
