//! A cuboid, triangle or polytope where it stands.

use crate::geometry::sketch::{self, Joint, Row, Sketch};
use crate::geometry::{Edge, Mesh, MeshVertices, Pose, Shape};
use crate::math::short_list::ShortList;
use glam::{DMat3, DVec3};

/// Vertices of one feature.
pub(super) type Vertices = ShortList<u32, 32>;

/// A shape with vertices, seen along the world's axes from the pair's origin.
pub(super) struct Hull<'a> {
    shape: &'a Shape,
    /// A polytope's; those of others are made when they are asked for.
    vertices: &'a [DVec3],
    edges: &'a [Edge],
    sketch: Option<&'a Sketch>,
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
        let Mesh {
            vertices, edges, ..
        } = Mesh::of(shape)?;
        Some(Self {
            shape,
            vertices: match vertices {
                MeshVertices::Borrowed(vertices) => vertices,
                MeshVertices::Cuboid(_) | MeshVertices::Triangle(_) => &[],
            },
            edges,
            sketch: match shape {
                Shape::Polytope(polytope) => polytope.sketch(),
                _ => None,
            },
            rotation: DMat3::from_quat(pose.orientation),
            centre: shape.centre(),
            offset,
            radius: shape.max_dist(),
        })
    }

    pub(super) fn edges(&self) -> &[Edge] {
        self.edges
    }

    /// What a small polytope is roughly.
    pub(super) fn sketch(&self) -> Option<&'a Sketch> {
        self.sketch
    }

    /// What an edge joins, of a hull of which no number is beyond a byte.
    #[inline]
    pub(super) fn joint(&self, edge: u8) -> Option<Joint> {
        match self.sketch {
            Some(sketch) => sketch.joint(edge),
            None => self.edges.get(usize::from(edge)).map(Joint::of),
        }
    }

    /// What all edges join, of a hull of which no number is beyond a byte.
    #[inline]
    pub(super) fn for_each_joint(&self, tell: impl FnMut(Joint)) {
        match self.sketch {
            Some(sketch) => sketch.joints().for_each(tell),
            None => self.edges.iter().map(Joint::of).for_each(tell),
        }
    }

    pub(super) fn vertex_count(&self) -> usize {
        match self.shape {
            Shape::Sphere(_) => 0,
            Shape::Cuboid(_) => 8,
            Shape::Triangle(_) => 3,
            Shape::Polytope(_) => self.vertices.len(),
        }
    }

    /// Where a vertex is in the shape's own frame.
    #[inline]
    fn local(&self, index: u32) -> Option<DVec3> {
        match self.shape {
            Shape::Sphere(_) => None,
            Shape::Cuboid(cuboid) => {
                let side = |axis: u32| if index >> axis & 1 == 1 { 1.0 } else { -1.0 };
                (index < 8).then(|| cuboid.half_extents() * DVec3::new(side(0), side(1), side(2)))
            }
            Shape::Triangle(triangle) => triangle.vertices().get(index as usize).copied(),
            Shape::Polytope(_) => self.vertices.get(index as usize).copied(),
        }
    }

    pub(super) fn point(&self, index: u32) -> DVec3 {
        self.turned(index) + self.offset
    }

    /// A vertex as seen from the centre.
    #[inline]
    pub(super) fn turned(&self, index: u32) -> DVec3 {
        let local = self.local(index);
        debug_assert!(local.is_some(), "no vertex {index}");
        self.rotation * (local.unwrap_or(self.centre) - self.centre)
    }

    /// Four vertices in a row, as seen from the centre in its own frame; beyond the last comes the first.
    #[inline]
    pub(super) fn row(&self, number: u32) -> Row {
        let first = self.local(0).unwrap_or(self.centre);
        let vertex = |lane: usize| self.local(4 * number + lane as u32).unwrap_or(first);
        sketch::row(std::array::from_fn(|lane| vertex(lane) - self.centre))
    }

    /// How it is turned.
    pub(super) fn rotation(&self) -> DMat3 {
        self.rotation
    }

    /// A face's normal, in its own frame, and how far the face lies from the centre; what fills up
    /// sketches beyond the last. Triangles have no faces in this sense.
    #[inline]
    pub(super) fn plane(&self, face: usize) -> (DVec3, f64) {
        match self.shape {
            Shape::Sphere(_) | Shape::Triangle(_) => Sketch::NO_FACE,
            Shape::Cuboid(cuboid) if face < 6 => {
                let side = if face & 1 == 1 { 1.0 } else { -1.0 };
                let half = cuboid.half_extents()[face / 2];
                (side * DVec3::AXES[face / 2], half)
            }
            Shape::Cuboid(_) => Sketch::NO_FACE,
            Shape::Polytope(polytope) => {
                let normal = polytope.face_normals().get(face);
                match (normal, polytope.face_offsets().get(face)) {
                    (Some(&normal), Some(offset)) => (normal, offset - normal.dot(self.centre)),
                    _ => Sketch::NO_FACE,
                }
            }
        }
    }

    /// How far, in metres, a point of a face may lie below the plane that
    /// [`plane`](Self::plane) tells: a face may be dented by rounding of its coordinates,
    /// which may be large beside its size.
    pub(super) fn plane_error(&self) -> f64 {
        1e-10 * self.radius + 256.0 * f64::EPSILON * self.centre.abs().max_element()
    }

    /// From an edge's first vertex to its second; not of unit length.
    pub(super) fn edge_vector(&self, vertices: [u32; 2]) -> DVec3 {
        let [from, to] = vertices.map(|index| self.local(index).unwrap_or(self.centre));
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

    /// Whether no vertex of a face lies far below `highest`, one of those farthest along a unit vector.
    ///
    /// Two edges that are as good as one line tell no face. Others than a polytope's have no such edges.
    pub(super) fn is_level(&self, face: u32, highest: u32, direction: DVec3) -> bool {
        /// Share of the radius: far more than a face is dented by.
        const DENT: f64 = 1e-9;
        let Shape::Polytope(polytope) = self.shape else {
            return true;
        };
        let Some(top) = self.local(highest) else {
            return true;
        };
        let local = self.rotation.transpose() * direction;
        let slack = DENT * self.radius + self.plane_error();
        (polytope.rim(face).iter())
            .filter_map(|&vertex| self.local(vertex))
            .all(|vertex| (top - vertex).dot(local) <= slack)
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

    /// The vertex farthest along a unit vector, of the lowest number if several are.
    #[inline]
    pub(super) fn support(&self, direction: DVec3) -> DVec3 {
        let local = self.rotation.transpose() * direction;
        let index = match (self.shape, self.sketch) {
            (Shape::Cuboid(_), _) => {
                u32::from(local.x > 0.0)
                    | u32::from(local.y > 0.0) << 1
                    | u32::from(local.z > 0.0) << 2
            }
            (_, Some(sketch)) => {
                // Most often there is but one.
                let candidates = sketch.highest(local, Sketch::ERROR * self.radius as f32);
                if candidates.is_power_of_two() {
                    candidates.trailing_zeros()
                } else {
                    self.farthest(sketch::numbers(candidates), local)
                }
            }
            _ => self.farthest(0..self.vertex_count() as u32, local),
        };
        self.point(index)
    }

    /// Which of these vertices is farthest along a direction in its own frame.
    fn farthest(&self, numbers: impl Iterator<Item = u32>, direction: DVec3) -> u32 {
        let (mut best, mut height) = (0, f64::NEG_INFINITY);
        for index in numbers {
            let along = self
                .local(index)
                .map_or(height, |vertex| vertex.dot(direction));
            // Told apart without a branch that nobody can foresee.
            let is_farther = along > height;
            best = if is_farther { index } else { best };
            height = if is_farther { along } else { height };
        }
        best
    }

    /// The vertices within `margin` of the farthest along a unit vector, in ascending order.
    pub(super) fn farthest_within(&self, direction: DVec3, margin: f64) -> Vertices {
        let local = self.rotation.transpose() * direction;
        let mut near = Vertices::new();
        match (self.shape, self.sketch) {
            (Shape::Cuboid(cuboid), _) => {
                let [x, y, z] = (cuboid.half_extents() * local).to_array();
                let side = |bit: usize, part: f64| if bit & 1 == 1 { part } else { -part };
                let height =
                    |corner: usize| side(corner, x) + side(corner >> 1, y) + side(corner >> 2, z);
                let heights: [f64; 8] = std::array::from_fn(height);
                let top = heights.into_iter().fold(f64::NEG_INFINITY, f64::max);
                for (index, _) in (0..)
                    .zip(heights)
                    .filter(|(_, height)| top - height <= margin)
                {
                    near.push(index);
                }
            }
            (_, Some(sketch)) => {
                // Rounded up.
                let rough = Sketch::ERROR * self.radius as f32 + 1.01 * margin as f32;
                let candidates = sketch.highest(local, rough);
                if candidates.is_power_of_two() {
                    near.push(candidates.trailing_zeros());
                } else {
                    self.push_within(|| sketch::numbers(candidates), (local, margin), &mut near);
                }
            }
            _ => {
                let all = 0..self.vertex_count() as u32;
                self.push_within(|| all.clone(), (local, margin), &mut near);
            }
        }
        near
    }

    /// Adds those of some vertices that are within `margin` of the farthest of them.
    fn push_within<I: Iterator<Item = u32>>(
        &self,
        numbers: impl Fn() -> I,
        (direction, margin): (DVec3, f64),
        near: &mut Vertices,
    ) {
        let height = |index: u32| {
            let vertex = self.local(index).unwrap_or(self.centre);
            (vertex - self.centre).dot(direction)
        };
        let higher = |a: f64, b: f64| if b > a { b } else { a };
        let top = numbers().map(height).fold(f64::NEG_INFINITY, higher);
        for index in numbers().filter(|&index| top - height(index) <= margin) {
            near.push(index);
        }
    }
}
