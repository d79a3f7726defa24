//! What is asked of a hierarchy.

use super::block::{Block, WIDTH};
use super::bounds::Bounds;
use super::tree::NOBODY;
use super::{Leaf, View};
use crate::geometry::{Aabb, Ray};
use glam::{DVec3, Vec3, Vec4};

/// Which of eight boxes are of interest, a bit for each, and how far away these are at least.
type Near = (u32, [f32; WIDTH]);

/// What boxes are compared with.
trait Probe {
    /// The boxes that are no farther away than `limit`.
    fn near(&self, block: &Block, limit: f32) -> Near;
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
    /// By axis: the corner that meets the near side of a box, rounded outward, and the one
    /// that leaves the far side.
    first: Vec3,
    last: Vec3,
    /// One over the direction, whose largest component is 1.
    inverse: Vec3,
}

impl Line {
    fn new(from: &Bounds, direction: Vec3) -> Self {
        let inverse = Vec3::from_array(direction.to_array().map(inverse));
        let forward = inverse.cmpgt(Vec3::ZERO);
        Self {
            first: Vec3::select(forward, from.max, from.min),
            last: Vec3::select(forward, from.min, from.max),
            inverse,
        }
    }
}

impl Probe for Line {
    #[inline]
    fn near(&self, block: &Block, limit: f32) -> Near {
        let mut enter = [Vec4::ZERO; 2];
        let mut leave = [Vec4::splat(limit); 2];
        for axis in 0..3 {
            let (min, max) = block.sides(axis);
            let inverse = self.inverse[axis];
            let (near, far) = if inverse > 0.0 {
                (min, max)
            } else {
                (max, min)
            };
            for half in 0..2 {
                // No NaN but for boxes that hold nothing, which enter after all others leave.
                enter[half] = enter[half].max((near[half] - self.first[axis]) * inverse);
                leave[half] = leave[half].min((far[half] - self.last[axis]) * inverse);
            }
        }
        let mut hits = 0;
        for half in 0..2 {
            enter[half] *= 1.0 - ROUNDING;
            let late = leave[half] + ROUNDING * leave[half].abs();
            hits |= enter[half].cmple(late).bitmask() << (4 * half);
        }
        (hits, eight(enter))
    }
}

/// Eight numbers of two halves.
#[inline]
fn eight([low, high]: [Vec4; 2]) -> [f32; WIDTH] {
    let ([a, b, c, d], [e, f, g, h]) = (low.to_array(), high.to_array());
    [a, b, c, d, e, f, g, h]
}

/// A box that stands.
struct Region(Bounds);

impl Probe for Region {
    #[inline]
    fn near(&self, block: &Block, _: f32) -> Near {
        (block.overlaps(&self.0), [0.0; WIDTH])
    }
}

/// A point, as the box that rounding makes of it.
struct Place(Bounds);

impl Probe for Place {
    #[inline]
    fn near(&self, block: &Block, limit: f32) -> Near {
        let mut squares = [Vec4::ZERO; 2];
        for axis in 0..3 {
            let (min, max) = block.sides(axis);
            for half in 0..2 {
                let below = min[half] - self.0.max[axis];
                let above = self.0.min[axis] - max[half];
                let off = below.max(above).max(Vec4::ZERO);
                squares[half] += off * off;
            }
        }
        let distances = eight(squares).map(|square| square.sqrt() * (1.0 - ROUNDING));
        let mut hits = 0;
        for (lane, distance) in distances.iter().enumerate() {
            // What holds nothing is infinitely far away.
            let is_near = *distance <= limit && *distance < f32::INFINITY;
            hits |= u32::from(is_near) << lane;
        }
        (hits, distances)
    }
}

/// A node or leaf that is to be looked at.
#[derive(Debug, Clone, Copy, Default)]
struct Entry {
    distance: f32,
    /// Levels below the node's own, and its own; zero for a leaf.
    above: u32,
    index: u32,
}

/// Entries at a time: at most seven more than are taken for each of the eleven levels that
/// 2³² leaves make.
const STACK: usize = 96;

impl<T: Copy + Sync> View<'_, T> {
    /// The bodies whose boxes are nearest to a point, which is given with its
    /// rounding as a box; nearest first, roughly.
    ///
    /// `visit` answers with the distance, in metres, beyond which nothing is of
    /// interest any more.
    pub fn near(&self, place: &Aabb, mut visit: impl FnMut(Leaf<'_, T>) -> f64) {
        let place = Place(Bounds::around(place, self.bvh.origin));
        self.search(&place, f32::INFINITY, |leaf| {
            (visit(leaf) * (1.0 + 1e-6)) as f32
        });
    }

    /// All bodies whose boxes overlap `aabb`, in no particular order.
    ///
    /// Boxes are those of the last [`Bvh::update`](super::Bvh::update); bodies that wait are
    /// visited in any case.
    pub fn overlapping(&self, aabb: &Aabb, mut visit: impl FnMut(Leaf<'_, T>)) {
        let region = Region(Bounds::around(aabb, self.bvh.origin));
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
            self.bvh.origin,
        );
        let line = Line::new(&from, direction);
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
        for (_, slot, data) in &self.bvh.waiting {
            let id = super::LeafId::WAITING;
            limit = limit.min(visit(Leaf {
                id,
                slot: *slot,
                data,
            }));
        }
        for (number, tree) in self.bvh.trees.iter().enumerate() {
            let levels = match self.moment {
                Some(moment) => moment.trees.get(number),
                None => Some(&tree.levels),
            };
            if let Some(levels) = levels
                && tree.live() > 0
            {
                search_levels(levels, probe, &mut limit, |index| {
                    let slot = *tree.leaves.get(index as usize)?;
                    let data = tree.data.get(index as usize)?;
                    let id = super::LeafId {
                        tree: number as u32,
                        leaf: index,
                    };
                    (slot != NOBODY).then(|| visit(Leaf { id, slot, data }))
                });
            }
        }
    }
}

/// Visits the leaves below these levels.
fn search_levels(
    levels: &[Vec<Block>],
    probe: &impl Probe,
    limit: &mut f32,
    mut visit: impl FnMut(u32) -> Option<f32>,
) {
    // Of zeros, which are written by the page.
    let mut stack = [Entry::default(); STACK];
    stack[0].above = levels.len() as u32;
    let mut count = 1_usize;
    while let Some(&Entry {
        distance,
        above,
        index,
    }) = count.checked_sub(1).and_then(|last| stack.get(last))
    {
        count -= 1;
        if distance > *limit {
            continue;
        }
        let Some(level) = above.checked_sub(1) else {
            if let Some(bound) = visit(index) {
                *limit = limit.min(bound);
            }
            continue;
        };
        let blocks = levels.get(level as usize);
        let Some(block) = blocks.and_then(|blocks| blocks.get(index as usize)) else {
            continue;
        };
        let (mut hits, distances) = probe.near(block, *limit);
        let start = count;
        while hits != 0 {
            let lane = hits.trailing_zeros();
            hits &= hits - 1;
            let entry = Entry {
                distance: distances[lane as usize % WIDTH],
                above: level,
                index: index * WIDTH as u32 + lane,
            };
            // The nearest is to be taken first, so it comes last; of equally near ones the first.
            let mut place = count.min(STACK - 1);
            while place > start && stack[place - 1].distance <= entry.distance {
                stack[place] = stack[place - 1];
                place -= 1;
            }
            stack[place] = entry;
            count = (count + 1).min(STACK);
        }
    }
}
