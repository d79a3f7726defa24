//! Cubic Bézier curves.

use crate::curve::{hermite, quadratic, span};
use crate::error::PathError;
use crate::math::domain;
use crate::tolerance::MAX_COORDINATE;
use glam::DVec3;

/// Below this share of a curve's largest velocity component the direction of its velocity is
/// mostly rounding: 1e-12 leaves 3 to 4 digits of it.
const STANDSTILL: f64 = 1e-12;

/// A cubic Bézier curve, one piece of a [`Spline`](crate::Spline).
///
/// The parameter `u` runs from 0 to 1; beyond them it is clamped, and NaN counts
/// as 0. Both ends are met bit for bit. The curve is that of its control points
/// as rounded to `f64`.
///
/// Source: the thesis, eq. 2.18.
///
/// ```
/// use feeler::{CubicBezier, PathError};
///
/// let curve = CubicBezier::new([
///     [-2.0, 2.0, 0.0], [-2.0, -2.0, 0.0], [2.0, -2.0, 0.0], [2.0, 2.0, 0.0],
/// ])?;
/// assert_eq!(curve.point(0.5), [0.0, -1.0, 0.0].into());
/// assert!((curve.length_between(0.0, 1.0) - 8.0).abs() < 1e-12);
///
/// assert!(CubicBezier::new([[f64::NAN, 0.0, 0.0]; 4]).is_err());
/// # Ok::<(), PathError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CubicBezier {
    control_points: [DVec3; 4],
}

impl CubicBezier {
    /// The curve with the control points `B0 … B3`, in metres. They may coincide.
    ///
    /// # Errors
    /// If a coordinate is not finite or beyond [`MAX_COORDINATE`].
    pub fn new(control_points: [impl Into<DVec3>; 4]) -> Result<Self, PathError> {
        let control_points = control_points.map(Into::into);
        for point in control_points {
            domain::vector("control point", point, MAX_COORDINATE)?;
        }
        Ok(Self { control_points })
    }

    /// The curve from `from` to `to` with the given derivatives by `u` at its
    /// ends: `B0 = from`, `B1 = from + leaving/3`, `B2 = to − arriving/3`,
    /// `B3 = to`.
    ///
    /// Source: the thesis, eqs. 2.13–2.16.
    ///
    /// # Errors
    /// If a component is not finite or beyond [`MAX_COORDINATE`].
    pub fn from_hermite(
        from: impl Into<DVec3>,
        leaving: impl Into<DVec3>,
        to: impl Into<DVec3>,
        arriving: impl Into<DVec3>,
    ) -> Result<Self, PathError> {
        Ok(Self::from_hermite_unchecked(
            domain::vector("point", from.into(), MAX_COORDINATE)?,
            domain::vector("tangent", leaving.into(), MAX_COORDINATE)?,
            domain::vector("point", to.into(), MAX_COORDINATE)?,
            domain::vector("tangent", arriving.into(), MAX_COORDINATE)?,
        ))
    }

    /// [`from_hermite`](Self::from_hermite) behind the door.
    pub(crate) fn from_hermite_unchecked(
        from: DVec3,
        leaving: DVec3,
        to: DVec3,
        arriving: DVec3,
    ) -> Self {
        let control_points = hermite::control_points(from, leaving, to, arriving);
        debug_assert!(
            control_points.iter().all(|point| point.is_finite()),
            "control points are not finite: {control_points:?}"
        );
        Self { control_points }
    }

    /// The control points `B0 … B3`, in metres.
    #[must_use]
    pub fn control_points(&self) -> [DVec3; 4] {
        self.control_points
    }

    /// The point at `u`, in metres.
    ///
    /// Within a few rounding errors of the curve's size plus one of the
    /// coordinates.
    #[must_use]
    pub fn point(&self, u: f64) -> DVec3 {
        let u = clamped(u);
        let [b0, b1, b2, b3] = self.control_points;
        let rest = 1.0 - u;
        // Offsets from the nearer end: both ends come out exactly, and far from
        // the origin only the last sum rounds at the coordinates' size.
        if u < 0.5 {
            let offset = u * (3.0 * rest * (rest * (b1 - b0) + u * (b2 - b0)) + u * u * (b3 - b0));
            b0 + offset
        } else {
            let offset =
                rest * (3.0 * u * (u * (b2 - b3) + rest * (b1 - b3)) + rest * rest * (b0 - b3));
            b3 + offset
        }
    }

    /// The derivative by `u`, in metres.
    #[must_use]
    pub fn derivative(&self, u: f64) -> DVec3 {
        first_derivative(self.velocity(), clamped(u))
    }

    /// The second derivative by `u`, in metres.
    #[must_use]
    pub fn second_derivative(&self, u: f64) -> DVec3 {
        second_derivative(self.velocity(), clamped(u))
    }

