//! Settings of a world.

use crate::broad_phase::{BroadPhase, ObbTest};
use crate::error::ConfigError;
use crate::math::domain;
use crate::narrow_phase::rays::RayConfig;

/// Settings of a [`CollisionWorld`](crate::CollisionWorld).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "crate::world::data::WorldConfigData",
        into = "crate::world::data::WorldConfigData"
    )
)]
pub struct WorldConfig {
    /// How two bodies are examined.
    pub method: Method,
    /// Which pairs of bodies are examined.
    pub broad_phase: BroadPhase,
}

/// How two bodies are examined.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum Method {
    /// By one ray in configuration space: see [`exact`](crate::narrow_phase::exact).
    ///
    /// Straight motions are exact to rounding, with separating normals. On curves and in
    /// rotation planes part the bodies for certain until they touch to within
    /// [`TOUCH`](crate::tolerance::TOUCH): no touch is jumped over, and what comes or stays too near
    /// for too long is told as undecided.
    #[default]
    Exact,
    /// By rays from their surfaces, as the thesis does.
    Rays(RayConfig),
}

impl WorldConfig {
    pub(crate) fn checked(self) -> Result<Self, ConfigError> {
        if let Method::Rays(rays) = self.method {
            rays.checked()?;
        }
        if let BroadPhase::SweptObb(ObbTest::Rays { rays, .. }) = self.broad_phase {
            let max = f64::from(RayConfig::MAX_RAYS);
            domain::within("broad_phase.rays", f64::from(rays), 1.0, max)?;
        }
        Ok(self)
    }
}
