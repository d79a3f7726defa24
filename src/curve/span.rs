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
/// rounding, from the stretch's start to anywhere on it. One cache line.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub(crate) struct Span {
    /// Distance from the path's start to the span's.
    pub(crate) start: f64,
    /// Parameter of the curve at the span's start.
    u_start: f64,
    /// How far the parameter goes.
    width: f64,
    /// The reciprocal of its arc length.
    per_length: f64,
    guess: Guess,
}

/// A stretch of a cubic that is short enough to be a [`Span`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cut {
    pub(crate) u_start: f64,
    pub(crate) width: f64,
    pub(crate) length: f64,
}

/// Coefficients of a first guess: two fewer than the degree of the interpolation, whose ends are
/// known.
const COUNT: usize = 6;

/// Where inside a span the lengths are taken that a guess is made from: Chebyshev nodes.
const LOOKS: [f64; COUNT] = [
    0.017_037_086_855_465_85,
    0.146_446_609_406_726_24,
    0.370_590_477_448_739_6,
    0.629_409_522_551_260_4,
    0.853_553_390_593_273_8,
    0.982_962_913_144_534_1,
];

/// A first guess at the inverse: `x` for a share of the length.
///
/// It is good to some 1e-6, and what is left of it one step of the iteration takes off: `f32` will
/// do.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Guess {
    /// `x = y + y(1 − y)·q(y)`, which meets both ends: the coefficients of `q`.
    Smooth([f32; COUNT]),
    /// From a standstill the length grows as a power of `x`, and the power is the
    /// speed at the end over the mean speed. This is its inverse.
    FromHalt(f32),
    /// The same from the end.
    ToHalt(f32),
    /// The speeds at start and end: between them taken as linear, they make
    /// the length a quadratic in `x`.
    Steep(f32, f32),
}

impl Guess {
    fn new(hodograph: &Hodograph, length: f64) -> Self {
        // In units of the mean speed.
        let start = hodograph.velocity(0.0).length() / length;
        let end = hodograph.velocity(1.0).length() / length;
        if start.min(end) * STEEP > 1.0 {
            Self::Smooth(Self::interpolation(hodograph, length).map(|c| c as f32))
        } else if start < HALT && end > HALT {
            Self::FromHalt(end.recip() as f32)
        } else if end < HALT && start > HALT {
            Self::ToHalt(start.recip() as f32)
        } else {
            Self::Steep(start as f32, end as f32)
        }
    }

    /// Newton's divided differences, and from them powers.
    fn interpolation(hodograph: &Hodograph, length: f64) -> [f64; COUNT] {
        let shares = LOOKS.map(|x| hodograph.length_to(x) / length);
        let mut differences: [f64; COUNT] = std::array::from_fn(|i| {
            let share = shares[i];
            (LOOKS[i] - share) / (share * (1.0 - share))
        });
        for order in 1..COUNT {
            for i in (order..COUNT).rev() {
                differences[i] =
                    (differences[i] - differences[i - 1]) / (shares[i] - shares[i - order]);
            }
        }
        let mut powers = [0.0; COUNT];
        for i in (0..COUNT).rev() {
            // times (y − shareᵢ), and one more difference.
            for power in (1..COUNT).rev() {
                powers[power] = powers[power - 1] - shares[i] * powers[power];
            }
            powers[0] = differences[i] - shares[i] * powers[0];
        }
        powers
    }

    /// The guess for a share in `0..1`; it lies there too.
    #[inline]
    fn at(&self, y: f64) -> f64 {
        let guess = match *self {
            Self::Smooth(coefficients) => {
                let [a, b, c, d, e, f] = coefficients.map(f64::from);
                let y2 = y * y;
                let q = (a + y * b) + y2 * ((c + y * d) + y2 * (e + y * f));
                y + y * (1.0 - y) * q
            }
            Self::FromHalt(power) => y.powf(f64::from(power)),
            Self::ToHalt(power) => 1.0 - (1.0 - y).powf(f64::from(power)),
            Self::Steep(start, end) => {
                let (start, end) = (f64::from(start), f64::from(end));
                let target = y * (start + end);
                target / (start + (start * start + (end - start) * target).sqrt())
            }
        };
        // False for NaN as well.
        if guess > 0.0 && guess < 1.0 { guess } else { y }
    }
}

impl Span {
    /// The span that a part of a curve is, at `start` metres of a path.
    pub(crate) fn new(velocity: &[DVec3; 3], cut: &Cut, start: f64) -> Self {
        let hodograph = Hodograph::over(velocity, cut.u_start, cut.width);
        Self {
            start,
            u_start: cut.u_start,
            width: cut.width,
            per_length: cut.length.recip(),
            guess: Guess::new(&hodograph, cut.length),
        }
    }

    /// The parameter at `distance` from the path's start.
    #[inline]
    pub(crate) fn u_at(&self, velocity: &[DVec3; 3], distance: f64) -> f64 {
        let hodograph = Hodograph::over(velocity, self.u_start, self.width);
        let x = self.invert(&hodograph, distance - self.start);
        (self.u_start + x * self.width).min(1.0)
    }

