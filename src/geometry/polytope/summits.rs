//! For every direction the few vertices that may be farthest along it, roughly.

use super::Lanes;
use super::sketch::transposed;
use super::support::{Seen, Support};
use glam::{DVec3, Vec4};

/// Vertices that a cell has room for: twice as many as there are as a rule.
const ROOM: usize = 8;

/// Cells per vertex: with more, more of the table is looked at that is not in the cache; with fewer,
/// more cells have no room. Measured by `benches/exact_flat.rs`; only time depends on it.
const CELLS_PER_VERTEX: f64 = 2.0;

/// Of more vertices the table would be larger than what it saves.
const MOST_VERTICES: usize = 1 << u8::BITS;

/// A vertex as seen from the centre, in shares of the radius; of the fourth there is no need.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[repr(align(16))]
struct Place([f32; 4]);

/// The directions in cells: a square of them, folded to an octahedron. For each cell all vertices that
/// are farthest along one of its directions.
///
/// A search that looks for farthest vertices again and again need not climb: it computes the cell, and
/// compares what is in it all at once.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Summits {
    /// Numbers of vertices, over and over again if they are few. Nothing but the first of all vertices if
    /// there is no room for them, and, which does no harm, if it is the only one.
    cells: Vec<[u8; ROOM]>,
    /// Cells on a side of the square, an even number, so that the octahedron's edges lie between
    /// cells or across their corners.
    side: usize,
    /// As many as there are numbers: none need be checked.
    places: Option<Box<[Place; MOST_VERTICES]>>,
}

impl Summits {
    const NONE: Self = Self {
        cells: Vec::new(),
        side: 0,
        places: None,
    };

