//! The inverse of arc length on one span, as a polynomial.

use crate::curve::hodograph::Hodograph;
use crate::curve::span::Span;
use std::f64::consts::PI;

/// Coefficients of a fit.
///
/// The quadrature rule is exact on a span because the nearest complex zero of the
/// speed lies more than three half-widths off its middle. There the inverse is singular
/// as well, and its Chebyshev coefficients fall with `(3 + √8)⁻ᵏ`: the
/// twentieth is below rounding.
const COUNT: usize = 20;

/// Two last coefficients above this, relative to the first, mean that too much was cut off:
/// what follows them is a sixth of it.
const TAIL: f64 = 3e-15;

/// How far a fit may be from the iterated inverse where it was not made from it, as a share
/// of the span: a few times the rounding of both.
const OFF: f64 = 3e-15;

/// The parameter of a curve for a distance on one span: exact to rounding, without a root.
///
/// `u = u_start + y·q(2y − 1)` with the share `y` of the span's length, so that the
/// span's start comes out bit for bit. Three cache lines, so that a look-up
/// among any number of spans waits for memory once.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub(super) struct Fit {
    /// Distance from the path's start to the span's.
    pub(super) start: f64,
    per_metre: f64,
    u_start: f64,
    pub(super) piece: u32,
    /// Whether the polynomial is good enough to be the answer.
    pub(super) good: bool,
    coefficients: [f64; COUNT],
}

impl Fit {
    /// The parameter at `distance` from the path's start.
    pub(super) fn u_at(&self, distance: f64) -> f64 {
        let share = ((distance - self.start) * self.per_metre).min(1.0);
        self.u_start + share * polynomial(&self.coefficients, 2.0 * share - 1.0)
    }
}

/// `Σ cₖ·tᵏ`, by fours: a third of the latency of Horner's scheme.
fn polynomial(c: &[f64; COUNT], t: f64) -> f64 {
    let t2 = t * t;
    let t4 = t2 * t2;
    let t8 = t4 * t4;
    let four = |i: usize| (c[i] + t * c[i + 1]) + t2 * (c[i + 2] + t * c[i + 3]);
    let low = four(0) + t4 * four(4);
    let high = four(8) + t4 * four(12);
    (low + t8 * high) + (t8 * t8) * four(16)
}

/// Makes fits; holds what all of them need.
pub(super) struct Fitter {
    /// Shares of a span's length at which its inverse is looked at: Chebyshev nodes.
    shares: [f64; COUNT],
    /// From values there to coefficients of Chebyshev polynomials.
    weights: [[f64; COUNT]; COUNT],
}

impl Fitter {
    pub(super) fn new() -> Self {
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
        }
    }

    /// The fit of a span of which it is not yet known where it starts.
    pub(super) fn fit(&self, piece: u32, hodograph: &Hodograph, span: &Span) -> Fit {
        let at = |share: f64| span.invert(hodograph, share * span.length) * (span.width / share);
        let values = self.shares.map(at);
        let chebyshev = self.weights.each_ref().map(|row| {
            row.iter()
                .zip(values)
                .map(|(weight, value)| weight * value)
                .sum::<f64>()
        });
        let mut fit = Fit {
            start: 0.0,
            per_metre: span.length.recip(),
            u_start: span.u_start,
            piece,
            good: false,
            coefficients: powers(&chebyshev),
        };
        let tail = chebyshev[COUNT - 1].abs() + chebyshev[COUNT - 2].abs();
        // False for NaN and infinity, of spans without length.
        fit.good = tail <= TAIL * chebyshev[0].abs()
            && [1e-4, 0.02, 0.35, 0.6, 0.93, 1.0].into_iter().all(|share| {
                let value = polynomial(&fit.coefficients, 2.0 * share - 1.0);
                (value - at(share)).abs() * share <= OFF * span.width
            });
        fit
    }
}

/// From coefficients of Chebyshev polynomials to those of powers.
///
/// The latter's are at most 2.42ᵏ times as large, and the former fall faster:
/// nothing is lost.
fn powers(chebyshev: &[f64; COUNT]) -> [f64; COUNT] {
    let mut sum = [0.0; COUNT];
    let (mut last, mut this) = ([0.0; COUNT], [0.0; COUNT]);
    this[0] = 1.0;
    for (degree, weight) in chebyshev.iter().enumerate() {
        for (sum, coefficient) in sum.iter_mut().zip(this) {
            *sum += weight * coefficient;
        }
        // T(k+1) = 2t·T(k) − T(k−1), and T(1) = t.
        let factor = if degree == 0 { 1.0 } else { 2.0 };
        let next = std::array::from_fn(|power| {
            let shifted = if power == 0 { 0.0 } else { this[power - 1] };
            factor * shifted - last[power]
        });
        (last, this) = (this, next);
    }
    sum
}
