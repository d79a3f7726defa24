//! Growing a polytope inside the Minkowski difference until its nearest face is
//! a face of the difference itself.

use super::pair::Pair;
use super::{Width, unit};
use crate::math::exact::doubled_area;
use glam::DVec3;
use robust::{Coord3D, orient3d};
use std::cell::RefCell;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Points after which the growth gives up. Two hulls of 1000 vertices around
/// one centre take some thousands.
const MAX_POINTS: usize = 100_000;

/// Sine of the angle between the two shorter edges below which a face's normal is taken with
/// twice the digits. Lower, and the plane of a thin face does not go through its far corner.
const THIN: f64 = 0.1;

/// What the growth came to.
pub(super) enum Expansion {
    /// A direction of no more width than touch was met.
    Apart,
    /// The least width, within rounding.
    Least(Width),
    /// Out of the budget.
    Undecided,
}

/// The least width of the pair, starting from four points of its Minkowski
/// difference, the first three counter-clockwise seen from outside.
///
/// The nearest face is pushed out to the difference's support along its normal
/// until nothing moves. Distances are signed, so that the start need not hold
/// the origin. Every direction tried bounds the answer from above by a real
/// width, the nearest face of the polytope inside bounds it from below; between
/// them is rounding when it ends.
///
/// The polytope stays convex and closed because what a new point sees is decided
/// exactly. Faces so thin that their normals mean nothing may fail to move; they
/// are left aside, which costs no more than their thickness.
///
/// Source: van den Bergen (2001); predicates: Shewchuk (1997).
pub(super) fn least(pair: &Pair, start: [DVec3; 4]) -> Expansion {
    ROOM.with(|room| match room.try_borrow_mut() {
        Ok(mut inner) => {
            let least = grow(pair, start, &mut inner);
            if inner.points.capacity() > ROOMY {
                *inner = Inner::default();
            }
            least
        }
        Err(_) => grow(pair, start, &mut Inner::default()),
    })
}

/// So much room for points is kept from pair to pair: most take some dozens.
const ROOMY: usize = 4096;

thread_local! {
    /// Room that a thread has made for one pair and uses for the next, so that settled frames of a
    /// world do not allocate. Nothing in it outlives a call.
    static ROOM: RefCell<Inner> = RefCell::default();
}

/// [`least`], in the room given.
fn grow(pair: &Pair, start: [DVec3; 4], inner: &mut Inner) -> Expansion {
    if !inner.begin(start) {
        return Expansion::Undecided;
    }
    let mut best: Option<Width> = None;
    let rounding = pair.rounding();
    while inner.points.len() < MAX_POINTS {
        let Some(Nearest { face, distance }) = inner.queue.pop() else {
            break;
        };
        if best.is_some_and(|best| distance >= best.width - rounding) {
            break;
        }
        let Some(normal) = inner.faces[face].as_ref().map(|face| face.normal) else {
            continue;
        };
        let point = pair.support(normal);
        let width = point.dot(normal);
        if width <= pair.touch {
            return Expansion::Apart;
        }
        if best.is_none_or(|best| width < best.width) {
            best = Some(Width {
                direction: normal,
                width,
            });
        }
        if width - distance > rounding {
            inner.add(point, face);
        }
    }
    match best {
        Some(best) if inner.points.len() < MAX_POINTS => Expansion::Least(best),
        _ => Expansion::Undecided,
    }
}

/// A convex polytope of triangles.
#[derive(Default)]
struct Inner {
    points: Vec<DVec3>,
    /// None where a face was taken away.
    faces: Vec<Option<Face>>,
    queue: BinaryHeap<Nearest>,
    /// The edges around what the point being added sees, in order.
    horizon: Vec<Horizon>,
    /// Edges still to be looked across.
    ahead: Vec<Horizon>,
}

struct Face {
    vertices: [usize; 3],
    /// The face across the edge from vertex `i` to vertex `i + 1`.
    neighbours: [usize; 3],
    normal: DVec3,
}

/// An edge of a face that is seen, running counter-clockwise around it, and
/// the face on its other side.
struct Horizon {
    from: usize,
    to: usize,
    beyond: usize,
}

/// A face in the queue; the nearest comes first, and of equals the oldest.
struct Nearest {
    distance: f64,
    face: usize,
}

impl Inner {
    /// Makes a tetrahedron; answers false if the points lie in one plane or run the wrong way round.
    fn begin(&mut self, points: [DVec3; 4]) -> bool {
        self.points.clear();
        self.faces.clear();
        self.queue.clear();
        self.points.extend(points);
        let [a, b, c, d] = points;
        if !above([a, b, c], d).is_lt() {
            return false;
        }
        self.push([0, 1, 2], [1, 2, 3]);
        self.push([1, 0, 3], [0, 3, 2]);
        self.push([2, 1, 3], [0, 1, 3]);
        self.push([0, 2, 3], [0, 2, 1]);
        true
    }

