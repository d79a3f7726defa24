//! Vertices side by side, roughly.

use glam::DVec3;

/// Vertices compared at once: a register of SSE2.
const WIDTH: usize = 4;

/// Heights are rounded to multiples of this, and their last bits tell the number of the vertex: the
/// largest of them tells both.
const STEP: f32 = 1.0 / (1 << 15) as f32;

/// Adding and subtracting it rounds a number to multiples of [`STEP`].
const ROUNDER: f32 = 1.5 * (1 << 23) as f32 * STEP;

/// Heights are below 2, where they are multiples of this: up to 128 numbers fit in a [`STEP`].
const NUMBER: f32 = 1.0 / (1 << 22) as f32;
const NUMBERS: u32 = 128;

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
    /// Up to this many vertices are worth comparing one and all; of more, climbing finds the
    /// farthest sooner. Measured by `benches/exact_flat.rs`; only time depends on it.
    pub(crate) const FEW: usize = 24;

    /// By how much less than the farthest vertex the one found may reach along a direction, in
    /// shares of the largest distance and of the direction's length: two heights, each rounded to 2e-5
    /// where the direction is at least 0.5 long.
    pub(crate) const ERROR: f64 = 1e-4;

    /// What lies lower by this share in [`stand_out`](Self::stand_out) does so for certain, by nearly
    /// as much.
    pub(crate) const MARGIN: f64 = 0.5e-5;

    /// Vertices as seen from `centre`, none of which is farther from there than `radius`.
    pub(super) fn list(vertices: &[DVec3], centre: DVec3, radius: f64) -> Vec<Self> {
        let lanes = |four: &[DVec3]| {
            let share: [DVec3; WIDTH] = std::array::from_fn(|lane| {
                (four.get(lane)).map_or(DVec3::NAN, |&vertex| (vertex - centre) / radius)
            });
            Self {
                x: share.map(|v| v.x as f32),
                y: share.map(|v| v.y as f32),
                z: share.map(|v| v.z as f32),
            }
        };
        vertices.chunks(WIDTH).map(lanes).collect()
    }

    #[inline]
    fn heights(&self, [x, y, z]: [f32; 3]) -> [f32; WIDTH] {
        std::array::from_fn(|lane| x * self.x[lane] + y * self.y[lane] + z * self.z[lane])
    }

    /// The number of a vertex that is farthest along a direction to within
    /// [`ERROR`](Self::ERROR); some vertex if the direction is zero or not finite.
    #[inline]
    pub(crate) fn farthest(list: &[Self], direction: DVec3) -> u32 {
        let direction = (power_of_two_for(direction) * direction).to_array();
        let direction = direction.map(|x| x as f32);
        let mut most = [f32::NEG_INFINITY; WIDTH];
        let mut numbers: [f32; WIDTH] = std::array::from_fn(|lane| lane as f32 * NUMBER);
        for lanes in list {
            let heights = lanes.heights(direction);
            for lane in 0..WIDTH {
                let height = (heights[lane] + ROUNDER) - ROUNDER + numbers[lane];
                most[lane] = if height > most[lane] {
                    height
                } else {
                    most[lane]
                };
                numbers[lane] += WIDTH as f32 * NUMBER;
            }
        }
        let upper = |a: f32, b: f32| if b > a { b } else { a };
        let most = upper(upper(most[0], most[1]), upper(most[2], most[3]));
        (most * (1.0 / NUMBER)) as i32 as u32 % NUMBERS
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
