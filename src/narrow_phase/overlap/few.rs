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
use glam::{DMat3, DVec3, Mat4, Vec4};

/// Hulls with more edges, faces or vertices are not small: of 18 points and more, or 32 where
/// three edges meet at each.
const EDGES: usize = 48;
const FACES: usize = 32;
const VERTICES: usize = ROWS * LANES;

/// Vertices looked at together: a register of SSE2.
const LANES: usize = 4;
const ROWS: usize = 8;

/// What hulls of up to 12 vertices need of rows, and what faces these can have: less room to fill.
const SMALL_ROWS: usize = 3;
const SMALL_FACES: usize = 20;

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
        hull.rim_normals().is_none()
            && hull.edges().len() <= EDGES
            && hull.face_count() as usize <= FACES
            && hull.vertex_count() <= VERTICES
    };
    is_small(&pair.a) && is_small(&pair.b)
}

/// Coordinates of four vertices: all x, all y, all z.
type Row = [Vec4; 3];

/// One hull's part in the Minkowski difference, roughly: B as seen from its centre, or A turned round.
struct Side<const ROWS: usize, const FACES: usize> {
    /// Vertices; the last fill up with the first.
    vertices: [Row; ROWS],
    /// Normals of the faces, and how far each face lies from the centre, less how far the offset of the
    /// two centres leads along its normal: what the pair is wide there beside the other hull's part.
    planes: [Vec4; FACES],
    faces: usize,
}

/// In single precision.
#[inline]
fn single(vector: DVec3) -> Vec4 {
    Vec4::new(vector.x as f32, vector.y as f32, vector.z as f32, 0.0)
}

impl<const ROWS: usize, const FACES: usize> Side<ROWS, FACES> {
    /// As seen along the axes of its own, turned by `turn`; `offset` in the frame it is turned to.
    #[inline]
    fn new(hull: &Hull, turn: impl Fn(Vec4) -> Vec4, offset: Vec4) -> Self {
        let mut side = Self {
            vertices: [[Vec4::ZERO; 3]; ROWS],
            planes: [Vec4::ZERO; FACES],
            faces: (hull.face_count() as usize).min(FACES),
        };
        let vertex = |index: usize| {
            hull.local_from_centre(index)
                .map(|local| turn(single(local)))
        };
        let first = vertex(0).unwrap_or(Vec4::ZERO);
        for (number, row) in side.vertices.iter_mut().enumerate() {
            let [a, b, c, d] =
                std::array::from_fn(|lane| vertex(LANES * number + lane).unwrap_or(first));
            let all = Mat4::from_cols(a, b, c, d).transpose();
            *row = [all.x_axis, all.y_axis, all.z_axis];
        }
        hull.for_each_plane(side.planes.iter_mut(), |normal, height, place| {
            let normal = turn(single(normal));
            *place = normal.with_w(height as f32 - normal.dot(offset));
        });
        side
    }

    /// What the pair is at least wide along a normal of the other side, by each of the vertices
    /// here; the largest of these numbers, too.
    #[inline]
    fn widths(&self, plane: Vec4, widths: &mut [Vec4; ROWS]) -> f32 {
        let [x, y, z, beyond] = plane.to_array().map(Vec4::splat);
        let mut tops = Vec4::NEG_INFINITY;
        for (widths, &[xs, ys, zs]) in widths.iter_mut().zip(&self.vertices) {
            *widths = beyond + (x * xs + y * ys + z * zs);
            tops = tops.max(*widths);
        }
        tops.max_element()
    }
}

/// What the pair is at least wide along the normals of one side's faces.
struct Bounds<const ROWS: usize, const FACES: usize> {
    /// By each of the other side's vertices.
    widths: [[Vec4; ROWS]; FACES],
    /// By all of them.
    tops: [f32; FACES],
}

impl<const ROWS: usize, const FACES: usize> Bounds<ROWS, FACES> {
    fn none() -> Self {
        Self {
            widths: [[Vec4::ZERO; ROWS]; FACES],
            tops: [f32::INFINITY; FACES],
        }
    }

    #[inline]
    fn fill(&mut self, side: &Side<ROWS, FACES>, other: &Side<ROWS, FACES>) {
        let places = self.widths.iter_mut().zip(&mut self.tops);
        for ((widths, top), &plane) in places.zip(&side.planes).take(side.faces) {
            *top = other.widths(plane, widths);
        }
    }

    /// The face along whose normal the pair may be least wide.
    #[inline]
    fn least(&self) -> (u32, f32) {
        let lower = |best: (u32, f32), face: (u32, &f32)| {
            if *face.1 < best.1 {
                (face.0, *face.1)
            } else {
                best
            }
        };
        (0..).zip(&self.tops).fold((0, f32::INFINITY), lower)
    }

    /// The edges along whose arcs the pair may be no wider than `limit` somewhere.
    ///
    /// A point of the edge and a vertex of the other hull make a point of the Minkowski
    /// difference, beyond which the difference reaches all along the arc. On an arc between two unit
    /// vectors p and q lies αp + βq with α and β of one sign and α + β at least 1: if that point
    /// lies farther than `limit` along both, it does so along all of the arc.
    #[inline]
    fn edges<'r>(&self, hull: &Hull, limit: f32, room: &'r mut [u8; EDGES]) -> &'r [u8] {
        let mut count = 0;
        for (number, edge) in (0..EDGES as u8).zip(hull.edges()) {
            let [left, right] = edge.faces.map(|face| self.widths.get(face as usize));
            let (Some(left), Some(right)) = (left, right) else {
                continue;
            };
            let tops = (left.iter().zip(right))
                .fold(Vec4::NEG_INFINITY, |tops, (&left, &right)| {
                    tops.max(left.min(right))
                });
            // Written in any case, and overwritten if it is too wide: no branch.
            if let Some(place) = room.get_mut(count) {
                *place = number;
            }
            count += usize::from(tops.max_element() <= limit);
        }
        room.get(..count).unwrap_or_default()
    }
}

