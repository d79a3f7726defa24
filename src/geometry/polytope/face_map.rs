//! Which faces lie where: the way into a polytope for a ray.

use super::{Edge, Polytope};
use crate::geometry::Aabb;
use glam::DVec3;

/// Finest grid of cells on a side of the bounds: 24 576 cells in all.
///
/// One cell for a face up to there; finer ones would shorten a ray's walk by less than
/// the memory they take costs.
const MAX_RESOLUTION: usize = 64;

/// The faces' neighbours, and for every part of the bounding box a face near it.
///
/// From there a walk over neighbours finds the face that a ray enters by
/// after a step or two.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FaceMap {
    /// A point inside: the mean of the vertices.
    inner: DVec3,
    /// What rounding may do to a height, see [`facing`](Self::facing).
    height_error: f64,
    bounds: Aabb,
    resolution: usize,
    /// Cells per metre along each axis.
    density: DVec3,
    /// By side of the bounds (−x, +x, −y, +y, −z, +z), then by the two coordinates on it.
    cells: Vec<u32>,
    /// Where each face's list begins in `neighbours`; one more for the end.
    firsts: Vec<u32>,
    neighbours: Vec<u32>,
    /// Normals and offsets once more, side by side: a walk reads one line of cache a face.
    planes: Vec<[f64; 4]>,
}

impl FaceMap {
    /// The map of a polytope that is complete but for its map.
    pub(super) fn of(polytope: &Polytope) -> Self {
        let (vertices, count) = (polytope.vertices(), polytope.face_normals().len());
        let (firsts, neighbours) = adjacency(count, polytope.edges());
        let mut map = Self {
            inner: vertices.iter().sum::<DVec3>() / vertices.len().max(1) as f64,
            height_error: 0.0,
            bounds: Aabb::around(vertices.iter().copied()),
            resolution: ((count as f64 / 6.0).sqrt().ceil() as usize).clamp(1, MAX_RESOLUTION),
            density: DVec3::ZERO,
            cells: Vec::new(),
            firsts,
            neighbours,
            planes: (polytope.face_normals().iter())
                .zip(polytope.face_offsets())
                .map(|(n, &offset)| [n.x, n.y, n.z, offset])
                .collect(),
        };
        let shallowest = (polytope.face_normals().iter())
            .zip(polytope.face_offsets())
            .map(|(normal, offset)| offset - normal.dot(map.inner))
            .fold(f64::INFINITY, f64::min);
        let size = map.bounds.min.abs().max(map.bounds.max.abs()).max_element();
        map.height_error = 64.0 * f64::EPSILON * size / shallowest.max(f64::MIN_POSITIVE);
        map.density = map.resolution as f64 / (map.bounds.max - map.bounds.min);
        let mut face = 0;
        for side in 0..6 {
            for cell in 0..map.resolution * map.resolution {
                let (row, column) = (cell / map.resolution, cell % map.resolution);
                let outwards = map.cell_centre(side, row, column) - map.inner;
                (face, _) = map.facing(polytope, outwards, face);
                map.cells.push(face);
            }
        }
        map
    }

    /// The box around the vertices.
    #[inline]
    pub(crate) fn bounds(&self) -> &Aabb {
        &self.bounds
    }

    /// Normal and offset of a face's plane.
    #[inline]
    pub(crate) fn plane(&self, face: u32) -> (DVec3, f64) {
        let [x, y, z, offset] = self.planes[face as usize];
        (DVec3::new(x, y, z), offset)
    }

    /// The faces that share an edge with `face`.
    #[inline]
    pub(crate) fn neighbours(&self, face: u32) -> &[u32] {
        let face = face as usize;
        &self.neighbours[self.firsts[face] as usize..self.firsts[face + 1] as usize]
    }

