//! Coplanar triangles become one face.

use super::support::{Seen, Support};
use super::topology::{self, Lists};
use crate::geometry::Edge;
use crate::geometry::triangle::THIN;
use crate::math::exact::doubled_area;
use glam::DVec3;

/// Faces and edges of a closed surface of triangles.
pub(super) struct Faces {
    /// Outward unit normals.
    pub(super) normals: Vec<DVec3>,
    /// Vertices around each face, counter-clockwise seen from outside.
    pub(super) rims: Lists,
    /// Edges between different faces.
    pub(super) edges: Vec<Edge>,
    /// The face each triangle is part of.
    pub(super) of_triangle: Vec<u32>,
}

/// Not yet part of a face.
const NONE: u32 = u32::MAX;

/// How often a face's plane is laid anew while the face grows. A fan of thin
/// triangles, whose first plane is a bad one, needs two or three.
const FITS: usize = 6;

impl Faces {
    /// Gathers the triangles of a closed surface into faces, each flat to
    /// within `tolerance` metres.
    ///
    /// Faces grow from the largest triangles, over edges, as long as all corners
    /// lie within `tolerance` of *one* plane: that of the whole face, laid anew as
    /// it grows. So nothing creeps around a curved hull triangle by triangle. A
    /// triangle that faces the other way joins only if it is a sliver, lower
    /// than `tolerance`, whose own direction is rounding.
    pub(super) fn merge(vertices: &[DVec3], triangles: &[[u32; 3]], tolerance: f64) -> Self {
        let mut merger = Merger::new(vertices, triangles);
        let mut order: Vec<u32> = (0..triangles.len() as u32).collect();
        let size = |t: &u32| merger.areas[*t as usize].length_squared();
        order.sort_by(|s, t| size(t).total_cmp(&size(s)).then(s.cmp(t)));
        let mut groups = 0;
        for seed in order {
            if merger.group[seed as usize] == NONE {
                merger.grow(seed, groups, tolerance);
                groups += 1;
            }
        }
        merger.finish()
    }

    /// Which of `count` vertices are the end of an edge.
    pub(super) fn corners(&self, count: usize) -> Vec<u32> {
        let mut corner = vec![false; count];
        for &vertex in self.edges.iter().flat_map(|edge| &edge.vertices) {
            corner[vertex as usize] = true;
        }
        (0..count as u32).filter(|&v| corner[v as usize]).collect()
    }

    /// Gives every vertex a new number.
    pub(super) fn renumber(&mut self, numbers: &[u32]) {
        let edges = self.edges.iter_mut().flat_map(|edge| &mut edge.vertices);
        for vertex in self.rims.items_mut().iter_mut().chain(edges) {
            *vertex = numbers[*vertex as usize];
        }
    }

    /// For each face the largest `normal · x` over all vertices, as rounded.
    ///
    /// Asks the face's own vertices and those of the hull within rounding of the
    /// summit, instead of all.
    pub(super) fn offsets(
        &self,
        vertices: &[DVec3],
        triangles: &[[u32; 3]],
        support: &Support,
        tolerance: f64,
    ) -> Vec<f64> {
        let largest = (vertices.iter())
            .map(|vertex| vertex.abs().max_element())
            .fold(0.0, f64::max);
        let slack = tolerance + 16.0 * f64::EPSILON * largest;
        let mut seen = Seen::new(vertices.len());
        let mut offsets: Vec<f64> = (self.normals.iter())
            .map(|&normal| support.visit_summit(vertices, normal, slack, &mut seen))
            .collect();
        for (corners, &face) in triangles.iter().zip(&self.of_triangle) {
            let normal = self.normals[face as usize];
            let offset = &mut offsets[face as usize];
            for &corner in corners {
                *offset = offset.max(normal.dot(vertices[corner as usize]));
            }
        }
        offsets
    }
}

