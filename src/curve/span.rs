//! Stretches of a cubic short enough for one quadrature rule.

use crate::curve::hodograph::Hodograph;
use glam::DVec3;
use std::ops::Range;

/// Largest error of a span's length, as a share of the greatest speed (the length a
/// curve has at most).
///
/// A few times the rounding of one rule's sum. Smaller, and rounding would be
/// mistaken for error and spans split for nothing; larger, and lengths lose
/// digits.
const SPAN_ERROR: f64 = 1e-15;

/// How often a span is halved at most.
///
/// Beside a kink of the speed that no split lies on, the error falls by 4 with
/// every halving: 25 halvings reach rounding.
const MAX_HALVINGS: u32 = 40;

/// A span whose mean speed is over this many times the speeds at both of its
/// ends is halved, so that the inverse has one difficult end at most.
const STEEP: f64 = 3.0;

/// A speed below this share of a span's mean counts as a standstill when a first
/// guess is made. Only speed depends on it.
const STANDSTILL: f64 = 1e-3;

/// A Newton step below this, in `x` and relative to the speed, leaves an error
/// of its cube: below rounding, no need to look again.
const LAST_STEP: f64 = 1e-5;

/// A stretch of a cubic on which one Gauss–Legendre rule gives arc lengths to
/// rounding, from the stretch's start to anywhere on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Span {
    /// Parameter of the curve at the span's start.
    pub(crate) u_start: f64,
    /// How far the parameter goes.
    pub(crate) width: f64,
    /// Arc length.
    pub(crate) length: f64,
    /// Mean speed over the speed at start and end: slopes of the inverse. Infinite at
    /// a cusp.
    slopes: [f64; 2],
}

impl Span {
    fn new(u_start: f64, width: f64, hodograph: &Hodograph, length: f64) -> Self {
        let slope = |x: f64| length / hodograph.velocity(x).length();
        Self {
            u_start,
            width,
            length,
            slopes: [slope(0.0), slope(1.0)],
        }
    }

    /// Where on the span, from 0 to 1, the arc length from its start is
    /// `distance`.
    ///
    /// Halley's iteration on the integral, in a bracket, from an interpolated
    /// guess: one or two evaluations of the rule as a rule, and at most 100
    /// whatever the speed does.
    pub(crate) fn invert(&self, hodograph: &Hodograph, distance: f64) -> f64 {
        // A span of no length is all one point; NaN cannot come here.
        if distance <= 0.0 || self.length <= 0.0 {
            return 0.0;
        }
        if distance >= self.length {
            return 1.0;
        }
        let mut x = self.guess(distance / self.length);
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..100 {
            let excess = hodograph.length_to(x) - distance;
            if excess > 0.0 {
                high = x;
            } else {
                low = x;
            }
            let (speed, slope) = hodograph.speed_and_slope(x);
            let newton = -excess / speed;
            let bend = newton * slope / speed;
            let step = newton / (1.0 + 0.5 * bend).max(0.5);
            if newton.abs() <= LAST_STEP && bend.abs() <= LAST_STEP {
                return (x + step).clamp(0.0, 1.0);
            }
            if excess.abs() <= f64::EPSILON * distance {
                return x;
            }
            // False for NaN and infinity as well: at a cusp halve instead.
            x = if x + step > low && x + step < high {
                x + step
            } else {
                0.5 * (low + high)
            };
            if high - low <= f64::EPSILON * low {
                break;
            }
        }
        x
    }

    /// A first guess at the inverse; `share` is the arc length's share in `0..1`.
    fn guess(&self, share: f64) -> f64 {
        let [first, last] = self.slopes;
        let rest = 1.0 - share;
        let guess = if first <= STEEP && last <= STEEP {
            // Cubic Hermite interpolation of the inverse.
            share * (first * rest * rest + share * (3.0 - 2.0 * share) - last * share * rest)
        } else if STANDSTILL * first > 1.0 {
            // From a standstill the length grows as x^p, and p is the speed at the end.
            share.powf(last)
        } else if STANDSTILL * last > 1.0 {
            1.0 - rest.powf(first)
        } else {
            // Speed taken as linear; the length then is a quadratic in x.
            let (v0, v1) = (1.0 / first, 1.0 / last);
            let target = share * (v0 + v1);
            target / (v0 + (v0 * v0 + (v1 - v0) * target).sqrt())
        };
        // False for NaN as well.
        if guess > 0.0 && guess < 1.0 {
            guess
        } else {
            share
        }
    }
}

/// Cuts the stretch `range` of a cubic into spans and hands them over in order.
///
/// `velocity` are the control points of the cubic's derivative.
///
/// A span is good when the rule over the whole of it agrees with the rule over
/// its halves. Where the speed has a kink (a cusp) or nearly so, halving closes in on
/// it by a factor of two a time, so the curve is first cut where it is slowest:
/// beside a cusp that lies on a cut the speed is smooth.
pub(crate) fn subdivide(velocity: &[DVec3; 3], range: Range<f64>, mut emit: impl FnMut(Span)) {
    let size = velocity.iter().map(|v| v.length()).fold(0.0, f64::max);
    let mut cutter = Cutter {
        velocity,
        error: SPAN_ERROR * size,
        emit: &mut emit,
    };
    let width = range.end - range.start;
    if width <= 0.0 {
        return;
    }
    let whole = Hodograph::over(velocity, range.start, width);
    let length = whole.length_to(1.0);
    if cutter
        .try_emit(range.start, width, &whole, length)
        .is_none()
    {
        return;
    }
    let mut start = range.start;
    let cuts = whole.slowest().map(|x| range.start + x * width);
    for end in cuts.chain(std::iter::once(range.end)) {
        // Cuts at the very ends cut nothing.
        if end > start {
            let part = Hodograph::over(velocity, start, end - start);
            cutter.cut(start, end - start, part.length_to(1.0), MAX_HALVINGS);
            start = end;
        }
    }
}

struct Cutter<'a, Emit> {
    velocity: &'a [DVec3; 3],
    error: f64,
    emit: &'a mut Emit,
}

impl<Emit: FnMut(Span)> Cutter<'_, Emit> {
    fn cut(&mut self, start: f64, width: f64, length: f64, halvings: u32) {
        let hodograph = Hodograph::over(self.velocity, start, width);
        if halvings == 0 {
            (self.emit)(Span::new(start, width, &hodograph, length));
        } else if let Some([left, right]) = self.try_emit(start, width, &hodograph, length) {
            let half = 0.5 * width;
            self.cut(start, half, left, halvings - 1);
            self.cut(start + half, half, right, halvings - 1);
        }
    }

    /// Hands the span over if it is good; otherwise the lengths of its halves.
    fn try_emit(
        &mut self,
        start: f64,
        width: f64,
        hodograph: &Hodograph,
        length: f64,
    ) -> Option<[f64; 2]> {
        let half = 0.5 * width;
        let left = hodograph.length_to(0.5);
        let right = Hodograph::over(self.velocity, start + half, half).length_to(1.0);
        let span = Span::new(start, width, hodograph, length);
        let steep = span.slopes.iter().all(|slope| *slope > STEEP);
        // A span shorter than its error may be as steep as it likes.
        let good = (length - (left + right)).abs() <= self.error && !(steep && length > self.error);
        if good {
            (self.emit)(span);
            return None;
        }
        Some([left, right])
    }
}