    /// A face near `point`, which lies on or near a side of the bounds.
    #[inline]
    pub(crate) fn near(&self, side: usize, point: DVec3) -> u32 {
        let (row, column) = across(side / 2);
        let place = (point - self.bounds.min) * self.density;
        // `as` takes NaN to 0 and what is negative too.
        let index = |axis: usize| (place[axis] as usize).min(self.resolution - 1);
        self.cells[(side * self.resolution + index(row)) * self.resolution + index(column)]
    }

    /// Whether `point` lies inside or outside; none if it is so near the surface that
    /// rounding decides.
    pub(crate) fn holds(&self, polytope: &Polytope, point: DVec3) -> Option<bool> {
        let outwards = point - self.inner;
        let share = (outwards / (self.bounds.max - self.bounds.min)).abs();
        let axis = share.max_position();
        let start = self.near(2 * axis + usize::from(outwards[axis] > 0.0), point);
        let (_, height) = self.facing(polytope, outwards, start);
        let error = self.height_error * height.max(1.0);
        ((height - 1.0).abs() > error).then_some(height < 1.0)
    }

    /// The face that the ray from the inner point `outwards` leaves by, found from
    /// `start`, and the height of `outwards` over it: 1 on the face's plane, 0 at the inner point.
    ///
    /// Seen from a point inside, the faces' planes are the corners of the dual polytope, and
    /// the face sought is its furthest corner: climbing over neighbours finds it.
    pub(crate) fn facing(&self, polytope: &Polytope, outwards: DVec3, start: u32) -> (u32, f64) {
        let (normals, offsets) = (polytope.face_normals(), polytope.face_offsets());
        let height = |face: u32| {
            let normal = normals[face as usize];
            normal.dot(outwards) / (offsets[face as usize] - normal.dot(self.inner))
        };
        let (mut face, mut highest) = (start, height(start));
        loop {
            let current = face;
            for &neighbour in self.neighbours(current) {
                let height = height(neighbour);
                // Strictly: so that no face is visited twice and the climb ends.
                if height > highest {
                    (face, highest) = (neighbour, height);
                }
            }
            if face == current {
                return (face, highest);
            }
        }
    }

    fn cell_centre(&self, side: usize, row: usize, column: usize) -> DVec3 {
        let (row_axis, column_axis) = across(side / 2);
        let mut share = DVec3::splat(side as f64 % 2.0);
        share[row_axis] = (row as f64 + 0.5) / self.resolution as f64;
        share[column_axis] = (column as f64 + 0.5) / self.resolution as f64;
        self.bounds.min + share * (self.bounds.max - self.bounds.min)
    }
}

/// The two axes across `axis`.
#[inline]
fn across(axis: usize) -> (usize, usize) {
    match axis {
        0 => (1, 2),
        1 => (2, 0),
        _ => (0, 1),
    }
}

impl Default for FaceMap {
    /// The map of no faces.
    fn default() -> Self {
        Self {
            inner: DVec3::ZERO,
            height_error: 0.0,
            bounds: Aabb::EMPTY,
            resolution: 1,
            density: DVec3::ZERO,
            cells: Vec::new(),
            firsts: vec![0],
            neighbours: Vec::new(),
            planes: Vec::new(),
        }
    }
}

fn adjacency(faces: usize, edges: &[Edge]) -> (Vec<u32>, Vec<u32>) {
    let mut firsts = vec![0_u32; faces + 1];
    for edge in edges {
        for face in edge.faces {
            firsts[face as usize + 1] += 1;
        }
    }
    for face in 0..faces {
        firsts[face + 1] += firsts[face];
    }
    let mut next = firsts.clone();
    let mut neighbours = vec![0; 2 * edges.len()];
    for edge in edges {
        for (face, other) in [
            (edge.faces[0], edge.faces[1]),
            (edge.faces[1], edge.faces[0]),
        ] {
            neighbours[next[face as usize] as usize] = other;
            next[face as usize] += 1;
        }
    }
    (firsts, neighbours)
}
