//! A few vertices, compared side by side.

use glam::DVec3;

/// Vertices compared at once: two registers of SSE2.
const LANES: usize = 4;

/// A polytope with more vertices than this is climbed instead; only time depends on it.
pub(super) const FEW: usize = 24;

/// The vertices of a core as they are turned, from its centre.
#[derive(Clone)]
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
    pub(super) const EMPTY: Self = Self {
        blocks: [Block {
            x: [0.0; LANES],
            y: [0.0; LANES],
            z: [0.0; LANES],
        }; FEW / LANES],
        used: 0,
    };

    /// Up to [`FEW`] vertices in place of those before.
    #[inline]
    pub(super) fn fill(&mut self, vertices: &[DVec3], turned: impl Fn(DVec3) -> DVec3) {
        self.used = 0;
        self.extend(vertices, turned);
    }

    /// More of them, behind whole fours.
    #[inline]
    pub(super) fn extend(&mut self, vertices: &[DVec3], turned: impl Fn(DVec3) -> DVec3) {
        for four in vertices.chunks(LANES) {
            let Some(block) = self.blocks.get_mut(self.used) else {
                debug_assert!(false, "more vertices than a cloud has room for");
                return;
            };
            for lane in 0..LANES {
                // Lanes left over repeat a vertex and so never are the only highest.
                let vertex = turned(four[lane.min(four.len() - 1)]);
                (block.x[lane], block.y[lane], block.z[lane]) = vertex.into();
            }
            self.used += 1;
        }
    }

    #[inline]
    pub(super) fn vertex(&self, index: u32) -> DVec3 {
        let (block, lane) = (index as usize / LANES, index as usize % LANES);
        let Block { x, y, z } = &self.blocks[block];
        DVec3::new(x[lane], y[lane], z[lane])
    }

    /// A vertex farthest along a direction of any length.
    #[inline]
    pub(super) fn farthest(&self, direction: DVec3) -> u32 {
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
        (LANES * blocks[lane] as usize + lane) as u32
    }
}
