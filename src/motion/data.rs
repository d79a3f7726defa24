//! Paths and motions as they are written.
//!
//! `{ fixed = [..] }`, `{ line = { from = [..], to = [..], speed = 1.0 } }` and so on, with
//! `spin = { axis = [..], rate = 1.0 }` beside it for a body that spins.
//! What is read goes through the constructors.

use crate::curve::{Spline, SplineData, SplineDataError};
use crate::error::{MotionError, PathError};
use crate::math::data::Vector;
use crate::motion::journey::Journey;
use crate::motion::kind::Kind;
use crate::motion::{AtEnd, Facing, Motion, Path, Turning};
use glam::DVec3;
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
    #[error("a motion is one of `fixed`, `line`, `spline` and `free`")]
    Course,
    #[error("a motion has `spin` or `facing`, not both")]
    Turning,
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

/// A line and how it is flown.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AlongLine {
    from: Vector,
    to: Vector,
    speed: f64,
    #[serde(default, skip_serializing_if = "is_default")]
    at_end: AtEnd,
    #[serde(default, skip_serializing_if = "is_default")]
    start_distance: f64,
    #[serde(default, skip_serializing_if = "is_default")]
    start_time: f64,
}

/// A spline and how it is flown. Fields spelled out: flattened ones would
/// let unknown fields pass.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AlongSpline {
    #[serde(skip_serializing_if = "Option::is_none")]
    points: Option<Vec<Vector>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    start_tangent: Option<Vector>,
    #[serde(skip_serializing_if = "Option::is_none")]
    end_tangent: Option<Vector>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tangents: Option<Vec<Vector>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    control_points: Option<Vec<Vector>>,
    speed: f64,
    #[serde(default, skip_serializing_if = "is_default")]
    at_end: AtEnd,
    #[serde(default, skip_serializing_if = "is_default")]
    start_distance: f64,
    #[serde(default, skip_serializing_if = "is_default")]
    start_time: f64,
}

fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FreeData {
    position: Vector,
    velocity: Vector,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SpinData {
    axis: Vector,
    rate: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    point: Option<Vector>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct FacingData {
    forward: Vector,
    up: Vector,
    world_up: Vector,
}

/// One course, and at most one way to turn.
#[derive(Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct MotionData {
    #[serde(skip_serializing_if = "Option::is_none")]
    fixed: Option<Vector>,
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<AlongLine>,
    #[serde(skip_serializing_if = "Option::is_none")]
    spline: Option<AlongSpline>,
    #[serde(skip_serializing_if = "Option::is_none")]
    free: Option<FreeData>,
    #[serde(skip_serializing_if = "Option::is_none")]
    spin: Option<SpinData>,
    #[serde(skip_serializing_if = "Option::is_none")]
    facing: Option<FacingData>,
}

impl TryFrom<MotionData> for Motion {
    type Error = MotionDataError;

    fn try_from(data: MotionData) -> Result<Self, MotionDataError> {
        let motion = match (data.fixed, data.line, data.spline, data.free) {
            (Some(position), None, None, None) => Self::fixed(position)?,
            (None, Some(along), None, None) => {
                Self::along(Path::line(along.from, along.to)?, along.speed)?
                    .starting_at(along.start_distance)?
                    .starting_after(along.start_time)?
                    .at_end(along.at_end)?
            }
            (None, None, Some(along), None) => {
                let spline = SplineData {
                    points: along.points,
                    start_tangent: along.start_tangent,
                    end_tangent: along.end_tangent,
                    tangents: along.tangents,
                    control_points: along.control_points,
                };
                Self::along(Spline::try_from(spline)?.into(), along.speed)?
                    .starting_at(along.start_distance)?
                    .starting_after(along.start_time)?
                    .at_end(along.at_end)?
            }
            (None, None, None, Some(FreeData { position, velocity })) => {
                Self::free(position, velocity)?
            }
            _ => return Err(MotionDataError::Course),
        };
        match (data.spin, data.facing) {
            (None, None) => Ok(motion),
            (Some(SpinData { axis, rate, point }), None) => {
                let point = point.map_or(DVec3::ZERO, DVec3::from);
                Ok(motion.spin_about(point, axis, rate)?)
            }
            (None, Some(facing)) => Ok(motion.facing(Facing {
                forward: facing.forward.into(),
                up: facing.up.into(),
                world_up: facing.world_up.into(),
            })?),
            (Some(_), Some(_)) => Err(MotionDataError::Turning),
        }
    }
}

impl From<Motion> for MotionData {
    fn from(motion: Motion) -> Self {
        let mut data = Self::default();
        match motion.kind() {
            Kind::Fixed { position } => data.fixed = Some((*position).into()),
            Kind::Free { position, velocity } => {
                data.free = Some(FreeData {
                    position: (*position).into(),
                    velocity: (*velocity).into(),
                });
            }
            Kind::Along(journey) => {
                let &Journey {
                    ref path,
                    speed,
                    at_end,
                    start_distance,
                    start_time,
                } = journey;
                match PathData::from(path) {
                    PathData::Line(LineData { from, to }) => {
                        data.line = Some(AlongLine {
                            from,
                            to,
                            speed,
                            at_end,
                            start_distance,
                            start_time,
                        });
                    }
                    PathData::Spline(spline) => {
                        data.spline = Some(AlongSpline {
                            points: spline.points,
                            start_tangent: spline.start_tangent,
                            end_tangent: spline.end_tangent,
                            tangents: spline.tangents,
                            control_points: spline.control_points,
                            speed,
                            at_end,
                            start_distance,
                            start_time,
                        });
                    }
                }
            }
        }
        match motion.turning() {
            Turning::Not => {}
            Turning::Spin(spin) => {
                data.spin = Some(SpinData {
                    axis: spin.axis().into(),
                    rate: spin.rate(),
                    point: (spin.point() != DVec3::ZERO).then(|| spin.point().into()),
                });
            }
            Turning::Facing(attitude) => {
                let facing = attitude.facing();
                data.facing = Some(FacingData {
                    forward: facing.forward.into(),
                    up: facing.up.into(),
                    world_up: facing.world_up.into(),
                });
            }
        }
        data
    }
}
