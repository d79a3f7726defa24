//! The farthest vertex of a body, again and again.

use super::body::Body;
use crate::geometry::{Polytope, Shape};
use glam::{DMat3, DVec3};

/// Vertices compared side by side: two registers of SSE2.
const LANES: usize = 4;

/// Up to this many vertices are all compared; a polytope with more is climbed. Measured by
/// `benches/exact_flat.rs`; only time depends on it.
const FEW: usize = 24;

/// A body's vertices along the axes of a search, about the body's centre.
#[expect(
    clippy::large_enum_variant,
    reason = "lives on the stack for one cast; boxed it would cost an allocation"
)]
pub(super) enum Extremes<'a> {
    Few(Cloud),
    Many(Climber<'a>),
}

impl<'a> Extremes<'a> {
    /// `turn` leads from the shape's frame to the search's.
    #[inline]
    pub(super) fn new(body: &Body<'a>, turn: &DMat3) -> Self {
        match body.shape {
            Shape::Polytope(polytope) if polytope.vertices().len() > FEW => Self::Many(Climber {
                polytope,
                centre: body.centre,
                turn: *turn,
                last: polytope.support(DVec3::ZERO),
            }),
            _ => Self::Few(Cloud::new(body, turn)),
        }
    }

    /// A vertex farthest along a direction of any length, and where it is.
    #[inline]
    pub(super) fn farthest(&mut self, direction: DVec3) -> (u32, DVec3) {
        match self {
            Self::Few(cloud) => cloud.farthest(direction),
            Self::Many(climber) => climber.farthest(direction),
        }
    }

    /// The same for a direction near that of the last call.
    #[inline]
    pub(super) fn farthest_nearby(&mut self, direction: DVec3) -> (u32, DVec3) {
        match self {
            Self::Few(cloud) => cloud.farthest(direction),
            Self::Many(climber) => climber.farthest_nearby(direction),
        }
    }
}

/// A few vertices, turned once and compared side by side.
pub(super) struct Cloud {
    blocks: [Block; FEW / LANES],
    used: usize,
}

#[derive(Clone, Copy)]
struct Block {
    x: [f64; LANES],
    y: [f64; LANES],
    z: [f64; LANES],
}

impl Cloud {
    #[inline]
    fn new(body: &Body, turn: &DMat3) -> Self {
        let mut cloud = Self {
            blocks: [Block {
                x: [0.0; LANES],
                y: [0.0; LANES],
                z: [0.0; LANES],
            }; FEW / LANES],
            used: 0,
        };
        match body.shape {
            Shape::Sphere(_) => {}
            Shape::Cuboid(cuboid) => {
                let half = cuboid.half_extents();
                let (x, y, z) = (
                    half.x * turn.x_axis,
                    half.y * turn.y_axis,
                    half.z * turn.z_axis,
                );
                let (sum, difference) = (x + y, x - y);
                cloud.fill(&[-sum - z, difference - z, -difference - z, sum - z]);
                cloud.fill(&[-sum + z, difference + z, -difference + z, sum + z]);
            }
            Shape::Triangle(triangle) => {
                let [a, b, c] = triangle.vertices().map(|v| *turn * (v - body.centre));
                cloud.fill(&[a, b, c]);
            }
            Shape::Polytope(polytope) => {
                for four in polytope.vertices().chunks(LANES) {
                    let mut turned = [DVec3::ZERO; LANES];
                    for (turned, vertex) in turned.iter_mut().zip(four) {
                        *turned = *turn * (*vertex - body.centre);
                    }
                    cloud.fill(&turned[..four.len()]);
                }
            }
        }
        cloud
    }

    /// One more block; lanes left over repeat the first vertex.
    #[inline]
    fn fill(&mut self, vertices: &[DVec3]) {
        let (Some(block), Some(&first)) = (self.blocks.get_mut(self.used), vertices.first()) else {
            debug_assert!(false, "more vertices than a cloud has room for");
            return;
        };
        for lane in 0..LANES {
            let vertex = vertices.get(lane).copied().unwrap_or(first);
            (block.x[lane], block.y[lane], block.z[lane]) = (vertex.x, vertex.y, vertex.z);
        }
        self.used += 1;
    }

    #[inline]
    fn farthest(&self, direction: DVec3) -> (u32, DVec3) {
        let mut most = [f64::NEG_INFINITY; LANES];
        // As numbers of the heights' own width, so that both are chosen by one mask.
        let mut blocks = [0.0; LANES];
        for (number, block) in self.blocks.iter().take(self.used).enumerate() {
            for lane in 0..LANES {
                let height = direction.x * block.x[lane]
                    + direction.y * block.y[lane]
                    + direction.z * block.z[lane];
                let higher = height > most[lane];
                most[lane] = if higher { height } else { most[lane] };
                blocks[lane] = if higher { number as f64 } else { blocks[lane] };
            }
        }
        let upper = |i: usize, j: usize| if most[j] > most[i] { j } else { i };
        let (low, high) = (upper(0, 1), upper(2, 3));
        let lane = upper(low, high);
        let block = blocks[lane] as usize;
        let Block { x, y, z } = &self.blocks[block];
        let place = DVec3::new(x[lane], y[lane], z[lane]);
        // A lane that repeats its block's first vertex never is the only highest.
        ((LANES * block + lane) as u32, place)
    }
}

/// A polytope of many vertices.
pub(super) struct Climber<'a> {
    polytope: &'a Polytope,
    centre: DVec3,
    turn: DMat3,
    last: u32,
}

impl Climber<'_> {
    fn farthest(&mut self, direction: DVec3) -> (u32, DVec3) {
        self.last = self.polytope.support(self.turn.transpose() * direction);
        self.here()
    }

    fn farthest_nearby(&mut self, direction: DVec3) -> (u32, DVec3) {
        let direction = self.turn.transpose() * direction;
        self.last = self.polytope.support_near(direction, self.last);
        self.here()
    }

    fn here(&self) -> (u32, DVec3) {
        let place = self.polytope.vertices()[self.last as usize] - self.centre;
        (self.last, self.turn * place)
    }
}
