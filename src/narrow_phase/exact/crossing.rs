//! When two bodies in straight relative motion touch and part.

use crate::geometry::Feature;
use glam::DVec3;

/// The time during which two bodies in straight relative motion share a point.
///
/// Fractions count in relative motions and run over all of time: the bodies
/// overlap as the motion begins if `enter.fraction < 0 < leave`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// How they come to touch.
    pub enter: Touching,
    /// When they share a point last.
    pub leave: f64,
}

/// How two bodies come to touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touching {
    /// When, in relative motions.
    pub fraction: f64,
    /// A point that both share then, as an offset in metres from where the
    /// second body's position is at that moment, along the world's axes.
    pub point: DVec3,
    /// Unit normal, out of the second body towards the first.
    pub normal: DVec3,
    /// The parts that touch: of the first body, of the second.
    pub features: [Feature; 2],
}
