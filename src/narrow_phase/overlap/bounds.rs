//! What a pair of small hulls is at least wide along one's faces and the arcs between them.
//!
//! Any vertex of the other hull bounds the widths along all of a hull's normals from below, four by
//! four. The face of the least bound is measured, and the vertex that reaches farthest along its normal
//! bounds all of them once more. A handful of faces and vertices suffices as a rule, of the twenty
//! and twelve that two hulls of 12 points have.

use super::hull::Hull;
use crate::geometry::sketch::{self, Bits, Joint, Planes, Row, Sketch};
use glam::{Vec3, Vec4};

/// Room for the numbers of all edges: a power of two, so that no place need be checked.
pub(super) const ROOM: usize = Sketch::EDGES.next_power_of_two();

/// Vertices whose bounds are kept for the arcs. Fewer let more edges through; more are seldom found.
const COLUMNS: usize = 6;

/// What a bit of a [code](Bounds::codes) is counted on from: the least number in single precision whose
/// last bit counts one.
const CODE: f32 = 8_388_608.0;

/// Those bits.
const BITS: Bits = (1 << COLUMNS) - 1;

/// For each lane what makes four infinite there and nowhere else.
const CLOSED: [Vec4; 4] = {
    let (open, shut) = (f32::NEG_INFINITY, f32::INFINITY);
    [
        Vec4::new(shut, open, open, open),
        Vec4::new(open, shut, open, open),
        Vec4::new(open, open, shut, open),
        Vec4::new(open, open, open, shut),
    ]
};

/// A [`Row`] in memory, where one of the four is as near as all.
pub(super) type Lanes = [[f32; 4]; 3];

#[inline]
fn lanes([x, y, z]: Row) -> Lanes {
    [x.to_array(), y.to_array(), z.to_array()]
}

#[inline]
fn row(&[x, y, z]: &Lanes) -> Row {
    [
        Vec4::from_array(x),
        Vec4::from_array(y),
        Vec4::from_array(z),
    ]
}

/// A hull's vertices roughly, turned by `turn`.
#[inline]
pub(super) fn vertices<const ROWS: usize>(hull: &Hull, turn: impl Fn(Row) -> Row) -> [Lanes; ROWS] {
    let mut vertices = [[[0.0; 4]; 3]; ROWS];
    if let Some(sketch) = hull.sketch() {
        for (place, row) in vertices.iter_mut().zip(sketch.rows()) {
            *place = lanes(turn(row));
        }
    } else {
        for (place, number) in vertices.iter_mut().zip(0..) {
            *place = lanes(turn(hull.row(number)));
        }
    }
    // What is left over changes nothing.
    let (used, first) = (hull.vertex_count().div_ceil(4), vertices[0]);
    vertices.iter_mut().skip(used).for_each(|row| *row = first);
    vertices
}

/// How far vertices reach along a direction, and the number of one that does so.
#[inline]
pub(super) fn reach<const ROWS: usize>(vertices: &[Lanes; ROWS], direction: Vec3) -> (f32, usize) {
    let [x, y, z] = direction.to_array().map(Vec4::splat);
    let mut heights = [Vec4::ZERO; ROWS];
    let mut most = Vec4::NEG_INFINITY;
    for (height, lanes) in heights.iter_mut().zip(vertices) {
        let [xs, ys, zs] = row(lanes);
        *height = x * xs + y * ys + z * zs;
        most = most.max(*height);
    }
    let most = most.max_element();
    let floor = Vec4::splat(most);
    let mut bits = 0_u32;
    for (number, height) in heights.iter().enumerate() {
        bits |= height.cmpge(floor).bitmask() << (4 * number);
    }
    (most, (bits.trailing_zeros() as usize).min(4 * ROWS - 1))
}

/// One of four in a row.
#[inline]
fn of<const N: usize>(rows: &[Lanes; N], number: usize) -> Vec3 {
    let [x, y, z] = &rows[(number / 4).min(N - 1)];
    let lane = number % 4;
    Vec3::new(x[lane], y[lane], z[lane])
}

/// Where vertices are, or faces' normals, by their number.
#[inline]
pub(super) fn at<const N: usize>(rows: &[Lanes; N], number: u8) -> Vec3 {
    of(rows, usize::from(number))
}

/// A face and what the pair is wide along its normal, to within rounding to single precision.
#[derive(Clone, Copy)]
pub(super) struct Measured {
    pub(super) face: u32,
    pub(super) width: f32,
}

/// What the pair is at least wide along the normals of one side's faces.
pub(super) struct Bounds<const FOURS: usize> {
    /// The normals, four by four.
    pub(super) normals: [Lanes; FOURS],
    /// How far the faces lie from the centre, less how far the offset leads along their normals: what the
    /// pair is wide there beside the other hull's part.
    beyond: [[f32; 4]; FOURS],
    /// The vertices of the other side that were looked at.
    seen: Bits,
    /// What the pair is at least wide by them, one after the other.
    columns: [[Vec4; FOURS]; COLUMNS],
    /// So many of them.
    count: usize,
    /// By all of these together; infinite for faces that have been measured.
    open: [Vec4; FOURS],
    /// The faces that have been measured, and their widths.
    measured: Bits,
    widths: [f32; Sketch::FACES],
}

