//! Sums of products without rounding, for the few places where a sign must be right.

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
}
