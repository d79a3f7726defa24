//! The inverse of arc length on one span, as a polynomial.

use crate::curve::span::Span;
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Coefficients of a fit.
///
/// The quadrature rule is exact on a span because the nearest complex zero of the
/// speed lies more than two half-widths off its middle. There the inverse is singular
/// as well, and its Chebyshev coefficients fall with `4.2⁻ᵏ`: the last are below rounding, and
/// fewer would not make a cache line less.
const COUNT: usize = 28;

/// Two last coefficients above this, relative to the first, mean that too much was cut off:
/// what follows them is a sixth of it.
const TAIL: f64 = 3e-15;

/// How far a fit may be from the iterated inverse where it was not made from it, as a share
/// of the span: a few times the rounding of both.
const OFF: f64 = 6e-15;

/// Share of a span before its end within which rounding may put a distance on either side of it.
///
/// Spans are no shorter than some 1e-12 of a path; of those that are, all is seam.
const SEAM: f64 = 1e-3;

/// The parameter of a curve for a distance on one span: exact to rounding, without a root or an
/// integral.
///
/// `u = u_start + y·q(2y − 1)` with the share `y` of the span's length, so that the
/// span's start comes out bit for bit. Four cache lines: too much for splines of thousands of pieces, which
/// do without.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub(super) struct Fit {
    /// Distance from the path's start to the span's.
    pub(super) start: f64,
    pub(super) per_metre: f64,
    pub(super) u_start: f64,
    /// The span's curve.
    pub(super) piece: u32,
    /// Whether the polynomial is good enough to be the answer.
    pub(super) good: bool,
    pub(super) coefficients: [f64; COUNT],
}

impl Fit {
    /// The parameter at `distance` from the path's start, which lies on the span.
    #[inline]
    pub(super) fn u_at(&self, distance: f64) -> f64 {
        let share = self.share(distance).clamp(0.0, 1.0);
        let u = self.u_start + share * polynomial(&self.coefficients, 2.0 * share - 1.0);
        u.min(1.0)
    }

    /// Whether a distance from the path's start lies on the span for certain, and what the
    /// polynomial says there is right.
    #[inline]
    pub(super) fn holds(&self, distance: f64) -> bool {
        // Where the next span begins may be an ulp before or after what this one's length says.
        self.good && distance >= self.start && self.share(distance) < 1.0 - SEAM
    }

    #[inline]
    fn share(&self, distance: f64) -> f64 {
        (distance - self.start) * self.per_metre
    }
}

/// `Σ cₖ·tᵏ`, by fours: a third of the latency of Horner's scheme.
#[inline]
fn polynomial(c: &[f64; COUNT], t: f64) -> f64 {
    let t2 = t * t;
    let t4 = t2 * t2;
    let t8 = t4 * t4;
    let four = |i: usize| (c[i] + t * c[i + 1]) + t2 * (c[i + 2] + t * c[i + 3]);
    let low = (four(0) + t4 * four(4)) + t8 * (four(8) + t4 * four(12));
    let high = (four(16) + t4 * four(20)) + t8 * four(24);
    low + (t8 * t8) * high
}

/// Makes fits; holds what all of them need.
pub(super) struct Fitter {
    /// Shares of a span's length at which its inverse is looked at: Chebyshev nodes.
    shares: [f64; COUNT],
    /// From values there to coefficients of Chebyshev polynomials.
    weights: [[f64; COUNT]; COUNT],
    /// Those polynomials' own coefficients, which are integers.
    powers: [[f64; COUNT]; COUNT],
}

/// The one there is, made when it is needed first.
pub(super) static FITTER: LazyLock<Fitter> = LazyLock::new(Fitter::new);

impl Fitter {
    fn new() -> Self {
        let count = COUNT as f64;
        let angle = |node: usize| PI * (node as f64 + 0.5) / count;
        Self {
            shares: std::array::from_fn(|node| 0.5 - 0.5 * libm::cos(angle(node))),
            weights: std::array::from_fn(|k| {
                let scale = if k == 0 { 1.0 } else { 2.0 } / count;
                // Nodes run from −1: cos(k(π − angle)).
                let sign = if k % 2 == 0 { scale } else { -scale };
                std::array::from_fn(|node| sign * libm::cos(k as f64 * angle(node)))
            }),
            powers: polynomials(),
        }
    }

    /// Hands over a span that is `length` long with its fit and its length, or its parts with theirs where it takes
    /// shorter ones for fits to be good.
    pub(super) fn each(
        &self,
        velocity: &[DVec3; 3],
        (span, length): (Span, f64),
        halvings: u32,
        emit: &mut impl FnMut(Span, Fit, f64),
    ) {
        let fit = self.fit(velocity, &span, length);
        if fit.good || halvings == 0 {
            emit(span, fit, length);
            return;
        }
        for half in span.halves(velocity, length) {
            self.each(velocity, half, halvings - 1, emit);
        }
    }

    /// The fit of a span that is `length` long.
    pub(super) fn fit(&self, velocity: &[DVec3; 3], span: &Span, length: f64) -> Fit {
        let mut fit = Fit {
            start: span.start,
            piece: 0,
            per_metre: length.recip(),
            u_start: span.u_start,
            good: false,
            coefficients: [0.0; COUNT],
        };
        let place = span.place(velocity);
        let at = |share: f64| place.width_to(share * length) / share;
        let values = self.shares.map(at);
        let chebyshev = self.weights.each_ref().map(|row| {
            let mut sums = [0.0; 4];
            for (weights, values) in row.chunks_exact(4).zip(values.chunks_exact(4)) {
                for lane in 0..4 {
                    sums[lane] += weights[lane] * values[lane];
                }
            }
            (sums[0] + sums[1]) + (sums[2] + sums[3])
        });
        let tail = chebyshev[COUNT - 1].abs() + chebyshev[COUNT - 2].abs();
        // False for NaN and infinity, of spans without length.
        if tail <= TAIL * chebyshev[0].abs() {
            fit.coefficients = self.powers(&chebyshev);
            let whole = chebyshev[0].abs();
            fit.good = [1e-4, 0.02, 0.35, 0.6, 0.93, 1.0].into_iter().all(|share| {
                let value = polynomial(&fit.coefficients, 2.0 * share - 1.0);
                (value - at(share)).abs() * share <= OFF * whole
            });
        }
        fit
    }

    /// From coefficients of Chebyshev polynomials to those of powers.
    ///
    /// The latter's are at most 2.42ᵏ times as large, and the former fall faster:
    /// nothing is lost.
    fn powers(&self, chebyshev: &[f64; COUNT]) -> [f64; COUNT] {
        let mut sum = [0.0; COUNT];
        for (degree, (weight, polynomial)) in chebyshev.iter().zip(&self.powers).enumerate() {
            for (sum, coefficient) in sum[..=degree].iter_mut().zip(polynomial) {
                *sum += weight * coefficient;
            }
        }
        sum
    }
}

/// The coefficients of Chebyshev's polynomials.
fn polynomials() -> [[f64; COUNT]; COUNT] {
    let (mut last, mut this) = ([0.0; COUNT], [0.0; COUNT]);
    this[0] = 1.0;
    std::array::from_fn(|degree| {
        let polynomial = this;
        // T(k+1) = 2t·T(k) − T(k−1), and T(1) = t.
        let factor = if degree == 0 { 1.0 } else { 2.0 };
        let next = std::array::from_fn(|power| {
            let shifted = if power == 0 { 0.0 } else { this[power - 1] };
            factor * shifted - last[power]
        });
        (last, this) = (this, next);
        polynomial
    })
}