impl<const FOURS: usize> Bounds<FOURS> {
    /// Along the normals of a hull's faces, turned by `turn`, with the offset of the two centres in the frame
    /// that all of it is in, by one of the other side's vertices.
    #[inline]
    pub(super) fn new<const ROWS: usize>(
        hull: &Hull,
        turn: impl Fn(Row) -> Row,
        offset: Vec4,
        others: &[Lanes; ROWS],
        vertex: usize,
    ) -> Self {
        let mut bounds = Self {
            normals: [[[0.0; 4]; 3]; FOURS],
            beyond: [[f32::INFINITY; 4]; FOURS],
            seen: 0,
            columns: [[Vec4::INFINITY; FOURS]; COLUMNS],
            count: 0,
            open: [Vec4::NEG_INFINITY; FOURS],
            measured: 0,
            widths: [f32::INFINITY; Sketch::FACES],
        };
        let [to_x, to_y, to_z, _] = offset.to_array().map(Vec4::splat);
        let plane = |[x, y, z, height]: Planes| {
            let [x, y, z] = turn([x, y, z]);
            let beyond = height - (x * to_x + y * to_y + z * to_z);
            (lanes([x, y, z]), beyond.to_array())
        };
        let places = bounds.normals.iter_mut().zip(&mut bounds.beyond);
        if let Some(sketch) = hull.sketch() {
            for ((normals, beyond), planes) in places.zip(sketch.planes()) {
                (*normals, *beyond) = plane(planes);
            }
        } else {
            let fours = (hull.face_count() as usize).div_ceil(4);
            for ((normals, beyond), number) in places.zip(0..fours) {
                let face = |lane| hull.plane(4 * number + lane);
                (*normals, *beyond) = plane(sketch::planes(std::array::from_fn(face)));
            }
        }
        bounds.see(others, vertex);
        bounds
    }

    /// Bounds all faces by one of the other side's vertices.
    #[inline]
    fn see<const ROWS: usize>(&mut self, others: &[Lanes; ROWS], vertex: usize) {
        if self.seen >> vertex & 1 == 1 {
            return;
        }
        self.seen |= 1 << vertex;
        let [x, y, z] = of(others, vertex).to_array().map(Vec4::splat);
        // The last place is used again: what stands there bounds `open` already.
        let column = &mut self.columns[self.count.min(COLUMNS - 1)];
        self.count = (self.count + 1).min(COLUMNS);
        for (((width, open), normals), &beyond) in (column.iter_mut().zip(&mut self.open))
            .zip(&self.normals)
            .zip(&self.beyond)
        {
            let [xs, ys, zs] = row(normals);
            *width = Vec4::from_array(beyond) + (x * xs + y * ys + z * zs);
            *open = open.max(*width);
        }
    }

    /// Measures the face that the pair may be least wide along, if any that has not been may be no wider than
    /// `limit` allows.
    #[inline]
    pub(super) fn measure<const ROWS: usize>(
        &mut self,
        limit: f32,
        others: &[Lanes; ROWS],
    ) -> Option<Measured> {
        let least = self.open.iter().fold(Vec4::INFINITY, |a, &b| a.min(b));
        let least = least.min_element();
        if !(least <= limit && least < f32::INFINITY) {
            return None;
        }
        let floor = Vec4::splat(least);
        let mut bits = 0_u32;
        for (number, open) in self.open.iter().enumerate() {
            bits |= open.cmple(floor).bitmask() << (4 * number);
        }
        let face = (bits.trailing_zeros() as usize).min(4 * FOURS - 1);
        let (four, lane) = (face / 4, face % 4);
        let normal = of(&self.normals, face);
        let (height, vertex) = reach(others, normal);
        let width = self.beyond[four][lane] + height;
        // A normal that could not be made is zero.
        let width = if normal == Vec3::ZERO {
            f32::INFINITY
        } else {
            width
        };
        // All four are written: what is read back at once had better been written in one.
        self.open[four] = self.open[four].max(CLOSED[lane]);
        self.measured |= 1 << face;
        self.widths[face % Sketch::FACES] = width;
        self.see(others, vertex);
        Some(Measured {
            face: face as u32,
            width,
        })
    }

    /// The measured faces along whose normals the pair may be no wider than `limit`, ascending.
    #[inline]
    pub(super) fn up_to(&self, limit: f32) -> impl Iterator<Item = u32> {
        let limit = Vec4::splat(limit);
        let mut bits = 0;
        for (number, &widths) in self.widths.as_chunks().0.iter().take(FOURS).enumerate() {
            bits |= Vec4::from_array(widths).cmple(limit).bitmask() << (4 * number);
        }
        sketch::numbers(bits & self.measured)
    }

