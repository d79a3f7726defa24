//! The farthest vertex of a body, again and again.

use super::body::Body;
use crate::geometry::{Lanes, Polytope, Shape};
use glam::{DMat3, DVec3};

/// Room for a few vertices.
pub(super) type Few = [Lanes; Lanes::BLOCKS];

/// A body's vertices along the axes of a search, about the body's centre.
pub(super) enum Extremes<'a> {
    Few(&'a [Lanes]),
    Many(Climber<'a>),
}

impl<'a> Extremes<'a> {
    /// `turn` leads from the shape's frame to the search's.
    #[inline(always)]
    pub(super) fn turned(body: &Body<'a>, turn: &DMat3, few: &'a mut Few) -> Self {
        let axes = [turn.x_axis, turn.y_axis, turn.z_axis];
        let used = match body.shape {
            Shape::Sphere(_) => 0,
            Shape::Cuboid(cuboid) => {
                let half = cuboid.half_extents();
                let [x, y, z] = [half.x * axes[0], half.y * axes[1], half.z * axes[2]];
                let (sum, difference) = (x + y, x - y);
                few[0] = Lanes::new([-sum - z, difference - z, -difference - z, sum - z]);
                few[1] = Lanes::new([-sum + z, difference + z, -difference + z, sum + z]);
                2
            }
            Shape::Triangle(triangle) => {
                let [a, b, c] = triangle.vertices().map(|v| *turn * (v - body.centre));
                few[0] = Lanes::new([a, b, c, DVec3::NAN]);
                1
            }
            Shape::Polytope(polytope) => {
                let lanes = polytope.lanes();
                if lanes.is_empty() {
                    return Self::Many(Climber::new(polytope, body, turn));
                }
                for (turned, lanes) in few.iter_mut().zip(lanes) {
                    *turned = lanes.turned(axes);
                }
                lanes.len()
            }
        };
        Self::Few(&few[..used])
    }

    /// The same where the search's frame is the shape's.
    #[inline(always)]
    pub(super) fn standing(body: &Body<'a>, few: &'a mut Few) -> Self {
        match body.shape {
            Shape::Polytope(polytope) if !polytope.lanes().is_empty() => {
                Self::Few(polytope.lanes())
            }
            _ => Self::turned(body, &DMat3::IDENTITY, few),
        }
    }

    /// A vertex farthest along a direction of any length, and where it is.
    #[inline]
    pub(super) fn farthest(&mut self, direction: DVec3) -> (u32, DVec3) {
        match self {
            Self::Few(lanes) => Lanes::farthest(lanes, direction),
            Self::Many(climber) => climber.farthest(direction),
        }
    }

    /// The same for a direction near that of the last call.
    #[inline]
    pub(super) fn farthest_nearby(&mut self, direction: DVec3) -> (u32, DVec3) {
        match self {
            Self::Few(lanes) => Lanes::farthest(lanes, direction),
            Self::Many(climber) => climber.farthest_nearby(direction),
        }
    }

    /// Where a vertex is.
    #[inline]
    pub(super) fn vertex(&self, number: u32) -> DVec3 {
        match self {
            Self::Few(lanes) => Lanes::vertex(lanes, number),
            Self::Many(climber) => climber.place(number),
        }
    }

    /// Whether all vertices but these lie lower along a unit vector, by more than `margin`.
    ///
    /// The body is convex: of many vertices only neighbours need be looked at.
    #[inline]
    pub(super) fn stand_out<const N: usize>(
        &self,
        vertices: [u32; N],
        direction: DVec3,
        margin: f64,
    ) -> bool {
        match self {
            Self::Few(lanes) => {
                let heights = vertices.map(|vertex| direction.dot(Lanes::vertex(lanes, vertex)));
                let floor = heights.into_iter().fold(f64::INFINITY, f64::min) - margin;
                Lanes::count_above(lanes, direction, floor) == N
            }
            Self::Many(climber) => climber.stand_out(&vertices, direction, margin),
        }
    }
}

/// A polytope of many vertices.
pub(super) struct Climber<'a> {
    polytope: &'a Polytope,
    centre: DVec3,
    turn: DMat3,
    last: u32,
}

impl<'a> Climber<'a> {
    fn new(polytope: &'a Polytope, body: &Body<'a>, turn: &DMat3) -> Self {
        Self {
            polytope,
            centre: body.centre,
            turn: *turn,
            last: 0,
        }
    }

    fn farthest(&mut self, direction: DVec3) -> (u32, DVec3) {
        self.last = self.polytope.support(self.turn.transpose() * direction);
        (self.last, self.place(self.last))
    }

    fn farthest_nearby(&mut self, direction: DVec3) -> (u32, DVec3) {
        let direction = self.turn.transpose() * direction;
        self.last = self.polytope.support_near(direction, self.last);
        (self.last, self.place(self.last))
    }

    #[inline]
    fn place(&self, vertex: u32) -> DVec3 {
        self.turn * (self.polytope.vertices()[vertex as usize] - self.centre)
    }

    fn stand_out(&self, vertices: &[u32], direction: DVec3, margin: f64) -> bool {
        let direction = self.turn.transpose() * direction;
        let places = self.polytope.vertices();
        vertices.iter().all(|&vertex| {
            let here = places[vertex as usize];
            let neighbours = self.polytope.neighbours(vertex);
            let lower = |&other: &u32| {
                vertices.contains(&other) || direction.dot(here - places[other as usize]) > margin
            };
            !neighbours.is_empty() && neighbours.iter().all(lower)
        })
    }
}
