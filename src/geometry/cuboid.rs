//! Boxes.

use crate::error::ShapeError;
use crate::geometry::Edge;
use crate::math::domain;
use crate::tolerance::{MAX_LENGTH, MIN_LENGTH};
use glam::DVec3;

/// A solid box around the origin of its frame, with its edges along the axes.
///
/// Vertices are numbered by sides: bit 0, 1, 2 of the number is set where x, y,
/// z is positive. Faces are numbered −x, +x, −y, +y, −z, +z. Edges 0–3 run
/// along x, 4–7 along y, 8–11 along z.
///
/// ```
/// use feeler::{Cuboid, ShapeError};
/// use glam::DVec3;
///
/// let cuboid = Cuboid::new([1.0, 2.0, 3.0])?;
/// assert_eq!(cuboid.vertices()[0b101], DVec3::new(1.0, -2.0, 3.0));
/// assert!(Cuboid::new([1.0, -2.0, 3.0]).is_err());
/// # Ok::<(), ShapeError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "crate::geometry::data::CuboidData",
        into = "crate::geometry::data::CuboidData"
    )
)]
pub struct Cuboid {
    half_extents: DVec3,
}

impl Cuboid {
    /// A box with the given half edge lengths in metres.
    ///
    /// # Errors
    /// If a half-extent is not finite or not within
    /// [`MIN_LENGTH`]`..=`[`MAX_LENGTH`].
    pub fn new(half_extents: impl Into<DVec3>) -> Result<Self, ShapeError> {
        let half_extents = half_extents.into();
        for (field, value) in ["half_extents.x", "half_extents.y", "half_extents.z"]
            .into_iter()
            .zip(half_extents.to_array())
        {
            domain::within(field, value, MIN_LENGTH, MAX_LENGTH)?;
        }
        Ok(Self { half_extents })
    }

    /// Half the edge lengths in metres.
    #[must_use]
    pub fn half_extents(&self) -> DVec3 {
        self.half_extents
    }

    /// The eight corners.
    #[must_use]
    pub fn vertices(&self) -> [DVec3; 8] {
        std::array::from_fn(|index| {
            let side = |axis: usize| if index >> axis & 1 == 1 { 1.0 } else { -1.0 };
            self.half_extents * DVec3::new(side(0), side(1), side(2))
        })
    }

    /// Corners of the twelve triangles, counter-clockwise seen from outside; the
    /// triangles `2f` and `2f + 1` form face `f`.
    pub(crate) const TRIANGLES: [[u32; 3]; 12] = [
        [0, 4, 6],
        [0, 6, 2], // −x
        [1, 3, 7],
        [1, 7, 5], // +x
        [0, 1, 5],
        [0, 5, 4], // −y
        [2, 6, 7],
        [2, 7, 3], // +y
        [0, 2, 3],
        [0, 3, 1], // −z
        [4, 5, 7],
        [4, 7, 6], // +z
    ];

    pub(crate) const EDGES: [Edge; 12] = [
        Edge {
            vertices: [0, 1],
            faces: [2, 4],
        },
        Edge {
            vertices: [2, 3],
            faces: [4, 3],
        },
        Edge {
            vertices: [4, 5],
            faces: [5, 2],
        },
        Edge {
            vertices: [6, 7],
            faces: [3, 5],
        },
        Edge {
            vertices: [0, 2],
            faces: [4, 0],
        },
        Edge {
            vertices: [1, 3],
            faces: [1, 4],
        },
        Edge {
            vertices: [4, 6],
            faces: [0, 5],
        },
        Edge {
            vertices: [5, 7],
            faces: [5, 1],
        },
        Edge {
            vertices: [0, 4],
            faces: [0, 2],
        },
        Edge {
            vertices: [1, 5],
            faces: [2, 1],
        },
        Edge {
            vertices: [2, 6],
            faces: [3, 0],
        },
        Edge {
            vertices: [3, 7],
            faces: [1, 3],
        },
    ];
}
