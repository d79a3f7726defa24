//! Paths and motions as they are written.
//!
//! `{ fixed = [..] }`, `{ line = { from = [..], to = [..], speed = 1.0 } }` and so on.
//! What is read goes through the constructors.

use crate::curve::{Spline, SplineData, SplineDataError};
use crate::error::{MotionError, PathError};
use crate::math::data::Vector;
use crate::motion::kind::Kind;
use crate::motion::{Motion, Path};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// What is wrong with a motion as it was written.
#[derive(Debug, Error)]
pub(super) enum MotionDataError {
    #[error(transparent)]
    Motion(#[from] MotionError),
    #[error(transparent)]
    Path(#[from] PathError),
    #[error(transparent)]
    Spline(#[from] SplineDataError),
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LineData {
    from: Vector,
    to: Vector,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum PathData {
    Line(LineData),
    Spline(SplineData),
}

impl TryFrom<PathData> for Path {
    type Error = MotionDataError;

    fn try_from(data: PathData) -> Result<Self, MotionDataError> {
        match data {
            PathData::Line(line) => Ok(Self::line(line.from, line.to)?),
            PathData::Spline(spline) => Ok(Spline::try_from(spline)?.into()),
        }
    }
}

impl From<&Path> for PathData {
    fn from(path: &Path) -> Self {
        match path.as_spline() {
            Some(spline) => Self::Spline(spline.into()),
            None => Self::Line(LineData {
                from: path.start().into(),
                to: path.end().into(),
            }),
        }
    }
}

impl From<Path> for PathData {
    fn from(path: Path) -> Self {
        Self::from(&path)
    }
}

/// A line and the speed along it.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AlongLine {
    from: Vector,
    to: Vector,
    speed: f64,
}

/// A spline and the speed along it. Fields spelled out: flattened ones would
/// let unknown fields pass.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AlongSpline {
    points: Vec<Vector>,
    #[serde(skip_serializing_if = "Option::is_none")]
    start_tangent: Option<Vector>,
    #[serde(skip_serializing_if = "Option::is_none")]
    end_tangent: Option<Vector>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tangents: Option<Vec<Vector>>,
    speed: f64,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FreeData {
    position: Vector,
    velocity: Vector,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum MotionData {
    Fixed(Vector),
    Line(AlongLine),
    Spline(AlongSpline),
    Free(FreeData),
}

impl TryFrom<MotionData> for Motion {
    type Error = MotionDataError;

    fn try_from(data: MotionData) -> Result<Self, MotionDataError> {
        Ok(match data {
            MotionData::Fixed(position) => Self::fixed(position)?,
            MotionData::Line(AlongLine { from, to, speed }) => {
                Self::along(Path::line(from, to)?, speed)?
            }
            MotionData::Spline(along) => {
                let spline = SplineData {
                    points: along.points,
                    start_tangent: along.start_tangent,
                    end_tangent: along.end_tangent,
                    tangents: along.tangents,
                };
                Self::along(Spline::try_from(spline)?.into(), along.speed)?
            }
            MotionData::Free(FreeData { position, velocity }) => Self::free(position, velocity)?,
        })
    }
}

impl From<Motion> for MotionData {
    fn from(motion: Motion) -> Self {
        match motion.kind() {
            Kind::Fixed { position } => Self::Fixed((*position).into()),
            Kind::Free { position, velocity } => Self::Free(FreeData {
                position: (*position).into(),
                velocity: (*velocity).into(),
            }),
            Kind::Along { path, speed } => match PathData::from(path) {
                PathData::Line(LineData { from, to }) => Self::Line(AlongLine {
                    from,
                    to,
                    speed: *speed,
                }),
                PathData::Spline(spline) => Self::Spline(AlongSpline {
                    points: spline.points,
                    start_tangent: spline.start_tangent,
                    end_tangent: spline.end_tangent,
                    tangents: spline.tangents,
                    speed: *speed,
                }),
            },
        }
    }
}
