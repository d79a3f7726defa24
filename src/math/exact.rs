//! Sums of products without rounding, for the few places where a sign or a direction must be
//! right.

use glam::DVec3;

/// `a² + b² + c² − r²`, rounded once: zero exactly if the sum is zero.
///
/// The products are split by Dekker's method (exact unless they underflow:
/// numbers above 1e-140 are safe) and their halves summed from the largest to
/// the smallest by two-sums, which is exact where the sum nearly cancels.
pub(crate) fn sum_of_squares_minus([a, b, c]: [f64; 3], r: f64) -> f64 {
    let squares = [square(r), square(a), square(b), square(c)];
    // An expansion grown term by term (Shewchuk 1997, GROW-EXPANSION): each
    // pass leaves its exact rounding error behind.
    let mut terms = [0.0_f64; 8];
    let mut used = 0;
    for (index, (high, low)) in squares.into_iter().enumerate() {
        let sign = if index == 0 { -1.0 } else { 1.0 };
        for part in [sign * low, sign * high] {
            let mut carry = part;
            for term in &mut terms[..used] {
                (carry, *term) = two_sum(carry, *term);
            }
            terms[used] = carry;
            used += 1;
        }
    }
    // Increasing in size and not overlapping: summing upwards rounds harmlessly.
    terms.iter().sum()
}

/// `(b − a) × (c − a)`, right to a few 1e-16 of its length however thin the triangle: it loses
/// the digits only that cancel in twice the usual precision.
///
/// For a fat triangle the plain product of two differences is as good.
pub(crate) fn doubled_area(a: DVec3, b: DVec3, c: DVec3) -> DVec3 {
    let difference = |a: DVec3, b: DVec3| [0, 1, 2].map(|axis| two_sum(a[axis], -b[axis]));
    let (u, v) = (difference(b, a), difference(c, a));
    let across = |i: usize, j: usize| {
        let (one, other) = (product(u[i], v[j]), product(u[j], v[i]));
        let (high, low) = two_sum(one.0, -other.0);
        high + (low + (one.1 - other.1))
    };
    DVec3::new(across(1, 2), across(2, 0), across(0, 1))
}

/// The product of two sums of two floats, likewise.
fn product(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    let high = a.0 * b.0;
    (high, a.0.mul_add(b.0, -high) + (a.0 * b.1 + a.1 * b.0))
}

/// `x²` as a sum of two floats (Dekker).
fn square(x: f64) -> (f64, f64) {
    let product = x * x;
    let shifted = 134_217_729.0 * x;
    let high = shifted - (shifted - x);
    let low = x - high;
    (
        product,
        ((high * high - product) + 2.0 * high * low) + low * low,
    )
}

/// `a + b` and its rounding error (Knuth).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let virtual_b = sum - a;
    (sum, (a - (sum - virtual_b)) + (b - virtual_b))
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "exact sums are what is tested")]
mod tests {
    use super::*;

    #[test]
    fn cancels_exactly() {
        // 2² + 3² + 6² = 7², and the neighbours of 6 fall on either side.
        for scale in [1.0, 0.1_f64.exp2(), 1e-9, 1e9] {
            let [a, b, c, r] = [2.0, 3.0, 6.0, 7.0].map(|x| {
                // Few enough bits that the products of small integers stay exact.
                x * f64::from_bits(f64::to_bits(scale) & !0xff)
            });
            assert_eq!(sum_of_squares_minus([a, b, c], r), 0.0);
            assert!(sum_of_squares_minus([a, b, c.next_up()], r) > 0.0);
            assert!(sum_of_squares_minus([a, b, c.next_down()], r) < 0.0);
            assert!(sum_of_squares_minus([a, b, c], r.next_up()) < 0.0);
        }
    }

    #[test]
    fn the_area_of_a_sliver_keeps_its_digits() {
        // Corners on one line but for the last bit of one coordinate.
        let a = DVec3::new(0.1, 0.2, 0.3);
        let (b, c) = (3.0 * a, DVec3::new(0.5, 1.0_f64.next_up(), 1.5));
        let area = doubled_area(a, b, c);
        let turned = doubled_area(b, c, a);
        assert!(area.length() > 0.0);
        assert!(
            area.distance(turned) <= 1e-15 * area.length(),
            "{area} {turned}"
        );
    }
}
