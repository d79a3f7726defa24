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

/// All of a body's vertices, turned.
pub(super) struct Turned<const N: usize> {
    blocks: [Lanes; N],
    count: usize,
}

impl<const N: usize> Turned<N> {
    pub(super) const EMPTY: Self = Self {
        blocks: [Lanes::NONE; N],
        count: 0,
    };

    #[inline(always)]
    pub(super) fn fill(&mut self, list: &[Lanes], turn: &Turn) {
        for (block, lanes) in self.blocks.iter_mut().zip(list) {
            *block = lanes.turned(&turn.columns, turn.shift);
        }
        self.count = list.len().min(N);
    }
}

impl<const N: usize> Cloud for Turned<N> {
    #[inline(always)]
    fn farthest(&self, direction: Vector) -> (u32, Vector) {
        let blocks = &self.blocks[..self.count];
        let vertex = Lanes::highest(blocks, direction);
        (vertex, Lanes::place(blocks, vertex))
    }
}

/// Few vertices not turned yet.
pub(super) struct Unturned<'a> {
    pub(super) list: &'a [Lanes],
    pub(super) turn: Turn,
}

impl Cloud for Unturned<'_> {
    #[inline(always)]
    fn farthest(&self, direction: Vector) -> (u32, Vector) {
        let vertex = Lanes::highest(self.list, self.turn.back(direction));
        let place = Lanes::place(self.list, vertex);
        (vertex, self.turn.of(place))
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
        let local = self.turn.back(direction);
        let summits = self.polytope.summits();
        let (vertex, place) = (summits.highest(local)).unwrap_or_else(|| self.climb(local));
        (vertex, self.turn.of(place))
    }
}

impl Many<'_> {
    #[cold]
    fn climb(&self, direction: Vector) -> (u32, Vector) {
        let polytope = self.polytope;
        let vertex = polytope.support(DVec3::from(direction.map(f64::from)));
        let from = polytope.vertices()[vertex as usize] - polytope.centre();
        (vertex, single(from / polytope.max_dist()))
    }
}
