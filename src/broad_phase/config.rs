//! Which broad phase to use.

use super::{obb_overlap_by_axes, obb_overlap_by_rays};
use crate::geometry::Obb;

/// How candidate pairs are found.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum BroadPhase {
    /// Hierarchies of boxes around each body's motion in the frame: see
    /// [`Bvh`](super::Bvh). For any number of bodies.
    #[default]
    Bvh,
    /// Oriented boxes around whole paths, each tested against every other once.
    SweptObb(ObbTest),
    /// No broad phase: all pairs with a moving body in them. For comparison.
    AllPairs,
}

/// How two oriented boxes are tested for overlap.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum ObbTest {
    /// By separating axes: see [`obb_overlap_by_axes`]. Never misses.
    #[default]
    Axes,
    /// By rays, as the thesis does: see [`obb_overlap_by_rays`]. May miss.
    Rays {
        /// Rays from each face.
        rays: u32,
        /// Where the random points on the faces come from.
        seed: u64,
    },
}

impl ObbTest {
    /// Whether the boxes overlap, as far as this test can tell.
    #[must_use]
    pub fn overlap(self, a: &Obb, b: &Obb) -> bool {
        match self {
            Self::Axes => obb_overlap_by_axes(a, b),
            Self::Rays { rays, seed } => obb_overlap_by_rays(a, b, rays, seed),
        }
    }
}
