//! Vertices side by side, roughly.

use glam::{DVec3, Vec4};

/// Vertices compared at once: a register of SSE2.
pub(crate) const WIDTH: usize = 4;

/// Four vertices as seen from the centre, in shares of the largest distance from there; places left
/// over repeat the first vertex of all, which then has a lower number as well.
///
/// In single precision: a search looks for vertices many times, and only what it ends with has to
/// be right.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(16))]
pub(crate) struct Lanes {
    x: [f32; WIDTH],
    y: [f32; WIDTH],
    z: [f32; WIDTH],
}

impl Lanes {
    /// Four times the centre.
    pub(crate) const NONE: Self = Self {
        x: [0.0; WIDTH],
        y: [0.0; WIDTH],
        z: [0.0; WIDTH],
    };

    /// Up to this many vertices are worth comparing one and all; of more, climbing finds the
    /// farthest sooner. Measured by `benches/exact_flat.rs`; only time depends on it.
    pub(crate) const FEW: usize = 24;

    /// By how much less than the farthest vertex the one found may reach along a direction, in
    /// shares of the largest distance and of the direction's length: ten times what two heights are off at
    /// most.
    pub(crate) const ERROR: f64 = 2e-5;

    /// What lies lower by this share in [`stand_out`](Self::stand_out) does so for certain, by nearly
    /// as much.
    pub(crate) const MARGIN: f64 = 0.5e-5;

