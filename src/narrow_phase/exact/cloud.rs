//! A body's vertices in the frame of a ray, in single precision.

use crate::geometry::{Lanes, Polytope};
use glam::DVec3;

/// Across the ray in two axes, then along it.
pub(super) type Vector = [f32; 3];

#[inline]
pub(super) fn dot([a, b, c]: Vector, [x, y, z]: Vector) -> f32 {
    a * x + b * y + c * z
}

pub(super) fn single(vector: DVec3) -> Vector {
    vector.to_array().map(|x| x as f32)
}

/// How a body's vertices, in shares of its radius, are turned into the frame of the ray.
#[derive(Clone, Copy)]
pub(super) struct Turn {
    /// Of the matrix that turns them.
    pub(super) columns: [Vector; 3],
    pub(super) shift: Vector,
}

impl Turn {
    #[inline(always)]
    fn of(&self, [x, y, z]: Vector) -> Vector {
        let [p, q, r] = self.columns;
        let axis = |i: usize| p[i] * x + q[i] * y + r[i] * z + self.shift[i];
        [axis(0), axis(1), axis(2)]
    }

    /// What is farthest along a direction is so along this one before it is turned.
    #[inline(always)]
    fn back(&self, direction: Vector) -> Vector {
        let [p, q, r] = self.columns;
        [dot(p, direction), dot(q, direction), dot(r, direction)]
    }
}

/// A body in the frame of the ray, in shares of the pair's size.
pub(super) trait Cloud {
    /// A vertex that is farthest, or nearly, and where it is.
    fn farthest(&self, direction: Vector) -> (u32, Vector);
}

/// Where it lies: a copy would cost as much as what is done with it.
impl<C: Cloud> Cloud for &C {
    #[inline(always)]
    fn farthest(&self, direction: Vector) -> (u32, Vector) {
        C::farthest(self, direction)
    }
}

/// All of a body's vertices, turned; blocks left over repeat the first.
pub(super) struct Turned<const N: usize>([Lanes; N]);

impl<const N: usize> Turned<N> {
    #[inline(always)]
    pub(super) fn of(list: &[Lanes], turn: &Turn) -> Self {
        let turned = |lanes: &Lanes| lanes.turned(&turn.columns, turn.shift);
        let mut lists = list.iter();
        let mut blocks = [lists.next().map_or(Lanes::NONE, turned); N];
        for (block, lanes) in blocks.iter_mut().skip(1).zip(lists) {
            *block = turned(lanes);
        }
        Self(blocks)
    }
}

impl<const N: usize> Cloud for Turned<N> {
    #[inline(always)]
    fn farthest(&self, direction: Vector) -> (u32, Vector) {
        let vertex = Lanes::highest_of(&self.0, direction);
        (vertex, Lanes::place(&self.0, vertex))
    }
}

/// A polytope with too many vertices to turn.
pub(super) struct Many<'a> {
    pub(super) polytope: &'a Polytope,
    pub(super) turn: Turn,
}

impl Cloud for Many<'_> {
    #[inline(always)]
    fn farthest(&self, direction: Vector) -> (u32, Vector) {
        let (vertex, place) = farthest_of_many(self.polytope, self.turn.back(direction));
        (vertex, self.turn.of(place))
    }
}

/// A vertex that is farthest along a direction of the polytope's own frame, or nearly, and where it is from the
/// centre, in shares of the radius.
#[inline(always)]
pub(super) fn farthest_of_many(polytope: &Polytope, direction: Vector) -> (u32, Vector) {
    let found = polytope.summits().highest(direction);
    found.unwrap_or_else(|| climb(polytope, direction))
}

#[cold]
fn climb(polytope: &Polytope, direction: Vector) -> (u32, Vector) {
    let vertex = polytope.support(DVec3::from(direction.map(f64::from)));
    let from = polytope.vertices()[vertex as usize] - polytope.centre();
    (vertex, single(from / polytope.max_dist()))
}
