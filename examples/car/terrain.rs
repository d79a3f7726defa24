//! Hills of triangles.

use feeler::{Ray, RayCast, ShapeError, Triangle};
use glam::DVec3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use std::f64::consts::TAU;

/// Edge of a cell of the mesh, in metres; two triangles each.
pub(crate) const CELL: f64 = 0.75;
const CELLS: [i32; 2] = [48, 6];
pub(crate) const LENGTH: f64 = CELL * CELLS[0] as f64;

/// What a ray found.
pub(crate) struct Ground {
    /// How far below the ray's origin; negative above it. In metres.
    pub(crate) distance: f64,
    /// How many triangles it met: more than one on an edge or a vertex.
    pub(crate) triangles: usize,
}

pub(crate) struct Terrain {
    triangles: Vec<Triangle>,
}

impl Terrain {
    /// Along x from 0, along y around 0.
    pub(crate) fn new(seed: u64) -> Result<Self, ShapeError> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut unit = || (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        // Waves from 24 m down to 4 m, the shorter the lower.
        let waves = [0, 1, 2, 3, 4, 5].map(|index| {
            let length = 24.0 / 1.45_f64.powi(index);
            let (across, phase) = (0.8 * (unit() - 0.5), TAU * unit());
            (0.025 * length, TAU / length, across * TAU / length, phase)
        });
        let height = |x: f64, y: f64| -> f64 {
            let wave = |&(high, along, across, phase): &(f64, f64, f64, f64)| {
                high * (along * x + across * y + phase).sin()
            };
            waves.iter().map(wave).sum()
        };
        let vertex = |column: i32, row: i32| {
            let (x, y) = (
                f64::from(column) * CELL,
                f64::from(row - CELLS[1] / 2) * CELL,
            );
            DVec3::new(x, y, height(x, y))
        };
        let mut triangles = Vec::new();
        for (column, row) in (0..CELLS[0]).flat_map(|c| (0..CELLS[1]).map(move |r| (c, r))) {
            let [a, b] = [vertex(column, row), vertex(column + 1, row)];
            let [c, d] = [vertex(column + 1, row + 1), vertex(column, row + 1)];
            triangles.push(Triangle::new(a, b, c)?);
            triangles.push(Triangle::new(a, c, d)?);
        }
        Ok(Self { triangles })
    }

    pub(crate) fn triangles(&self) -> &[Triangle] {
        &self.triangles
    }

    /// The ground under or over a point, by a vertical ray; none beside the mesh.
    pub(crate) fn below(&self, point: DVec3) -> Option<Ground> {
        let ray = Ray::new(point, DVec3::NEG_Z);
        // The whole line is asked for, because a wheel may have sunk.
        let spans = self
            .triangles
            .iter()
            .filter_map(|triangle| triangle.line_span(&ray));
        let distances: Vec<f64> = spans.map(|span| span.enter.fraction).collect();
        let nearest = |a: &&f64, b: &&f64| a.abs().total_cmp(&b.abs());
        Some(Ground {
            distance: *distances.iter().min_by(nearest)?,
            triangles: distances.len(),
        })
    }
}
