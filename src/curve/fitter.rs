//! Polynomials that are the inverse of arc length.

use crate::curve::fit::{COUNT, Fit, LOW};
use crate::curve::hodograph::Hodograph;
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Nodes at which the speed is looked at.
///
/// On a span whose inverse is a polynomial of [`COUNT`] terms the speed's nearest complex zero is some seven half-widths
/// away, and the coefficients of the speed fall as `7⁻ᵏ`.
const NODES: usize = 20;

/// A last coefficient of the speed above this, relative to the first, means that too much was cut off.
const SPEED_TAIL: f64 = 1e-13;

/// Steps of Newton's iteration from a polynomial that meets both ends with two derivatives there.
const STEPS: usize = 2;

/// Nodes that are looked at abreast.
const LANES: usize = 4;

/// Last coefficients above this share of what a fit may be off mean that it is off.
const TAIL: f64 = 0.5;

/// Where a fit is looked at, as shares of its length: between its nodes, and at the end.
const LOOKS: [f64; 4] = [0.03, 0.35, 0.77, 1.0];

/// How far a fit may be off, as a share of its span: a few times the rounding of what it is made from.
const OFF: f64 = 3e-15;

/// The same for spans of long paths: there distances are that coarse.
const MOST_OFF: f64 = 1e-12;

/// How many times as wide a span is tried if one was not good for no known reason.
pub(super) const NARROWER: f64 = 0.7;

/// Makes fits; holds what all of them need.
pub(super) struct Fitter {
    /// Where on a span speeds are looked at: Chebyshev nodes.
    places: [f64; NODES],
    /// From speeds there to coefficients of Chebyshev polynomials: by node.
    speeds: [[f64; NODES]; NODES],
    /// Shares of a span's length at which its inverse is looked at: Chebyshev nodes as well.
    shares: [f64; COUNT],
    /// From values there to coefficients of Chebyshev polynomials: by node.
    values: [[f64; COUNT]; COUNT],
    /// Powers, as sums of Chebyshev polynomials.
    powers: [[f64; NODES + 1]; NODES + 1],
}

/// The one there is, made when it is needed first.
pub(super) static FITTER: LazyLock<Fitter> = LazyLock::new(Fitter::new);

impl Fitter {
    fn new() -> Self {
        Self {
            places: nodes(),
            speeds: weights(),
            shares: nodes(),
            values: weights(),
            powers: powers(),
        }
    }

    /// The inverse of arc length over `width` of a curve's parameter from `u_start` on, with no place in a path
    /// yet; and the length, and how many times as wide a span may be tried next.
    ///
    /// It is off by `off` metres at most, or by rounding. If there is no such polynomial of this degree: how many times
    /// as wide a span may be tried instead.
    pub(super) fn fit(
        &self,
        velocity: &[DVec3; 3],
        (u_start, width): (f64, f64),
        off: f64,
    ) -> Result<(Fit, f64, f64), f64> {
        let hodograph = Hodograph::over(velocity, u_start, width);
        let series = self.length(&hodograph)?;
        let length = hodograph.length_to(1.0);
        // Down: no share is above 1.
        let mut per_metre = length.recip() as f32;
        if f64::from(per_metre) * length > 1.0 {
            per_metre = per_metre.next_down();
        }
        let metre = f64::from(per_metre);
        let off = off.clamp(OFF * length, MOST_OFF * length);
        let mut chebyshev = self.inverse(&hodograph, &series, length, metre);
        let tail = chebyshev[COUNT - 1].abs() + chebyshev[COUNT - 2].abs();
        let wider = wider(TAIL * off / length * chebyshev[0].abs(), tail);
        // False for NaN and infinity, of spans without length.
        if !(wider >= 1.0 && per_metre.is_finite() && metre > 0.0) {
            return Err(wider);
        }
        let mut fit = Fit {
            start: 0.0,
            u_start,
            per_metre,
            piece: 0,
            low: [0.0; LOW],
            high: [0.0; COUNT - LOW],
        };
        chebyshev = chebyshev.map(|coefficient| width * coefficient);
        self.to_powers(&mut chebyshev, |power, coefficient| {
            match fit.low.get_mut(power) {
                Some(low) => {
                    *low = coefficient;
                    coefficient
                }
                None => {
                    let high = coefficient as f32;
                    fit.high[power - LOW] = high;
                    f64::from(high)
                }
            }
        });
        let good = LOOKS.into_iter().all(|share| {
            let way = share * length;
            let y = way * metre;
            let x = y * fit.mean(2.0 * y - 1.0) / width;
            // The quadrature that it is held against is rounded as much again.
            (hodograph.length_to(x) - way).abs() <= 2.0 * off
        });
        if good {
            Ok((fit, length, wider))
        } else {
            Err(NARROWER)
        }
    }

