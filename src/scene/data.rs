//! Scenes as they are written.

use super::{NamedBody, Scene};
use crate::error::SceneError;
use crate::geometry::Shape;
use crate::motion::Motion;
use crate::world::{Body, Groups, Orientation, WorldConfig};
use serde::{Deserialize, Serialize};

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SceneData {
    name: String,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    about: String,
    #[serde(default = "default_frame_rate")]
    frame_rate: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    duration: Option<f64>,
    #[serde(default, skip_serializing_if = "is_default")]
    config: WorldConfig,
    #[serde(default)]
    bodies: Vec<NamedBody>,
}

fn default_frame_rate() -> f64 {
    Scene::FRAME_RATE
}

fn is_default(config: &WorldConfig) -> bool {
    *config == WorldConfig::default()
}

impl TryFrom<SceneData> for Scene {
    type Error = SceneError;

    fn try_from(data: SceneData) -> Result<Self, SceneError> {
        let scene = Self {
            name: data.name,
            about: data.about,
            config: data.config,
            frame_rate: data.frame_rate,
            duration: data.duration,
            bodies: data.bodies,
        };
        scene.check()?;
        Ok(scene)
    }
}

impl From<Scene> for SceneData {
    fn from(scene: Scene) -> Self {
        Self {
            name: scene.name,
            about: scene.about,
            frame_rate: scene.frame_rate,
            duration: scene.duration,
            config: scene.config,
            bodies: scene.bodies,
        }
    }
}

/// A body's fields spelled out: flattened ones would let unknown fields pass.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct NamedBodyData {
    name: String,
    shape: Shape,
    #[serde(default, skip_serializing_if = "Orientation::is_identity")]
    orientation: Orientation,
    motion: Motion,
    #[serde(default, skip_serializing_if = "Groups::are_all")]
    groups: Groups,
}

impl TryFrom<NamedBodyData> for NamedBody {
    type Error = SceneError;

    fn try_from(data: NamedBodyData) -> Result<Self, SceneError> {
        let NamedBodyData { name, .. } = data;
        let body = Body::moving(data.shape, data.motion)
            .oriented(data.orientation.0)
            .in_groups(data.groups);
        match body.clone().checked() {
            Ok(_) => Ok(Self { name, body }),
            Err(source) => Err(SceneError::Body { name, source }),
        }
    }
}

impl From<NamedBody> for NamedBodyData {
    fn from(NamedBody { name, body }: NamedBody) -> Self {
        Self {
            name,
            orientation: Orientation(body.orientation()),
            groups: body.groups(),
            shape: body.shape,
            motion: body.motion,
        }
    }
}
