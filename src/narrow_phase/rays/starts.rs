//! Rays' starting points, and the rays that they send.

use crate::geometry::{Feature, Mesh, Pose, Shape};
use crate::narrow_phase::rays::aim::Aim;
use crate::narrow_phase::rays::shadow::{Shadow, Side, View};
use glam::{DVec2, DVec3};

/// Starting points on one body as a structure of arrays, in view coordinates:
/// first those somewhere on the surface, then vertices and points of edges.
#[derive(Default)]
pub(super) struct Starts {
    pub(super) xs: Vec<f64>,
    pub(super) ys: Vec<f64>,
    /// Depth of the point along the motion.
    pub(super) zs: Vec<f64>,
    /// Of the points after those on the surface.
    origins: Vec<Origin>,
}

/// What a starting point is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Origin {
    /// A point somewhere on the surface.
    Area,
    /// A vertex.
    Vertex(u32),
    /// A point of an edge, at this share between its ends; the last numbers are
    /// the shares up to which its neighbours on the edge have been looked at.
    Edge {
        edge: u32,
        at: f64,
        between: (f64, f64),
    },
}

impl Starts {
    pub(super) fn clear(&mut self) {
        self.xs.clear();
        self.ys.clear();
        self.zs.clear();
        self.origins.clear();
    }

    pub(super) fn len(&self) -> usize {
        self.xs.len()
    }

    pub(super) fn origin(&self, index: usize) -> Origin {
        let surface = self.len() - self.origins.len();
        index
            .checked_sub(surface)
            .and_then(|index| self.origins.get(index).copied())
            .unwrap_or(Origin::Area)
    }

    fn push(&mut self, point: DVec3, origin: Origin) {
        self.push_surface(point);
        self.origins.push(origin);
    }

    /// A point on the surface; only before all vertices and edges.
    pub(super) fn push_surface(&mut self, point: DVec3) {
        self.xs.push(point.x);
        self.ys.push(point.y);
        self.zs.push(point.z);
    }

    /// Points on the surface over the aim, where the lattice's points fall.
    pub(super) fn push_aimed(&mut self, lattice: &[DVec2], aim: &Aim, body: &Shadow<'_>) {
        debug_assert!(self.xs.is_empty(), "points over the aim come first");
        aim.points(lattice, &mut self.xs, &mut self.ys);
        body.depths(Side::Far, &self.xs, &self.ys, &mut self.zs);
    }

    /// All vertices of a body; with an aim, those over it.
    pub(super) fn push_vertices(&mut self, body: &Outline<'_>, aim: Option<&Aim>) {
        for (index, &vertex) in body.vertices.iter().enumerate() {
            if aim.is_none_or(|aim| aim.clip(vertex.truncate(), vertex.truncate()).is_some()) {
                self.push(vertex, Origin::Vertex(index as u32));
            }
        }
    }

    /// `each` points on every edge that lies over the aim, spread evenly.
    pub(super) fn push_edges(&mut self, body: &Outline<'_>, aim: &Aim, each: u32) {
        for edge in 0..body.mesh.as_ref().map_or(0, |mesh| mesh.edges.len()) {
            let Some((from, to)) = body.edge(edge as u32) else {
                continue;
            };
            let Some((enter, leave)) = aim.clip(from.truncate(), to.truncate()) else {
                continue;
            };
            let step = (leave - enter) / f64::from(each + 1);
            for index in 1..=each {
                let at = enter + f64::from(index) * step;
                let origin = Origin::Edge {
                    edge: edge as u32,
                    at,
                    between: ((at - step).max(enter), (at + step).min(leave)),
                };
                self.push(from.lerp(to, at), origin);
            }
        }
    }
}

/// A body's vertices and edges in view coordinates.
pub(super) struct Outline<'a> {
    mesh: Option<Mesh<'a>>,
    vertices: Vec<DVec3>,
}

impl<'a> Outline<'a> {
    pub(super) fn new(shape: &'a Shape, pose: &Pose, view: View, centre: DVec3) -> Self {
        let mesh = Mesh::of(shape);
        let local =
            |vertex: DVec3| centre + view.coordinates(pose.direction(vertex - shape.centre()));
        let vertices = mesh.as_ref().map_or_else(Vec::new, |mesh| {
            mesh.vertices.iter().map(|&v| local(v)).collect()
        });
        Self { mesh, vertices }
    }

    /// The two ends of an edge.
    pub(super) fn edge(&self, edge: u32) -> Option<(DVec3, DVec3)> {
        let [from, to] = self.mesh.as_ref()?.edges.get(edge as usize)?.vertices;
        Some((
            *self.vertices.get(from as usize)?,
            *self.vertices.get(to as usize)?,
        ))
    }
}

impl Origin {
    /// The feature of a body that a point of this origin belongs to; `surface`
    /// for points that are neither on a vertex nor on an edge.
    pub(super) fn feature(self, surface: Feature) -> Feature {
        match self {
            Self::Area => surface,
            Self::Vertex(vertex) => Feature::Vertex(vertex),
            Self::Edge { edge, .. } => Feature::Edge(edge),
        }
    }
}

/// Which shadow gives the rest of the line: kept beside the points it belongs to.
pub(super) fn gaps_ahead(starts: &Starts, target: &Shadow<'_>, depths: &mut Vec<f64>) {
    target.depths(Side::Near, &starts.xs, &starts.ys, depths);
    for (depth, start) in depths.iter_mut().zip(&starts.zs) {
        *depth -= start;
    }
}

/// As [`gaps_ahead`], for rays sent back against the motion.
pub(super) fn gaps_behind(starts: &Starts, target: &Shadow<'_>, depths: &mut Vec<f64>) {
    target.depths(Side::Far, &starts.xs, &starts.ys, depths);
    for (depth, start) in depths.iter_mut().zip(&starts.zs) {
        *depth = start - *depth;
    }
}
