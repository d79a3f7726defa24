//! Scenes: bodies, settings and a frame rate, to be read, edited and written.
//!
//! The library knows no file format; any that serde serves will do. In TOML a
//! scene reads as follows.
//!
//! ```
//! use feeler::Scene;
//!
//! let scene: Scene = toml::from_str(r#"
//!     name = "Two balls"
//!     about = "One flies past the other, a little too close."
//!
//!     [[bodies]]
//!     name = "target"
//!     shape = { sphere = { radius = 1 } }
//!     motion = { fixed = [0, 0, 0] }
//!
//!     [[bodies]]
//!     name = "ball"
//!     shape = { sphere = { radius = 1 } }
//!     motion = { line = { from = [3, 0, 1], to = [0, 0, 1], speed = 1 } }
//! "#)?;
//! let (mut world, bodies) = scene.world()?;
//! let contact = world.step(3.0)?[0];
//! assert_eq!((contact.a, contact.b), (bodies[1], bodies[0]));
//!
//! // What is read is checked as constructors check it.
//! let bad = toml::from_str::<Scene>(r#"
//!     name = "No ball"
//!     [[bodies]]
//!     name = "ball"
//!     shape = { sphere = { radius = -1 } }
//!     motion = { fixed = [0, 0, 0] }
//! "#);
//! assert!(bad.is_err_and(|error| error.message().starts_with("radius is -1e0, below")));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | key | what | if left out |
//! |---|---|---|
//! | `name`, `about` | for people | `about` is empty |
//! | `frame_rate` | frames per second | 24 |
//! | `duration` | seconds | open |
//! | `config` | a [`WorldConfig`] | the default |
//! | `bodies` | each a `name`, `shape`, `orientation`, `motion`, `groups` | none |
//!
//! Shapes: `{ sphere = { radius } }`, `{ cuboid = { half_extents } }`,
//! `{ triangle = { vertices } }`, `{ hull = { points } }` (the convex hull),
//! `{ mesh = { vertices, triangles } }`.
//!
//! Motions: `{ fixed = position }`, `{ line = { from, to, speed } }`,
//! `{ spline = { points, start_tangent, end_tangent, speed } }` or with `tangents`
//! for every point or `control_points` instead of both, `{ free = { position, velocity } }`. Lines and splines take
//! `at_end` (`rest`, `loop`, `return`), `start_distance` and `start_time` as well. Beside
//! the course may stand `spin = { axis, rate, point }` (`point` may be left out) or
//! `facing = { forward, up, world_up }`.
//!
//! Orientations: a quaternion `[x, y, z, w]`, or `{ axis, degrees }`. Groups:
//! `{ memberships, mask }`, a bit for each; left out, all of both.

mod data;

use crate::error::SceneError;
use crate::math::domain;
use crate::tolerance::{MAX_TIME_STEP, MIN_TIME_STEP};
use crate::world::{Body, BodyId, CollisionWorld, WorldConfig};
use serde::{Deserialize, Serialize};
use std::collections::HashSet;

/// Bodies, settings and a frame rate: see the [module](self).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "data::SceneData", into = "data::SceneData")]
pub struct Scene {
    /// What people call it.
    pub name: String,
    /// What it shows; may be empty.
    pub about: String,
    /// The settings of its world.
    pub config: WorldConfig,
    /// Frames per second.
    pub frame_rate: f64,
    /// How long it lasts, in seconds; none if that is open.
    pub duration: Option<f64>,
    /// Who takes part.
    pub bodies: Vec<NamedBody>,
}

/// A body and its name, which no other body of the scene has.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "data::NamedBodyData", into = "data::NamedBodyData")]
pub struct NamedBody {
    /// The name.
    pub name: String,
    /// The body.
    pub body: Body,
}

impl Scene {
    /// Frames per second where a scene does not say: the thesis's.
    pub const FRAME_RATE: f64 = 24.0;

    /// A world with the scene's settings and bodies, and the bodies' ids in
    /// the order of [`bodies`](Self::bodies).
    ///
    /// # Errors
    /// If a setting, the frame rate, the duration or a body is outside its
    /// domain, or if two bodies have the same name.
    pub fn world(&self) -> Result<(CollisionWorld, Vec<BodyId>), SceneError> {
        self.check()?;
        let mut world = CollisionWorld::new(self.config)?;
        let insert = |named: &NamedBody| {
            (world.insert(named.body.clone())).map_err(|source| SceneError::Body {
                name: named.name.clone(),
                source,
            })
        };
        let ids = self.bodies.iter().map(insert).collect::<Result<_, _>>()?;
        Ok((world, ids))
    }

    /// How long a frame lasts, in seconds.
    #[must_use]
    pub fn time_step(&self) -> f64 {
        self.frame_rate.recip()
    }

    /// What inserting the bodies does not check.
    fn check(&self) -> Result<(), SceneError> {
        let (min, max) = (MAX_TIME_STEP.recip(), MIN_TIME_STEP.recip());
        domain::within("frame_rate", self.frame_rate, min, max)?;
        if let Some(duration) = self.duration {
            domain::within("duration", duration, MIN_TIME_STEP, MAX_TIME_STEP)?;
        }
        let mut names = HashSet::new();
        for NamedBody { name, .. } in &self.bodies {
            if !names.insert(name) {
                return Err(SceneError::DuplicateName { name: name.clone() });
            }
        }
        Ok(())
    }
}
