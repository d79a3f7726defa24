//! What the rounding of frames makes of bodies that fly alike.

use glam::DVec3;

/// By how much two bodies that fly alike seem to near each other in a frame, whose length is rounded
/// otherwise for each of them.
pub(super) fn skew(seconds_a: f64, seconds_b: f64, motion_a: DVec3, motion_b: DVec3) -> f64 {
    let longer = seconds_a.max(seconds_b);
    let share = if longer > 0.0 {
        (seconds_a - seconds_b).abs() / longer
    } else {
        0.0
    };
    (share + 8.0 * f64::EPSILON) * motion_a.length().min(motion_b.length())
}
