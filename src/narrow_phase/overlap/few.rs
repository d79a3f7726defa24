//! The least width of two small hulls, by the faces and edges that can have it.
//!
//! As [`faces`](super::faces), which looks at all of them. Two hulls of 12 points span
//! 900 pairs of edges; all but a few of them face where the pair is wider than some
//! face is. Which these are is told in single precision, with a margin for its rounding, in B's
//! frame, where nothing of B need be turned; what is left is measured as ever. Many times as fast
//! as growing a polytope, and nothing is allocated.

use super::faces::Arc;
use super::hull::Hull;
use super::pair::Pair;
use super::{Width, unit};
use crate::geometry::sketch::{self, Bits, Joint, Planes, Row, Sketch, single};
use glam::{DMat3, DVec3, Vec3, Vec4};

/// What hulls of up to 12 vertices need of rows of four vertices, and of fours of faces; what all small
/// ones need. Less room to fill.
const FEW_ROWS: usize = 3;
const FEW_FOURS: usize = 5;
const ROWS: usize = Sketch::VERTICES / 4;
const FOURS: usize = Sketch::FACES / 4;

/// Room for the numbers of all edges: a power of two, so that no place need be checked.
const ROOM: usize = Sketch::EDGES.next_power_of_two();

/// What rounding to single precision may do to a width, as a share of the radii and the offset
/// together.
///
/// A vertex of A is turned and compared with a normal: ten roundings along each of the three axes,
/// each of 6e-8, on the way to a height, of which two make a width beside the offset's own. Larger
/// only lets more edges through.
const SINGLE: f64 = 128.0 * (0.5 * f32::EPSILON) as f64;

/// Whether both hulls are solid and small.
pub(super) fn are_few(pair: &Pair) -> bool {
    let is_small = |hull: &Hull| {
        hull.sketch().is_some()
            || hull.rim_normals().is_none()
                && hull.edges().len() <= Sketch::EDGES
                && hull.face_count() as usize <= Sketch::FACES
                && hull.vertex_count() <= Sketch::VERTICES
    };
    is_small(&pair.a) && is_small(&pair.b)
}

/// A hull's vertices roughly, turned by `turn`.
#[inline]
fn vertices<const ROWS: usize>(hull: &Hull, turn: impl Fn(Row) -> Row) -> [Row; ROWS] {
    let mut vertices = [[Vec4::ZERO; 3]; ROWS];
    if let Some(sketch) = hull.sketch() {
        for (place, row) in vertices.iter_mut().zip(sketch.rows()) {
            *place = turn(row);
        }
    } else {
        for (place, number) in vertices.iter_mut().zip(0..) {
            *place = turn(hull.row(number));
        }
    }
    // What is left over changes nothing.
    let (used, first) = (hull.vertex_count().div_ceil(4), vertices[0]);
    vertices.iter_mut().skip(used).for_each(|row| *row = first);
    vertices
}

/// How far vertices reach along a direction.
#[inline]
fn reach<const ROWS: usize>(vertices: &[Row; ROWS], direction: Vec4) -> f32 {
    let [x, y, z, _] = direction.to_array().map(Vec4::splat);
    let tops = vertices
        .iter()
        .fold(Vec4::NEG_INFINITY, |tops, &[xs, ys, zs]| {
            tops.max(x * xs + y * ys + z * zs)
        });
    tops.max_element()
}

/// What the pair is at least wide along the normals of one side's faces.
struct Bounds<const ROWS: usize, const FOURS: usize> {
    /// By each of the other side's vertices.
    widths: [[[Vec4; ROWS]; 4]; FOURS],
    /// By all of them.
    tops: [Vec4; FOURS],
    /// The normals, four by four.
    normals: [Row; FOURS],
    /// So many fours of faces are in use.
    fours: usize,
}

