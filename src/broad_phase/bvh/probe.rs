//! What is asked of a hierarchy.

use super::block::{Block, WIDTH};
use super::bounds::Bounds;
use super::tree::NOBODY;
use super::{Bvh, Leaf};
use crate::geometry::{Aabb, Ray};
use glam::{DVec3, Vec3};

/// How far from a probe boxes are at least; infinitely far if they are of no interest.
trait Probe {
    fn distances(&self, block: &Block) -> [f32; WIDTH];
}

/// Share by which distances are lessened: some eight roundings of `f32`.
const ROUNDING: f32 = 1e-6;

/// One over a component of a direction whose largest is 1; finite, so that no
/// product with it is a NaN.
///
/// Boxes are at least 1e-13 m wide, and none is 1e17 m away: what the line does not
/// leave along this axis it leaves along another.
fn inverse(component: f32) -> f32 {
    const LARGEST: f32 = 1e30;
    if component.abs() > 1.0 / LARGEST {
        component.recip()
    } else {
        LARGEST
    }
}

/// A box that moves along a ray.
struct Line {
    /// Its corners as it starts, rounded outward.
    low: Vec3,
    high: Vec3,
    /// One over the direction, whose largest component is 1.
    inverse: Vec3,
}

impl Probe for Line {
    fn distances(&self, block: &Block) -> [f32; WIDTH] {
        let mut enter = [0.0_f32; WIDTH];
        let mut leave = [f32::INFINITY; WIDTH];
        for axis in 0..3 {
            let (min, max) = block.sides(axis);
            let inverse = self.inverse[axis];
            for lane in 0..WIDTH {
                let one = (min[lane] - self.high[axis]) * inverse;
                let other = (max[lane] - self.low[axis]) * inverse;
                let (low, high) = if one < other {
                    (one, other)
                } else {
                    (other, one)
                };
                // Not `max` and `min`, which mind NaN, of which there is none.
                enter[lane] = if low > enter[lane] { low } else { enter[lane] };
                leave[lane] = if high < leave[lane] {
                    high
                } else {
                    leave[lane]
                };
            }
        }
        let mut distances = [f32::INFINITY; WIDTH];
        for lane in 0..WIDTH {
            let nearest = enter[lane] - ROUNDING * enter[lane];
            if nearest <= leave[lane] + ROUNDING * leave[lane].abs() {
                distances[lane] = nearest;
            }
        }
        distances
    }
}

/// A box that stands.
struct Region(Bounds);

impl Probe for Region {
    fn distances(&self, block: &Block) -> [f32; WIDTH] {
        let hits = block.overlaps(&self.0);
        std::array::from_fn(|lane| {
            if hits >> lane & 1 == 1 {
                0.0
            } else {
                f32::INFINITY
            }
        })
    }
}

/// A point, as the box that rounding makes of it.
struct Place(Bounds);

impl Probe for Place {
    fn distances(&self, block: &Block) -> [f32; WIDTH] {
        let mut squares = [0.0_f32; WIDTH];
        for axis in 0..3 {
            let (min, max) = block.sides(axis);
            for lane in 0..WIDTH {
                let below = min[lane] - self.0.max[axis];
                let above = self.0.min[axis] - max[lane];
                let off = below.max(above).max(0.0);
                squares[lane] += off * off;
            }
        }
        squares.map(|square| square.sqrt() * (1.0 - ROUNDING))
    }
}

impl<T: Copy> Bvh<T> {
    /// The bodies whose boxes are nearest to a point, which is given with its
    /// rounding as a box; nearest first, roughly.
    ///
    /// `visit` answers with the distance, in metres, beyond which nothing is of
    /// interest any more.
    pub fn near(&self, place: &Aabb, mut visit: impl FnMut(Leaf<'_, T>) -> f64) {
        let place = Place(Bounds::around(place, self.origin));
        self.search(&place, f32::INFINITY, |leaf| {
            (visit(leaf) * (1.0 + 1e-6)) as f32
        });
    }

    /// All bodies whose boxes overlap `aabb`, in no particular order.
    ///
    /// Boxes are those of the last [`update`](Self::update); bodies that wait are
    /// visited in any case.
    pub fn overlapping(&self, aabb: &Aabb, mut visit: impl FnMut(Leaf<'_, T>)) {
        let region = Region(Bounds::around(aabb, self.origin));
        self.search(&region, f32::INFINITY, |leaf| {
            visit(leaf);
            f32::INFINITY
        });
    }

    /// All bodies whose boxes a box of these half extents meets on its way along
    /// `ray`, as far as fraction `until`; roughly in this order.
    ///
    /// `visit` answers with the fraction beyond which nothing is of interest any more.
    /// The ray must be finite, and its direction not zero.
    pub fn along(
        &self,
        (ray, half_extents): (&Ray, DVec3),
        until: f64,
        mut visit: impl FnMut(Leaf<'_, T>) -> f64,
    ) {
        let scale = ray.direction.abs().max_element();
        let direction = (ray.direction / scale).as_vec3();
        let from = Bounds::around(
            &Aabb {
                min: ray.origin - half_extents,
                max: ray.origin + half_extents,
            },
            self.origin,
        );
        let line = Line {
            low: from.min,
            high: from.max,
            inverse: Vec3::from_array(direction.to_array().map(inverse)),
        };
        // Distances count in scaled directions; rounded up.
        let scaled = |fraction: f64| (fraction * scale * (1.0 + 1e-6)) as f32;
        self.search(&line, scaled(until), |leaf| scaled(visit(leaf)));
    }

    /// Visits the leaves nearer than a limit, which every visit sets anew.
    fn search(
        &self,
        probe: &impl Probe,
        mut limit: f32,
        mut visit: impl FnMut(Leaf<'_, T>) -> f32,
    ) {
        for (_, slot, data) in &self.waiting {
            let id = super::LeafId::WAITING;
            limit = limit.min(visit(Leaf {
                id,
                slot: *slot,
                data,
            }));
        }
        let mut stack: Vec<(f32, u32, u32)> = Vec::with_capacity(64);
        for (number, tree) in (0..).zip(&self.trees) {
            if tree.live() == 0 {
                continue;
            }
            stack.clear();
            stack.push((0.0, tree.levels.len() as u32, 0));
            while let Some((distance, above, index)) = stack.pop() {
                if distance > limit {
                    continue;
                }
                if above == 0 {
                    let id = super::LeafId {
                        tree: number,
                        leaf: index,
                    };
                    if let Some(leaf) = self.at(id)
                        && leaf.slot != NOBODY
                    {
                        limit = limit.min(visit(leaf));
                    }
                    continue;
                }
                let level = above - 1;
                let blocks = tree.levels.get(level as usize);
                let Some(block) = blocks.and_then(|blocks| blocks.get(index as usize)) else {
                    continue;
                };
                let start = stack.len();
                for (lane, distance) in (0..).zip(probe.distances(block)) {
                    if distance <= limit && distance < f32::INFINITY {
                        stack.push((distance, level, index * WIDTH as u32 + lane));
                    }
                }
                // The nearest is taken first; of equally near ones the first.
                stack[start..].sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(b.2.cmp(&a.2)));
            }
        }
    }
}
