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

    /// How many of the points, the first, are points of the surface.
    pub(super) fn surface(&self) -> usize {
        self.len() - self.origins.len()
    }

    pub(super) fn origin(&self, index: usize) -> Origin {
        index
            .checked_sub(self.surface())
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

    /// Points on the surface over the aim, where the lattice's points fall; only before all
    /// vertices and edges.
    pub(super) fn push_aimed(&mut self, lattice: &[DVec2], aim: &Aim, body: &Shadow<'_>) {
        let before = self.len();
        aim.points(lattice, &mut self.xs, &mut self.ys);
        let (xs, ys) = (&self.xs[before..], &self.ys[before..]);
        body.depths(Side::Far, xs, ys, &mut self.zs);
    }

    /// The points over the aim where one body, a ball, touches a face of the other
    /// first; or the other itself, if it is a ball as well.
    pub(super) fn push_faces(&mut self, a: &Shadow<'_>, b: &Shadow<'_>, aim: &Aim) {
        if let (Some((from, radius_a)), Some((to, radius_b))) = (a.ball(), b.ball()) {
            // On the line between the centres, in whatever direction it leads.
            let at = from.lerp(to, radius_a / (radius_a + radius_b));
            self.push_surface(at.extend(a.depth(Side::Far, at)));
            return;
        }
        let (ball, faces, side) = if a.disc().is_some() {
            (a, b, Side::Near)
        } else {
            (b, a, Side::Far)
        };
        let Some(radius) = ball.disc() else {
            return;
        };
        faces.for_each_normal(side, |normal| {
            // Out of the faces' body, into the ball.
            let at = ball.centre.truncate() - radius * normal;
            if aim.clip(at, at).is_some() {
                self.push_surface(at.extend(a.depth(Side::Far, at)));
            }
        });
    }

    /// All vertices of a body; with an aim, those over it.
    pub(super) fn push_vertices(&mut self, body: &Outline<'_>, aim: Option<&Aim>) {
        for (index, &vertex) in body.vertices.iter().enumerate() {
            if aim.is_none_or(|aim| aim.clip(vertex.truncate(), vertex.truncate()).is_some()) {
                self.push(vertex, Origin::Vertex(index as u32));
            }
        }
    }

    /// On every edge that lies over the aim, the point that touches a ball first.
    ///
    /// The ball is the other body, `centre` its place. `side` is 1 for rays along
    /// the motion, −1 for those against it.
    pub(super) fn push_tangents(
        &mut self,
        body: &Outline<'_>,
        aim: &Aim,
        (centre, radius): (DVec2, f64),
        side: f64,
    ) {
        for edge in 0..body.edges() {
            let Some((from, to)) = body.edge(edge) else {
                continue;
            };
            let Some((enter, leave)) = aim.clip(from.truncate(), to.truncate()) else {
                continue;
            };
            // From the foot of the centre's perpendicular, at a share x of the
            // edge, the gap is −√(R² − x²L²) − xz, and least where
            // xL² = z√(R² − x²L²).
            let (along, rise) = ((to - from).truncate(), side * (to - from).z);
            let length_squared = along.length_squared();
            if length_squared <= 0.0 {
                // Along the motion: its ends are vertices.
                continue;
            }
            let foot = (centre - from.truncate()).dot(along) / length_squared;
            let aside = (from.truncate() + foot * along - centre).length();
            let half = f64::max((radius - aside) * (radius + aside), 0.0).sqrt();
            let length = (length_squared * (length_squared + rise * rise)).sqrt();
            let at = (foot + rise * half / length).clamp(enter, leave);
            let between = (at, at);
            self.push(from.lerp(to, at), Origin::Edge { edge, at, between });
        }
    }

    /// `each` points on every edge that lies over the aim, spread evenly.
    pub(super) fn push_edges(&mut self, body: &Outline<'_>, aim: &Aim, each: u32) {
        for edge in 0..body.edges() {
            let Some((from, to)) = body.edge(edge) else {
                continue;
            };
            let Some((enter, leave)) = aim.clip(from.truncate(), to.truncate()) else {
                continue;
            };
            let step = (leave - enter) / f64::from(each + 1);
            for index in 1..=each {
                let at = enter + f64::from(index) * step;
                let origin = Origin::Edge {
                    edge,
                    at,
                    between: ((at - step).max(enter), (at + step).min(leave)),
                };
                self.push(from.lerp(to, at), origin);
            }
        }
    }
}

/// A body's vertices and edges in view coordinates; a ball has none.
#[derive(Default)]
pub(super) struct Outline<'a> {
    mesh: Option<Mesh<'a>>,
    vertices: Vec<DVec3>,
}

impl<'a> Outline<'a> {
    pub(super) fn new(shape: &'a Shape, pose: &Pose, view: View, centre: DVec3) -> Self {
        let Some(mesh) = Mesh::of(shape) else {
            return Self::default();
        };
        let local =
            |vertex: DVec3| centre + view.coordinates(pose.direction(vertex - shape.centre()));
        let vertices = mesh.vertices.iter().map(|&v| local(v)).collect();
        Self {
            mesh: Some(mesh),
            vertices,
        }
    }

    /// How many edges there are.
    pub(super) fn edges(&self) -> u32 {
        // Vertices, and with them edges, are numbered by u32.
        self.mesh.as_ref().map_or(0, |mesh| mesh.edges.len() as u32)
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
    /// Whether it is a point of an edge whose neighbours may be nearer.
    pub(super) fn is_open(self) -> bool {
        matches!(self, Self::Edge { between, .. } if between.0 < between.1)
    }

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
    depths.clear();
    target.depths(Side::Near, &starts.xs, &starts.ys, depths);
    for (depth, start) in depths.iter_mut().zip(&starts.zs) {
        *depth -= start;
    }
}

/// As [`gaps_ahead`], for rays sent back against the motion.
pub(super) fn gaps_behind(starts: &Starts, target: &Shadow<'_>, depths: &mut Vec<f64>) {
    depths.clear();
    target.depths(Side::Far, &starts.xs, &starts.ys, depths);
    for (depth, start) in depths.iter_mut().zip(&starts.zs) {
        *depth = start - *depth;
    }
}