    /// Where on the span, from 0 to 1, the arc length from its start is
    /// `distance`.
    ///
    /// Newton's iteration on the integral with two terms more (Householder), in a
    /// bracket, from an interpolated guess: as a rule one evaluation of the
    /// integral, and at most 100 whatever the speed does.
    #[inline]
    fn invert(&self, hodograph: &Hodograph, distance: f64) -> f64 {
        let share = distance * self.per_length;
        // A span of no length is all one point: 0 · ∞.
        if share.is_nan() || share <= 0.0 {
            return 0.0;
        }
        if share >= 1.0 {
            return 1.0;
        }
        let x = self.guess.at(share);
        let step = Step::from(hodograph, x, distance);
        if step.is_last() {
            return step.last(x);
        }
        iterate(hodograph, distance, x)
    }
}

/// What the inverse's series says where a guess is.
struct Step {
    excess: f64,
    newton: f64,
    bend: f64,
    twist: f64,
}

impl Step {
    #[inline]
    fn from(hodograph: &Hodograph, x: f64, distance: f64) -> Self {
        let excess = hodograph.length_to(x) - distance;
        let (speed, first, second) = hodograph.speed(x);
        let per_speed = 1.0 / speed;
        let newton = -excess * per_speed;
        Self {
            excess,
            newton,
            bend: 0.5 * newton * first * per_speed,
            twist: newton * newton * second * per_speed / 6.0,
        }
    }

    #[inline]
    fn is_last(&self) -> bool {
        self.newton.abs() <= LAST_STEP
            && self.bend.abs() <= LAST_STEP
            && self.twist.abs() <= LAST_STEP * LAST_STEP
    }

    #[inline]
    fn last(&self, x: f64) -> f64 {
        let series = 1.0 - self.bend + 2.0 * self.bend * self.bend - self.twist;
        (x + self.newton * series).clamp(0.0, 1.0)
    }
}

#[cold]
fn iterate(hodograph: &Hodograph, distance: f64, guess: f64) -> f64 {
    let mut x = guess;
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..100 {
        let step = Step::from(hodograph, x, distance);
        if step.is_last() {
            return step.last(x);
        }
        let Step {
            excess,
            newton,
            bend,
            ..
        } = step;
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

/// Cuts the stretch `range` of a cubic into spans and hands them over in order.
///
/// `velocity` are the control points of the cubic's derivative.
///
/// A span is good when the rule over the whole of it agrees with the rule over
/// its halves. That test alone would not do: see [`sections`].
pub(crate) fn subdivide(velocity: &[DVec3; 3], range: Range<f64>, mut emit: impl FnMut(Cut)) {
    let mut cutter = Cutter {
        velocity,
        error: SPAN_ERROR * greatest(velocity),
        emit: &mut emit,
    };
    sections(velocity, range, |Range { start, end }| {
        let part = Hodograph::over(velocity, start, end - start);
        cutter.cut(start, end - start, part.length_to(1.0), MAX_HALVINGS);
    });
}

/// Cuts the stretch `range` of a cubic wherever it is slow and slowest.
///
/// Where the curve halts (a cusp), or all
/// but halts, its speed has a kink, and a kink between a stretch's end and its first
/// node is seen by no rule. Beside a cusp that lies on a cut the speed is smooth.
pub(crate) fn sections(velocity: &[DVec3; 3], range: Range<f64>, mut emit: impl FnMut(Range<f64>)) {
    let width = range.end - range.start;
    if width <= 0.0 {
        return;
    }
    let size = greatest(velocity);
    let whole = Hodograph::over(velocity, range.start, width);
    let slow = SLOW * width * size;
    // All velocities are means of three: where none of these has too little along the middle
    // one, there is no need to look where the speed is least.
    let fast = |vector: &DVec3| vector.dot(velocity[1]) > SLOW * size * velocity[1].length();
    let slowest = (!velocity.iter().all(fast)).then(|| whole.slowest());
    let cuts = slowest
        .into_iter()
        .flatten()
        .filter(|x| whole.velocity(*x).length() < slow)
        .map(|x| range.start + x * width);
    let mut start = range.start;
    for end in cuts.chain(std::iter::once(range.end)) {
        // Cuts at the very ends cut nothing.
        if end > start {
            emit(start..end);
            start = end;
        }
    }
}

/// No velocity is greater.
fn greatest(velocity: &[DVec3; 3]) -> f64 {
    velocity.iter().map(|v| v.length()).fold(0.0, f64::max)
}

struct Cutter<'a, Emit> {
    velocity: &'a [DVec3; 3],
    error: f64,
    emit: &'a mut Emit,
}

impl<Emit: FnMut(Cut)> Cutter<'_, Emit> {
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
            (self.emit)(Cut {
                u_start: start,
                width,
                length,
            });
        } else {
            self.cut(start, half, left, halvings - 1);
            self.cut(start + half, half, right, halvings - 1);
        }
    }
}
