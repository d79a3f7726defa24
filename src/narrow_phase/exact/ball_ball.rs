//! A ball cast at a ball.

use super::ball_approach::{enter, normal};
use super::ball_line::{Line, Touch, slack};
use super::{Crossing, Touching};
use crate::geometry::Feature;
use crate::raycast::PLAIN_SQUARES;
use glam::DVec3;

/// When two balls in straight relative motion touch and part.
///
/// `between` leads from the first ball's centre to the second's, `motion` is how far the
/// first moves relative to the second; metres. None if they never touch, if there is no
/// motion, or if a number is not finite. A graze is a touch that ends as it begins.
///
/// One ray against a sphere of both radii, from its closest point rather than by
/// `b² − 4ac` (Haines et al., *Ray Tracing Gems* 2019, ch. 7): off by some ulp of the distance. O(1).
///
/// ```
/// use feeler::narrow_phase::exact::ball_ball;
/// use glam::DVec3;
///
/// let between = DVec3::new(10.0, 0.0, 0.0);
/// let crossing = ball_ball(1.0, 2.0, between, DVec3::new(14.0, 0.0, 0.0));
/// assert_eq!(crossing.map(|c| (c.enter.fraction, c.leave)), Some((0.5, 13.0 / 14.0)));
/// assert!(ball_ball(1.0, 2.0, between, DVec3::Y).is_none());
/// ```
#[must_use]
#[inline]
pub fn ball_ball(radius_a: f64, radius_b: f64, between: DVec3, motion: DVec3) -> Option<Crossing> {
    let line = Line::new(-between, motion)?;
    let radii = [radius_a, radius_b];
    let enter = of_ball(&line, radii)?;
    let last = of_ball(&line.reversed(), radii);
    line.crossing(enter, last)
}

/// What [`ball_ball`] says of the way in, to the bit, without the way out.
///
/// The usual case by itself: two balls that are apart, not too far, and come together steeply enough that no
/// digits are lost.
#[inline(always)]
pub(crate) fn two_balls(
    radius_a: f64,
    radius_b: f64,
    between: DVec3,
    motion: DVec3,
) -> Option<Touching> {
    let radius = radius_a + radius_b;
    let near = radius * radius;
    let (origin, direction) = (-between, motion);
    let square = direction.length_squared();
    // What is not finite fails one of the comparisons.
    if PLAIN_SQUARES.contains(&square) {
        let apart = origin.length_squared() - near;
        let moment = origin.cross(direction);
        let room = near * square - moment.length_squared();
        if room < 0.0 {
            if room < -2.0 * radius * slack(origin, radius) * square {
                return None;
            }
        } else if apart > 1e-12 * near && apart <= NEAR * near {
            let (along, half) = (-origin.dot(direction), room.sqrt());
            if along > 0.0 && half > STEEP * along {
                let normal = steep_normal(direction, moment, half, radius * square);
                return Some(Touching {
                    fraction: apart / (along + half),
                    point: radius_b * normal,
                    normal,
                    features: [Feature::Surface; 2],
                });
            }
        }
    }
    // Whoever passes vectors on sends them through memory in the usual case as well, at a third of the
    // cost: hence single numbers.
    let radii = [radius_a, radius_b];
    unusual(
        radii, between.x, between.y, between.z, motion.x, motion.y, motion.z,
    )
}

/// [`two_balls`] that overlap, part, graze or are far from each other, or of which a number is extreme.
#[cold]
#[inline(never)]
fn unusual(
    radii: [f64; 2],
    x: f64,
    y: f64,
    z: f64,
    along_x: f64,
    along_y: f64,
    along_z: f64,
) -> Option<Touching> {
    let between = DVec3::new(x, y, z);
    let line = Line::new(-between, DVec3::new(along_x, along_y, along_z))?;
    line.touching(of_ball(&line, radii)?)
}

/// Share of the way to the closest approach that a path within the radius takes up at least where
/// rounding cannot put the touch behind the closest approach.
pub(super) const STEEP: f64 = 1e-3;

/// Out of the second ball, where the path through a radius is `half` long, times `square`.
#[inline(always)]
pub(super) fn steep_normal(
    direction: DVec3,
    moment: DVec3,
    half: f64,
    radius_square: f64,
) -> DVec3 {
    (direction.cross(moment) - half * direction) * (1.0 / radius_square)
}

/// Squared distance, in radii, up to which [`steep_normal`] is of unit length but for 4 ulp.
///
/// Its square is the sum of both terms' of `room`, less that of `moment · direction` which rounding
/// leaves: 1e-31 of the squared distance.
pub(super) const NEAR: f64 = 1e12;

/// Two balls of these radii.
///
/// All in cross products, so that whether they touch is known before anything is divided.
#[inline(always)]
pub(super) fn of_ball(line: &Line, radii: [f64; 2]) -> Option<Touch> {
    let Line {
        origin,
        direction,
        square,
        ..
    } = *line;
    let radius = radii[0] + radii[1];
    // The closest distance times the direction, and what is left of the radius there; both times
    // the direction's square.
    let moment = origin.cross(direction);
    let room = radius * radius * square - moment.length_squared();
    if room < 0.0 && room < -2.0 * radius * line.slack(radius) * square {
        return None;
    }
    let half = room.max(0.0).sqrt();
    // From the closest point: `origin + enter · direction` would lose the digits of a far
    // origin twice.
    let normal = if room >= 0.0 && origin.length_squared() <= NEAR * (radius * radius) {
        steep_normal(direction, moment, half, radius * square)
    } else {
        normal(direction.cross(moment) - half * direction, radius * square)
    };
    Some(Touch {
        fraction: enter(origin, -origin.dot(direction), half, square, radius),
        foot: radii[1] * normal,
        normal,
        feature: Feature::Surface,
    })
}
