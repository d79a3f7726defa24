//! Real roots of a quadratic, without cancellation.

/// The real roots of `a·u² + 2·half_b·u + c`, in no order.
///
/// `a` or all three may vanish. A double root comes once or twice, and not at
/// all if rounding makes its discriminant negative: callers look for changes
/// of sign, and a double root is none.
pub(crate) fn roots(a: f64, half_b: f64, c: f64) -> impl Iterator<Item = f64> {
    let discriminant = half_b * half_b - a * c;
    // Adding numbers of like sign loses no digits; the other root follows from
    // the product of both, c / a.
    let sum = -(half_b + discriminant.max(0.0).sqrt().copysign(half_b));
    let found = if discriminant >= 0.0 {
        [sum / a, c / sum]
    } else {
        [f64::NAN; 2]
    };
    // 0/0 and x/0: no such root.
    found.into_iter().filter(|root| root.is_finite())
}