    /// For each face which of the columns are wider than `limit` along the face's normal.
    #[inline]
    fn codes(&self, limit: f32) -> [[f32; 4]; Sketch::FACES / 4] {
        let limit = Vec4::splat(limit);
        let mut codes = [Vec4::splat(CODE); FOURS];
        let mut bit = 1.0;
        for column in self.columns.iter().take(self.count) {
            let one = Vec4::splat(bit);
            for (code, width) in codes.iter_mut().zip(column) {
                *code += Vec4::select(width.cmpgt(limit), one, Vec4::ZERO);
            }
            bit += bit;
        }
        let mut numbers = [[0.0; 4]; Sketch::FACES / 4];
        for (number, code) in numbers.iter_mut().zip(codes) {
            *number = code.to_array();
        }
        numbers
    }

    /// The edges along whose arcs the pair may be no wider than `limit` somewhere.
    ///
    /// A point of the edge and a vertex of the other hull make a point of the Minkowski
    /// difference, beyond which the difference reaches all along the arc. On an arc between two unit
    /// vectors p and q lies αp + βq with α and β of one sign and α + β at least 1: if that point
    /// lies farther than `limit` along both, it does so along all of the arc.
    #[inline]
    pub(super) fn edges<'r>(&self, hull: &Hull, limit: f32, room: &'r mut [u8; ROOM]) -> &'r [u8] {
        let codes = self.codes(limit);
        let code = |face: u8| codes.as_flattened()[usize::from(face) % Sketch::FACES].to_bits();
        let (mut count, mut number) = (0, 0);
        hull.for_each_joint(|Joint { faces, .. }| {
            let [left, right] = faces.map(code);
            // Written in any case, and overwritten if it is too wide: no branch.
            room[count % ROOM] = number;
            count += usize::from(left & right & BITS == 0);
            number += 1;
        });
        room.get(..count).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::sketch::single;
    use crate::geometry::{Polytope, Pose, Shape};
    use crate::narrow_phase::overlap::pair::Pair;
    use glam::DVec3;

    /// Points on a spiral around an ellipsoid.
    fn hull(count: u32, squeeze: DVec3) -> Shape {
        let points = (0..count).map(|index| {
            let z = f64::from(2 * index + 1) / f64::from(count) - 1.0;
            let (y, x) = (2.4 * f64::from(index)).sin_cos();
            squeeze * ((1.0 - z * z).sqrt() * DVec3::new(x, y, 0.0) + z * DVec3::Z)
        });
        Polytope::from_points(points).unwrap().into()
    }

    #[test]
    fn what_is_left_out_is_wider_than_the_limit() {
        const ROWS: usize = Sketch::VERTICES / 4;
        const FOURS: usize = Sketch::FACES / 4;
        const ERROR: f64 = 1e-5;
        let (mut measured, mut faces, mut left, mut edges) = (0, 0, 0, 0);
        for step in 0..300 {
            let squeeze = DVec3::new(1.0, 0.7, if step % 3 == 0 { 0.1 } else { 0.9 });
            let (a, b) = (
                hull(4 + step % 13, DVec3::ONE),
                hull(16 - step % 9, squeeze),
            );
            let step = f64::from(step);
            let place = 0.8 * DVec3::new((0.7 * step).sin(), (1.1 * step).cos(), step.sin());
            let pair = Pair::new(&a, &Pose::at(place), &b, &Pose::IDENTITY, 1e-12).unwrap();
            let around: [Lanes; ROWS] =
                vertices(&pair.a, |row| row.map(|all| Vec4::splat(-1.0) * all));
            let offset = single(pair.offset);
            let mut bounds = Bounds::<FOURS>::new(&pair.b, |row| row, offset, &around, 0);
            let mut limit = f32::INFINITY;
            let mut seen = Vec::new();
            while let Some(Measured { face, width }) = bounds.measure(limit, &around) {
                let exact = pair.width(pair.b.face_normal(face)).width;
                assert!((f64::from(width) - exact).abs() < ERROR, "{step}");
                limit = limit.min(width);
                seen.push(face);
            }
            let limit_told = f64::from(limit);
            for face in (0..pair.b.face_count()).filter(|face| !seen.contains(face)) {
                let exact = pair.width(pair.b.face_normal(face)).width;
                assert!(exact > limit_told - ERROR, "{step}");
            }
            let mut room = [0; ROOM];
            let kept = bounds.edges(&pair.b, limit, &mut room);
            for (number, edge) in (0_u8..).zip(pair.b.edges()) {
                let [one, next] = edge.faces.map(|face| pair.b.face_normal(face));
                let mut along = (0..=16).map(|share| one.lerp(next, f64::from(share) / 16.0));
                let is_wide =
                    along.all(|normal| pair.width(normal.normalize()).width > limit_told - ERROR);
                assert!(is_wide || kept.contains(&number), "{step}");
            }
            measured += seen.len();
            faces += pair.b.face_count() as usize;
            left += kept.len();
            edges += pair.b.edges().len();
        }
        // Enough are left out, and enough are not.
        assert!(
            (faces / 20..faces / 2).contains(&measured),
            "{measured} of {faces}"
        );
        assert!((edges / 20..edges / 2).contains(&left), "{left} of {edges}");
    }
}
