//! Parts of a shape's surface.

/// Which part of a shape's surface is meant.
///
/// The numbers are those of the shape: see [`Cuboid`](crate::Cuboid),
/// [`Triangle`](crate::Triangle) and [`Polytope`](crate::Polytope).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Feature {
    /// A vertex, by its number.
    Vertex(u32),
    /// An edge, by its number.
    Edge(u32),
    /// A face, by its number. Coplanar triangles of a polytope are one face.
    Face(u32),
    /// A point of a surface without edges, as a sphere's.
    Surface,
}
