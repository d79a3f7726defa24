//! Splines.

use crate::curve::arc_length::{ArcLength, Near};
use crate::curve::{CubicBezier, catmull_rom, hermite};
use crate::error::PathError;
use crate::math::domain;
use crate::tolerance::{MAX_COORDINATE, MIN_LENGTH};
use glam::DVec3;

/// A curve through given points, walked by the distance flown along it.
///
/// Between two successive points lies a piece, a [`CubicBezier`]; in the points
/// the pieces share their tangent, unless [given](Self::bezier) otherwise. Distances are arc lengths in metres from the
/// first point; below 0 and beyond [`length`](Self::length) they are clamped, and NaN
/// counts as 0. The given points are met bit for bit.
///
/// A body that flies `speed · time` keeps its speed everywhere: through slow and
/// fast pieces alike, and through a cusp, where the derivative by the
/// parameter vanishes. Places are exact to 1e-13 of the path's length plus
/// rounding in the coordinates, rather than interpolated as the thesis does it
/// ([`ArcLengthTable`](crate::ArcLengthTable)).
///
/// A look-up evaluates one polynomial, checked when the spline was built, and its steps do not
/// grow with the number of pieces: 40 to 60 ns for up to a thousand of them, 60 to 100 ns among ten thousand
/// (`benches/arc_length.rs`); but places that no cache holds any more wait for memory. Building costs some 20 to 35 µs a piece,
/// up to four times as much beside standstills, and a piece takes 1 to 2 kB.
///
/// Source: the thesis, section 2.2.8.
///
/// ```
/// use feeler::{PathError, Spline};
///
/// let corner = [1.0, 1.0, 0.0];
/// let spline = Spline::through(
///     [[0.0, 0.0, 0.0], corner, [2.0, 0.0, 0.0]],
///     [0.0, 2.0, 0.0],
///     [0.0, -2.0, 0.0],
/// )?;
/// let half = 0.5 * spline.length();
/// assert!((spline.position_at(half) - glam::DVec3::from(corner)).length() < 1e-12);
/// assert!((spline.tangent_at(half) - glam::DVec3::X).length() < 1e-12);
///
/// // Two points that coincide make a piece of no length.
/// let twice = Spline::through([corner, corner], [0.0; 3], [0.0; 3]);
/// assert!(matches!(twice, Err(PathError::PieceTooShort { piece: 0, .. })));
/// # Ok::<(), PathError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "crate::curve::data::SplineData",
        into = "crate::curve::data::SplineData"
    )
)]
pub struct Spline {
    pieces: Vec<CubicBezier>,
    /// One for every point, as given or Catmull's; the pieces hold them only rounded.
    tangents: Vec<DVec3>,
    form: Form,
    arc_length: ArcLength,
}

/// What a spline was made from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Form {
    /// Points and tangents.
    Hermite,
    /// Control points.
    Bezier,
}

/// How the parameter runs between the points of a Catmull–Rom spline.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Knots {
    /// The same between any two points. Where near points follow on far ones
    /// the curve overshoots, and may cross itself.
    Uniform,
    /// As the root of their distance: the curve stays close to its points and has
    /// neither cusps nor loops between two of them.
    ///
    /// Yuksel, Schaefer and Keyser, *Parameterization and applications of
    /// Catmull–Rom curves* (2011).
    #[default]
    Centripetal,
}

impl Spline {
    /// The spline through `points`, in metres, with the given tangents at the
    /// first and the last.
    ///
    /// Inside, the tangent at a point is Catmull's: from the point before to the
    /// point after. Tangents are derivatives by the parameter: the longer, the
    /// straighter the curve leaves the point. They may be zero.
    ///
    /// # Errors
    /// If there are fewer than two points, if a component is not finite or
    /// beyond [`MAX_COORDINATE`], or if a piece is shorter than [`MIN_LENGTH`].
    pub fn through<P: Into<DVec3>>(
        points: impl IntoIterator<Item = P>,
        start_tangent: impl Into<DVec3>,
        end_tangent: impl Into<DVec3>,
    ) -> Result<Self, PathError> {
        let points = checked_points(points)?;
        let start = domain::vector("start tangent", start_tangent.into(), MAX_COORDINATE)?;
        let end = domain::vector("end tangent", end_tangent.into(), MAX_COORDINATE)?;
        let tangents = hermite::catmull_tangents(&points, start, end);
        Self::from_checked(&points, tangents)
    }