impl<const ROWS: usize, const FOURS: usize> Bounds<ROWS, FOURS> {
    /// Along the normals of a hull's faces, turned by `turn`, with the other side's vertices, and with the
    /// offset of the two centres in the frame that all of it is in.
    #[inline]
    fn new(hull: &Hull, turn: impl Fn(Row) -> Row, offset: Vec4, others: &[Row; ROWS]) -> Self {
        let mut bounds = Self {
            widths: [[[Vec4::ZERO; ROWS]; 4]; FOURS],
            tops: [Vec4::INFINITY; FOURS],
            normals: [[Vec4::ZERO; 3]; FOURS],
            fours: (hull.face_count() as usize).div_ceil(4).min(FOURS),
        };
        let [to_x, to_y, to_z, _] = offset.to_array().map(Vec4::splat);
        let mut fill = |number: usize, [x, y, z, height]: Planes| {
            let [x, y, z] = turn([x, y, z]);
            // How far the faces lie from the centre, less how far the offset leads along their normals:
            // what the pair is wide there beside the other hull's part.
            let beyond = height - (x * to_x + y * to_y + z * to_z);
            let normals = [x, y, z, beyond].map(|all| all.to_array());
            let (Some(widths), Some(place), Some(turned)) = (
                bounds.widths.get_mut(number),
                bounds.tops.get_mut(number),
                bounds.normals.get_mut(number),
            ) else {
                return;
            };
            *turned = [x, y, z];
            let mut tops = [Vec4::NEG_INFINITY; 4];
            for (lane, (widths, tops)) in widths.iter_mut().zip(&mut tops).enumerate() {
                let [x, y, z, beyond] = normals.map(|all| Vec4::splat(all[lane]));
                for (width, &[xs, ys, zs]) in widths.iter_mut().zip(others) {
                    *width = beyond + (x * xs + y * ys + z * zs);
                    *tops = tops.max(*width);
                }
            }
            let [a, b, c, d] = sketch::transposed(tops);
            *place = a.max(b).max(c.max(d));
        };
        if let Some(sketch) = hull.sketch() {
            (0..)
                .zip(sketch.planes())
                .for_each(|(number, planes)| fill(number, planes));
        } else {
            for number in 0..bounds.fours {
                let plane = |lane| hull.plane(4 * number + lane);
                fill(number, sketch::planes(std::array::from_fn(plane)));
            }
        }
        bounds
    }

    /// The face along whose normal the pair may be least wide.
    #[inline]
    fn least(&self) -> (u32, f32) {
        let least = self.tops.iter().fold(Vec4::INFINITY, |a, &b| a.min(b));
        let least = least.min_element();
        let face = self.up_to(least).next();
        (face.unwrap_or(0), least)
    }

    /// The faces along whose normals the pair may be no wider than `limit`.
    #[inline]
    fn up_to(&self, limit: f32) -> impl Iterator<Item = u32> {
        let limit = Vec4::splat(limit);
        let mut bits = 0;
        for (number, tops) in self.tops.iter().enumerate() {
            bits |= tops.cmple(limit).bitmask() << (4 * number);
        }
        sketch::numbers(bits)
    }

    /// For each face the vertices beside which the pair is wider than `limit` along the face's normal.
    #[inline]
    fn beyond(&self, limit: f32) -> [Bits; Sketch::FACES] {
        let limit = Vec4::splat(limit);
        let mut beyond = [0; Sketch::FACES];
        let faces = self.widths.iter().take(self.fours).flatten();
        for (bits, widths) in beyond.iter_mut().zip(faces) {
            for (row, width) in widths.iter().enumerate() {
                *bits |= width.cmpgt(limit).bitmask() << (4 * row);
            }
        }
        beyond
    }

    /// The edges along whose arcs the pair may be no wider than `limit` somewhere.
    ///
    /// A point of the edge and a vertex of the other hull make a point of the Minkowski
    /// difference, beyond which the difference reaches all along the arc. On an arc between two unit
    /// vectors p and q lies αp + βq with α and β of one sign and α + β at least 1: if that point
    /// lies farther than `limit` along both, it does so along all of the arc.
    #[inline]
    fn edges<'r>(&self, hull: &Hull, limit: f32, room: &'r mut [u8; ROOM]) -> &'r [u8] {
        let beyond = self.beyond(limit);
        let (mut count, mut number) = (0, 0);
        hull.for_each_joint(|Joint { faces, .. }| {
            let [left, right] = faces.map(|face| beyond[usize::from(face) % Sketch::FACES]);
            // Written in any case, and overwritten if it is too wide: no branch.
            room[count % ROOM] = number;
            count += usize::from(left & right == 0);
            number += 1;
        });
        room.get(..count).unwrap_or_default()
    }

    /// An edge's arc roughly, of a hull with these vertices.
    #[inline]
    fn rough_arc(&self, joint: Joint, vertices: &[Row; ROWS]) -> RoughArc {
        let of = |rows: &[Row], number: u8| match rows.get(usize::from(number) / 4) {
            Some(row) => Vec3::from_array(row.map(|all| all[usize::from(number) % 4])),
            None => Vec3::ZERO,
        };
        let [from, to] = joint.vertices.map(|vertex| of(vertices, vertex));
        RoughArc {
            edge: to - from,
            ends: joint.faces.map(|face| of(&self.normals, face)),
        }
    }
}

