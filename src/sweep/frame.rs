//! The box around one frame.

use crate::geometry::Aabb;
use glam::DVec3;

/// The box around a sphere that moves straight from `from` to `to`.
///
/// Rounded outward: it holds every point of the sphere, and is the tightest
/// such box but for one rounding. Units: metres.
///
/// O(1).
///
/// ```
/// use feeler::sweep::swept_aabb;
/// use glam::DVec3;
///
/// let aabb = swept_aabb(DVec3::ZERO, DVec3::new(3.0, 0.0, 0.0), 0.5);
/// assert!(aabb.contains(DVec3::new(3.5, 0.0, 0.0)));
/// assert!(!aabb.contains(DVec3::new(0.0, 0.500_001, 0.0)));
/// ```
#[must_use]
pub fn swept_aabb(from: DVec3, to: DVec3, radius: f64) -> Aabb {
    Aabb {
        min: (from.min(to) - radius).map(f64::next_down),
        max: (from.max(to) + radius).map(f64::next_up),
    }
}
