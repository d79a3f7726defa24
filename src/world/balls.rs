//! Two balls in straight flight: most pairs of most worlds.

use crate::early_out::{self, Rejection};
use crate::geometry::Feature;
use crate::narrow_phase::exact::{Touching, two_balls};
use crate::narrow_phase::overlap::of_balls;
use crate::tolerance::touch_tolerance;
use crate::world::pair::{Finding, SLIDE};
use crate::world::skew::skew;
use crate::world::tracks::{Span, Track};
use crate::world::{ContactKind, PairContact};
use glam::DVec3;

/// What [`examine`](super::pair::examine) finds of two balls in straight flight,
/// to the bit, from their tracks alone; or the early-out that shows that they cannot meet.
///
/// A body's record is several cache lines long, its track little more than one.
#[inline]
pub(super) fn examine(a: &Track, b: &Track, span: Span) -> Result<Option<Finding>, Rejection> {
    let (flight_a, flight_b) = (a.flight(span), b.flight(span));
    let seconds = || [a.since, b.since].map(|since| span.of_motion(since).1);
    look((flight_a, a.reach), (flight_b, b.reach), seconds)
}

/// The same of two flights in the same time, each from where and by how much, and the balls' radii.
#[inline]
pub(super) fn meet(a: ((DVec3, DVec3), f64), b: ((DVec3, DVec3), f64)) -> Option<Finding> {
    look(a, b, || [1.0; 2]).unwrap_or_default()
}

/// The same, if it is known how long each flies.
#[inline]
fn look(
    ((start_a, motion_a), radius_a): ((DVec3, DVec3), f64),
    ((start_b, motion_b), radius_b): ((DVec3, DVec3), f64),
    seconds: impl Fn() -> [f64; 2],
) -> Result<Option<Finding>, Rejection> {
    let reach = radius_a + radius_b;
    let between = start_b - start_a;
    if between.length_squared() < reach * reach
        && let Some(contact) = overlapping((start_a, radius_a), (start_b, radius_b))
    {
        return Ok(Some(contact.into()));
    }
    let motion = motion_a - motion_b;
    if let Some(rejection) = early_out::reject(between, motion, reach) {
        return Err(rejection);
    }
    let Some(enter) = two_balls(radius_a, radius_b, between, motion) else {
        return Ok(None);
    };
    let coordinate = start_a.abs().max(start_b.abs()).max_element();
    let touch = touch_tolerance(reach, coordinate);
    let depth = enter.fraction * motion.dot(enter.normal);
    let length = motion.length();
    let late = (enter.fraction - 1.0) * length > touch;
    if late || enter.fraction < 0.0 && depth > touch {
        return Ok(None);
    }
    let fraction = enter.fraction.clamp(0.0, 1.0);
    let found = Touching { fraction, ..enter };
    let closing = -motion.dot(found.normal);
    let at_once = fraction * length <= SLIDE * reach;
    let touching = fraction * length <= touch || at_once && fraction * closing <= touch;
    if touching {
        let [seconds_a, seconds_b] = seconds();
        if closing <= (SLIDE * length).max(skew(seconds_a, seconds_b, motion_a, motion_b)) {
            return Ok(None);
        }
    }
    Ok(Some(Finding {
        contact: PairContact {
            fraction,
            point: start_b + (found.point + fraction * motion_b),
            normal: found.normal,
            features: found.features,
            kind: ContactKind::Touch,
        },
        resting: touching,
    }))
}

/// The pair as overlapping as the frame begins, if it does.
#[inline]
fn overlapping(a: (DVec3, f64), b: (DVec3, f64)) -> Option<PairContact> {
    let found = of_balls(a, b)?;
    Some(PairContact {
        fraction: 0.0,
        point: found.point,
        normal: found.direction,
        features: [Feature::Surface; 2],
        kind: ContactKind::Overlap { depth: found.depth },
    })
}
