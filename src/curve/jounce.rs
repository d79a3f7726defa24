//! How much the fourth derivative of a stretch of a cubic is at most.

use glam::DVec3;

/// An upper bound of the fourth derivative by arc length over a stretch of a cubic, per cubic metre; infinite
/// beside a cusp.
///
/// `velocity` are the Bernstein coefficients of the derivative over the stretch, by a parameter of which
/// the stretch is `width` long.
///
/// With the velocity `v`, its square `w` and the parameter `x`, any derivative by arc length is `N w⁻ᵉ` with a
/// polynomial `N`, and the next is `(N' w − e N w') w⁻ᵉ⁻³ᐟ²`; the second is `((v × v') × v) w⁻²`, with
/// which it begins. So the fourth has a polynomial of the tenth degree, no larger than its Bernstein
/// coefficients, over `w⁵`.
pub(super) fn jounce(velocity: &[DVec3; 3], width: f64) -> f64 {
    let [a, b, c] = *velocity;
    let axis = a + b + c;
    let slowest = axis.dot(a).min(axis.dot(b)).min(axis.dot(c)) / axis.length();
    let (ab, bb, ac, bc) = (a.dot(b), b.dot(b), a.dot(c), b.dot(c));
    // All polynomials here are scaled: coefficients times binomials, so that products are convolutions.
    let square = Scaled([a.dot(a), 4.0 * ab, 4.0 * bb + 2.0 * ac, 4.0 * bc, c.dot(c)]);
    let [w0, w1, w2, w3, w4] = square.0;
    let least = w0.min(0.25 * w1).min(w2 / 6.0).min(0.25 * w3).min(w4);
    let least = least.max(if slowest > 0.0 {
        slowest * slowest
    } else {
        0.0
    });
    let per_square = 1.0 / (least * (1.0 - 1e-9));
    let change: Scaled<f64, 4> = square.derivative();
    let [ab, ac, bc] = [a.cross(b), a.cross(c), b.cross(c)];
    let twice = 2.0 * b;
    let second = Scaled([
        ab.cross(a),
        ab.cross(twice) + ac.cross(a),
        ab.cross(c) + ac.cross(twice) + bc.cross(a),
        ac.cross(c) + bc.cross(twice),
        bc.cross(c),
    ]);
    // Twice the numerator, so far.
    let third: Scaled<DVec3, 8> = second.next::<4, 8>(2.0, &square, &change);
    let fourth: Scaled<DVec3, 11> = third.next::<7, 11>(3.5, &square, &change);
    let mut most = 0.0_f64;
    for (coefficient, binomial) in fourth.0.iter().zip(TENTH) {
        most = most.max(coefficient.length_squared() * (binomial * binomial));
    }
    // What rounding leaves of sums that cancel, and more.
    let bend = (b - a).length_squared().max((c - b).length_squared());
    let size = bb.max(w0).max(w4);
    let rounding = 1e-12 * size * size * bend * bend.sqrt();
    let bound = 2.0 * (most.sqrt() + rounding) * per_square.powi(5) / width.abs().powi(3);
    // 0/0 of a stretch that halts: nothing is known.
    if bound.is_nan() || least <= 0.0 {
        f64::INFINITY
    } else {
        bound
    }
}

/// The reciprocals of the tenth degree's binomials.
const TENTH: [f64; 11] = [
    1.0,
    1.0 / 10.0,
    1.0 / 45.0,
    1.0 / 120.0,
    1.0 / 210.0,
    1.0 / 252.0,
    1.0 / 210.0,
    1.0 / 120.0,
    1.0 / 45.0,
    1.0 / 10.0,
    1.0,
];

/// A polynomial on `0..=1`: its Bernstein coefficients times the binomials of its degree.
struct Scaled<T, const N: usize>([T; N]);

impl Scaled<f64, 5> {
    fn derivative(&self) -> Scaled<f64, 4> {
        Scaled(std::array::from_fn(|i| {
            (i + 1) as f64 * self.0[i + 1] - (4 - i) as f64 * self.0[i]
        }))
    }
}

impl<const N: usize> Scaled<DVec3, N> {
    /// `N' w − e N w'`, of `LESS` coefficients less one.
    fn next<const LESS: usize, const NEXT: usize>(
        &self,
        exponent: f64,
        square: &Scaled<f64, 5>,
        change: &Scaled<f64, 4>,
    ) -> Scaled<DVec3, NEXT> {
        let mut next = [DVec3::ZERO; NEXT];
        for i in 0..LESS {
            let slope = (i + 1) as f64 * self.0[i + 1] - (LESS - i) as f64 * self.0[i];
            for (j, w) in square.0.iter().enumerate() {
                next[i + j] += *w * slope;
            }
        }
        for (i, value) in self.0.iter().enumerate() {
            let value = exponent * *value;
            for (j, w) in change.0.iter().enumerate() {
                next[i + j] -= *w * value;
            }
        }
        Scaled(next)
    }
}

#[cfg(test)]
mod tests {
    use crate::curve::{Section, Spline};
    use glam::DVec3;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::{Rng, SeedableRng};
    use std::error::Error;

    /// A cubic that meets places and tangents at both ends of a window is off by no more than the bound
    /// says, and often by not much less.
    #[test]
    fn no_window_bends_by_more_than_the_bound() -> Result<(), Box<dyn Error>> {
        let mut rng = ChaCha8Rng::seed_from_u64(31);
        let mut unit = || (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        let (mut bounded, mut tight) = (0, 0);
        for number in 0..20_000 {
            let size = 10.0_f64.powf(6.0 * unit() - 3.0);
            let mut point = || size * (DVec3::new(unit(), unit(), unit()) - 0.5);
            let spline = Spline::bezier([point(), point(), point(), point()])?;
            let from = unit() * spline.length();
            let way = 10.0_f64.powf(-3.0 * unit()) * (spline.length() - from);
            let locate = |distance: f64| spline.locate(distance).1;
            let ends = [locate(from), locate(from + way)];
            let bound = Section::of(&spline.pieces()[0], ends, true).jounce();
            if bound.is_infinite() {
                continue;
            }
            let (p, q) = (spline.position_at(from), spline.position_at(from + way));
            let (t, s) = (spline.tangent_at(from), spline.tangent_at(from + way));
            let middle = 0.5 * (p + q) + 0.125 * way * (t - s);
            let off = (spline.position_at(from + 0.5 * way) - middle).length();
            let most = bound * way.powi(4) / 384.0;
            let rounding = 1e-12 * spline.length();
            assert!(off <= most + rounding, "{number}: {off} {most}");
            bounded += 1;
            tight += i32::from(off > 0.25 * most && off > rounding);
        }
        assert!(bounded > 15_000 && tight > 1500, "{bounded} {tight}");
        Ok(())
    }
}