    /// Those of vertices none of which is farther from `centre` than `radius`; none of so few or so many
    /// that others find them sooner.
    pub(super) fn of(vertices: &[DVec3], support: &Support, centre: DVec3, radius: f64) -> Self {
        if vertices.len() <= Lanes::FEW || vertices.len() > MOST_VERTICES {
            return Self::NONE;
        }
        let side = 2 * (0.5 * (CELLS_PER_VERTEX * vertices.len() as f64).sqrt()).ceil() as usize;
        let mut seen = Seen::new(vertices.len());
        let mut cell = |number: usize| {
            let (row, column) = (number / side, number % side);
            let corner = |row: usize, column: usize| {
                let place = |place: usize| 2.0 * place as f64 / side as f64 - 1.0;
                unfolded(place(row), place(column))
            };
            let corners =
                [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| corner(row + i, column + j));
            let found = support.summits(vertices, &corners, ROOM, &mut seen);
            let vertex = |place: usize| match found.get(place % found.len().max(1)) {
                Some(&vertex) if found.len() <= ROOM => vertex as u8,
                _ => 0,
            };
            std::array::from_fn(vertex)
        };
        let cells = (0..side * side).map(&mut cell).collect();
        let mut places = Box::new([Place::default(); MOST_VERTICES]);
        for (place, &vertex) in places.iter_mut().zip(vertices) {
            let [x, y, z] = ((vertex - centre) / radius).to_array().map(|x| x as f32);
            *place = Place([x, y, z, 0.0]);
        }
        Self {
            cells,
            side,
            places: Some(places),
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    /// The number of a vertex that is farthest along a direction to within
    /// [`Lanes::ERROR`], and where it is as seen from the centre, in shares of the radius; none if the
    /// cell has no room for all that may be.
    #[inline(always)]
    pub(crate) fn highest(&self, direction: [f32; 3]) -> Option<(u32, [f32; 3])> {
        let places = self.places.as_deref()?;
        let cell = self.cells.get(self.cell(direction))?;
        let [x, y, z] = direction.map(Vec4::splat);
        let heights = |four: [u8; 4]| {
            let [p, q, r, _] =
                transposed(four.map(|vertex| Vec4::from_array(places[usize::from(vertex)].0)));
            x * p + y * q + z * r
        };
        let [a, b, c, d, e, f, g, h] = *cell;
        let heights = [heights([a, b, c, d]), heights([e, f, g, h])];
        let vertex = cell[Lanes::first_of_highest(&heights) as usize % ROOM];
        let [x, y, z, _] = places[usize::from(vertex)].0;
        (cell[0] | cell[1] != 0).then_some((u32::from(vertex), [x, y, z]))
    }

    /// The cell a direction lies in. NaN and zero lie in some cell.
    ///
    /// No branch, for none could be predicted.
    #[inline(always)]
    fn cell(&self, [x, y, z]: [f32; 3]) -> usize {
        /// Numbers from here up to twice as much have no digits after the point.
        const WHOLE: f32 = 8_388_608.0;
        let per_size = 1.0 / (x.abs() + y.abs() + z.abs());
        let (u, v) = ((x * per_size).abs(), (y * per_size).abs());
        let (u, v) = if z < 0.0 { (1.0 - v, 1.0 - u) } else { (u, v) };
        let half = 0.5 * self.side as f32;
        let index = |share: f32, sign: f32| {
            // Rounded down, by rounding to nearest.
            let place = share.copysign(sign) * half + (half - 0.5);
            let whole = (place + WHOLE).to_bits() as i32 - WHOLE.to_bits() as i32;
            whole.max(0).min(self.side as i32 - 1) as usize
        };
        index(u, x) * self.side + index(v, y)
    }
}

/// The direction at a place of the square, whose coordinates go from −1 to 1.
fn unfolded(u: f64, v: f64) -> DVec3 {
    let z = 1.0 - u.abs() - v.abs();
    if z >= 0.0 {
        return DVec3::new(u, v, z);
    }
    DVec3::new((1.0 - v.abs()).copysign(u), (1.0 - u.abs()).copysign(v), z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Polytope;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::{Rng, SeedableRng};
    use std::error::Error;

    #[test]
    fn no_vertex_is_farther_by_more_than_rounding() -> Result<(), Box<dyn Error>> {
        let mut rng = ChaCha8Rng::seed_from_u64(3);
        let mut number = move || (rng.next_u64() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0;
        let (mut told, mut looked) = (0, 0);
        for count in [25, 40, 100, 180, 256, 400] {
            for flat in [1.0, 0.01] {
                let mut vector = || DVec3::new(number(), number(), number());
                let mut point = || DVec3::new(1.0, 2.0, flat) * vector().normalize_or(DVec3::X);
                let hull = Polytope::from_points((0..count).map(|_| 5.0 + point()))?;
                let summits = hull.summits();
                assert_eq!(summits.is_empty(), count == 400);
                for round in 0..2000 {
                    let mut direction = vector().normalize_or(DVec3::X);
                    // The edges and corners of the octahedron, too.
                    if round % 4 == 0 {
                        direction[round / 4 % 3] *= 1e-7;
                    }
                    if round % 16 == 0 {
                        direction[(round / 16 + 1) % 3] = 0.0;
                    }
                    let direction = direction.normalize();
                    looked += 1;
                    let Some((vertex, place)) =
                        summits.highest(direction.to_array().map(|x| x as f32))
                    else {
                        continue;
                    };
                    told += 1;
                    let reach = |vertex: u32| direction.dot(hull.vertices()[vertex as usize]);
                    let short = reach(hull.support(direction)) - reach(vertex);
                    assert!(
                        short <= Lanes::ERROR * hull.max_dist(),
                        "{count} {direction}"
                    );
                    let from = hull.vertices()[vertex as usize] - hull.centre();
                    let off = DVec3::from_array(place.map(f64::from)) - from / hull.max_dist();
                    assert!(off.length() < 1e-6);
                }
            }
        }
        assert!(told > looked * 3 / 4, "{told} of {looked}");
        Ok(())
    }

    #[test]
    fn nothing_is_asked_too_much() -> Result<(), Box<dyn Error>> {
        let around = |k: u32| {
            let (y, x) = libm::sincos(f64::from(k));
            [(x, y, 1.0), (x, y, -1.0)].map(DVec3::from)
        };
        let drum = Polytope::from_points((0..40).flat_map(around))?;
        let odd = [
            0.0,
            -0.0,
            1.0,
            -1.0,
            f32::NAN,
            f32::INFINITY,
            f32::MIN_POSITIVE,
        ];
        for x in odd {
            for y in odd {
                for z in odd {
                    if let Some((vertex, _)) = drum.summits().highest([x, y, z]) {
                        assert!((vertex as usize) < drum.vertices().len());
                    }
                }
            }
        }
        // All forty of a lid are farthest along its normal.
        assert!(drum.summits().highest([0.0, 0.0, 1.0]).is_none());
        Ok(())
    }
}