struct Merger<'a> {
    vertices: &'a [DVec3],
    triangles: &'a [[u32; 3]],
    neighbours: Vec<[u32; 3]>,
    /// Normals of the triangles, twice their area long.
    areas: Vec<DVec3>,
    /// Longest side of each triangle.
    longest: Vec<f64>,
    group: Vec<u32>,
    members: Vec<u32>,
}

impl<'a> Merger<'a> {
    fn new(vertices: &'a [DVec3], triangles: &'a [[u32; 3]]) -> Self {
        let (areas, longest) = (triangles.iter())
            .map(|corners| area_and_longest(corners.map(|c| vertices[c as usize])))
            .unzip();
        Self {
            vertices,
            triangles,
            neighbours: topology::neighbours(triangles),
            areas,
            longest,
            group: vec![NONE; triangles.len()],
            members: Vec::new(),
        }
    }

    /// Makes the face around `seed`.
    fn grow(&mut self, seed: u32, group: u32, tolerance: f64) {
        // A group with a hole, or one that touches itself, is no face: with a
        // finer tolerance it will be, and at the latest when it is one triangle.
        for tolerance in [tolerance, tolerance / 4.0, tolerance / 16.0] {
            let mut normal = unit(self.areas[seed as usize]);
            let mut size = 0;
            self.members.clear();
            for _ in 0..FITS {
                self.flood(seed, group, normal, tolerance);
                if self.members.len() <= size {
                    break;
                }
                size = self.members.len();
                normal = self.normal_of_members();
            }
            if self.members.len() == 1 || self.rim(group).is_some() {
                return;
            }
            self.release();
        }
        self.members.clear();
        self.group[seed as usize] = group;
    }

    fn release(&mut self) {
        for &member in &self.members {
            self.group[member as usize] = NONE;
        }
    }

    fn normal_of_members(&self) -> DVec3 {
        let areas = self.members.iter().map(|&t| self.areas[t as usize]);
        unit(areas.sum())
    }

    /// Takes into the group what can be reached from `seed` and is flat.
    fn flood(&mut self, seed: u32, group: u32, normal: DVec3, tolerance: f64) {
        self.release();
        // The plane's height: amid the corners taken so far, by the last normal.
        let origin = self.middle(seed);
        let heights = (self.members.iter())
            .flat_map(|&member| self.triangles[member as usize])
            .map(|corner| normal.dot(self.vertices[corner as usize] - origin));
        let (low, high) = heights.fold((0.0_f64, 0.0_f64), |(low, high), height| {
            (low.min(height), high.max(height))
        });
        let level = 0.5 * (low + high);
        self.members.clear();
        self.members.push(seed);
        self.group[seed as usize] = group;
        let mut next = 0;
        while let Some(&member) = self.members.get(next) {
            next += 1;
            for neighbour in self.neighbours[member as usize] {
                let n = neighbour as usize;
                if self.group[n] != NONE {
                    continue;
                }
                let flat = self.triangles[n].iter().all(|&corner| {
                    let height = normal.dot(self.vertices[corner as usize] - origin);
                    (height - level).abs() <= tolerance
                });
                if flat && self.areas[n].dot(normal) >= -tolerance * self.longest[n] {
                    self.group[n] = group;
                    self.members.push(neighbour);
                }
            }
        }
    }

    fn middle(&self, triangle: u32) -> DVec3 {
        let [a, b, c] = self.triangles[triangle as usize].map(|c| self.vertices[c as usize]);
        a + ((b - a) + (c - a)) / 3.0
    }

