//! The farthest vertex along a direction.

use super::Lanes;
use super::topology::Lists;
use glam::DVec3;

/// Up to this many vertices are compared one by one; with more, climbing over
/// edges is faster. Measured by `benches/polytope.rs`; only time depends on it.
const SCAN: usize = Lanes::FEW;

/// Vertices per cell of the table of starts: with one a climb takes about one step, and the
/// table is small beside the vertices.
const VERTICES_PER_CELL: usize = 1;

/// How to find the farthest vertex of a convex body.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Support {
    /// For each vertex of the exact hull those it shares an edge with; nothing
    /// for a vertex that is no corner of the hull. A summit on this graph is *the*
    /// summit; on a mesh that is convex to within rounding it need not be.
    climb: Lists,
    /// Each side of a cube around the origin has `cells × cells` cells.
    cells: usize,
    /// For each cell the farthest vertex along its middle; empty if vertices are scanned.
    starts: Vec<u32>,
}

impl Support {
    /// `first` is a corner of the hull.
    pub(super) fn new(vertices: &[DVec3], climb: Lists, first: u32) -> Self {
        let mut support = Self {
            climb,
            cells: ((vertices.len() / (6 * VERTICES_PER_CELL)) as f64)
                .sqrt()
                .ceil()
                .max(1.0) as usize,
            starts: Vec::new(),
        };
        if vertices.len() > SCAN {
            let mut start = first;
            for cell in 0..6 * support.cells * support.cells {
                start = support.climb(vertices, support.middle(cell), start);
                support.starts.push(start);
            }
        }
        support
    }

    /// A vertex farthest along `direction`.
    pub(super) fn vertex(&self, vertices: &[DVec3], direction: DVec3) -> u32 {
        match self.by_table(direction) {
            Some(start) => self.climb(vertices, direction, start),
            None => scan(vertices, direction),
        }
    }

    /// The same, sought from a vertex that may be nearer than the table's.
    pub(super) fn vertex_near(&self, vertices: &[DVec3], direction: DVec3, guess: u32) -> u32 {
        let Some(start) = self.by_table(direction) else {
            return scan(vertices, direction);
        };
        let reach = |vertex: u32| direction.dot(vertices[vertex as usize]);
        let nearer = reach(guess) > reach(start);
        let start = std::hint::select_unpredictable(nearer, guess, start);
        self.climb(vertices, direction, start)
    }

    /// The vertex that the table has for a direction; none without one.
    #[inline]
    pub(super) fn by_table(&self, direction: DVec3) -> Option<u32> {
        self.starts.get(self.cell(direction)).copied()
    }

    /// The farthest of the table's vertex and of those around it: as a rule of all.
    #[inline]
    pub(super) fn by_ring(&self, vertices: &[DVec3], direction: DVec3) -> Option<u32> {
        let vertex = self.by_table(direction)?;
        Some(self.highest_around(vertices, direction, vertex).0)
    }

    /// By how much less than the farthest vertex the table's may reach along a direction, in shares
    /// of its length and of the largest distance between two vertices.
    ///
    /// That one is the farthest along the middle of the direction's cell, which on a face of the cube is
    /// no farther off than half a cell's diagonal.
    pub(super) fn table_error(&self) -> f64 {
        std::f64::consts::SQRT_2 / self.cells as f64
    }

    /// The corners of the exact hull around one of them.
    pub(super) fn neighbours(&self, vertex: u32) -> &[u32] {
        self.climb.get(vertex as usize)
    }

    /// All corners of the hull that may be as far along `normal` as any, to
    /// within `slack`; of a convex body they hang together.
    pub(super) fn visit_summit(
        &self,
        vertices: &[DVec3],
        normal: DVec3,
        slack: f64,
        seen: &mut Seen,
    ) -> f64 {
        let reach = |vertex: u32| normal.dot(vertices[vertex as usize]);
        let summit = self.vertex(vertices, normal);
        let mut most = reach(summit);
        let floor = most - slack;
        seen.clear();
        seen.push(summit);
        let mut next = 0;
        while let Some(&vertex) = seen.list.get(next) {
            next += 1;
            for &neighbour in self.climb.get(vertex as usize) {
                let height = reach(neighbour);
                if height >= floor {
                    most = most.max(height);
                    seen.push(neighbour);
                }
            }
        }
        most
    }

