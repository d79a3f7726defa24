//! The farthest vertex of a body, again and again.

use super::body::Body;
use crate::geometry::{Lanes, Polytope, Shape};
use glam::{DMat3, DVec3};

/// How closely a farthest vertex is sought. Only the end of a search need be right; on the way
/// there what is nearly farthest does as well and costs less.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Care {
    /// Whatever a table of directions has.
    Coarse,
    /// Of a polytope with many vertices the farthest around that one, of others the farthest to within
    /// [`Lanes::ERROR`].
    Close,
    /// To within rounding.
    Closest,
}

/// A body's vertices along the axes of a search, about the body's centre.
pub(super) struct Extremes<'a> {
    body: &'a Body<'a>,
    /// From the shape's frame to the search's.
    turn: DMat3,
    vertices: Vertices<'a>,
}

/// What a body's vertices are sought among.
enum Vertices<'a> {
    Plain,
    /// A polytope's with few.
    Few(&'a Polytope, &'a [Lanes]),
    /// A polytope's with many.
    Many(&'a Polytope),
}

impl<'a> Extremes<'a> {
    #[inline(always)]
    pub(super) fn new(body: &'a Body<'a>, turn: DMat3) -> Self {
        let vertices = match body.shape {
            Shape::Polytope(polytope) => match polytope.lanes() {
                [] => Vertices::Many(polytope),
                lanes => Vertices::Few(polytope, lanes),
            },
            _ => Vertices::Plain,
        };
        Self {
            body,
            turn,
            vertices,
        }
    }

    /// With how much care to begin: more would be wasted, and less is no cheaper.
    #[inline]
    pub(super) fn least_care(&self) -> Care {
        match self.vertices {
            Vertices::Many(_) => Care::Coarse,
            Vertices::Few(..) => Care::Close,
            Vertices::Plain => Care::Closest,
        }
    }

    /// By how much less than the farthest vertex the one found may reach along a unit vector, in
    /// metres.
    pub(super) fn error(&self, care: Care) -> f64 {
        let share = match (&self.vertices, care) {
            (Vertices::Many(polytope), Care::Coarse | Care::Close) => polytope.table_error(),
            (Vertices::Few(..), Care::Coarse | Care::Close) => Lanes::ERROR,
            _ => 0.0,
        };
        share * self.body.radius
    }

    /// A vertex farthest along a direction of any length, to within [`error`](Self::error), and where
    /// it is.
    #[inline]
    pub(super) fn farthest(&self, direction: DVec3, care: Care) -> (u32, DVec3) {
        let direction = self.turn.transpose() * direction;
        let vertex = match (&self.vertices, care) {
            (Vertices::Few(_, lanes), Care::Coarse | Care::Close) => {
                Lanes::farthest(lanes, direction)
            }
            (Vertices::Many(polytope), Care::Coarse) => polytope.support_by_table(direction),
            (Vertices::Many(polytope), Care::Close) => polytope.support_by_ring(direction),
            (Vertices::Few(polytope, _) | Vertices::Many(polytope), Care::Closest) => {
                polytope.support(direction)
            }
            (Vertices::Plain, _) => self.body.support_local(direction),
        };
        (vertex, self.turn * self.body.local(vertex))
    }
}

impl Body<'_> {
    /// Whether all vertices but these lie lower along a unit vector of the world, by more
    /// than `margin`, a small share of the radius.
    ///
    /// The body is convex: of many vertices only neighbours need be looked at.
    #[inline]
    pub(super) fn stand_out<const N: usize>(
        &self,
        vertices: [u32; N],
        direction: DVec3,
        margin: f64,
    ) -> bool {
        let direction = self.rotation.transpose() * direction;
        let height = |vertex| direction.dot(self.local(vertex));
        let alone = || {
            let floor = vertices.map(height).into_iter().fold(f64::MAX, f64::min) - margin;
            let count = self.vertex_count() as u32;
            (0..count).all(|other| vertices.contains(&other) || height(other) < floor)
        };
        let Shape::Polytope(polytope) = self.shape else {
            return alone();
        };
        match polytope.lanes() {
            [] => vertices.iter().all(|&vertex| {
                let here = polytope.vertices()[vertex as usize];
                let neighbours = polytope.neighbours(vertex);
                let lower = |&other: &u32| {
                    let step = here - polytope.vertices()[other as usize];
                    vertices.contains(&other) || direction.dot(step) > margin
                };
                !neighbours.is_empty() && neighbours.iter().all(lower)
            }),
            lanes => {
                let count = polytope.vertices().len();
                Lanes::stand_out(lanes, count, vertices, direction) || alone()
            }
        }
    }
}
