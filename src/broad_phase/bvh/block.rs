//! Eight boxes side by side.

use super::bounds::Bounds;
use glam::{Vec3, Vec4};

/// Boxes to a block, children to a node.
///
/// Two registers of four. With four, a hierarchy has twice the nodes; measured on
/// 100 000 balls its pairs take a third longer to find.
pub(super) const WIDTH: usize = 8;

/// The boxes of a node's children, coordinate by coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Block {
    min: [[f32; WIDTH]; 3],
    max: [[f32; WIDTH]; 3],
}

impl Block {
    pub(super) const EMPTY: Self = Self {
        min: [[f32::INFINITY; WIDTH]; 3],
        max: [[f32::NEG_INFINITY; WIDTH]; 3],
    };

    #[inline]
    pub(super) fn lane(&self, lane: usize) -> Bounds {
        let at = |sides: &[[f32; WIDTH]; 3]| {
            Vec3::new(
                sides[0][lane % WIDTH],
                sides[1][lane % WIDTH],
                sides[2][lane % WIDTH],
            )
        };
        Bounds {
            min: at(&self.min),
            max: at(&self.max),
        }
    }

    #[inline]
    pub(super) fn set(&mut self, lane: usize, bounds: &Bounds) {
        for axis in 0..3 {
            self.min[axis][lane % WIDTH] = bounds.min[axis];
            self.max[axis][lane % WIDTH] = bounds.max[axis];
        }
    }

    /// Where the eight begin and end along an axis, four by four.
    #[inline]
    pub(super) fn sides(&self, axis: usize) -> ([Vec4; 2], [Vec4; 2]) {
        (halves(&self.min[axis % 3]), halves(&self.max[axis % 3]))
    }

    /// The box around all eight.
    #[inline]
    pub(super) fn union(&self) -> Bounds {
        let least = |side: &[f32; WIDTH]| {
            let [low, high] = halves(side);
            low.min(high).min_element()
        };
        let most = |side: &[f32; WIDTH]| {
            let [low, high] = halves(side);
            low.max(high).max_element()
        };
        Bounds {
            min: Vec3::new(
                least(&self.min[0]),
                least(&self.min[1]),
                least(&self.min[2]),
            ),
            max: Vec3::new(most(&self.max[0]), most(&self.max[1]), most(&self.max[2])),
        }
    }

    /// Which of the eight share a point with `bounds`, a bit for each.
    #[inline]
    pub(super) fn overlaps(&self, bounds: &Bounds) -> u32 {
        let mut found = [0; 2];
        for (half, found) in found.iter_mut().enumerate() {
            let below = |axis: usize| {
                halves(&self.min[axis])[half].cmple(Vec4::splat(bounds.max[axis]))
                    & halves(&self.max[axis])[half].cmpge(Vec4::splat(bounds.min[axis]))
            };
            *found = (below(0) & below(1) & below(2)).bitmask();
        }
        found[0] | found[1] << 4
    }
}

#[inline]
fn halves(side: &[f32; WIDTH]) -> [Vec4; 2] {
    let [a, b, c, d, e, f, g, h] = *side;
    [Vec4::new(a, b, c, d), Vec4::new(e, f, g, h)]
}