    /// The spline through `points`, in metres, with a tangent for each.
    ///
    /// Tangents are derivatives by the parameter and may be zero.
    ///
    /// # Errors
    /// As for [`through`](Self::through), and if there is not one tangent for
    /// every point.
    pub fn with_tangents<P: Into<DVec3>, T: Into<DVec3>>(
        points: impl IntoIterator<Item = P>,
        tangents: impl IntoIterator<Item = T>,
    ) -> Result<Self, PathError> {
        let points = checked_points(points)?;
        let tangents = checked("tangent", tangents)?;
        if tangents.len() != points.len() {
            return Err(PathError::TangentCount {
                points: points.len(),
                tangents: tangents.len(),
            });
        }
        Self::from_checked(&points, tangents)
    }

    /// The Catmull–Rom spline through `points`, in metres.
    ///
    /// The tangent in a point follows from the point, the one before and the one after.
    /// Before the first point and after the last each lies one more, as far on as
    /// its neighbour is back; but if the last point is the first one again the
    /// spline closes smoothly, and a body may loop on it.
    ///
    /// Source: Catmull and Rom, *A class of local interpolating splines* (1974);
    /// tangents for any knots after Barry and Goldman (1988).
    ///
    /// ```
    /// use feeler::Knots;
    /// use feeler::{Motion, Spline};
    ///
    /// let ring = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [1.0, 0.0, 0.0]];
    /// let ring = Spline::catmull_rom(ring, Knots::Centripetal)?;
    /// assert!((ring.tangent_at(0.0) - ring.tangent_at(ring.length())).length() < 1e-15);
    /// assert!(Motion::along(ring.into(), 1.0)?.looping().is_ok());
    ///
    /// assert!(Spline::catmull_rom([[0.0; 3]], Knots::Uniform).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If there are fewer than two points, if a component is not finite or
    /// beyond [`MAX_COORDINATE`], or if a piece is shorter than [`MIN_LENGTH`].
    pub fn catmull_rom<P: Into<DVec3>>(
        points: impl IntoIterator<Item = P>,
        knots: Knots,
    ) -> Result<Self, PathError> {
        let points = checked_points(points)?;
        Self::from_control_points(&catmull_rom::control_points(&points, knots))
    }

    /// The spline of the cubic Bézier curves with the given control points, in metres:
    /// `B0 B1 B2 B3` of the first, then `B1 B2 B3` of each further one, which
    /// begins where the one before ends.
    ///
    /// So there are no gaps; but a control point, the joint after it and the
    /// next control point need not lie on one line, and then the spline has a corner
    /// there: a body turns at once, at full speed.
    ///
    /// ```
    /// use feeler::{PathError, Spline};
    ///
    /// let eight = [[-2.0, 2.0, 0.0], [-2.0, -2.0, 0.0], [2.0, -2.0, 0.0], [2.0, 2.0, 0.0]];
    /// assert!((Spline::bezier(eight)?.length() - 8.0).abs() < 1e-14);
    ///
    /// let error = Spline::bezier([[0.0; 3]; 5]);
    /// assert_eq!(error, Err(PathError::ControlPointCount { count: 5 }));
    /// # Ok::<(), PathError>(())
    /// ```
    ///
    /// # Errors
    /// If there are not 4, 7, 10 … control points, if a component is not finite or
    /// beyond [`MAX_COORDINATE`], or if a piece is shorter than [`MIN_LENGTH`].
    pub fn bezier<P: Into<DVec3>>(
        control_points: impl IntoIterator<Item = P>,
    ) -> Result<Self, PathError> {
        Self::from_control_points(&checked("control point", control_points)?)
    }

    fn from_control_points(points: &[DVec3]) -> Result<Self, PathError> {
        let count = points.len();
        if count < 4 || count % 3 != 1 {
            return Err(PathError::ControlPointCount { count });
        }
        let pieces = (0..count / 3)
            .map(|piece| CubicBezier::new([0, 1, 2, 3].map(|i| points[3 * piece + i])))
            .collect::<Result<Vec<_>, _>>()?;
        let leaving = pieces.iter().map(|piece| piece.derivative(0.0));
        let arriving = pieces.last().map(|piece| piece.derivative(1.0));
        let tangents = leaving.chain(arriving).collect();
        Self::of_pieces(pieces, tangents, Form::Bezier)
    }

    fn from_checked(points: &[DVec3], tangents: Vec<DVec3>) -> Result<Self, PathError> {
        let pieces: Vec<_> = points
            .windows(2)
            .zip(tangents.windows(2))
            .map(|(p, t)| CubicBezier::from_hermite_unchecked(p[0], t[0], p[1], t[1]))
            .collect();
        Self::of_pieces(pieces, tangents, Form::Hermite)
    }

    fn of_pieces(
        pieces: Vec<CubicBezier>,
        tangents: Vec<DVec3>,
        form: Form,
    ) -> Result<Self, PathError> {
        match ArcLength::measure(&pieces, MIN_LENGTH) {
            Ok(arc_length) => Ok(Self {
                pieces,
                tangents,
                form,
                arc_length,
            }),
            Err((piece, length)) => Err(PathError::PieceTooShort {
                piece,
                length,
                min: MIN_LENGTH,
            }),
        }
    }

