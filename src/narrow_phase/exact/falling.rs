//! Where a polynomial comes down to zero.

/// A place in `0..=1` up to which the polynomial with these Bernstein coefficients is positive, at its first
/// root or where it is within `close` of zero, or a little before where it grazes it; none if it is positive all the
/// way. 0 where anything is not finite.
///
/// There are no more roots than coefficients change their sign (Descartes), and if they do so once, Newton's
/// iteration in a bracket finds it. Else: a polynomial lies within the hull of its coefficients, and so it comes
/// down no earlier than the hull does. There it is cut, and what follows is looked at in the same way.
#[inline]
pub(super) fn first_fall<const N: usize>(coefficients: [f64; N], close: f64) -> Option<f64> {
    /// One does but in a graze.
    const ROUNDS: u32 = 32;
    let mut c = coefficients;
    // NaN is not positive.
    if c.iter().all(|height| *height > 0.0) {
        return None;
    }
    if !c.iter().sum::<f64>().is_finite() {
        return Some(0.0);
    }
    let (mut from, mut width) = (0.0, 1.0);
    for _ in 0..ROUNDS {
        let low = c.iter().take_while(|height| **height > 0.0).count();
        if low == N {
            return None;
        }
        if c[0] <= close {
            break;
        }
        if c[low..].iter().all(|height| *height <= 0.0) {
            return Some(from + width * only_fall(&c, close));
        }
        // Down and up again: cut where it is lowest, as far as that is known.
        let lows = c[low..].iter().take_while(|height| **height <= 0.0).count();
        let middle = (low as f64 + 0.5 * (lows - 1) as f64) / (N - 1) as f64;
        let head = before(c, middle);
        if head[N - 1] <= 0.0 && head[..N - 1].is_sorted_by_key(|height| *height <= 0.0) {
            return Some(from + width * middle * only_fall(&head, close));
        }
        let step = hull_fall(&c);
        from += step * width;
        width *= 1.0 - step;
        c = after(c, step);
    }
    Some(from)
}

/// Where a polynomial comes down to zero that does so once, or is no more than `close` above it.
#[inline]
fn only_fall<const N: usize>(c: &[f64; N], close: f64) -> f64 {
    /// Newton's iteration takes some four; the rest are for bisection.
    const STEPS: u32 = 48;
    let degree = (N - 1) as f64;
    let (mut low, mut high) = (0.0, 1.0);
    let (mut height, mut slope) = (c[0], degree * (c[1] - c[0]));
    let mut x = 0.0;
    for _ in 0..STEPS {
        let next = x - (height - 0.5 * close) / slope;
        // Not so for NaN.
        x = if next > low && next < high {
            next
        } else {
            0.5 * (low + high)
        };
        if x <= low || x >= high {
            break;
        }
        (height, slope) = at(c, x);
        if height > 0.0 {
            low = x;
            if height <= close {
                break;
            }
        } else {
            high = x;
        }
    }
    low
}

/// Value and slope (de Casteljau).
#[inline]
fn at<const N: usize>(c: &[f64; N], x: f64) -> (f64, f64) {
    let mut c = *c;
    let rest = 1.0 - x;
    for last in (2..N).rev() {
        for i in 0..last {
            c[i] = rest * c[i] + x * c[i + 1];
        }
    }
    (rest * c[0] + x * c[1], (N - 1) as f64 * (c[1] - c[0]))
}

/// Where the hull of the coefficients, the first of which is positive, comes down to zero; infinite if nowhere.
///
/// That is on the line from one that is positive to one that is not.
#[inline]
fn hull_fall<const N: usize>(c: &[f64; N]) -> f64 {
    let mut least = f64::INFINITY;
    for low in 1..N {
        if c[low] <= 0.0 {
            for high in 0..low {
                if c[high] > 0.0 {
                    let share = c[high] / (c[high] - c[low]);
                    least = least.min(high as f64 + (low - high) as f64 * share);
                }
            }
        }
    }
    least / (N - 1) as f64
}

/// The coefficients of what comes before a share (de Casteljau).
#[inline]
fn before<const N: usize>(mut c: [f64; N], share: f64) -> [f64; N] {
    let rest = 1.0 - share;
    for first in 1..N {
        for i in (first..N).rev() {
            c[i] = rest * c[i - 1] + share * c[i];
        }
    }
    c
}

/// The coefficients of what follows after a share.
#[inline]
pub(super) fn after<const N: usize>(mut c: [f64; N], share: f64) -> [f64; N] {
    let rest = 1.0 - share;
    for last in (1..N).rev() {
        for i in 0..last {
            c[i] = rest * c[i] + share * c[i + 1];
        }
    }
    c
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::{Rng, SeedableRng};

    /// No root is jumped over, and none told that is not there.
    #[test]
    fn polynomials_are_positive_up_to_where_they_fall() {
        let mut rng = ChaCha8Rng::seed_from_u64(32);
        let mut number = || (rng.next_u64() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0;
        let (mut falls, mut clear, mut early) = (0, 0, 0);
        for case in 0..20_000 {
            let mut c: [f64; 7] = std::array::from_fn(|_| number());
            c[0] = c[0].abs() + 1e-3;
            // Some come down to a hair's breadth and turn there.
            if case % 4 == 0 {
                let (low, height) = (number().abs(), 1e-9 * number());
                let square = |x: f64| (x - low) * (x - low) + height;
                let [a, b, d] = [square(0.0), square(0.5), square(1.0)];
                let middle = 2.0 * b - 0.5 * (a + d);
                c = elevated([a, middle, d]);
            }
            let fall = first_fall(c, 1e-12);
            let to = fall.unwrap_or(1.0);
            for step in 0..=1000 {
                let height = at(&c, to * f64::from(step) / 1000.0).0;
                assert!(height > -1e-14, "{case}: {c:?} {to} {height}");
            }
            match fall {
                Some(place) => {
                    falls += 1;
                    let height = at(&c, place).0;
                    early += i32::from(height > 2e-12);
                    assert!(height < 1e-3, "{case}: {c:?} {place} {height}");
                }
                None => clear += 1,
            }
        }
        assert!(falls > 5000 && clear > 3000, "{falls} {clear}");
        assert!(100 * early < falls, "{early} of {falls}");
    }

    /// A quadratic as one of the sixth degree.
    fn elevated(c: [f64; 3]) -> [f64; 7] {
        let [a, b, d] = c;
        std::array::from_fn(|i| {
            let i = i as f64;
            let shares = [(6.0 - i) * (5.0 - i), 2.0 * i * (6.0 - i), i * (i - 1.0)];
            (shares[0] * a + shares[1] * b + shares[2] * d) / 30.0
        })
    }

    #[test]
    fn what_is_not_a_number_is_not_clear() {
        assert_eq!(first_fall([1.0, f64::NAN, 1.0], 0.0), Some(0.0));
        assert_eq!(first_fall([1.0, f64::INFINITY, -1.0], 0.0), Some(0.0));
        assert_eq!(first_fall([1.0, 2.0, 0.5], 0.0), None);
        assert_eq!(first_fall([0.0, 2.0, 0.5], 0.0), Some(0.0));
    }
}
