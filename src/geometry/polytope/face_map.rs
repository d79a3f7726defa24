//! Which faces lie where: the way into a polytope for a ray.

use super::{Edge, Polytope};
use crate::geometry::Aabb;
use glam::DVec3;

/// Finest grid of cells on a side of the bounds: 24 576 cells in all.
///
/// One cell for a face up to there; finer ones would shorten a ray's walk by less than
/// the memory they take costs.
const MAX_RESOLUTION: usize = 64;

/// What lies across one of a face's edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Side {
    /// The face there.
    pub(crate) face: u32,
    /// The edge.
    pub(crate) edge: u32,
}

/// A face with all that a walk needs to know of it: one line of cache.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
struct FaceLine {
    /// Normal and offset.
    plane: [f64; 4],
    /// All of them, if there are no more.
    sides: [Side; 3],
    /// Where all of them begin among the map's sides, and how many there are.
    first: u32,
    count: u32,
}

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
    resolution: usize,
    /// The middle of the bounds, half their extents and the inverses of those.
    middle: DVec3,
    half: DVec3,
    per_half: DVec3,
    /// By side of the bounds (−x, +x, −y, +y, −z, +z), then by the two coordinates on it.
    cells: Vec<u32>,
    lines: Vec<FaceLine>,
    /// Those of faces that have more than three.
    sides: Vec<Side>,
}

impl FaceMap {
    /// The map of a polytope that is complete but for its map.
    pub(super) fn of(polytope: &Polytope) -> Self {
        let (vertices, count) = (polytope.vertices(), polytope.face_normals().len());
        let bounds = Aabb::around(vertices.iter().copied());
        let half = 0.5 * (bounds.max - bounds.min);
        let (lines, sides) = lines(polytope);
        let mut map = Self {
            inner: vertices.iter().sum::<DVec3>() / vertices.len().max(1) as f64,
            height_error: 0.0,
            resolution: ((count as f64 / 6.0).sqrt().ceil() as usize).clamp(1, MAX_RESOLUTION),
            middle: bounds.min + half,
            half,
            per_half: 1.0 / half,
            cells: Vec::new(),
            lines,
            sides,
        };
        let shallowest = (polytope.face_normals().iter())
            .zip(polytope.face_offsets())
            .map(|(normal, offset)| offset - normal.dot(map.inner))
            .fold(f64::INFINITY, f64::min);
        let size = bounds.min.abs().max(bounds.max.abs()).max_element();
        map.height_error = 64.0 * f64::EPSILON * size / shallowest.max(f64::MIN_POSITIVE);
        let mut face = 0;
        for side in 0..6 {
            for cell in 0..map.resolution * map.resolution {
                let (row, column) = (cell / map.resolution, cell % map.resolution);
                let outwards = map.cell_centre(side, row, column) - map.inner;
                (face, _) = map.facing(outwards, face);
                map.cells.push(face);
            }
        }
        map
    }

    /// Normal and offset of a face's plane.
    #[inline]
    pub(crate) fn plane(&self, face: u32) -> (DVec3, f64) {
        let [x, y, z, offset] = self.lines[face as usize].plane;
        (DVec3::new(x, y, z), offset)
    }

    /// What lies across a face's edges, in the order of the edges' numbers.
    #[inline]
    pub(crate) fn sides(&self, face: u32) -> &[Side] {
        let line = &self.lines[face as usize];
        let (first, count) = (line.first as usize, line.count as usize);
        (line.sides.get(..count)).unwrap_or_else(|| &self.sides[first..first + count])
    }

    /// A face near to where a line enters the polytope, or passes it by.
    #[inline]
    pub(crate) fn entry(&self, origin: DVec3, direction: DVec3) -> u32 {
        self.ellipsoid_entry(origin, direction, self.per_half)
    }

    /// The same for the polytope grown by `radius`.
    #[inline]
    pub(crate) fn grown_entry(&self, origin: DVec3, direction: DVec3, radius: f64) -> u32 {
        self.ellipsoid_entry(origin, direction, 1.0 / (self.half + radius))
    }

    /// Takes the polytope for the ellipsoid that fills its bounds, whose half-axes are the inverses
    /// of `scale`: a guess that needs one root and no branch. Never quite at its silhouette, where
    /// half of the faces look away from the line. NaN gives some face.
    #[inline]
    fn ellipsoid_entry(&self, origin: DVec3, direction: DVec3, scale: DVec3) -> u32 {
        let (origin, direction) = ((origin - self.middle) * scale, direction * scale);
        let square = direction.length_squared();
        let along = origin.dot(direction);
        let room = along * along - square * (origin.length_squared() - 1.0);
        let ahead = along + room.max(0.1 * square).sqrt();
        self.near(square * origin - ahead * direction)
    }