    /// The pieces, one less than points.
    #[must_use]
    pub fn pieces(&self) -> &[CubicBezier] {
        &self.pieces
    }

    /// The points it leads through, in metres.
    pub fn points(&self) -> impl Iterator<Item = DVec3> + '_ {
        let first = self.pieces.first().map(|piece| piece.control_points()[0]);
        let others = self.pieces.iter().map(|piece| piece.control_points()[3]);
        first.into_iter().chain(others)
    }

    /// The tangents in its points, as they were given or chosen: where a spline of
    /// Bézier curves has a corner or changes its pace the leaving one, at its end the
    /// arriving one.
    #[must_use]
    pub fn tangents(&self) -> &[DVec3] {
        &self.tangents
    }

    #[cfg(feature = "serde")]
    pub(crate) fn form(&self) -> Form {
        self.form
    }

    /// The length of the whole spline, in metres.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.arc_length.length()
    }

    /// Index of the piece and parameter `u` on it at `distance`.
    ///
    /// Where two pieces meet this is the start of the later one.
    #[must_use]
    pub fn locate(&self, distance: f64) -> (usize, f64) {
        self.arc_length.locate(&self.pieces, distance)
    }

    /// The same, to the bit, for who knows [where](Near) another look-up has ended.
    #[inline]
    pub(crate) fn locate_near(&self, distance: f64, near: Near) -> ((usize, f64), Near) {
        self.arc_length.locate_near(&self.pieces, distance, near)
    }

    /// The piece at `distance`, which begins there where two meet, and some place on it.
    #[inline]
    pub(crate) fn piece_near(&self, distance: f64, near: Near) -> (usize, Near) {
        self.arc_length.piece_near(distance, near)
    }

    /// The parameter at a distance that lies on a piece: see [`ArcLength::seek`].
    #[inline]
    pub(crate) fn seek(&self, piece: usize, distance: f64, near: Near) -> (f64, Near) {
        self.arc_length.seek(&self.pieces, piece, distance, near)
    }

    /// The distance at parameter `u` of `piece`: the inverse of
    /// [`locate`](Self::locate). A piece beyond the last counts as the spline's end.
    #[must_use]
    pub fn distance_at(&self, piece: usize, u: f64) -> f64 {
        self.arc_length.distance_at(&self.pieces, piece, u)
    }

    /// How far a piece may be followed smoothly: see [`ArcLength::smooth_way`].
    #[inline]
    pub(crate) fn smooth_way(
        &self,
        piece: usize,
        from: (Near, f64),
        forward: bool,
        root: f64,
    ) -> (f64, f64) {
        self.arc_length.smooth_way(piece, from, forward, root)
    }

    /// The distance at which a piece begins.
    pub(crate) fn joint(&self, piece: usize) -> f64 {
        self.arc_length.joint(piece)
    }

    /// The point at `distance`, in metres.
    #[must_use]
    pub fn position_at(&self, distance: f64) -> DVec3 {
        let (piece, u) = self.locate(distance);
        self.pieces[piece].point(u)
    }

    /// The same, to the bit, for who knows [where](Near) another look-up has ended.
    pub(crate) fn position_near(&self, distance: f64, near: Near) -> DVec3 {
        let ((piece, u), _) = self.locate_near(distance, near);
        self.pieces[piece].point(u)
    }

    /// The unit tangent at `distance`: velocity over speed of a body there.
    ///
    /// At a cusp it jumps; there it is one of the two one-sided tangents, as
    /// [`CubicBezier::tangent`] chooses it, in a joint the leaving one, at
    /// the spline's end the arriving one.
    #[must_use]
    pub fn tangent_at(&self, distance: f64) -> DVec3 {
        let (piece, u) = self.locate(distance);
        let tangent = self.pieces[piece].tangent(u);
        debug_assert!(
            tangent.is_some(),
            "piece {piece} has a length but no tangent"
        );
        tangent.unwrap_or(DVec3::X)
    }
}

fn checked_points<P: Into<DVec3>>(
    points: impl IntoIterator<Item = P>,
) -> Result<Vec<DVec3>, PathError> {
    let points = checked("point", points)?;
    if points.len() < 2 {
        return Err(PathError::TooFewPoints {
            count: points.len(),
            min: 2,
        });
    }
    Ok(points)
}

fn checked<V: Into<DVec3>>(
    field: &'static str,
    vectors: impl IntoIterator<Item = V>,
) -> Result<Vec<DVec3>, PathError> {
    vectors
        .into_iter()
        .map(|vector| Ok(domain::vector(field, vector.into(), MAX_COORDINATE)?))
        .collect()
}
