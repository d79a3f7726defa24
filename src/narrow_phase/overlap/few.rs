//! The least width of two small hulls, by the faces and edges that can have it.
//!
//! As [`faces`](super::faces), which looks at all of them. Two hulls of 12 points span
//! 900 pairs of edges; all but a few of them face where the pair is wider than some
//! face is. Which these are is told in single precision, with a margin for its rounding, in B's
//! frame, where nothing of B need be turned; what is left is measured as ever. No normal of a
//! face is looked at in double precision that does not take part in the answer, as a rule: on
//! the way to a body that was not looked at for a while each costs as much as a face's
//! width. Many times as fast as growing a polytope, and nothing is allocated.

use super::bounds::{Bounds, Lanes, Measured, ROOM, at, reach, vertices};
use super::faces::Arc;
use super::hull::Hull;
use super::pair::Pair;
use super::{Width, unit};
use crate::geometry::sketch::{Joint, Row, Sketch, single};
use glam::{DMat3, DVec3, Vec3, Vec4};

/// What hulls of up to 12 vertices need of rows of four vertices, and of fours of faces; what all small
/// ones need. Less room to fill.
const FEW_ROWS: usize = 3;
const FEW_FOURS: usize = 5;
const ROWS: usize = Sketch::VERTICES / 4;
const FOURS: usize = Sketch::FACES / 4;

/// So many of B's edges are crossed with A's at a time: nearly always all that are left.
const TOGETHER: usize = 16;

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

/// An edge and the arc of directions along which it is the support, in single precision.
#[derive(Clone, Copy, Default)]
struct RoughArc {
    /// One end of the edge.
    point: Vec3,
    /// From there to the other.
    edge: Vec3,
    ends: [Vec3; 2],
}

impl RoughArc {
    /// What rounding may do to a height in [`may_cross`](Self::may_cross), and as much again, as a share of
    /// the radius: what is above it is far above what [`Arc::crossing`] lets pass.
    const MARGIN: f32 = 1e-5;

    /// What rounding may do to an edge, and as much again, as a share of the radius: to two
    /// vertices, each turned and told from the other.
    const EDGE: f32 = 2e-6;

    /// Of an edge of a hull with these vertices and normals.
    #[inline]
    fn new<const ROWS: usize, const FOURS: usize>(
        joint: Joint,
        vertices: &[Lanes; ROWS],
        normals: &[Lanes; FOURS],
    ) -> Self {
        let [from, to] = joint.vertices.map(|vertex| at(vertices, vertex));
        Self {
            point: from,
            edge: to - from,
            ends: joint.faces.map(|face| at(normals, face)),
        }
    }

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

    /// How these arcs, which [may](Self::may_cross) cross, do so. Where the pair is wider than `limit` it
    /// is too wide; `size` is the sum of the radii and the offset.
    ///
    /// The direction is off by the edges' rounding beside the sine of their angle: told only where that
    /// is little.
    #[inline]
    fn crossing(
        &self,
        other: &Self,
        radii: [f32; 2],
        (offset, size): (Vec3, f32),
        limit: f32,
    ) -> Crossing {
        let cross = self.edge.cross(other.edge);
        let length = cross.length();
        let error = Self::EDGE * (radii[0] * other.edge.length() + radii[1] * self.edge.length());
        let sides = [self, other].map(|arc| cross.dot(arc.ends[0] + arc.ends[1]));
        if !(error < 1e-3 * length && sides[1].abs() > 0.01 * length) {
            return Crossing::Unclear;
        }
        // Positive on the side that both arcs lie on.
        let sign = sides[1].signum();
        let width = sign * (self.point + other.point - offset).dot(cross);
        let other_side = sign * sides[0];
        if other_side < -0.01 * length || width > limit * length + 2.0 * error * size {
            return Crossing::Useless;
        }
        let is_between = |arc: &Self, across: &Self, radius: f32| {
            let [one, next] = across.ends.map(|end| end.dot(arc.edge));
            one.min(next) < -Self::MARGIN * radius && one.max(next) > Self::MARGIN * radius
        };
        let is_clear = other_side > 0.01 * length
            && is_between(self, other, radii[0])
            && is_between(other, self, radii[1]);
        if is_clear {
            // A's edge is turned round.
            Crossing::Clear(-sign)
        } else {
            Crossing::Unclear
        }
    }
}

/// How two arcs cross, as far as single precision can tell.
#[derive(Clone, Copy)]
enum Crossing {
    /// Where the pair is too wide, or not at all: the one where the other's continuation passes, half way
    /// around the sphere.
    Useless,
    /// In the direction of the cross product of the two edges, times this sign.
    Clear(f32),
    /// If at all.
    Unclear,
}

impl Crossing {
    /// The direction of the crossing, and how wide the edges are there; of edges of A and B.
    fn measured(self, pair: &Pair, edge_a: u8, edge_b: u8) -> Option<(DVec3, f64)> {
        match self {
            Self::Useless => None,
            Self::Clear(sign) => {
                // No normal of a face need be fetched.
                let ((from_a, a), (from_b, b)) = (line(&pair.a, edge_a)?, line(&pair.b, edge_b)?);
                let direction = unit(a.cross(b))?;
                let direction = if sign < 0.0 { -direction } else { direction };
                Some((direction, (from_b - from_a).dot(direction)))
            }
            Self::Unclear => {
                let (a, b) = (arc(&pair.a, edge_a, -1.0)?, arc(&pair.b, edge_b, 1.0)?);
                let direction = a.crossing(&b)?;
                Some((direction, (b.point - a.point).dot(direction)))
            }
        }
    }
}

