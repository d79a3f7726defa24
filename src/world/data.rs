//! Bodies and settings as they are written.

use crate::broad_phase::BroadPhase;
use crate::error::{BodyError, ConfigError};
use crate::geometry::Shape;
use crate::math::data::{Numbers, Vector};
use crate::math::domain;
use crate::motion::Motion;
use crate::tolerance::{MAX_LENGTH, MIN_LENGTH};
use crate::world::{Body, Groups, Method, WorldConfig};
use glam::{DQuat, DVec3};
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{self, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BodyData {
    shape: Shape,
    #[serde(default, skip_serializing_if = "Orientation::is_identity")]
    orientation: Orientation,
    motion: Motion,
    #[serde(default, skip_serializing_if = "Groups::are_all")]
    groups: Groups,
}

impl TryFrom<BodyData> for Body {
    type Error = BodyError;

    fn try_from(data: BodyData) -> Result<Self, BodyError> {
        let body = Self::moving(data.shape, data.motion)
            .oriented(data.orientation.0)
            .in_groups(data.groups);
        body.clone().checked()?;
        // As it was written: unlike in a world, the orientation keeps its drift.
        Ok(body)
    }
}

impl From<Body> for BodyData {
    fn from(body: Body) -> Self {
        Self {
            shape: body.shape,
            orientation: Orientation(body.orientation),
            motion: body.motion,
            groups: body.groups,
        }
    }
}

/// A quaternion `[x, y, z, w]`, or `{ axis = [..], degrees = 90 }`.
#[derive(Default)]
pub(crate) struct Orientation(pub(crate) DQuat);

impl Orientation {
    pub(crate) fn is_identity(&self) -> bool {
        self.0 == DQuat::IDENTITY
    }
}

impl Serialize for Orientation {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Numbers(self.0.to_array()).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Orientation {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(OrientationVisitor)
    }
}

struct OrientationVisitor;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct AxisAngle {
    axis: Vector,
    degrees: f64,
}

impl<'de> Visitor<'de> for OrientationVisitor {
    type Value = Orientation;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a quaternion [x, y, z, w] or { axis = [x, y, z], degrees = angle }")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Orientation, A::Error> {
        let Numbers(xyzw) = Numbers::<4>::deserialize(SeqAccessDeserializer::new(seq))?;
        Ok(Orientation(DQuat::from_array(xyzw)))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Orientation, A::Error> {
        let AxisAngle { axis, degrees } = AxisAngle::deserialize(MapAccessDeserializer::new(map))?;
        let axis = DVec3::from(axis);
        let check = |field, value, min| {
            domain::within(field, value, min, MAX_LENGTH).map_err(de::Error::custom)
        };
        let length = check("orientation.axis.length", axis.length(), MIN_LENGTH)?;
        let degrees = check("orientation.degrees", degrees, -MAX_LENGTH)?;
        // Not glam's, whose sine is the platform's.
        let (sine, cosine) = libm::sincos(0.5 * degrees.to_radians());
        let axis = sine * (axis / length);
        Ok(Orientation(DQuat::from_xyzw(
            axis.x, axis.y, axis.z, cosine,
        )))
    }
}

#[derive(Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[derive(Default)]
pub(super) struct WorldConfigData {
    method: Method,
    broad_phase: BroadPhase,
}

impl TryFrom<WorldConfigData> for WorldConfig {
    type Error = ConfigError;

    fn try_from(data: WorldConfigData) -> Result<Self, ConfigError> {
        Self {
            method: data.method,
            broad_phase: data.broad_phase,
        }
        .checked()
    }
}

impl From<WorldConfig> for WorldConfigData {
    fn from(config: WorldConfig) -> Self {
        Self {
            method: config.method,
            broad_phase: config.broad_phase,
        }
    }
}
