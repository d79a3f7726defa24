//! A cuboid, triangle or polytope where it stands.

use crate::geometry::{Edge, Mesh, Pose, Shape};
use crate::math::short_list::ShortList;
use glam::{DMat3, DVec3};

/// Vertices of one feature.
pub(super) type Vertices = ShortList<u32, 32>;

/// A shape with vertices, seen along the world's axes from the pair's origin.
pub(super) struct Hull<'a> {
    shape: &'a Shape,
    mesh: Mesh<'a>,
    rotation: DMat3,
    /// The shape's centre in its own frame; vertices are turned around it, so
    /// that a shape far from its own origin is moved by rounding, not bent.
    centre: DVec3,
    /// Where that centre stands.
    offset: DVec3,
    /// The bounding radius, in metres.
    pub(super) radius: f64,
}

impl<'a> Hull<'a> {
    /// The shape at `pose` with its centre at `offset`; none for a sphere.
    #[inline]
    pub(super) fn new(shape: &'a Shape, pose: &Pose, offset: DVec3) -> Option<Self> {
        Some(Self {
            shape,
            mesh: Mesh::of(shape)?,
            rotation: DMat3::from_quat(pose.orientation),
            centre: shape.centre(),
            offset,
            radius: shape.max_dist(),
        })
    }

    pub(super) fn edges(&self) -> &[Edge] {
        self.mesh.edges
    }

    pub(super) fn vertex_count(&self) -> usize {
        self.mesh.vertices.len()
    }

    pub(super) fn point(&self, index: u32) -> DVec3 {
        self.turned(index) + self.offset
    }

    /// A vertex as seen from the centre.
    #[inline]
    pub(super) fn turned(&self, index: u32) -> DVec3 {
        let local = self.mesh.vertices.get(index as usize).copied();
        debug_assert!(local.is_some(), "no vertex {index}");
        self.rotation * (local.unwrap_or(self.centre) - self.centre)
    }

    /// A vertex as seen from the centre, in its own frame.
    #[inline]
    pub(super) fn local_from_centre(&self, index: usize) -> Option<DVec3> {
        self.mesh
            .vertices
            .get(index)
            .map(|&local| local - self.centre)
    }

    /// How it is turned.
    pub(super) fn rotation(&self) -> DMat3 {
        self.rotation
    }

    /// Hands each face's normal, in its own frame, and how far the face lies from the centre, to
    /// `tell` with a place for what becomes of them. Triangles have no faces in this sense.
    #[inline]
    pub(super) fn for_each_plane<P>(
        &self,
        places: impl Iterator<Item = P>,
        mut tell: impl FnMut(DVec3, f64, P),
    ) {
        match self.shape {
            Shape::Sphere(_) | Shape::Triangle(_) => {}
            Shape::Cuboid(cuboid) => {
                for (face, place) in (0..6).zip(places) {
                    let side = if face & 1 == 1 { 1.0 } else { -1.0 };
                    let half = cuboid.half_extents()[face / 2];
                    tell(side * DVec3::AXES[face / 2], half, place);
                }
            }
            Shape::Polytope(polytope) => {
                let planes = polytope.face_normals().iter().zip(polytope.face_offsets());
                for ((&normal, offset), place) in planes.zip(places) {
                    tell(normal, offset - normal.dot(self.centre), place);
                }
            }
        }
    }

    /// How far, in metres, a point of a face may lie below the plane that
    /// [`for_each_plane`](Self::for_each_plane) tells: a face may be dented by rounding of its coordinates,
    /// which may be large beside its size.
    pub(super) fn plane_error(&self) -> f64 {
        1e-10 * self.radius + 256.0 * f64::EPSILON * self.centre.abs().max_element()
    }

    /// From an edge's first vertex to its second; not of unit length.
    pub(super) fn edge_vector(&self, edge: &Edge) -> DVec3 {
        let [from, to] = edge
            .vertices
            .map(|index| self.mesh.vertices[index as usize]);
        self.rotation * (to - from)
    }

    /// Outward unit normals of the faces.
    pub(super) fn face_normals(&self) -> impl Iterator<Item = DVec3> {
        (0..self.face_count()).map(|face| self.face_normal(face))
    }

    pub(super) fn face_count(&self) -> u32 {
        match self.shape {
            Shape::Sphere(_) => 0,
            Shape::Cuboid(_) => 6,
            Shape::Triangle(_) => 2,
            Shape::Polytope(polytope) => polytope.face_normals().len() as u32,
        }
    }

    /// Outward unit normal of a face.
    pub(super) fn face_normal(&self, face: u32) -> DVec3 {
        let side = if face & 1 == 1 { 1.0 } else { -1.0 };
        match self.shape {
            Shape::Sphere(_) => DVec3::ZERO,
            Shape::Cuboid(_) => side * self.rotation.col(face as usize / 2 % 3),
            Shape::Triangle(triangle) => self.rotation * (-side * triangle.normal()),
            Shape::Polytope(polytope) => self.rotation * polytope.face_normals()[face as usize],
        }
    }

    /// Outward normals of a triangle's edges, in its plane; none for a solid.
    ///
    /// Half way from one side of the triangle to the other, where its edges
    /// have their normals too.
    pub(super) fn rim_normals(&self) -> Option<[DVec3; 3]> {
        let Shape::Triangle(triangle) = self.shape else {
            return None;
        };
        let [a, b, c] = triangle.vertices();
        Some(
            [b - a, c - b, a - c]
                .map(|edge| self.rotation * edge.cross(triangle.normal()).normalize_or_zero()),
        )
    }

    /// The vertex farthest along `direction`, of the lowest number if several are.
    pub(super) fn support(&self, direction: DVec3) -> DVec3 {
        let local = self.rotation.transpose() * direction;
        let index = match self.shape {
            Shape::Cuboid(_) => {
                u32::from(local.x > 0.0)
                    | u32::from(local.y > 0.0) << 1
                    | u32::from(local.z > 0.0) << 2
            }
            _ => farthest(&self.mesh.vertices, local),
        };
        self.point(index)
    }

    /// The vertices within `margin` of the farthest along `direction`, in ascending order.
    pub(super) fn farthest_within(&self, direction: DVec3, margin: f64) -> Vertices {
        let local = self.rotation.transpose() * direction;
        let height = |vertex: DVec3| (vertex - self.centre).dot(local);
        let vertices = || self.mesh.vertices.iter().copied();
        let top = vertices()
            .map(height)
            .fold(f64::NEG_INFINITY, |a, b| if b > a { b } else { a });
        let mut near = Vertices::new();
        for (index, vertex) in (0..).zip(vertices()) {
            if top - height(vertex) <= margin {
                near.push(index);
            }
        }
        near
    }
}

/// Index of the point farthest along `direction`.
fn farthest(points: &[DVec3], direction: DVec3) -> u32 {
    let (mut best, mut height) = (0, f64::NEG_INFINITY);
    for (index, point) in points.iter().enumerate() {
        let along = point.dot(direction);
        // Told apart without a branch that nobody can foresee.
        let is_farther = along > height;
        best = if is_farther { index } else { best };
        height = if is_farther { along } else { height };
    }
    best as u32
}