    fn push(&mut self, vertices: [usize; 3], neighbours: [usize; 3]) {
        let [a, b, c] = vertices.map(|vertex| self.points[vertex]);
        let face = self.faces.len();
        let normal = normal([a, b, c]);
        if let Some(normal) = normal {
            self.queue.push(Nearest {
                distance: a.dot(normal).max(b.dot(normal)).max(c.dot(normal)),
                face,
            });
        }
        self.faces.push(Some(Face {
            vertices,
            neighbours,
            normal: normal.unwrap_or(DVec3::ZERO),
        }));
    }

    fn sees(&self, point: DVec3, face: usize) -> bool {
        self.faces[face].as_ref().is_some_and(|face| {
            above(face.vertices.map(|vertex| self.points[vertex]), point).is_gt()
        })
    }

    /// Takes in a point that lies outside `face`; does nothing if it does not.
    fn add(&mut self, point: DVec3, face: usize) {
        if !self.sees(point, face) {
            return;
        }
        self.look_around(point, face);
        let apex = self.points.len();
        self.points.push(point);
        let first = self.faces.len();
        let count = self.horizon.len();
        for index in 0..count {
            let Horizon { from, to, beyond } = self.horizon[index];
            let before = first + (index + count - 1) % count;
            let after = first + (index + 1) % count;
            self.push([from, to, apex], [beyond, after, before]);
            if let Some(beyond) = &mut self.faces[beyond] {
                for side in 0..3 {
                    if beyond.vertices[side] == to && beyond.vertices[(side + 1) % 3] == from {
                        beyond.neighbours[side] = first + index;
                    }
                }
            }
        }
    }

    /// Takes away the faces the point sees, `first` among them, and keeps the
    /// edges around them.
    fn look_around(&mut self, point: DVec3, first: usize) {
        self.horizon.clear();
        self.ahead.clear();
        // Depth first; each face is searched from the edge it was entered by
        // on, so that the edges come out counter-clockwise.
        self.leave(first, None);
        while let Some(edge) = self.ahead.pop() {
            if self.sees(point, edge.beyond) {
                self.leave(edge.beyond, Some(edge.to));
            } else if self.faces[edge.beyond].is_some() {
                self.horizon.push(edge);
            }
        }
    }

    /// Takes a face away and puts its edges on the stack, but for the one that
    /// starts at `entry`.
    fn leave(&mut self, face: usize, entry: Option<usize>) {
        let Some(face) = self.faces[face].take() else {
            return;
        };
        let entered = entry.and_then(|entry| face.vertices.iter().position(|&v| v == entry));
        let (start, count) = entered.map_or((0, 3), |side| (side + 1, 2));
        self.ahead
            .extend((start..start + count).rev().map(|side| Horizon {
                from: face.vertices[side % 3],
                to: face.vertices[(side + 1) % 3],
                beyond: face.neighbours[side % 3],
            }));
    }
}

/// On which side of the plane `a b c` the point lies: greater where its corners run
/// counter-clockwise. Exact.
fn above([a, b, c]: [DVec3; 3], point: DVec3) -> Ordering {
    let coordinates = |p: DVec3| Coord3D {
        x: p.x,
        y: p.y,
        z: p.z,
    };
    // Positive below the plane.
    let side = orient3d(
        coordinates(a),
        coordinates(b),
        coordinates(c),
        coordinates(point),
    );
    0.0_f64.partial_cmp(&side).unwrap_or(Ordering::Equal)
}

/// Unit normal from the two shorter edges, which give the least rounding.
fn normal([a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    let lengths = [
        a.distance_squared(b),
        b.distance_squared(c),
        c.distance_squared(a),
    ];
    let (first, second) = if lengths[0] >= lengths[1] && lengths[0] >= lengths[2] {
        (a - c, b - c)
    } else if lengths[1] >= lengths[2] {
        (b - a, c - a)
    } else {
        (c - b, a - b)
    };
    let cross = first.cross(second);
    let is_thin =
        cross.length_squared() < THIN * THIN * first.length_squared() * second.length_squared();
    unit(if is_thin {
        doubled_area(a, b, c)
    } else {
        cross
    })
}

impl PartialEq for Nearest {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Nearest {}

impl PartialOrd for Nearest {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Nearest {
    fn cmp(&self, other: &Self) -> Ordering {
        // The heap gives out the greatest.
        other
            .distance
            .total_cmp(&self.distance)
            .then(other.face.cmp(&self.face))
    }
}