    /// The arc length from a stretch's start as a polynomial of `2x − 1`; none else
    /// how many times as wide a stretch may have one.
    fn length(&self, hodograph: &Hodograph) -> Result<[f64; NODES + 1], f64> {
        let values = self.places.map(|x| hodograph.velocity(x).length());
        let speed = transform(&self.speeds, &values);
        let [.., before, last] = speed;
        let wider = wider(SPEED_TAIL * speed[0], before.abs() + last.abs());
        if wider < 1.0 {
            return Err(wider);
        }
        let speed = |index: usize| speed.get(index).copied().unwrap_or(0.0);
        let mut length: [f64; NODES + 1] = std::array::from_fn(|k| match k {
            0 => 0.0,
            1 => 0.5 * (speed(0) - 0.5 * speed(2)),
            _ => 0.25 * (speed(k - 1) - speed(k + 1)) / k as f64,
        });
        length[0] = (1..=NODES).rev().fold(0.0, |sum, k| {
            sum + if k % 2 == 0 { -length[k] } else { length[k] }
        });
        let mut powers = [0.0; NODES + 1];
        self.to_powers(&mut length, |power, coefficient| {
            powers[power] = coefficient;
            coefficient
        });
        Ok(powers)
    }

    /// The mean of the parameter's derivative from a stretch's start as far as to some share of its length, in Chebyshev
    /// polynomials of that share.
    fn inverse(
        &self,
        hodograph: &Hodograph,
        length: &[f64; NODES + 1],
        whole: f64,
        per_metre: f64,
    ) -> [f64; COUNT] {
        // The inverse's first two derivatives by the share.
        let ends = [0.0, 1.0].map(|x| {
            let (speed, change, _) = hodograph.speed(x);
            let first = whole / speed;
            (first, -change / speed * first * first)
        });
        let [(first, first_bend), (last, last_bend)] = ends;
        // The quintic's coefficients.
        let miss = [
            1.0 - first - 0.5 * first_bend,
            last - first - first_bend,
            last_bend - first_bend,
        ];
        let cubic = 10.0 * miss[0] - 4.0 * miss[1] + 0.5 * miss[2];
        let quartic = -15.0 * miss[0] + 7.0 * miss[1] - miss[2];
        let quintic = 6.0 * miss[0] - 3.0 * miss[1] + 0.5 * miss[2];
        let (metre, share) = (per_metre.recip(), (per_metre * whole).recip());
        let mut values = [0.0; COUNT];
        for (values, shares) in values
            .chunks_exact_mut(LANES)
            .zip(self.shares.chunks_exact(LANES))
        {
            let mut ways = [0.0; LANES];
            let mut t = [0.0; LANES];
            for lane in 0..LANES {
                let y = shares[lane] * share;
                let bend = 0.5 * first_bend + y * (cubic + y * (quartic + y * quintic));
                t[lane] = 2.0 * (y * (first + y * bend)) - 1.0;
                ways[lane] = shares[lane] * metre;
            }
            for _ in 0..STEPS {
                let (mut sum, mut slope) = ([length[NODES]; LANES], [0.0; LANES]);
                for coefficient in length[..NODES].iter().rev() {
                    for lane in 0..LANES {
                        slope[lane] = slope[lane] * t[lane] + sum[lane];
                        sum[lane] = sum[lane] * t[lane] + coefficient;
                    }
                }
                for lane in 0..LANES {
                    t[lane] -= (sum[lane] - ways[lane]) / slope[lane];
                }
            }
            for lane in 0..LANES {
                values[lane] = 0.5 * (1.0 + t[lane]) / shares[lane];
            }
        }
        transform(&self.values, &values)
    }

