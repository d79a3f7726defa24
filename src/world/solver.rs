//! How pairs are examined.

use crate::geometry::Shape;
use crate::narrow_phase::rays::{Chords, Overlaps, RayCaster};
use crate::world::Method;
use glam::DVec3;

/// A method with what it keeps from one pair to the next.
pub(crate) enum Solver {
    Exact,
    Rays(Box<RayCaster>),
}

/// How a frame is cut into stretches of straight motion.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stretching {
    /// Whether pairs that overlap as a stretch begins are reported.
    pub(crate) reports_overlaps: bool,
    /// Angle above which a curve's frame is subdivided, and by how many points.
    pub(crate) bend: Option<(f64, u32)>,
    /// How far a chord may stray from its arc, as a share of the pair's size.
    pub(crate) chords: Option<f64>,
}

impl Solver {
    /// The method's settings were checked.
    pub(crate) fn new(method: Method) -> Self {
        match method {
            Method::Exact => Self::Exact,
            Method::Rays(config) => Self::Rays(Box::new(RayCaster::new(config))),
        }
    }

    /// Starting points on a shape that do not depend on the motion, in its own frame.
    pub(crate) fn surface_points(&self, shape: &Shape) -> Vec<DVec3> {
        match self {
            Self::Exact => Vec::new(),
            Self::Rays(caster) => caster.surface_points(shape),
        }
    }

    pub(crate) fn stretching(&self) -> Stretching {
        /// Share of the pair's size by which chords stray from curves. A tenth
        /// of it would take three times as many.
        const CHORDS: f64 = 1e-7;
        match self {
            Self::Exact => Stretching {
                reports_overlaps: true,
                bend: None,
                chords: Some(CHORDS),
            },
            Self::Rays(caster) => {
                let config = caster.config();
                Stretching {
                    reports_overlaps: config.overlaps == Overlaps::Report,
                    bend: Some((config.curve_angle, config.curve_points)),
                    chords: match config.chords {
                        Chords::Within(share) => Some(share),
                        Chords::ByAngle => None,
                    },
                }
            }
        }
    }
}