/// The arc of an edge; `sign` −1 for a hull turned round.
#[inline]
fn arc(hull: &Hull, edge: u8, sign: f64) -> Option<Arc> {
    let edge = hull.edges().get(usize::from(edge))?;
    Some(Arc {
        point: hull.point(edge.vertices[0]),
        along: unit(hull.edge_vector(edge))?,
        ends: edge.faces.map(|face| sign * hull.face_normal(face)),
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
    // Before anything is made ready: most pairs that are apart are so along this line.
    let between = unit(pair.offset).map(|direction| pair.width(direction));
    let first = between.map_or(f64::INFINITY, |between| between.width);
    if first <= pair.touch {
        // Any direction will do.
        return between;
    }
    let most = pair.a.vertex_count().max(pair.b.vertex_count());
    if most <= SMALL_ROWS * LANES {
        search::<SMALL_ROWS, SMALL_FACES>(pair, first)
    } else {
        search::<ROWS, FACES>(pair, first)
    }
}

/// [`least`], of which it is known that it is no more than `first`.
fn search<const ROWS: usize, const FACES: usize>(pair: &Pair, first: f64) -> Option<Width> {
    let rounding = pair.rounding();
    let mut least = Least {
        rounding,
        best: None,
        most: first + 4.0 * rounding,
        margin: SINGLE * (pair.size + pair.offset.length())
            + pair.a.plane_error()
            + pair.b.plane_error(),
    };
    let to_b = pair.b.rotation().transpose();
    let offset = single(to_b * pair.offset);
    let turn = turned_round(to_b * pair.a.rotation());
    let a = Side::<ROWS, FACES>::new(&pair.a, turn, offset);
    let b = Side::<ROWS, FACES>::new(&pair.b, |vector| vector, offset);
    let (mut beside_a, mut beside_b) = (Bounds::none(), Bounds::none());
    beside_a.fill(&a, &b);
    beside_b.fill(&b, &a);
    let normal_a = |face: u32| -pair.a.face_normal(face);
    let normal_b = |face: u32| pair.b.face_normal(face);
    // The best face first: few others are left then.
    let (best_a, best_b) = (beside_a.least(), beside_b.least());
    let normal = if best_a.1 <= best_b.1 {
        normal_a(best_a.0)
    } else {
        normal_b(best_b.0)
    };
    // A normal that could not be made is zero.
    if normal != DVec3::ZERO {
        let shown = pair.width(normal);
        if shown.width <= pair.touch {
            return Some(shown);
        }
        least.limit(shown.width);
    }
    let faces_a = (0..).zip(&beside_a.tops).take(a.faces);
    let faces_b = (0..).zip(&beside_b.tops).take(b.faces);
    let normals = faces_a
        .map(|(face, &top)| (face, top, true))
        .chain(faces_b.map(|(face, &top)| (face, top, false)));
    for (face, top, is_of_a) in normals {
        if top > least.rough() {
            continue;
        }
        let normal = if is_of_a {
            normal_a(face)
        } else {
            normal_b(face)
        };
        if normal != DVec3::ZERO {
            let shown = pair.width(normal);
            if shown.width <= pair.touch {
                return Some(shown);
            }
            least.show(shown);
        }
    }
    let mut rooms = [[0; EDGES]; 2];
    let [room_a, room_b] = &mut rooms;
    let edges_a = beside_a.edges(&pair.a, least.rough(), room_a);
    let edges_b = beside_b.edges(&pair.b, least.rough(), room_b);
    if edges_b.len() <= FEW_ARCS {
        cross::<FEW_ARCS>(pair, (edges_a, edges_b), &mut least);
    } else {
        cross::<EDGES>(pair, (edges_a, edges_b), &mut least);
    }
    least.best
}

/// Most pairs leave fewer edges of a hull; to make room for more than there are takes as long as to
/// fill it.
const FEW_ARCS: usize = 8;

/// Shows all directions in which arcs of two hulls' edges cross; B has up to `N`.
fn cross<const N: usize>(pair: &Pair, (edges_a, edges_b): (&[u8], &[u8]), least: &mut Least) {
    if edges_a.is_empty() {
        return;
    }
    let mut arcs = [Arc::default(); N];
    let mut count = 0;
    for (place, made) in
        (arcs.iter_mut()).zip(edges_b.iter().filter_map(|&edge| arc(&pair.b, edge, 1.0)))
    {
        *place = made;
        count += 1;
    }
    for a in edges_a.iter().filter_map(|&edge| arc(&pair.a, edge, -1.0)) {
        for b in arcs.iter().take(count) {
            if let Some(direction) = a.crossing(b)
                && least.beats((b.point - a.point).dot(direction))
            {
                least.show(pair.width(direction));
            }
        }
    }
}

/// How A's vectors lie in B's frame, turned round.
fn turned_round(turn: DMat3) -> impl Fn(Vec4) -> Vec4 {
    let [x, y, z] = [turn.x_axis, turn.y_axis, turn.z_axis].map(|column| single(-column));
    move |vector| vector.x * x + vector.y * y + vector.z * z
}