    /// The vertices around the group, if its border is one loop that does not
    /// touch itself: then the group is a disc.
    fn rim(&self, group: u32) -> Option<Vec<u32>> {
        let inside =
            |t: u32, slot: usize| self.group[self.neighbours[t as usize][slot] as usize] == group;
        let mut border = 0;
        let mut start = None;
        for &t in &self.members {
            for slot in 0..3 {
                if !inside(t, slot) {
                    border += 1;
                    start = start.or(Some((t, slot)));
                }
            }
        }
        let (mut t, mut slot) = start?;
        let mut rim = Vec::with_capacity(border);
        while rim.len() < border {
            rim.push(self.triangles[t as usize][slot]);
            slot = (slot + 1) % 3;
            while inside(t, slot) {
                let pivot = self.triangles[t as usize][slot];
                t = self.neighbours[t as usize][slot];
                let corners = self.triangles[t as usize];
                slot = (0..3).find(|&slot| corners[slot] == pivot)?;
            }
        }
        // Back too early means a second loop somewhere: some vertex came twice.
        let mut sorted = rim.clone();
        sorted.sort_unstable();
        sorted.dedup();
        (start == Some((t, slot)) && sorted.len() == border).then_some(rim)
    }

    /// Numbers the faces by their first triangles and collects their edges.
    fn finish(mut self) -> Faces {
        let groups = self.group.iter().max().map_or(0, |&last| last as usize + 1);
        let mut face_of = vec![NONE; groups];
        let mut members: Vec<Vec<u32>> = Vec::new();
        for (triangle, &group) in self.group.iter().enumerate() {
            let face = &mut face_of[group as usize];
            if *face == NONE {
                *face = members.len() as u32;
                members.push(Vec::new());
            }
            members[*face as usize].push(triangle as u32);
        }
        for group in &mut self.group {
            *group = face_of[*group as usize];
        }
        let count = self.vertices.len() as f64;
        let inside: DVec3 = self.vertices.iter().map(|&v| v / count).sum();
        let mut faces = Faces {
            normals: Vec::with_capacity(members.len()),
            rims: Lists::new(),
            edges: Vec::new(),
            of_triangle: Vec::new(),
        };
        for (face, members) in members.into_iter().enumerate() {
            self.members = members;
            let normal = self.normal_of_members();
            // Triangles too thin for any normal: outwards is all there is to say.
            let normal = if normal == DVec3::ZERO {
                (self.middle(self.members[0]) - inside).normalize_or(DVec3::Z)
            } else {
                normal
            };
            faces.normals.push(normal);
            let rim = self.rim(face as u32);
            debug_assert!(rim.is_some(), "face {face} is no disc");
            faces.rims.push(rim.into_iter().flatten());
            for &t in &self.members {
                for slot in 0..3 {
                    let corners = self.triangles[t as usize];
                    let (from, to) = (corners[slot], corners[(slot + 1) % 3]);
                    let beyond = self.group[self.neighbours[t as usize][slot] as usize];
                    if from < to && beyond != face as u32 {
                        faces.edges.push(Edge {
                            vertices: [from, to],
                            faces: [face as u32, beyond],
                        });
                    }
                }
            }
        }
        faces.edges.sort_unstable_by_key(|edge| edge.vertices);
        faces.of_triangle = self.group;
        faces
    }
}

/// Of length one, or zero. Divides instead of multiplying by the reciprocal, so
/// that a face along the axes gets an exact normal.
fn unit(vector: DVec3) -> DVec3 {
    let length = vector.length();
    if length > 0.0 {
        vector / length
    } else {
        DVec3::ZERO
    }
}

/// Normal, twice the area long, and the longest side. Taken from the two
/// shorter sides, whose product is the least rounded; that of a thin triangle afresh with twice
/// the digits, or its plane would not go through its corners.
fn area_and_longest([a, b, c]: [DVec3; 3]) -> (DVec3, f64) {
    let (ab, bc, ca) = (b - a, c - b, a - c);
    let (x, y, z) = (
        ab.length_squared(),
        bc.length_squared(),
        ca.length_squared(),
    );
    let (area, longest, others) = if x >= y && x >= z {
        (bc.cross(ca), x, y * z)
    } else if y >= z {
        (ca.cross(ab), y, z * x)
    } else {
        (ab.cross(bc), z, x * y)
    };
    let is_thin = area.length_squared() < THIN * THIN * others;
    let area = if is_thin { doubled_area(a, b, c) } else { area };
    (area, longest.sqrt())
}