/// An edge and the arc of directions along which it is the support, in single precision.
#[derive(Clone, Copy)]
struct RoughArc {
    /// From one end of the edge to the other.
    edge: Vec3,
    ends: [Vec3; 2],
}

impl RoughArc {
    /// What rounding may do to a height in [`may_cross`](Self::may_cross), and as much again, as a share of
    /// the radius: what is above it is far above what [`Arc::crossing`] lets pass.
    const MARGIN: f32 = 1e-5;

    /// Whether the arcs may cross: the ends of each on opposite sides of the other's plane. `radii` are
    /// those of the edges' hulls.
    #[inline]
    fn may_cross(&self, other: &Self, radii: [f32; 2]) -> bool {
        let is_between = |arc: &Self, across: &Self, radius: f32| {
            let [one, next] = across.ends.map(|end| end.dot(arc.edge));
            let margin = Self::MARGIN * radius;
            !(one.min(next) > margin || one.max(next) < -margin)
        };
        is_between(self, other, radii[0]) && is_between(other, self, radii[1])
    }
}

/// The arc of an edge; `sign` −1 for a hull turned round.
#[inline]
fn arc(hull: &Hull, edge: u8, sign: f64) -> Option<Arc> {
    let joint = hull.joint(edge)?;
    let vertices = joint.vertices.map(u32::from);
    Some(Arc {
        point: hull.point(vertices[0]),
        along: unit(hull.edge_vector(vertices))?,
        ends: joint
            .faces
            .map(|face| sign * hull.face_normal(u32::from(face))),
    })
}

/// The least of the widths shown to it; of widths that differ by rounding, the first.
struct Least {
    rounding: f64,
    best: Option<Width>,
    /// Where the pair is wider than this nothing need be looked at.
    most: f64,
    /// What telling so in single precision may be off by.
    margin: f64,
}

impl Least {
    fn beats(&self, width: f64) -> bool {
        self.best
            .is_none_or(|best| width < best.width - self.rounding)
    }

    fn show(&mut self, shown: Width) {
        if self.beats(shown.width) {
            self.best = Some(shown);
            self.limit(shown.width);
        }
    }

    /// There is a direction with this width.
    fn limit(&mut self, width: f64) {
        self.most = self.most.min(width + 4.0 * self.rounding);
    }

    fn rough(&self) -> f32 {
        (self.most + self.margin) as f32
    }
}

/// The least width over all directions, or one of no more than touch if there is such a
/// one; none if rounding left no direction at all.
///
/// What the pair is wide along the normals of faces bounds it along the arcs between them: those
/// that are wider than what has been found, all along, need not be crossed with others.
pub(super) fn least(pair: &Pair) -> Option<Width> {
    let (a, b) = (&pair.a, &pair.b);
    let vertices = a.vertex_count().max(b.vertex_count());
    let faces = a.face_count().max(b.face_count()) as usize;
    if vertices <= 4 * FEW_ROWS && faces <= 4 * FEW_FOURS {
        search::<FEW_ROWS, FEW_FOURS>(pair)
    } else {
        search::<ROWS, FOURS>(pair)
    }
}

