//! A ball cast at a ball.

use super::ball_approach::{Approach, normal};
use super::ball_line::{Line, Touch};
use super::{Crossing, Touching};
use crate::geometry::Feature;
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

/// What [`ball_ball`] says of the way in, without the way out.
#[inline]
pub(crate) fn two_balls(
    radius_a: f64,
    radius_b: f64,
    between: DVec3,
    motion: DVec3,
) -> Option<Touching> {
    let line = Line::new(-between, motion)?;
    line.touching(of_ball(&line, [radius_a, radius_b])?)
}

/// Two balls of these radii.
#[inline]
pub(super) fn of_ball(line: &Line, radii: [f64; 2]) -> Option<Touch> {
    let radius = radii[0] + radii[1];
    let slack = line.slack(radius);
    if line.passes_by(line.origin, radius + 4.0 * slack) {
        return None;
    }
    let approach = Approach::new(line.origin, line.direction, line.square, radius);
    if approach.room < 0.0 && approach.room < -2.0 * radius * slack {
        return None;
    }
    let half = approach.half(line.square);
    // From the closest point: `origin + enter · direction` would lose the digits of a far
    // origin twice.
    let normal = normal(approach.closest - half * line.direction, radius);
    Some(Touch {
        fraction: approach.enter(line.origin, line.square, radius),
        foot: radii[1] * normal,
        normal,
        feature: Feature::Surface,
    })
}
