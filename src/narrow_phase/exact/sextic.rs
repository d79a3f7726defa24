//! Where the square of a cubic's distance comes down.

use glam::DVec3;

/// What products of coordinates round by, in shares of the sum of all terms.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The square of a cubic way's distance from the origin, less that of a distance: its coefficients, from the
/// constant up, over `0..=1`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sextic {
    coefficients: [f64; 7],
    /// What was taken off the second, third and fourth power for what is not known.
    loss: [f64; 3],
}

impl Sextic {
    /// Of the way with these coefficients, the first of which is farther off than `distance`.
    #[inline]
    pub(super) fn of([p, q, r, s]: [DVec3; 4], distance: f64) -> Self {
        let length = p.length();
        let coefficients = [
            (length - distance) * (length + distance),
            2.0 * p.dot(q),
            q.length_squared() + 2.0 * p.dot(r),
            2.0 * (p.dot(s) + q.dot(r)),
            r.length_squared() + 2.0 * q.dot(s),
            2.0 * r.dot(s),
            s.length_squared(),
        ];
        Self {
            coefficients,
            loss: [0.0; 3],
        }
    }

    /// The same, less what is given of the second, third and fourth power.
    #[inline]
    pub(super) fn less(self, loss: [f64; 3]) -> Self {
        let [a, b, c, d, e, f, g] = self.coefficients;
        let [square, cube, fourth] = loss;
        Self {
            coefficients: [a, b, c - square, d - cube, e - fourth, f, g],
            loss,
        }
    }

    /// A place in `0..=1` up to which it is positive, at its first root or where it is within `close` of zero, or within
    /// a share of what is not known there; none if it is positive all the way. 0 where anything is not finite.
    ///
    /// It is nowhere below the parabola that meets value and slope at a place and bends as little as it ever does: so
    /// whose root is no later than its own. Where it is the parabola that grazes, there is no need to find out
    /// where.
    #[inline]
    pub(super) fn first_fall(&self, close: f64) -> Option<f64> {
        /// Four to six do but in a graze.
        const ROUNDS: u32 = 40;
        /// Closer to zero than this share of what is not known it is not worth looking.
        const UNKNOWN: f64 = 0.25;
        let [square, cube, fourth] = self.loss.map(|loss| UNKNOWN * loss);
        let [a, b, c, d, e, f, g] = self.coefficients;
        let size = a.abs() + b.abs() + c.abs() + d.abs() + e.abs() + f.abs() + g.abs();
        if !size.is_finite() {
            return Some(0.0);
        }
        let constant = a - ROUNDING * size;
        // The second derivative by its Bernstein coefficients, none of which it is below.
        let [s, t, u, v, w] = [2.0 * c, 6.0 * d, 12.0 * e, 20.0 * f, 30.0 * g];
        let (half, sixth) = (0.5 * t, u / 6.0);
        let bend = s
            .min(s + 0.5 * half)
            .min(s + half + sixth)
            .min(s + 1.5 * half + 3.0 * sixth + 0.25 * v)
            .min(s + t + u + v + w);
        let (mut x, mut height, mut slope, mut near) = (0.0, constant, b, close);
        for _ in 0..ROUNDS {
            if height <= near {
                break;
            }
            let least = slope * slope - 2.0 * bend * height;
            if least < 0.0 || bend >= 0.0 && slope >= 0.0 {
                return None;
            }
            x += 2.0 * height / (least.sqrt() - slope) * (1.0 - 1e-12);
            if x >= 1.0 {
                return None;
            }
            let squared = x * x;
            near = close + squared * ((square + x * cube) + squared * fourth);
            height = (constant + x * b)
                + squared * ((c + x * d) + squared * ((e + x * f) + squared * g));
            slope = (b + x * (2.0 * c))
                + squared * ((3.0 * d + x * (4.0 * e)) + squared * (5.0 * f + x * (6.0 * g)));
        }
        Some(x)
    }
}

#[cfg(test)]
mod tests {
    use super::Sextic;
    use glam::DVec3;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::{Rng, SeedableRng};

    /// No fall is missed, none is told too early, and few are told where there are none.
    #[test]
    fn first_falls_are_found() {
        let mut rng = ChaCha8Rng::seed_from_u64(17);
        let mut unit = || (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        let (mut falls, mut none) = (0, 0);
        for number in 0..20_000 {
            let mut vector = |size: f64| size * (2.0 * DVec3::new(unit(), unit(), unit()) - 1.0);
            let way = [vector(2.0), vector(4.0), vector(6.0), vector(4.0)];
            let at = |x: f64| way[0] + x * (way[1] + x * (way[2] + x * way[3]));
            let distance = (0.5 + 0.49 * unit()) * way[0].length();
            let close = 1e-9 * distance;
            let sextic = Sextic::of(way, distance);
            let samples = 2000;
            let lowest = |until: f64| {
                (0..=samples)
                    .map(|sample| at(until * f64::from(sample) / f64::from(samples)).length())
                    .fold(f64::INFINITY, f64::min)
            };
            match sextic.first_fall(close) {
                None => {
                    none += 1;
                    let least = lowest(1.0);
                    assert!(least > distance, "{number}: {least} {distance}");
                }
                Some(x) => {
                    falls += 1;
                    let least = lowest(x);
                    assert!(least > distance - 1e-12, "{number}: {least} {distance}");
                    let there = at(x).length();
                    assert!(
                        there < distance + 1e-8,
                        "{number}: {there} {distance} at {x}"
                    );
                }
            }
        }
        assert!(falls > 3_000 && none > 3_000, "{falls} {none}");
    }

    #[test]
    fn what_is_not_finite_falls_at_once() {
        let way = [DVec3::X, DVec3::NAN, DVec3::ZERO, DVec3::ZERO];
        assert_eq!(Sextic::of(way, 0.5).first_fall(1e-9), Some(0.0));
    }
}
