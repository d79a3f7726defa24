//! The convex hull of points, exact.

use super::orient::side;
use super::simplex::simplex;
use super::support::Support;
use super::topology::vertex_neighbours;
use super::trim::trim;
use crate::error::ShapeError;
use glam::DVec3;

/// Vertices and triangles of a convex hull.
pub(super) struct Hull {
    /// Numbers of the points that are corners of the hull, ascending.
    pub(super) vertices: Vec<u32>,
    /// Counter-clockwise seen from outside; they name places in `vertices`.
    pub(super) triangles: Vec<[u32; 3]>,
    /// How thick the points are, in metres, to within a small factor.
    pub(super) thickness: f64,
}

impl Hull {
    /// The triangles by the numbers of the points.
    pub(super) fn triangles_of_points(&self) -> impl Iterator<Item = [u32; 3]> {
        (self.triangles.iter()).map(|corners| corners.map(|c| self.vertices[c as usize]))
    }

    /// Those of `all`, one for each point, that belong to the vertices.
    pub(super) fn pick<T: Copy>(&self, all: &[T]) -> Vec<T> {
        self.vertices.iter().map(|&v| all[v as usize]).collect()
    }

    /// The corners' mean: a point inside.
    pub(super) fn middle(&self, points: &[DVec3]) -> DVec3 {
        let count = self.vertices.len() as f64;
        (self.vertices.iter())
            .map(|&vertex| points[vertex as usize] / count)
            .sum()
    }

    /// How to find the farthest of the points.
    pub(super) fn support(&self, points: &[DVec3]) -> Support {
        let triangles: Vec<[u32; 3]> = self.triangles_of_points().collect();
        let climb = vertex_neighbours(points.len(), &triangles);
        Support::new(points, climb, self.vertices.first().copied().unwrap_or(0))
    }

    /// What rounding may have moved the points by, in metres: 16 ulp of the
    /// largest coordinate. A rotation and a shift cost about four.
    pub(super) fn rounding(&self, points: &[DVec3]) -> f64 {
        let largest = (self.vertices.iter())
            .map(|&vertex| points[vertex as usize].abs().max_element())
            .fold(0.0, f64::max);
        16.0 * f64::EPSILON * largest
    }

    /// How far the vertices of one face may lie from its plane, in metres:
    /// their rounding, but never so much that the two sides of a thin body
    /// become one.
    pub(super) fn flatness(&self, points: &[DVec3]) -> f64 {
        self.rounding(points).min(1e-3 * self.thickness)
    }
}

/// A triangle of the growing hull.
pub(super) struct Facet {
    /// Counter-clockwise seen from outside.
    pub(super) corners: [u32; 3],
    /// The facet across the edge from corner `i` to corner `i + 1`.
    pub(super) neighbours: [u32; 3],
    /// Points strictly above its plane, each on the list of one facet only.
    outside: Vec<u32>,
    alive: bool,
    /// The last apex that saw it; `u32::MAX` for none.
    seen_by: u32,
}

impl Facet {
    fn new(corners: [u32; 3], neighbours: [u32; 3]) -> Self {
        Self {
            corners,
            neighbours,
            outside: Vec::new(),
            alive: true,
            seen_by: u32::MAX,
        }
    }
}

/// The convex hull of distinct, finite, [tidied](super::orient::tidied) points.
///
/// Quickhull (Barber, Dobkin, Huhdanpaa 1996), but every decision is the exact
/// sign of a determinant, so there are no thick facets and nothing to repair.
/// A point on a facet's plane does not see it; what an apex sees is then one
/// disc, as if the apex stood a hair closer to the hull, and no new triangle is
/// degenerate because an apex above a facet lies on none of its edges' lines.
/// At last [`trim`] removes points inside faces and edges.
pub(super) fn convex_hull(points: &[DVec3]) -> Result<Hull, ShapeError> {
    let start = simplex(points)?;
    let mut quickhull = Quickhull::new(points, start.corners);
    while let Some(facet) = quickhull.pending.pop() {
        quickhull.expand(facet);
    }
    let facets = quickhull.finish();
    let (vertices, triangles) = trim(points, &facets);
    Ok(Hull {
        vertices,
        triangles,
        thickness: start.thickness,
    })
}

/// An edge of the rim of what an apex sees.
struct RimEdge {
    from: u32,
    to: u32,
    /// The unseen facet beyond it.
    beyond: u32,
}

struct Quickhull<'a> {
    points: &'a [DVec3],
    facets: Vec<Facet>,
    /// Facets that may have points outside.
    pending: Vec<u32>,
    /// The new facet whose rim edge starts at a point; only read where just written.
    facet_from: Vec<u32>,
    seen: Vec<u32>,
    rim: Vec<RimEdge>,
}

