//! What the early-outs see of a body.

use crate::early_out::{self, Rejection};
use crate::world::slots::Resident;
use glam::DVec3;

/// A sphere that moves straight and holds the body throughout the frame.
///
/// Small, and kept apart from the rest of the body: the early-outs go through
/// all pairs of a frame, and reading little is what makes them quick.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Envelope {
    centre: DVec3,
    displacement: DVec3,
    reach: f64,
}

impl Envelope {
    pub(super) fn of(resident: &Resident) -> Self {
        let frame = &resident.frame;
        let centre = frame.start + resident.centre_offset;
        // The centre is rounded where the narrow phase's differences are not.
        let rounding = 4.0 * f64::EPSILON * centre.abs().max_element();
        Self {
            centre,
            displacement: frame.displacement,
            reach: resident.reach + frame.deviation + rounding,
        }
    }

    /// Whether an early-out test shows that the two cannot touch in the frame.
    pub(super) fn reject(&self, other: &Self) -> Option<Rejection> {
        let between = other.centre - self.centre;
        let motion = self.displacement - other.displacement;
        early_out::reject(between, motion, self.reach + other.reach)
    }
}
