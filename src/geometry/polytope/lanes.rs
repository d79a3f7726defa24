//! Vertices side by side, roughly.

use glam::DVec3;

/// Vertices compared at once: a register of SSE2.
pub(crate) const WIDTH: usize = 4;

/// The last bits of a height, which are of no account, tell the number of the vertex, from 1 on: the
/// largest of them tells both. Setting no bits would be another operation for one of the lanes, and they
/// would be done one by one.
const NUMBER: u32 = 31;

/// Four vertices as seen from the centre, in shares of the largest distance from there; places left
/// over hold NaN, which is never farthest.
///
/// In single precision: a search looks for vertices many times, and only what it ends with has to
/// be right.
#[derive(Debug, Clone, Copy)]
#[repr(align(16))]
pub(crate) struct Lanes {
    x: [f32; WIDTH],
    y: [f32; WIDTH],
    z: [f32; WIDTH],
}

/// By bits, so that a polytope equals itself in spite of NaN.
impl PartialEq for Lanes {
    fn eq(&self, other: &Self) -> bool {
        let bits = |lanes: &Self| [lanes.x, lanes.y, lanes.z].map(|row| row.map(f32::to_bits));
        bits(self) == bits(other)
    }
}

impl Lanes {
    /// A place for vertices.
    pub(crate) const NONE: Self = Self {
        x: [0.0; WIDTH],
        y: [0.0; WIDTH],
        z: [0.0; WIDTH],
    };

    /// Up to this many vertices are worth comparing one and all; of more, climbing finds the
    /// farthest sooner. Measured by `benches/exact_flat.rs`; only time depends on it.
    pub(crate) const FEW: usize = 24;

    /// By how much less than the farthest vertex the one found may reach along a direction, in
    /// shares of the largest distance and of the direction's length: two heights, each off by 4e-6 at
    /// most.
    pub(crate) const ERROR: f64 = 2e-5;

    /// What lies lower by this share in [`stand_out`](Self::stand_out) does so for certain, by nearly
    /// as much.
    pub(crate) const MARGIN: f64 = 0.5e-5;

    /// Vertices as seen from `centre`, none of which is farther from there than `radius`.
    pub(super) fn list(vertices: &[DVec3], centre: DVec3, radius: f64) -> Vec<Self> {
        let lanes = |four: &[DVec3]| {
            Self::of(std::array::from_fn(|lane| {
                (four.get(lane)).map_or(DVec3::NAN, |&vertex| (vertex - centre) / radius)
            }))
        };
        vertices.chunks(WIDTH).map(lanes).collect()
    }

    /// Four vertices in shares of the largest distance.
    #[inline]
    pub(crate) fn of(vertices: [DVec3; WIDTH]) -> Self {
        Self {
            x: vertices.map(|v| v.x as f32),
            y: vertices.map(|v| v.y as f32),
            z: vertices.map(|v| v.z as f32),
        }
    }

    /// The corners of a box whose half extents are these shares, in the order of their numbers.
    #[inline]
    pub(crate) fn of_box(half: DVec3) -> [Self; 2] {
        let [x, y, z] = half.to_array().map(|x| x as f32);
        [-z, z].map(|z| Self {
            x: [-x, x, -x, x],
            y: [-y, -y, y, y],
            z: [z; WIDTH],
        })
    }

    /// The vertices turned by a matrix of these columns, then shifted.
    #[inline(always)]
    pub(crate) fn turned(&self, [u, v, w]: &[[f32; 3]; 3], shift: [f32; 3]) -> Self {
        let row = |axis: usize| {
            std::array::from_fn(|lane| {
                u[axis] * self.x[lane]
                    + v[axis] * self.y[lane]
                    + w[axis] * self.z[lane]
                    + shift[axis]
            })
        };
        Self {
            x: row(0),
            y: row(1),
            z: row(2),
        }
    }