/// One end of an edge and the unit vector along it.
fn line(hull: &Hull, edge: u8) -> Option<(DVec3, DVec3)> {
    let vertices = hull.joint(edge)?.vertices.map(u32::from);
    Some((hull.point(vertices[0]), unit(hull.edge_vector(vertices))?))
}

/// The arc of an edge; `sign` −1 for a hull turned round.
#[inline]
fn arc(hull: &Hull, edge: u8, sign: f64) -> Option<Arc> {
    let (point, along) = line(hull, edge)?;
    let ends = hull.joint(edge)?.faces;
    Some(Arc {
        point,
        along,
        ends: ends.map(|face| sign * hull.face_normal(u32::from(face))),
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
    let size = pair.size + pair.offset.length();
    let mut least = Least {
        rounding: pair.rounding(),
        best: None,
        most: f64::INFINITY,
        margin: SINGLE * size + pair.a.plane_error() + pair.b.plane_error(),
    };
    let to_b = pair.b.rotation().transpose();
    let turn = turned_round(to_b * pair.a.rotation());
    let vertices_a: [Lanes; ROWS] = vertices(&pair.a, &turn);
    let vertices_b: [Lanes; ROWS] = vertices(&pair.b, |row| row);
    let offset = to_b * pair.offset;
    let mut deepest = [0; 2];
    if let Some(between) = unit(offset) {
        // Most pairs that are apart are so along this line.
        let [along, ahead] = [between, offset].map(|vector| single(vector).truncate());
        let ((height_a, deepest_a), (height_b, deepest_b)) =
            (reach(&vertices_a, along), reach(&vertices_b, along));
        let rough = f64::from(height_a + height_b - ahead.dot(along));
        if rough <= pair.touch + least.margin {
            let between = pair.width(pair.b.rotation() * between);
            if between.width <= pair.touch {
                // Any direction will do.
                return Some(between);
            }
        }
        least.limit(rough + least.margin);
        deepest = [deepest_a, deepest_b];
    }
    let offset = single(offset);
    let mut beside_a = Bounds::<FOURS>::new(&pair.a, &turn, offset, &vertices_b, deepest[1]);
    let mut beside_b = Bounds::<FOURS>::new(&pair.b, |row| row, offset, &vertices_a, deepest[0]);
    let normal = |(is_of_a, face): (bool, u32)| {
        if is_of_a {
            -pair.a.face_normal(face)
        } else {
            pair.b.face_normal(face)
        }
    };
    let mut best = (f32::INFINITY, None);
    let mut note = |is_of_a: bool, Measured { face, width }, least: &mut Least| {
        if width < best.0 {
            best = (width, Some((is_of_a, face)));
            least.limit(f64::from(width) + least.margin);
        }
    };
    while let Some(measured) = beside_a.measure(least.rough(), &vertices_b) {
        note(true, measured, &mut least);
    }
    while let Some(measured) = beside_b.measure(least.rough(), &vertices_a) {
        note(false, measured, &mut least);
    }
    if let (width, Some(face)) = best
        && f64::from(width) <= pair.touch + least.margin
    {
        let shown = pair.width(normal(face));
        if shown.width <= pair.touch {
            return Some(shown);
        }
    }
    let limit = least.rough();
    let faces = (beside_a.up_to(limit).map(|face| (true, face)))
        .chain(beside_b.up_to(limit).map(|face| (false, face)));
    for face in faces {
        let shown = pair.width(normal(face));
        if shown.width <= pair.touch {
            return Some(shown);
        }
        least.show(shown);
    }
    let mut rooms = [[0; ROOM]; 2];
    let [room_a, room_b] = &mut rooms;
    let edges_a = beside_a.edges(&pair.a, least.rough(), room_a);
    let edges_b = beside_b.edges(&pair.b, least.rough(), room_b);
    let radii = [&pair.a, &pair.b].map(|hull| hull.radius as f32);
    let (offset, size) = (offset.truncate(), size as f32);
    let none = RoughArc::default();
    for edges_b in edges_b.chunks(TOGETHER) {
        let mut rough_b = [none; TOGETHER];
        for (place, joint) in
            (rough_b.iter_mut()).zip(edges_b.iter().map(|&edge| pair.b.joint(edge)))
        {
            *place = joint.map_or(none, |joint| {
                RoughArc::new(joint, &vertices_b, &beside_b.normals)
            });
        }
        for &edge_a in edges_a {
            let Some(joint) = pair.a.joint(edge_a) else {
                continue;
            };
            let rough_a = RoughArc::new(joint, &vertices_a, &beside_a.normals);
            for (&edge_b, rough_b) in edges_b.iter().zip(&rough_b) {
                if !rough_a.may_cross(rough_b, radii) {
                    continue;
                }
                let crossing = rough_a.crossing(rough_b, radii, (offset, size), least.rough());
                if let Some((direction, width)) = crossing.measured(pair, edge_a, edge_b)
                    && least.beats(width)
                {
                    least.show(pair.width(direction));
                }
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
