//! Cubic Bézier curves.

use glam::DVec3;

/// A cubic Bézier curve.
///
/// Source: the thesis, eq. 2.18.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CubicBezier {
    /// The control points `B0 … B3`, in metres.
    pub control_points: [DVec3; 4],
}
