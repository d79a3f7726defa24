//! The inverse of arc length on one span, as a polynomial.

/// Coefficients of a fit.
pub(super) const COUNT: usize = 20;

/// As many of them, the lower ones, are kept in double precision.
///
/// Those above are small: what rounding takes from one of them the lower ones make good but for a share of
/// `2⁻ᵏ`.
pub(super) const LOW: usize = 6;

/// Share of a span before its end within which rounding may put a distance on either side of it.
///
/// Spans shorter than some 1e-12 of a path, of which it may be more, have no polynomial.
const SEAM: f64 = 1e-3;

/// The parameter of a curve for a distance on one span: exact to rounding, without a root or an
/// integral.
///
/// `u = u_start + y·q(2y − 1)` with the share `y` of the span's length, so that the
/// span's start comes out bit for bit. Two cache lines, which processors fetch together.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(128))]
pub(super) struct Fit {
    /// Distance from the path's start to the span's.
    pub(super) start: f64,
    /// Parameter of the curve at the span's start.
    pub(super) u_start: f64,
    /// The share that a metre is, or a little less: infinite if there is no good polynomial.
    pub(super) per_metre: f32,
    /// The span's curve.
    pub(super) piece: u32,
    pub(super) low: [f64; LOW],
    pub(super) high: [f32; COUNT - LOW],
}

impl Fit {
    /// Of a span whose inverse is no polynomial.
    pub(super) fn none(u_start: f64) -> Self {
        Self {
            start: 0.0,
            u_start,
            per_metre: f32::INFINITY,
            piece: 0,
            low: [0.0; LOW],
            high: [0.0; COUNT - LOW],
        }
    }

    /// The parameter at `distance` from the path's start, if that lies on the span for certain, and what the
    /// polynomial says there is right.
    #[inline]
    pub(super) fn sure_u_at(&self, distance: f64) -> Option<f64> {
        let share = self.share(distance);
        // Where the next span begins may be an ulp before or after what this one's length says. False for NaN, too,
        // and without a polynomial.
        (0.0..1.0 - SEAM)
            .contains(&share)
            .then(|| self.u_at_share(share))
    }

    /// The parameter at `distance` from the path's start, which lies on the span; none where there is no
    /// polynomial.
    #[inline]
    pub(super) fn u_at(&self, distance: f64) -> Option<f64> {
        let share = self.share(distance).clamp(0.0, 1.0);
        self.per_metre
            .is_finite()
            .then(|| self.u_at_share(share).min(1.0))
    }

    #[inline]
    fn share(&self, distance: f64) -> f64 {
        (distance - self.start) * f64::from(self.per_metre)
    }

    #[inline]
    fn u_at_share(&self, share: f64) -> f64 {
        self.u_start + share * self.mean(2.0 * share - 1.0)
    }

    /// `Σ cₖ·tᵏ`, by fours: a third of the latency of Horner's scheme.
    #[inline]
    pub(super) fn mean(&self, t: f64) -> f64 {
        let c = |i: usize| match i.checked_sub(LOW) {
            Some(i) => f64::from(self.high[i]),
            None => self.low[i],
        };
        let t2 = t * t;
        let t4 = t2 * t2;
        let t8 = t4 * t4;
        let four = |i: usize| (c(i) + t * c(i + 1)) + t2 * (c(i + 2) + t * c(i + 3));
        let low = four(0) + t4 * four(4);
        let high = (four(8) + t4 * four(12)) + t8 * four(16);
        low + t8 * high
    }
}