/// [`least`], of hulls for which there is room.
fn search<const ROWS: usize, const FOURS: usize>(pair: &Pair) -> Option<Width> {
    let mut least = Least {
        rounding: pair.rounding(),
        best: None,
        most: f64::INFINITY,
        margin: SINGLE * (pair.size + pair.offset.length())
            + pair.a.plane_error()
            + pair.b.plane_error(),
    };
    let to_b = pair.b.rotation().transpose();
    let turn = turned_round(to_b * pair.a.rotation());
    let vertices_a: [Row; ROWS] = vertices(&pair.a, &turn);
    let vertices_b: [Row; ROWS] = vertices(&pair.b, |row| row);
    let offset = to_b * pair.offset;
    if let Some(between) = unit(offset) {
        // Most pairs that are apart are so along this line.
        let [along, ahead] = [between, offset].map(single);
        let rough =
            f64::from(reach(&vertices_a, along) + reach(&vertices_b, along) - ahead.dot(along));
        if rough <= pair.touch + least.margin {
            let between = pair.width(pair.b.rotation() * between);
            if between.width <= pair.touch {
                // Any direction will do.
                return Some(between);
            }
        }
        least.limit(rough + least.margin);
    }
    let offset = single(offset);
    let beside_a = Bounds::<ROWS, FOURS>::new(&pair.a, &turn, offset, &vertices_b);
    let beside_b = Bounds::<ROWS, FOURS>::new(&pair.b, |row| row, offset, &vertices_a);
    let normal_a = |face: u32| -pair.a.face_normal(face);
    let normal_b = |face: u32| pair.b.face_normal(face);
    // The best face first: few others are left then.
    let (best_a, best_b) = (beside_a.least(), beside_b.least());
    let (is_of_a, face, normal) = if best_a.1 <= best_b.1 {
        (true, best_a.0, normal_a(best_a.0))
    } else {
        (false, best_b.0, normal_b(best_b.0))
    };
    let best = (is_of_a, face);
    // A normal that could not be made is zero.
    let mut shown_best = None;
    if normal != DVec3::ZERO {
        let shown = pair.width(normal);
        if shown.width <= pair.touch {
            return Some(shown);
        }
        least.limit(shown.width);
        shown_best = Some(shown);
    }
    let limit = least.rough();
    let normals = (beside_a.up_to(limit).map(|face| (true, face)))
        .chain(beside_b.up_to(limit).map(|face| (false, face)));
    for (is_of_a, face) in normals {
        let shown = if (is_of_a, face) == best {
            shown_best
        } else {
            let normal = if is_of_a {
                normal_a(face)
            } else {
                normal_b(face)
            };
            (normal != DVec3::ZERO).then(|| pair.width(normal))
        };
        if let Some(shown) = shown {
            if shown.width <= pair.touch {
                return Some(shown);
            }
            least.show(shown);
        }
    }
    let mut rooms = [[0; ROOM]; 2];
    let [room_a, room_b] = &mut rooms;
    let edges_a = beside_a.edges(&pair.a, least.rough(), room_a);
    let edges_b = beside_b.edges(&pair.b, least.rough(), room_b);
    let radii = [&pair.a, &pair.b].map(|hull| hull.radius as f32);
    for &edge_a in edges_a {
        let Some(joint) = pair.a.joint(edge_a) else {
            continue;
        };
        let rough = beside_a.rough_arc(joint, &vertices_a);
        let mut a = None;
        for &edge_b in edges_b {
            let Some(joint) = pair.b.joint(edge_b) else {
                continue;
            };
            if !rough.may_cross(&beside_b.rough_arc(joint, &vertices_b), radii) {
                continue;
            }
            a = a.or_else(|| arc(&pair.a, edge_a, -1.0));
            if let (Some(a), Some(b)) = (&a, arc(&pair.b, edge_b, 1.0))
                && let Some(direction) = a.crossing(&b)
                && least.beats((b.point - a.point).dot(direction))
            {
                least.show(pair.width(direction));
            }
        }
    }
    least.best
}

/// How A's vectors lie in B's frame, turned round, four at a time.
fn turned_round(turn: DMat3) -> impl Fn(Row) -> Row {
    let columns = [turn.x_axis, turn.y_axis, turn.z_axis];
    let [u, v, w] = columns.map(|column| single(-column).to_array().map(Vec4::splat));
    move |[x, y, z]| std::array::from_fn(|axis| u[axis] * x + v[axis] * y + w[axis] * z)
}