    /// All corners of the hull that may be farthest along a direction between these; of a convex
    /// body they hang together.
    ///
    /// Some that are not are among them: left out are those that a single neighbour surpasses along
    /// every direction. If they are more than `most`, only some.
    pub(super) fn summits<'a, const N: usize>(
        &self,
        vertices: &[DVec3],
        directions: &[DVec3; N],
        most: usize,
        seen: &'a mut Seen,
    ) -> &'a [u32] {
        let middle = directions.iter().sum();
        seen.clear();
        seen.push(self.vertex(vertices, middle));
        let mut next = 0;
        while let Some(&vertex) = seen.list.get(next)
            && seen.list.len() <= most
        {
            next += 1;
            for &other in self.climb.get(vertex as usize) {
                if seen.listed[other as usize] {
                    continue;
                }
                let here = vertices[other as usize];
                let surpassed = |&higher: &u32| {
                    let step = here - vertices[higher as usize];
                    directions.iter().all(|direction| direction.dot(step) < 0.0)
                };
                if !self.climb.get(other as usize).iter().any(surpassed) {
                    seen.push(other);
                }
            }
        }
        &seen.list
    }

    /// From neighbour to higher neighbour. Heights are taken from differences
    /// of vertices: seen from afar, all of a cluster's vertices look equally high.
    ///
    /// A step must gain more than its rounding (six roundings, half an ulp each),
    /// or along a face's normal it would go round the face for ever.
    fn climb(&self, vertices: &[DVec3], direction: DVec3, start: u32) -> u32 {
        let mut best = start;
        // Products that underflow have no such bound on their rounding.
        for _ in 0..vertices.len() {
            let (higher, gain) = self.highest_around(vertices, direction, best);
            if higher == best {
                break;
            }
            let products = direction * (vertices[higher as usize] - vertices[best as usize]);
            if gain <= 4.0 * f64::EPSILON * products.abs().element_sum() {
                break;
            }
            best = higher;
        }
        best
    }

    /// The highest of a vertex and its neighbours, and how much higher it is.
    #[inline]
    fn highest_around(&self, vertices: &[DVec3], direction: DVec3, vertex: u32) -> (u32, f64) {
        let here = vertices[vertex as usize];
        let (mut gain, mut higher) = (0.0, vertex);
        for &neighbour in self.climb.get(vertex as usize) {
            let height = direction.dot(vertices[neighbour as usize] - here);
            // NaN is no gain. Two selections and no branch: which neighbour is higher
            // cannot be predicted.
            let up = height > gain;
            gain = if up { height } else { gain };
            higher = std::hint::select_unpredictable(up, neighbour, higher);
        }
        (higher, gain)
    }

    /// The cell `direction` runs through. NaN and zero get some cell: a cast
    /// from NaN to an integer gives 0.
    fn cell(&self, direction: DVec3) -> usize {
        let size = direction.abs();
        let axis = if size.x >= size.y && size.x >= size.z {
            0
        } else if size.y >= size.z {
            1
        } else {
            2
        };
        let DVec3 { x, y, z } = direction;
        let [main, first, second] = [[x, y, z], [y, z, x], [z, x, y]][axis];
        let scale = 0.5 * self.cells as f64 / main.abs();
        let place = |other: f64| {
            let place = (other * scale + 0.5 * self.cells as f64) as usize;
            place.min(self.cells - 1)
        };
        let side = 2 * axis + usize::from(main > 0.0);
        (side * self.cells + place(first)) * self.cells + place(second)
    }

    /// The direction through the middle of a cell.
    fn middle(&self, cell: usize) -> DVec3 {
        let (side, row, column) = (
            cell / (self.cells * self.cells),
            cell / self.cells % self.cells,
            cell % self.cells,
        );
        let place = |index: usize| (2 * index + 1) as f64 / self.cells as f64 - 1.0;
        let axis = side / 2;
        let mut direction = DVec3::ZERO;
        direction[axis] = if side % 2 == 1 { 1.0 } else { -1.0 };
        direction[(axis + 1) % 3] = place(row);
        direction[(axis + 2) % 3] = place(column);
        direction
    }
}

/// Each vertex in turn; of equals the first.
fn scan(vertices: &[DVec3], direction: DVec3) -> u32 {
    let (mut most, mut farthest) = (f64::NEG_INFINITY, 0);
    for (vertex, position) in vertices.iter().enumerate() {
        let reach = direction.dot(*position);
        // NaN is never farther. Two selections and no branch: which vertex is
        // farther than all before it cannot be predicted.
        let farther = reach > most;
        most = if farther { reach } else { most };
        farthest = std::hint::select_unpredictable(farther, vertex as u32, farthest);
    }
    farthest
}

/// A set of vertices, quick to empty.
pub(super) struct Seen {
    list: Vec<u32>,
    listed: Vec<bool>,
}

impl Seen {
    pub(super) fn new(count: usize) -> Self {
        Self {
            list: Vec::new(),
            listed: vec![false; count],
        }
    }

    fn clear(&mut self) {
        for &vertex in &self.list {
            self.listed[vertex as usize] = false;
        }
        self.list.clear();
    }

    fn push(&mut self, vertex: u32) {
        if !std::mem::replace(&mut self.listed[vertex as usize], true) {
            self.list.push(vertex);
        }
    }
}
