//! Settings of the ray method.

use crate::error::{ConfigError, ValueError};
use crate::math::domain;

/// How the ray method casts.
///
/// [`RayConfig::default`] is what this crate makes of the method: aimed rays,
/// both ways, refined. [`RayConfig::thesis`] is the method as published.
///
/// ```
/// use feeler::{CollisionWorld, ConfigError, Method, RayConfig, WorldConfig};
///
/// let rays = RayConfig { rays: 64, ..RayConfig::default() };
/// let world = CollisionWorld::new(WorldConfig { method: Method::Rays(rays), ..Default::default() })?;
///
/// let none = RayConfig { rays: 0, ..RayConfig::default() };
/// let config = WorldConfig { method: Method::Rays(none), ..Default::default() };
/// assert!(matches!(CollisionWorld::new(config), Err(ConfigError::Value(_))));
/// # Ok::<(), ConfigError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct RayConfig {
    /// How many rays, counted as the placement does; 1 to
    /// [`MAX_RAYS`](Self::MAX_RAYS). Rays from vertices and edges come on top.
    pub rays: u32,
    /// Seed of every random choice.
    pub seed: u64,
    /// Where the rays start.
    pub placement: Placement,
    /// Which of the two bodies sends them.
    pub senders: Senders,
    /// What follows the first rays.
    pub refinement: Refinement,
    /// What happens to pairs that overlap as a frame begins.
    pub overlaps: Overlaps,
    /// Angle in radians between a curve's tangent and the frame's chord above
    /// which the frame is subdivided; above 0, at most π. The thesis's 25°.
    pub curve_angle: f64,
    /// How many points then subdivide it; 1 to 1000. The thesis's 5.
    pub curve_points: u32,
    /// How exactly chords follow curves, besides.
    pub chords: Chords,
}

/// Where surface rays start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum Placement {
    /// The thesis's (§3.7, §3.8): a spherical grid on spheres, random points on
    /// every triangle of other shapes, and every vertex. `rays` counts per
    /// sphere and per triangle.
    Thesis,
    /// Evenly over spheres and triangles, and every vertex. `rays` counts per
    /// sphere and per triangle.
    ///
    /// The accuracy dial in its plain form. Unrefined, n rays from both bodies see a touch late,
    /// never early: along the motion by at most 0.8/n of the pair's reach, the sum of its bounding
    /// radii, where a ball takes part, and by 0.3/√n where edges meet; contact points are
    /// within 0.8/√n of the reach. That holds for bodies that meet within half their reach of
    /// head on; touches nearer to a graze than the rays are to each other may be missed.
    Even,
    /// Only where the shadows that the two bodies cast along the motion can
    /// overlap, every vertex and edge, wherever edges cross, and where a ball
    /// would touch each face, edge or ball. `rays` counts per pair.
    ///
    /// In straight motion first contact is between a vertex and a face, two
    /// edges, or a ball and any of these. There is a ray for each: no collision
    /// is missed, and times are right to rounding, some 1e-13 of the pair's size.
    Aimed,
}

/// Which body sends rays.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Senders {
    /// The first body, along the relative motion, as in the thesis.
    First,
    /// Both: the first along the motion, the second against it.
    Both,
}

/// What follows the first rays.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Refinement {
    /// Nothing: the shortest of them is the answer.
    None,
    /// Further rays ever closer around the shortest, as the thesis proposes in
    /// §4.1.1. Aimed rays spend three quarters of their number on it, but none
    /// between two balls, whose shortest ray is among the first; other
    /// placements add as many rays as `rays` says.
    AroundShortest,
}

/// What happens to pairs that overlap as a frame begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Overlaps {
    /// They are reported as overlapping, with depth, and cast no rays.
    Report,
    /// Nobody looks, as in the thesis, which presupposes that there are none.
    Ignore,
}

/// How exactly chords follow curves.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Chords {
    /// As the angle rule leaves them, as in the thesis.
    ByAngle,
    /// Halved until no chord strays farther from its arc than this share of the
    /// pair's size (the sum of the bounding radii); 1e-9 to 1.
    ///
    /// A pair that takes more than 65 536 halvings in one frame gets coarser
    /// chords from there on, so that every frame ends: frames that long are
    /// better cut up by the caller.
    Within(f64),
}

impl RayConfig {
    /// Largest number of rays.
    pub const MAX_RAYS: u32 = 1_000_000;

    /// The method as the thesis publishes it, with `rays` rays and its seed.
    #[must_use]
    pub fn thesis(rays: u32) -> Self {
        Self {
            rays,
            seed: 10,
            placement: Placement::Thesis,
            senders: Senders::First,
            refinement: Refinement::None,
            overlaps: Overlaps::Ignore,
            chords: Chords::ByAngle,
            ..Self::default()
        }
    }

    pub(crate) fn checked(self) -> Result<Self, ConfigError> {
        domain::within("rays", f64::from(self.rays), 1.0, f64::from(Self::MAX_RAYS))?;
        domain::within("curve_points", f64::from(self.curve_points), 1.0, 1000.0)?;
        domain::within("curve_angle", self.curve_angle, 0.0, std::f64::consts::PI)?;
        if self.curve_angle <= 0.0 {
            let (field, min) = ("curve_angle", f64::MIN_POSITIVE);
            return Err(ValueError::TooSmall {
                field,
                value: self.curve_angle,
                min,
            }
            .into());
        }
        if let Chords::Within(share) = self.chords {
            domain::within("chords", share, 1e-9, 1.0)?;
        }
        Ok(self)
    }
}

impl Default for RayConfig {
    fn default() -> Self {
        Self {
            rays: 100,
            seed: 10,
            placement: Placement::Aimed,
            senders: Senders::Both,
            refinement: Refinement::AroundShortest,
            overlaps: Overlaps::Report,
            curve_angle: 25_f64.to_radians(),
            curve_points: 5,
            chords: Chords::Within(1e-6),
        }
    }
}