impl<'a> Quickhull<'a> {
    /// The tetrahedron `a b c d`, where `d` lies below the triangle `a b c`.
    fn new(points: &'a [DVec3], [a, b, c, d]: [u32; 4]) -> Self {
        let mut hull = Self {
            points,
            facets: vec![
                Facet::new([a, b, c], [1, 2, 3]),
                Facet::new([b, a, d], [0, 3, 2]),
                Facet::new([c, b, d], [0, 1, 3]),
                Facet::new([a, c, d], [0, 2, 1]),
            ],
            pending: Vec::new(),
            facet_from: vec![0; points.len()],
            seen: Vec::new(),
            rim: Vec::new(),
        };
        for point in 0..points.len() as u32 {
            hull.assign(point, 0..4);
        }
        hull.pending.extend(0..4);
        hull
    }

    fn corners(&self, facet: u32) -> [DVec3; 3] {
        self.facets[facet as usize]
            .corners
            .map(|corner| self.points[corner as usize])
    }

    fn sees(&self, point: u32, facet: u32) -> bool {
        side(self.corners(facet), self.points[point as usize]) > 0.0
    }

    /// Puts the point on the list of the first of `facets` it sees, if any.
    fn assign(&mut self, point: u32, mut facets: std::ops::Range<u32>) {
        if let Some(facet) = facets.find(|&facet| self.sees(point, facet)) {
            self.facets[facet as usize].outside.push(point);
        }
    }

    /// The point on the facet's list farthest above it: rounded, but any point
    /// of the list is a good one.
    fn farthest(&self, facet: u32) -> Option<u32> {
        let [a, b, c] = self.corners(facet);
        let normal = (b - a).cross(c - a);
        let height = |point: u32| normal.dot(self.points[point as usize] - a);
        let outside = self.facets[facet as usize].outside.iter().copied();
        outside.reduce(|best, point| {
            if height(point) > height(best) {
                point
            } else {
                best
            }
        })
    }

    /// Replaces all facets that the farthest point outside `facet` sees by a
    /// cone from that point to the rim.
    fn expand(&mut self, facet: u32) {
        if !self.facets[facet as usize].alive {
            return;
        }
        let Some(apex) = self.farthest(facet) else {
            return;
        };
        self.flood(apex, facet);
        let first = self.facets.len() as u32;
        self.cone(apex);
        let new = first..self.facets.len() as u32;
        // A point above a seen facet and above none of the new ones is inside:
        // if it saw a surviving facet, it would also see the new facet on the
        // rim between the two, whose plane lies between theirs.
        for seen in std::mem::take(&mut self.seen) {
            let facet = &mut self.facets[seen as usize];
            facet.alive = false;
            for point in std::mem::take(&mut facet.outside) {
                if point != apex {
                    self.assign(point, new.clone());
                }
            }
        }
        self.pending
            .extend(new.filter(|&facet| !self.facets[facet as usize].outside.is_empty()));
    }

    /// Finds all facets `apex` sees, starting from one of them, and their rim.
    fn flood(&mut self, apex: u32, start: u32) {
        self.seen.clear();
        self.rim.clear();
        self.seen.push(start);
        self.facets[start as usize].seen_by = apex;
        let mut next = 0;
        while let Some(&facet) = self.seen.get(next) {
            next += 1;
            let Facet {
                corners,
                neighbours,
                ..
            } = self.facets[facet as usize];
            for slot in 0..3 {
                let beyond = neighbours[slot];
                if self.facets[beyond as usize].seen_by == apex {
                    continue;
                }
                if self.sees(apex, beyond) {
                    self.facets[beyond as usize].seen_by = apex;
                    self.seen.push(beyond);
                } else {
                    self.rim.push(RimEdge {
                        from: corners[slot],
                        to: corners[(slot + 1) % 3],
                        beyond,
                    });
                }
            }
        }
    }

    /// Adds a facet from every rim edge to `apex`.
    fn cone(&mut self, apex: u32) {
        let first = self.facets.len();
        for edge in &self.rim {
            let new = self.facets.len() as u32;
            self.facet_from[edge.from as usize] = new;
            self.facets.push(Facet::new(
                [edge.from, edge.to, apex],
                [edge.beyond, u32::MAX, u32::MAX],
            ));
            let beyond = &mut self.facets[edge.beyond as usize];
            for slot in 0..3 {
                if beyond.corners[slot] == edge.to && beyond.corners[(slot + 1) % 3] == edge.from {
                    beyond.neighbours[slot] = new;
                }
            }
        }
        for new in first..self.facets.len() {
            let to = self.facets[new].corners[1];
            let follower = self.facet_from[to as usize];
            self.facets[new].neighbours[1] = follower;
            self.facets[follower as usize].neighbours[2] = new as u32;
        }
    }

    /// The facets that survived, renumbered.
    fn finish(self) -> Vec<Facet> {
        let mut count = 0;
        let number: Vec<u32> = (self.facets.iter())
            .map(|facet| {
                let number = count;
                count += u32::from(facet.alive);
                number
            })
            .collect();
        let mut facets: Vec<Facet> = self.facets.into_iter().filter(|f| f.alive).collect();
        for facet in &mut facets {
            facet.neighbours = facet.neighbours.map(|n| number[n as usize]);
        }
        facets
    }
}