    /// A face that looks against `direction`, near to `face` if not that one itself; none does
    /// if the one given back does not.
    #[inline]
    pub(crate) fn against(&self, direction: DVec3, face: u32) -> u32 {
        let rate = |face: u32| self.plane(face).0.dot(direction);
        if rate(face) < 0.0 {
            return face;
        }
        let (mut steepest, mut least) = (face, 0.0);
        for side in self.sides(face) {
            let rate = rate(side.face);
            if rate < least {
                (steepest, least) = (side.face, rate);
            }
        }
        if steepest == face {
            (steepest, _) = self.facing(-direction, face);
        }
        steepest
    }

    /// A face near to where the ray from the middle of the bounds `outwards` comes out;
    /// in shares of the bounds, and of any length.
    #[inline]
    fn near(&self, outwards: DVec3) -> u32 {
        let size = outwards.abs();
        let axis = if size.x >= size.y && size.x >= size.z {
            0
        } else {
            1 + usize::from(size.z > size.y)
        };
        let outwards = outwards.to_array();
        let (row, column) = across(axis);
        let cells = 0.5 * self.resolution as f64;
        let share = cells / outwards[axis].abs();
        // `as` takes NaN to 0 and what is negative too.
        let index =
            |axis: usize| ((outwards[axis] * share + cells) as usize).min(self.resolution - 1);
        let side = 2 * axis + usize::from(outwards[axis] > 0.0);
        self.cells[(side * self.resolution + index(row)) * self.resolution + index(column)]
    }

    /// Whether `point` lies inside or outside; none if it is so near the surface that
    /// rounding decides.
    pub(crate) fn holds(&self, point: DVec3) -> Option<bool> {
        let outwards = point - self.inner;
        let start = self.near((point - self.middle) * self.per_half);
        let (_, height) = self.facing(outwards, start);
        let error = self.height_error * height.max(1.0);
        ((height - 1.0).abs() > error).then_some(height < 1.0)
    }

    /// The face that the ray from the inner point `outwards` leaves by, found from
    /// `start`, and the height of `outwards` over it: 1 on the face's plane, 0 at the inner point.
    ///
    /// Seen from a point inside, the faces' planes are the corners of the dual polytope, and
    /// the face sought is its furthest corner: climbing over neighbours finds it.
    pub(crate) fn facing(&self, outwards: DVec3, start: u32) -> (u32, f64) {
        let height = |face: u32| {
            let (normal, offset) = self.plane(face);
            normal.dot(outwards) / (offset - normal.dot(self.inner))
        };
        let (mut face, mut highest) = (start, height(start));
        loop {
            let current = face;
            for side in self.sides(current) {
                let neighbour = side.face;
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
        let mut share = DVec3::splat(2.0 * (side as f64 % 2.0) - 1.0);
        share[row_axis] = (2.0 * row as f64 + 1.0) / self.resolution as f64 - 1.0;
        share[column_axis] = (2.0 * column as f64 + 1.0) / self.resolution as f64 - 1.0;
        self.middle + share * self.half
    }
}

/// The two axes across `axis`.
#[inline]
fn across(axis: usize) -> (usize, usize) {
    [(1, 2), (2, 0), (0, 1)][axis]
}

impl Default for FaceMap {
    /// The map of no faces.
    fn default() -> Self {
        Self {
            inner: DVec3::ZERO,
            height_error: 0.0,
            resolution: 1,
            middle: DVec3::ZERO,
            half: DVec3::ZERO,
            per_half: DVec3::ZERO,
            cells: Vec::new(),
            lines: Vec::new(),
            sides: Vec::new(),
        }
    }
}

/// For each face its line, and the sides of those that have more than three.
fn lines(polytope: &Polytope) -> (Vec<FaceLine>, Vec<Side>) {
    let planes = (polytope.face_normals().iter()).zip(polytope.face_offsets());
    let mut around = vec![Vec::new(); planes.len()];
    for (edge, &Edge { faces: [a, b], .. }) in (0..).zip(polytope.edges()) {
        around[a as usize].push(Side { face: b, edge });
        around[b as usize].push(Side { face: a, edge });
    }
    let mut more = Vec::new();
    let line = |((n, &offset), around): ((&DVec3, &f64), Vec<Side>)| {
        let (first, count) = (more.len() as u32, around.len() as u32);
        let mut sides = [Side::default(); 3];
        if around.len() <= sides.len() {
            sides[..around.len()].copy_from_slice(&around);
        } else {
            more.extend(around);
        }
        FaceLine {
            plane: [n.x, n.y, n.z, offset],
            sides,
            first,
            count,
        }
    };
    let lines = planes.zip(around).map(line).collect();
    (lines, more)
}
