//! Paths.

use crate::curve::{Knots, Spline};
use crate::error::PathError;
use crate::math::domain;
use crate::tolerance::{MAX_COORDINATE, MIN_LENGTH};
use glam::DVec3;
use std::sync::Arc;

/// Where a body goes: a straight line or a spline.
///
/// A path is walked by distance: the arc length in metres from its start. Below 0
/// and beyond [`length`](Self::length) distances are clamped, so a body rests at its
/// path's end; NaN counts as 0. Both ends are met bit for bit.
///
/// Clones share the spline.
///
/// ```
/// use feeler::{Path, PathError};
///
/// let line = Path::line([0.0, 0.0, 0.0], [3.0, 4.0, 0.0])?;
/// assert_eq!(line.length(), 5.0);
/// assert_eq!(line.position_at(2.5), [1.5, 2.0, 0.0].into());
/// assert_eq!(line.position_at(99.0), line.end());
///
/// let nowhere = Path::line([1.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
/// assert!(matches!(nowhere, Err(PathError::PieceTooShort { .. })));
/// # Ok::<(), PathError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "crate::motion::data::PathData",
        into = "crate::motion::data::PathData"
    )
)]
pub struct Path {
    course: Course,
}

#[derive(Debug, Clone, PartialEq)]
enum Course {
    Line(Line),
    Spline(Arc<Spline>),
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Line {
    from: DVec3,
    to: DVec3,
    /// Unit vector.
    direction: DVec3,
    length: f64,
}

impl Line {
    fn position_at(&self, distance: f64) -> DVec3 {
        // From the nearer end, so that both ends are exact.
        if distance < 0.5 * self.length {
            self.from + distance.max(0.0) * self.direction
        } else if distance < self.length {
            self.to - (self.length - distance) * self.direction
        } else if distance.is_nan() {
            self.from
        } else {
            self.to
        }
    }
}

impl Path {
    /// The straight path between two points, in metres.
    ///
    /// # Errors
    /// If a coordinate is not finite or beyond [`MAX_COORDINATE`], or if the
    /// points are closer than [`MIN_LENGTH`].
    pub fn line(from: impl Into<DVec3>, to: impl Into<DVec3>) -> Result<Self, PathError> {
        let from = domain::vector("from", from.into(), MAX_COORDINATE)?;
        let to = domain::vector("to", to.into(), MAX_COORDINATE)?;
        let length = (to - from).length();
        if length < MIN_LENGTH {
            return Err(PathError::PieceTooShort {
                piece: 0,
                length,
                min: MIN_LENGTH,
            });
        }
        let direction = (to - from) / length;
        Ok(Self {
            course: Course::Line(Line {
                from,
                to,
                direction,
                length,
            }),
        })
    }

    /// The path through `points` with the given tangents at the first and the last
    /// and Catmull's between: see [`Spline::through`].
    ///
    /// # Errors
    /// As for [`Spline::through`].
    pub fn spline<P: Into<DVec3>>(
        points: impl IntoIterator<Item = P>,
        start_tangent: impl Into<DVec3>,
        end_tangent: impl Into<DVec3>,
    ) -> Result<Self, PathError> {
        Spline::through(points, start_tangent, end_tangent).map(Self::from)
    }

    /// The path through `points` with a tangent for each: see
    /// [`Spline::with_tangents`].
    ///
    /// # Errors
    /// As for [`Spline::with_tangents`].
    pub fn spline_with_tangents<P: Into<DVec3>, T: Into<DVec3>>(
        points: impl IntoIterator<Item = P>,
        tangents: impl IntoIterator<Item = T>,
    ) -> Result<Self, PathError> {
        Spline::with_tangents(points, tangents).map(Self::from)
    }

    /// The path through `points` alone: see [`Spline::catmull_rom`].
    ///
    /// # Errors
    /// As for [`Spline::catmull_rom`].
    pub fn catmull_rom<P: Into<DVec3>>(
        points: impl IntoIterator<Item = P>,
        knots: Knots,
    ) -> Result<Self, PathError> {
        Spline::catmull_rom(points, knots).map(Self::from)
    }

    /// The path along the cubic Bézier curves with the given control points: see
    /// [`Spline::bezier`].
    ///
    /// # Errors
    /// As for [`Spline::bezier`].
    pub fn bezier<P: Into<DVec3>>(
        control_points: impl IntoIterator<Item = P>,
    ) -> Result<Self, PathError> {
        Spline::bezier(control_points).map(Self::from)
    }

    /// The length of the whole path, in metres.
    #[must_use]
    pub fn length(&self) -> f64 {
        match &self.course {
            Course::Line(line) => line.length,
            Course::Spline(spline) => spline.length(),
        }
    }

    /// The point at `distance`, in metres.
    #[must_use]
    pub fn position_at(&self, distance: f64) -> DVec3 {
        match &self.course {
            Course::Line(line) => line.position_at(distance),
            Course::Spline(spline) => spline.position_at(distance),
        }
    }

    /// The unit tangent at `distance`; at a cusp see [`Spline::tangent_at`].
    #[must_use]
    pub fn tangent_at(&self, distance: f64) -> DVec3 {
        match &self.course {
            Course::Line(line) => line.direction,
            Course::Spline(spline) => spline.tangent_at(distance),
        }
    }

    /// Whether the path was built as a line. A spline may run straight too.
    #[must_use]
    pub fn is_straight(&self) -> bool {
        matches!(self.course, Course::Line(_))
    }

    /// The spline, if the path is one.
    #[must_use]
    pub fn as_spline(&self) -> Option<&Spline> {
        match &self.course {
            Course::Line(_) => None,
            Course::Spline(spline) => Some(spline),
        }
    }

    /// The path's first point, in metres.
    #[must_use]
    pub fn start(&self) -> DVec3 {
        self.position_at(0.0)
    }

    /// The path's last point, in metres.
    #[must_use]
    pub fn end(&self) -> DVec3 {
        self.position_at(self.length())
    }
}

impl From<Spline> for Path {
    fn from(spline: Spline) -> Self {
        Self {
            course: Course::Spline(Arc::new(spline)),
        }
    }
}
