//! A few vertices side by side.

use glam::DVec3;

/// Vertices compared at once: two registers of SSE2.
const WIDTH: usize = 4;

/// Four vertices; places left over hold NaN, which is never farthest.
#[derive(Debug, Clone, Copy)]
#[repr(align(32))]
pub(crate) struct Lanes {
    x: [f64; WIDTH],
    y: [f64; WIDTH],
    z: [f64; WIDTH],
}

/// By bits, so that a polytope equals itself in spite of NaN.
impl PartialEq for Lanes {
    fn eq(&self, other: &Self) -> bool {
        let bits = |lanes: &Self| [lanes.x, lanes.y, lanes.z].map(|row| row.map(f64::to_bits));
        bits(self) == bits(other)
    }
}

impl Lanes {
    pub(crate) const EMPTY: Self = Self {
        x: [f64::NAN; WIDTH],
        y: [f64::NAN; WIDTH],
        z: [f64::NAN; WIDTH],
    };

    /// Up to this many vertices are worth comparing one and all; of more, climbing finds the
    /// farthest sooner. Measured by `benches/exact_flat.rs`; only time depends on it.
    pub(crate) const FEW: usize = 24;

    /// So many lanes hold [`FEW`](Self::FEW) vertices.
    pub(crate) const BLOCKS: usize = Self::FEW / WIDTH;

    #[inline]
    pub(crate) fn new(vertices: [DVec3; WIDTH]) -> Self {
        Self {
            x: vertices.map(|v| v.x),
            y: vertices.map(|v| v.y),
            z: vertices.map(|v| v.z),
        }
    }

    /// Any number of vertices as seen from `centre`.
    pub(super) fn list(vertices: &[DVec3], centre: DVec3) -> Vec<Self> {
        let lanes = |four: &[DVec3]| {
            Self::new(std::array::from_fn(|lane| {
                four.get(lane).map_or(DVec3::NAN, |&vertex| vertex - centre)
            }))
        };
        vertices.chunks(WIDTH).map(lanes).collect()
    }

    /// The same vertices in another frame, of which the axes here are given.
    #[inline]
    pub(crate) fn turned(&self, [x, y, z]: [DVec3; 3]) -> Self {
        let mut turned = *self;
        for lane in 0..WIDTH {
            let (along_x, along_y, along_z) = (self.x[lane], self.y[lane], self.z[lane]);
            turned.x[lane] = x.x * along_x + y.x * along_y + z.x * along_z;
            turned.y[lane] = x.y * along_x + y.y * along_y + z.y * along_z;
            turned.z[lane] = x.z * along_x + y.z * along_y + z.z * along_z;
        }
        turned
    }

    #[inline]
    fn heights(&self, direction: DVec3) -> [f64; WIDTH] {
        let mut heights = [0.0; WIDTH];
        for (lane, height) in heights.iter_mut().enumerate() {
            *height = direction.x * self.x[lane]
                + direction.y * self.y[lane]
                + direction.z * self.z[lane];
        }
        heights
    }

    /// The vertex with a number, of those in a list of lanes.
    #[inline]
    pub(crate) fn vertex(list: &[Self], number: u32) -> DVec3 {
        let (block, lane) = (number as usize / WIDTH, number as usize % WIDTH);
        let lanes = &list[block];
        DVec3::new(lanes.x[lane], lanes.y[lane], lanes.z[lane])
    }

    /// Number and place of a vertex farthest along a direction.
    #[inline]
    pub(crate) fn farthest(list: &[Self], direction: DVec3) -> (u32, DVec3) {
        let mut most = [f64::NEG_INFINITY; WIDTH];
        // As numbers of the heights' own width, so that both are chosen by one mask.
        let mut blocks = [0.0; WIDTH];
        let mut number = 0.0;
        for lanes in list {
            let heights = lanes.heights(direction);
            for lane in 0..WIDTH {
                let higher = heights[lane] > most[lane];
                most[lane] = if higher { heights[lane] } else { most[lane] };
                blocks[lane] = if higher { number } else { blocks[lane] };
            }
            number += 1.0;
        }
        let upper = |i: usize, j: usize| if most[j] > most[i] { j } else { i };
        let lane = upper(upper(0, 1), upper(2, 3));
        let number = (WIDTH * blocks[lane] as usize + lane) as u32;
        (number, Self::vertex(list, number))
    }

    /// How many vertices lie at a height or above.
    #[inline]
    pub(crate) fn count_above(list: &[Self], direction: DVec3, floor: f64) -> usize {
        let mut counts = [0.0; WIDTH];
        for lanes in list {
            for (count, height) in counts.iter_mut().zip(lanes.heights(direction)) {
                *count += if height >= floor { 1.0 } else { 0.0 };
            }
        }
        counts.iter().sum::<f64>() as usize
    }
}
