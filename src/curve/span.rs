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

/// Share of the greatest speed below which a least speed gets a cut.
///
/// The second derivative is at most four times the greatest speed, so where the
/// least speed is more than a quarter of it the kink is rounded over a sixteenth of the
/// parameter's range, and nodes see it. Larger cuts more; smaller risks a miss.
const SLOW: f64 = 0.25;

/// A span whose mean speed is over this many times the speeds at both of its
/// ends is halved, so that the inverse has one difficult end at most.
const STEEP: f64 = 3.0;

/// A speed below this share of a span's mean counts as a standstill when a first
/// guess is made. Only speed depends on it.
const HALT: f64 = 1e-3;

/// A Newton step below this, in `x` and relative to where the speed would vanish,
/// is made good by the next two terms of the inverse's series: what is left is of its
/// fourth power, below rounding, and need not be looked at.
const LAST_STEP: f64 = 1e-4;

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
    guess: Guess,
}

/// A first guess at the inverse: `x` for a share of the length.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Guess {
    /// Quintic Hermite interpolation: coefficients from the first power up.
    Smooth([f64; 5]),
    /// From a standstill the length grows as a power of `x`, and the power is the
    /// speed at the end over the mean speed. This is its inverse.
    FromHalt(f64),
    /// The same from the end.
    ToHalt(f64),
    /// The speeds at start and end: between them taken as linear, they make
    /// the length a quadratic in `x`.
    Steep(f64, f64),
}

impl Guess {
    fn new(hodograph: &Hodograph, length: f64) -> Self {
        // In units of the mean speed.
        let (start, start_slope, _) = hodograph.speed(0.0);
        let (end, end_slope, _) = hodograph.speed(1.0);
        let (start, start_slope) = (start / length, start_slope / length);
        let (end, end_slope) = (end / length, end_slope / length);
        if start.min(end) * STEEP > 1.0 {
            // First and second derivatives of the inverse at both ends.
            let (a, b) = (1.0 / start, 1.0 / end);
            let (aa, bb) = (-start_slope * a * a * a, -end_slope * b * b * b);
            Self::Smooth([
                a,
                0.5 * aa,
                10.0 - 6.0 * a - 4.0 * b - 1.5 * aa + 0.5 * bb,
                -15.0 + 8.0 * a + 7.0 * b + 1.5 * aa - bb,
                6.0 - 3.0 * (a + b) + 0.5 * (bb - aa),
            ])
        } else if start < HALT && end > HALT {
            Self::FromHalt(1.0 / end)
        } else if end < HALT && start > HALT {
            Self::ToHalt(1.0 / start)
        } else {
            Self::Steep(start, end)
        }
    }

    /// The guess for a share in `0..1`; it lies there too.
    fn at(&self, share: f64) -> f64 {
        let guess = match *self {
            Self::Smooth([a, b, c, d, e]) => {
                share * (a + share * (b + share * (c + share * (d + share * e))))
            }
            Self::FromHalt(power) => share.powf(power),
            Self::ToHalt(power) => 1.0 - (1.0 - share).powf(power),
            Self::Steep(start, end) => {
                let target = share * (start + end);
                target / (start + (start * start + (end - start) * target).sqrt())
            }
        };
        // False for NaN as well.
        if guess > 0.0 && guess < 1.0 {
            guess
        } else {
            share
        }
    }
}

impl Span {
    fn new(u_start: f64, width: f64, hodograph: &Hodograph, length: f64) -> Self {
        Self {
            u_start,
            width,
            length,
            guess: Guess::new(hodograph, length),
        }
    }

    /// Both halves of the span, by its parameter.
    pub(crate) fn halves(&self, velocity: &[DVec3; 3]) -> [Self; 2] {
        let half = 0.5 * self.width;
        [self.u_start, self.u_start + half].map(|start| {
            let hodograph = Hodograph::over(velocity, start, half);
            Self::new(start, half, &hodograph, hodograph.length_to(1.0))
        })
    }

    /// Where on the span, from 0 to 1, the arc length from its start is
    /// `distance`.
    ///
    /// Newton's iteration on the integral with two terms more (Householder), in a
    /// bracket, from an interpolated guess: as a rule one evaluation of the
    /// integral, and at most 100 whatever the speed does.
    pub(crate) fn invert(&self, hodograph: &Hodograph, distance: f64) -> f64 {
        // A span of no length is all one point; NaN cannot come here.
        if distance <= 0.0 || self.length <= 0.0 {
            return 0.0;
        }
        if distance >= self.length {
            return 1.0;
        }
        let mut x = self.guess.at(distance / self.length);
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..100 {
            let excess = hodograph.length_to(x) - distance;
            let (speed, first, second) = hodograph.speed(x);
            let per_speed = 1.0 / speed;
            let newton = -excess * per_speed;
            let bend = 0.5 * newton * first * per_speed;
            let twist = newton * newton * second * per_speed / 6.0;
            if newton.abs() <= LAST_STEP
                && bend.abs() <= LAST_STEP
                && twist.abs() <= LAST_STEP * LAST_STEP
            {
                let series = 1.0 - bend + 2.0 * bend * bend - twist;
                return (x + newton * series).clamp(0.0, 1.0);
            }
            if excess.abs() <= f64::EPSILON * distance {
                break;
            }
            if excess > 0.0 {
                high = x;
            } else {
                low = x;
            }
            let step = newton / (1.0 + bend).max(0.5);
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
}

/// Cuts the stretch `range` of a cubic into spans and hands them over in order.
///
/// `velocity` are the control points of the cubic's derivative.
///
/// A span is good when the rule over the whole of it agrees with the rule over
/// its halves. That test alone would not do: where the curve halts (a cusp), or all
/// but halts, its speed has a kink, and a kink between a span's end and its first
/// node is seen by neither rule. So the curve is first cut wherever it is slow and
/// slowest; beside a cusp that lies on a cut the speed is smooth.
pub(crate) fn subdivide(velocity: &[DVec3; 3], range: Range<f64>, mut emit: impl FnMut(Span)) {
    let width = range.end - range.start;
    if width <= 0.0 {
        return;
    }
    let size = velocity.iter().map(|v| v.length()).fold(0.0, f64::max);
    let mut cutter = Cutter {
        velocity,
        error: SPAN_ERROR * size,
        emit: &mut emit,
    };
    let whole = Hodograph::over(velocity, range.start, width);
    let slow = SLOW * width * size;
    let cuts = whole
        .slowest()
        .filter(|x| whole.velocity(*x).length() < slow)
        .map(|x| range.start + x * width);
    let mut start = range.start;
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
        let half = 0.5 * width;
        let left = hodograph.length_to(0.5);
        let right = Hodograph::over(self.velocity, start + half, half).length_to(1.0);
        let ends = hodograph
            .velocity(0.0)
            .length()
            .max(hodograph.velocity(1.0).length());
        let good = (length - (left + right)).abs() <= self.error
            // A span shorter than its error may be as steep as it likes.
            && (STEEP * ends >= length || length <= self.error);
        if good || halvings == 0 {
            (self.emit)(Span::new(start, width, &hodograph, length));
        } else {
            self.cut(start, half, left, halvings - 1);
            self.cut(start + half, half, right, halvings - 1);
        }
    }
}
