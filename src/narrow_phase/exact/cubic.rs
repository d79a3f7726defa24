//! Where a cubic comes down to zero.

/// The least root in `0..=1` of the cubic with these Bernstein coefficients, the first of which is
/// positive, or a place before it where the cubic is within `close` of zero; none if it stays above zero.
///
/// Between the places where it turns it is monotone, and there Newton's iteration in a bracket finds it.
pub(super) fn first_root([c0, c1, c2, c3]: [f64; 4], close: f64) -> Option<f64> {
    // No less than the least of them.
    if c1 > 0.0 && c2 > 0.0 && c3 > 0.0 {
        return None;
    }
    // Powers: what is small at the start stays exact there.
    let linear = 3.0 * (c1 - c0);
    let square = 3.0 * ((c2 - c1) - (c1 - c0));
    let cube = (c3 - c0) - 3.0 * (c2 - c1);
    let cubic = Cubic([c0, linear, square, cube]);
    let discriminant = square * square - 3.0 * cube * linear;
    let mut low = 0.0;
    if discriminant >= 0.0 {
        let sum = -(square + discriminant.sqrt().copysign(square));
        let (one, other) = (sum / (3.0 * cube), linear / sum);
        for turn in [one.min(other), one.max(other)] {
            // NaN and infinity are no turns.
            if turn > low && turn < 1.0 {
                if cubic.at(turn).0 <= 0.0 {
                    return Some(cubic.falling_root(low, turn, close));
                }
                low = turn;
            }
        }
    }
    (cubic.at(1.0).0 <= 0.0).then(|| cubic.falling_root(low, 1.0, close))
}

/// By its coefficients, from the constant up.
struct Cubic([f64; 4]);

impl Cubic {
    /// Value and slope.
    #[inline]
    fn at(&self, x: f64) -> (f64, f64) {
        let [constant, linear, square, cube] = self.0;
        (
            constant + x * (linear + x * (square + x * cube)),
            linear + x * (2.0 * square + x * (3.0 * cube)),
        )
    }

    /// The root between `low`, where the cubic is positive, and `high`, where it is not, and between
    /// which it falls; its side towards `low`.
    fn falling_root(&self, mut low: f64, mut high: f64, close: f64) -> f64 {
        /// Newton's iteration takes some six; the rest are for bisection down to neighbours.
        const STEPS: u32 = 64;
        // One step from the start, if that leads anywhere.
        let mut x = low;
        for _ in 0..STEPS {
            let (height, slope) = self.at(x);
            if height > 0.0 {
                low = x;
                if height <= close {
                    break;
                }
            } else {
                high = x;
            }
            // A little short of the root, so that one side is as near as the other.
            let next = x - (height - 0.5 * close) / slope;
            // NaN as well.
            x = if next > low && next < high {
                next
            } else {
                0.5 * (low + high)
            };
            if x <= low || x >= high {
                break;
            }
        }
        low
    }
}

#[cfg(test)]
mod tests {
    use super::first_root;

    /// The cubic with these roots and leading coefficient, in Bernstein form.
    fn with_roots([a, b, c]: [f64; 3], lead: f64) -> [f64; 4] {
        // The blossom of (x − a)(x − b)(x − c).
        let blossom = |x: f64, y: f64, z: f64| {
            let (s1, s2) = ((x + y + z) / 3.0, (x * y + y * z + x * z) / 3.0);
            lead * (x * y * z - (a + b + c) * s2 + (a * b + b * c + a * c) * s1 - a * b * c)
        };
        [
            blossom(0.0, 0.0, 0.0),
            blossom(0.0, 0.0, 1.0),
            blossom(0.0, 1.0, 1.0),
            blossom(1.0, 1.0, 1.0),
        ]
    }

    #[test]
    fn least_roots_are_found() {
        let shares = [0.01, 0.2, 0.45, 0.7, 0.99, 1.3, 2.0];
        for (i, &first) in shares.iter().enumerate() {
            for (j, &second) in shares.iter().enumerate().skip(i + 1) {
                for &third in shares.iter().skip(j + 1) {
                    let found = first_root(with_roots([first, second, third], -1.0), 1e-16);
                    let want = (first <= 1.0).then_some(first);
                    assert_eq!(found.is_some(), want.is_some(), "{first} {second} {third}");
                    let off = found.unwrap_or(0.0) - want.unwrap_or(0.0);
                    assert!(off.abs() < 1e-12, "{first} {second} {third}: {off}");
                }
            }
        }
    }

    #[test]
    fn lines_parabolas_and_what_never_comes_down() {
        assert_eq!(first_root([1.0; 4], 1e-16), None);
        assert_eq!(first_root([1.0, 2.0, 0.5, 3.0], 1e-16), None);
        let line = first_root([3.0, 2.0, 1.0, 0.0], 1e-16);
        assert!(line.is_some_and(|x| (x - 1.0).abs() < 1e-15), "{line:?}");
        let line = first_root([1.0, 0.0, -1.0, -2.0], 1e-16);
        assert!(
            line.is_some_and(|x| (x - 1.0 / 3.0).abs() < 1e-15),
            "{line:?}"
        );
        // Dips below its control points' least only by them.
        assert_eq!(first_root([1.0, -0.1, -0.1, 1.0], 1e-16), None);
        assert!(first_root([1.0, -0.5, -0.5, 1.0], 1e-16).is_some());
        assert_eq!(first_root([f64::NAN; 4], 1e-16), None);
    }
}