    /// The unit tangent at `u`, or none if all four control points coincide.
    ///
    /// At a cusp, where the derivative vanishes, the tangent jumps; there it is
    /// the one leaving the cusp in the first half of the curve and the one
    /// arriving at it in the second half.
    #[must_use]
    pub fn tangent(&self, u: f64) -> Option<DVec3> {
        let u = clamped(u);
        let (velocity, _) = self.unit_velocity()?;
        let [v0, v1, v2] = velocity;
        let side = if u < 0.5 { 1.0 } else { -1.0 };
        // The first term of the derivative's Taylor series that does not vanish.
        [
            first_derivative(velocity, u),
            side * second_derivative(velocity, u),
            v0 - 2.0 * v1 + v2,
        ]
        .into_iter()
        .find(|vector| vector.length() > STANDSTILL)
        .and_then(DVec3::try_normalize)
    }

    /// Length of the curve between two parameters, in either order, in metres.
    ///
    /// Adaptive Gauss–Legendre quadrature, split where the curve is slowest, so
    /// that cusps and near-cusps cost no digits. The error is at most 1e-13 of
    /// the length of the whole control polygon.
    #[must_use]
    pub fn length_between(&self, u_from: f64, u_to: f64) -> f64 {
        let (u_from, u_to) = (clamped(u_from), clamped(u_to));
        let Some((velocity, size)) = self.unit_velocity() else {
            return 0.0;
        };
        let (low, high) = (u_from.min(u_to), u_from.max(u_to));
        let mut length = 0.0;
        span::subdivide(&velocity, low..high, |cut| length += cut.length);
        size * length
    }

    /// Least and greatest value of `axis · point` over the whole curve.
    ///
    /// For a unit `axis` these bound the curve along it, in metres: tighter than
    /// its control points, and not sampled. Found as the roots of a quadratic;
    /// either value is within 8 rounding errors of the largest of
    /// `|axis.x·x| + |axis.y·y| + |axis.z·z|` over the control points, so who
    /// must not lose a point of the curve grows the bounds by that much. An axis
    /// that is not finite bounds nothing.
    #[must_use]
    pub fn extent_along(&self, axis: DVec3) -> (f64, f64) {
        if !axis.is_finite() {
            return (f64::NEG_INFINITY, f64::INFINITY);
        }
        let [c0, c1, c2, c3] = self.control_points.map(|point| axis.dot(point));
        let (d0, d1, d2) = (c1 - c0, c2 - c1, c3 - c2);
        let turns = quadratic::roots(d0 - 2.0 * d1 + d2, d1 - d0, d0)
            .filter(|u| (0.0..=1.0).contains(u))
            .map(|u| {
                // de Casteljau: never leaves the control values by more than rounding.
                let mix = |a: f64, b: f64| (1.0 - u) * a + u * b;
                let (e0, e1, e2) = (mix(c0, c1), mix(c1, c2), mix(c2, c3));
                mix(mix(e0, e1), mix(e1, e2))
            });
        turns.fold((c0.min(c3), c0.max(c3)), |(min, max), value| {
            (min.min(value), max.max(value))
        })
    }

    /// Control points of the derivative, a quadratic Bézier curve.
    pub(crate) fn velocity(&self) -> [DVec3; 3] {
        let [b0, b1, b2, b3] = self.control_points;
        [3.0 * (b1 - b0), 3.0 * (b2 - b1), 3.0 * (b3 - b2)]
    }

    /// The unit tangent at `u`. Not finite in a cusp.
    pub(crate) fn leading(&self, u: f64) -> DVec3 {
        let velocity = first_derivative(self.velocity(), u);
        velocity / velocity.length()
    }

    /// How the curve goes on at `u`, by distance: its unit tangent and the derivative of that. Not
    /// finite in a cusp.
    pub(crate) fn heading(&self, u: f64) -> (DVec3, DVec3) {
        let velocity = self.velocity();
        let (first, second) = (
            first_derivative(velocity, u),
            second_derivative(velocity, u),
        );
        let square = first.length_squared();
        let bend = second - first.dot(second) / square * first;
        (first / square.sqrt(), bend / square)
    }

    /// [`velocity`](Self::velocity) over its largest component, and that: no
    /// square of it underflows, so curves of every size have lengths and tangents.
    /// None if all control points coincide.
    fn unit_velocity(&self) -> Option<([DVec3; 3], f64)> {
        let velocity = self.velocity();
        let largest = velocity
            .into_iter()
            .map(|vector| vector.abs().max_element())
            .fold(0.0, f64::max);
        // Below that, too little is left of the digits to divide by.
        (largest >= f64::MIN_POSITIVE).then(|| (velocity.map(|vector| vector / largest), largest))
    }
}

/// `u` within `0..=1`; NaN counts as 0.
fn clamped(u: f64) -> f64 {
    // `max` takes the other when one is NaN; `clamp` alone would let NaN through.
    u.max(0.0).clamp(0.0, 1.0)
}

/// The derivative at `u`, from its control points.
fn first_derivative([v0, v1, v2]: [DVec3; 3], u: f64) -> DVec3 {
    let rest = 1.0 - u;
    rest * rest * v0 + 2.0 * u * rest * v1 + u * u * v2
}

/// The second derivative at `u`, from the control points of the first.
fn second_derivative([v0, v1, v2]: [DVec3; 3], u: f64) -> DVec3 {
    2.0 * ((1.0 - u) * (v1 - v0) + u * (v2 - v1))
}