    #[inline(always)]
    fn heights(&self, [x, y, z]: [f32; 3]) -> [f32; WIDTH] {
        std::array::from_fn(|lane| x * self.x[lane] + y * self.y[lane] + z * self.z[lane])
    }

    /// The number of a vertex that is farthest along a direction to within
    /// [`ERROR`](Self::ERROR); some vertex if the direction is zero or not finite.
    #[inline]
    pub(crate) fn farthest(list: &[Self], direction: DVec3) -> u32 {
        let direction = (power_of_two_for(direction) * direction).to_array();
        let direction = direction.map(|x| x as f32);
        Self::highest(list, direction)
    }

    /// The number of a vertex that is farthest along a direction to within 8e-6 of its length; some
    /// vertex if products of the coordinates are out of the range of `f32`.
    #[inline(always)]
    pub(crate) fn highest(list: &[Self], direction: [f32; 3]) -> u32 {
        Self::number_of_highest(list.iter().map(|lanes| lanes.heights(direction)), direction)
    }

    /// The number of the largest of up to 24 heights along a direction, but for its last bits.
    #[inline(always)]
    pub(crate) fn number_of_highest(
        heights: impl Iterator<Item = [f32; WIDTH]>,
        direction: [f32; 3],
    ) -> u32 {
        let higher = |a: f32, b: f32| if b > a { b } else { a };
        // Not known to be nothing when this is compiled.
        let nothing = 0.0 * direction[0];
        let mut most = [f32::NEG_INFINITY; WIDTH];
        let mut numbers: [u32; WIDTH] = std::array::from_fn(|lane| 1 + lane as u32);
        for four in heights {
            for lane in 0..WIDTH {
                let height = four[lane];
                // Adding nothing keeps the comparison one of floats: a single instruction.
                let height = f32::from_bits(height.to_bits() & !NUMBER | numbers[lane]) + nothing;
                most[lane] = higher(most[lane], height);
                numbers[lane] += WIDTH as u32;
            }
        }
        let most = higher(higher(most[0], most[2]), higher(most[1], most[3]));
        (most.to_bits() & NUMBER).max(1) - 1
    }

    /// Where a vertex is.
    #[inline(always)]
    pub(crate) fn place(list: &[Self], vertex: u32) -> [f32; 3] {
        let lane = vertex as usize % WIDTH;
        match list.get(vertex as usize / WIDTH) {
            Some(lanes) => [lanes.x[lane], lanes.y[lane], lanes.z[lane]],
            None => [0.0; 3],
        }
    }

    /// Whether all vertices but these for certain lie lower along a unit vector.
    #[inline]
    pub(crate) fn stand_out<const N: usize>(
        list: &[Self],
        vertices: [u32; N],
        direction: DVec3,
    ) -> bool {
        let direction = direction.to_array().map(|x| x as f32);
        let [x, y, z] = direction;
        let heights = vertices.map(|number| {
            let (block, lane) = (number as usize / WIDTH, number as usize % WIDTH);
            let lanes = &list[block];
            x * lanes.x[lane] + y * lanes.y[lane] + z * lanes.z[lane]
        });
        let floor = heights.into_iter().fold(f32::INFINITY, f32::min) - Self::MARGIN as f32;
        let mut counts = [0; WIDTH];
        for lanes in list {
            for (count, height) in counts.iter_mut().zip(lanes.heights(direction)) {
                *count += u32::from(height >= floor);
            }
        }
        counts.iter().sum::<u32>() as usize == N
    }
}

/// What makes a direction's largest component at least 0.5 and less than 1.
#[inline]
fn power_of_two_for(direction: DVec3) -> f64 {
    const EXPONENT: u64 = 0x7ff << 52;
    const OF_A_HALF: u64 = 1022 << 52;
    const OF_ONE: u64 = 1023 << 52;
    let exponent = direction.abs().max_element().to_bits() & EXPONENT;
    f64::from_bits((OF_A_HALF + OF_ONE).wrapping_sub(exponent))
}