    /// Vertices as seen from `centre`, none of which is farther from there than `radius`.
    pub(super) fn list(vertices: &[DVec3], centre: DVec3, radius: f64) -> Vec<Self> {
        let first = vertices.first().copied().unwrap_or(centre);
        let lanes = |four: &[DVec3]| {
            let vertex = |lane| four.get(lane).copied().unwrap_or(first);
            Self::of(std::array::from_fn(|lane| (vertex(lane) - centre) / radius))
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
        let [x, y, z] = [self.x, self.y, self.z].map(Vec4::from_array);
        let row = |axis: usize| {
            let row = x * u[axis] + y * v[axis] + z * w[axis] + shift[axis];
            row.to_array()
        };
        Self {
            x: row(0),
            y: row(1),
            z: row(2),
        }
    }

    #[inline(always)]
    fn heights(&self, [x, y, z]: [Vec4; 3]) -> Vec4 {
        let [p, q, r] = [self.x, self.y, self.z].map(Vec4::from_array);
        x * p + y * q + z * r
    }

    /// How far the farthest vertex reaches along a direction, in shares of the largest distance, to
    /// within 1e-6 of the direction's length.
    #[inline(always)]
    pub(crate) fn reach(list: &[Self], direction: [f32; 3]) -> f32 {
        let direction = direction.map(Vec4::splat);
        let heights = list.iter().map(|lanes| lanes.heights(direction));
        heights.fold(Vec4::NEG_INFINITY, Vec4::max).max_element()
    }

    /// The number of a vertex that is farthest along a direction to within
    /// [`ERROR`](Self::ERROR); some vertex if the direction is zero or not finite.
    #[inline]
    pub(crate) fn farthest(list: &[Self], direction: DVec3) -> u32 {
        let direction = (power_of_two_for(direction) * direction).to_array();
        let direction = direction.map(|x| x as f32);
        Self::highest(list, direction)
    }

    /// The number of a vertex that is farthest along a direction to within 1e-6 of its length; some
    /// vertex if products of the coordinates are out of the range of `f32`.
    #[inline(always)]
    pub(crate) fn highest(list: &[Self], direction: [f32; 3]) -> u32 {
        let direction = direction.map(Vec4::splat);
        // Places left over are as high as others that come first, whatever the numbers are.
        let first = list
            .first()
            .map_or(Vec4::ZERO, |lanes| lanes.heights(direction));
        let mut heights = [first; Self::FEW / WIDTH];
        for (height, lanes) in heights.iter_mut().zip(list).skip(1) {
            *height = lanes.heights(direction);
        }
        Self::first_of_highest(&heights)
    }

    /// The same of a list whose length is known.
    #[inline(always)]
    pub(crate) fn highest_of<const N: usize>(list: &[Self; N], direction: [f32; 3]) -> u32 {
        let direction = direction.map(Vec4::splat);
        let mut heights = [Vec4::NEG_INFINITY; N];
        for (height, lanes) in heights.iter_mut().zip(list) {
            *height = lanes.heights(direction);
        }
        Self::first_of_highest(&heights)
    }

    /// The place of the first of the largest numbers; of some number if one is NaN.
    #[inline(always)]
    pub(super) fn first_of_highest<const N: usize>(heights: &[Vec4; N]) -> u32 {
        let most = heights.iter().copied().fold(Vec4::NEG_INFINITY, Vec4::max);
        let bits = Self::not_below(heights, most.max_element());
        if bits == 0 { 0 } else { bits.trailing_zeros() }
    }

    /// A bit for each height that is not below a floor.
    #[inline(always)]
    fn not_below(heights: &[Vec4], floor: f32) -> u32 {
        let floor = Vec4::splat(floor);
        let of_block = |(block, height): (usize, &Vec4)| {
            let bits = height.cmpge(floor).bitmask();
            bits << (WIDTH * block)
        };
        let blocks = heights.iter().enumerate().map(of_block);
        blocks.fold(0, |bits, block| bits | block)
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

    /// Whether all of so many vertices but these for certain lie lower along a unit vector.
    #[inline]
    pub(crate) fn stand_out<const N: usize>(
        list: &[Self],
        count: usize,
        vertices: [u32; N],
        direction: DVec3,
    ) -> bool {
        let direction = direction.to_array().map(|x| x as f32);
        let [x, y, z] = direction;
        let height = |number: u32| {
            let [p, q, r] = Self::place(list, number);
            x * p + y * q + z * r
        };
        let floor = vertices
            .map(height)
            .into_iter()
            .fold(f32::INFINITY, f32::min);
        let floor = Vec4::splat(floor - Self::MARGIN as f32);
        let direction = direction.map(Vec4::splat);
        let bits = list.iter().rev().fold(0, |bits: u32, lanes| {
            bits << WIDTH | lanes.heights(direction).cmpge(floor).bitmask()
        });
        let these = vertices
            .into_iter()
            .fold(0, |bits, vertex| bits | 1 << vertex);
        bits & !(u32::MAX << count) == these
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Points on a spiral around a sphere.
    fn points(count: u32) -> Vec<DVec3> {
        let point = |index| {
            let z = f64::from(2 * index + 1) / f64::from(count) - 1.0;
            let (y, x) = libm::sincos(2.4 * f64::from(index));
            (1.0 - z * z).sqrt() * DVec3::new(x, y, 0.0) + z * DVec3::Z
        };
        (0..count).map(point).collect()
    }

    fn directions() -> impl Iterator<Item = DVec3> {
        (0..500).map(|step| {
            let step = f64::from(step);
            let (y, x) = libm::sincos(0.7 * step);
            DVec3::new(x, y, libm::sin(1.9 * step)).normalize()
        })
    }

    #[test]
    fn the_farthest_stand_out_and_places_left_over_do_not() {
        for count in 1..=Lanes::FEW as u32 {
            let points = points(count);
            let list = Lanes::list(&points, DVec3::ZERO, 1.0);
            let (mut alone, mut first) = (0, 0);
            // Along the first point, too, which is what they repeat.
            for direction in directions().chain([points[0]]) {
                let height = |vertex: u32| points[vertex as usize].dot(direction);
                let vertex = Lanes::farthest(&list, direction);
                assert_eq!(
                    vertex,
                    Lanes::highest(&list, direction.to_array().map(|x| x as f32))
                );
                let most = (0..count).map(height).fold(f64::MIN, f64::max);
                assert!(height(vertex) > most - 1e-6, "{count} {direction}");
                let reach = Lanes::reach(&list, direction.to_array().map(|x| x as f32));
                assert!((f64::from(reach) - most).abs() < 1e-6);
                let others = (0..count).filter(|&other| other != vertex).map(height);
                let gap = height(vertex) - others.fold(f64::NEG_INFINITY, f64::max);
                let stands_out = Lanes::stand_out(&list, count as usize, [vertex], direction);
                assert!(stands_out || gap < Lanes::MARGIN + 1e-6);
                assert!(!stands_out || gap > Lanes::MARGIN - 1e-6);
                assert!(
                    count == 1 || !Lanes::stand_out(&list, count as usize, [vertex], -direction)
                );
                alone += u32::from(stands_out);
                first += u32::from(stands_out && vertex == 0);
            }
            assert!(alone > 400 && first > 0, "{count} {alone} {first}");
        }
    }

    #[test]
    fn whatever_the_direction_the_vertex_is_one_of_the_list() {
        let odd = [
            0.0,
            -0.0,
            1.0,
            f32::NAN,
            f32::INFINITY,
            f32::NEG_INFINITY,
            f32::MAX,
        ];
        for count in 1..=Lanes::FEW as u32 {
            let list = Lanes::list(&points(count), DVec3::ZERO, 1.0);
            for x in odd {
                for y in odd {
                    for z in odd {
                        assert!(Lanes::highest(&list, [x, y, z]) < count);
                    }
                }
            }
        }
    }
}
