//! What a ray meets first.

use super::SurfacePoint;

/// What a ray meets first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RayHit {
    /// It comes from outside and enters the solid here.
    Surface(SurfacePoint),
    /// It starts in the solid or on its surface, at fraction 0; there is no normal.
    Inside,
}

impl RayHit {
    /// The fraction of the hit: 0 for a start inside.
    #[must_use]
    pub fn fraction(&self) -> f64 {
        match self {
            Self::Surface(point) => point.fraction,
            Self::Inside => 0.0,
        }
    }

    /// The point of the surface that was hit, unless the ray started inside.
    #[must_use]
    pub fn surface(&self) -> Option<SurfacePoint> {
        match self {
            Self::Surface(point) => Some(*point),
            Self::Inside => None,
        }
    }
}
