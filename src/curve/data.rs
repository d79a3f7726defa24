//! Splines as they are written: points and tangents.

use crate::curve::spline::Form;
use crate::curve::{CubicBezier, Spline, hermite};
use crate::error::PathError;
use crate::math::data::Vector;
use glam::DVec3;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Points with either the tangents at both ends or one for every point; or control points.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SplineData {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) points: Option<Vec<Vector>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) start_tangent: Option<Vector>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) end_tangent: Option<Vector>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) tangents: Option<Vec<Vector>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) control_points: Option<Vec<Vector>>,
}

/// What is wrong with a spline as it was written.
#[derive(Debug, Error)]
pub(crate) enum SplineDataError {
    #[error(transparent)]
    Path(#[from] PathError),
    #[error("a spline needs either `tangents` or both `start_tangent` and `end_tangent`")]
    Tangents,
    #[error("a spline needs either `points` and tangents or `control_points` alone")]
    Points,
}

impl TryFrom<SplineData> for Spline {
    type Error = SplineDataError;

    fn try_from(data: SplineData) -> Result<Self, SplineDataError> {
        let points = match (data.points, data.control_points) {
            (Some(points), None) => points,
            (None, Some(control_points)) => {
                return match (data.start_tangent, data.end_tangent, data.tangents) {
                    (None, None, None) => Ok(Self::bezier(control_points)?),
                    _ => Err(SplineDataError::Points),
                };
            }
            _ => return Err(SplineDataError::Points),
        };
        match (data.start_tangent, data.end_tangent, data.tangents) {
            (Some(start), Some(end), None) => Ok(Self::through(points, start, end)?),
            (None, None, Some(tangents)) => Ok(Self::with_tangents(points, tangents)?),
            _ => Err(SplineDataError::Tangents),
        }
    }
}

impl From<&Spline> for SplineData {
    /// With the tangents at the ends alone where those between are Catmull's.
    fn from(spline: &Spline) -> Self {
        let points: Vec<DVec3> = spline.points().collect();
        let tangents = spline.tangents();
        let written = |vectors: &[DVec3]| vectors.iter().copied().map(Vector::from).collect();
        if spline.form() == Form::Bezier {
            let further = |piece: &CubicBezier| piece.control_points().into_iter().skip(1);
            let others = spline.pieces().iter().flat_map(further);
            let control_points = points.iter().copied().take(1).chain(others);
            return Self {
                points: None,
                start_tangent: None,
                end_tangent: None,
                tangents: None,
                control_points: Some(control_points.map(Vector::from).collect()),
            };
        }
        let ends = match tangents {
            [start, .., end] if hermite::catmull_tangents(&points, *start, *end) == tangents => {
                Some([*start, *end])
            }
            _ => None,
        };
        Self {
            points: Some(written(&points)),
            start_tangent: ends.map(|[start, _]| start.into()),
            end_tangent: ends.map(|[_, end]| end.into()),
            tangents: ends.is_none().then(|| written(tangents)),
            control_points: None,
        }
    }
}

impl From<Spline> for SplineData {
    fn from(spline: Spline) -> Self {
        Self::from(&spline)
    }
}
