//! How well a result agrees with what is expected: the thesis's measure.

/// Agreement of `found` with `expected`, in %.
///
/// The mean over the components of the smaller size by the larger; where one
/// of the two is 0, 1 is added to both sizes. The thesis describes the quotient
/// of result by expectation; its figures come out with the smaller by the larger.
///
/// It says nothing of opposite signs. Such a component agrees not at all here, so
/// that a mirrored result is no good result. (Around an expected 0 either sign is
/// as good.)
///
/// A measure with edges: expecting 0.5, a result of 0.01 counts as 2 %, one of 0 as 67 %.
pub(crate) fn agreement(found: [f64; 3], expected: [f64; 3]) -> f64 {
    let quotients = found.into_iter().zip(expected).map(|(x, y)| {
        if x * y < 0.0 {
            return 0.0;
        }
        let added = if x == 0.0 || y == 0.0 { 1.0 } else { 0.0 };
        let (x, y) = (x.abs() + added, y.abs() + added);
        x.min(y) / x.max(y)
    });
    100.0 * quotients.sum::<f64>() / 3.0
}