    /// From coefficients of Chebyshev polynomials to those of powers, from the highest on.
    ///
    /// `keep` tells what it makes of each: what rounding there takes off the lower ones make good, as far as
    /// they can.
    ///
    /// Coefficients of powers are at most 2.42ᵏ times as large as the others, which fall faster: nothing is lost.
    fn to_powers<const N: usize>(
        &self,
        chebyshev: &mut [f64; N],
        mut keep: impl FnMut(usize, f64) -> f64,
    ) {
        for power in (0..N).rev() {
            let row = &self.powers[power];
            let kept = keep(power, chebyshev[power] / row[power]);
            for (coefficient, weight) in chebyshev[..power].iter_mut().zip(row) {
                *coefficient -= kept * weight;
            }
        }
    }
}

/// How many times as wide a span may be whose last coefficients are `tail` and may be `most`.
///
/// The sixteenth root of what is left, less a little: they grow with at least the fifteenth power. Below 1 for NaN.
fn wider(most: f64, tail: f64) -> f64 {
    let root = (most / tail).sqrt().sqrt().sqrt().sqrt();
    if root >= 1.0 {
        (0.97 * root).clamp(1.0, 2.0)
    } else {
        // Of NaN the other is taken.
        (0.97 * root).max(0.25)
    }
}

/// Chebyshev nodes on `0..=1`.
fn nodes<const N: usize>() -> [f64; N] {
    std::array::from_fn(|node| 0.5 - 0.5 * libm::cos(angle::<N>(node)))
}

fn angle<const N: usize>(node: usize) -> f64 {
    PI * (node as f64 + 0.5) / N as f64
}

/// From values at [`nodes`] to coefficients of Chebyshev polynomials: by node, for the first half of them.
fn weights<const N: usize>() -> [[f64; N]; N] {
    std::array::from_fn(|node| {
        std::array::from_fn(|k| {
            let scale = if k == 0 { 1.0 } else { 2.0 } / N as f64;
            // Nodes run from −1: cos(k(π − angle)).
            let sign = if k % 2 == 0 { scale } else { -scale };
            sign * libm::cos(k as f64 * angle::<N>(node))
        })
    })
}

/// The coefficients of values at [`nodes`].
///
/// Polynomials of even degree have the same value at a node and at its mirror image, those of odd degree
/// opposite ones.
fn transform<const N: usize>(weights: &[[f64; N]; N], values: &[f64; N]) -> [f64; N] {
    let mut sums = [0.0; N];
    for node in 0..N / 2 {
        let (value, mirrored) = (values[node], values[N - 1 - node]);
        let pair = [value + mirrored, value - mirrored];
        for (sums, weights) in sums.chunks_exact_mut(2).zip(weights[node].chunks_exact(2)) {
            for lane in 0..2 {
                sums[lane] += weights[lane] * pair[lane];
            }
        }
    }
    sums
}

/// Powers as sums of Chebyshev polynomials: `t·Tₖ = (Tₖ₊₁ + Tₖ₋₁)/2`, and `t·T₀ = T₁`.
fn powers() -> [[f64; NODES + 1]; NODES + 1] {
    let mut this = [0.0; NODES + 1];
    this[0] = 1.0;
    std::array::from_fn(|_| {
        let power = this;
        let mut next = [0.0; NODES + 1];
        for (k, weight) in power.iter().enumerate() {
            let half = if k == 0 { *weight } else { 0.5 * weight };
            if let Some(above) = next.get_mut(k + 1) {
                *above += half;
            }
            if k > 0 {
                next[k - 1] += half;
            }
        }
        this = next;
        power
    })
}
