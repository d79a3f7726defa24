//! The touch afresh from plain features: a vertex on a face, or an edge across an edge.

use super::pair::{Pair, STEEP};
use super::portal::{Portal, Shadow};
use super::snap::{FEATURE, Place, Touch};
use crate::geometry::Feature;
use glam::DVec3;

/// Squared sine between two edges below which `snap` computes their normal with more care.
const PARALLEL: f64 = 1e-4;

/// An edge of A and one of B that are not nearly parallel.
pub(super) struct SkewEdges {
    pub(super) from: [DVec3; 2],
    pub(super) along: [DVec3; 2],
    pub(super) cross: DVec3,
    /// That of the cross product.
    pub(super) square: f64,
}

impl SkewEdges {
    /// By the edges' ends; none if `snap` has to compute their normal.
    #[inline]
    pub(super) fn of(pair: &Pair, ends_a: [u32; 2], ends_b: [u32; 2]) -> Option<Self> {
        let [from_a, to_a] = ends_a.map(|vertex| pair.a.vertex(vertex));
        let [from_b, to_b] = ends_b.map(|vertex| pair.b.vertex(vertex));
        let (along_a, along_b) = (to_a - from_a, to_b - from_b);
        let cross = along_a.cross(along_b);
        let square = cross.length_squared();
        let skew = square > PARALLEL * along_a.length_squared() * along_b.length_squared();
        skew.then_some(Self {
            from: [from_a, from_b],
            along: [along_a, along_b],
            cross,
            square,
        })
    }
}

/// The different ones of three numbers.
pub(super) enum Different {
    One(u32),
    Two([u32; 2]),
    Three([u32; 3]),
}

impl Different {
    pub(super) fn of([p, q, r]: [u32; 3]) -> Self {
        match (p == q, q == r, r == p) {
            (true, true, _) => Self::One(p),
            (true, false, _) | (false, true, _) => Self::Two([p, r]),
            (false, false, true) => Self::Two([p, q]),
            (false, false, false) => Self::Three([p, q, r]),
        }
    }
}

impl Shadow<'_> {
    /// The touch of the features that make a portal; none if they are not plain, or rounding
    /// might decide which they are.
    pub(super) fn settle(&self, portal: &Portal) -> Option<Touch> {
        use Different::{One, Three, Two};
        let [p, q, r] = portal.probes.map(|probe| probe.vertices);
        match (
            Different::of([p[0], q[0], r[0]]),
            Different::of([p[1], q[1], r[1]]),
        ) {
            (One(vertex), Three(face)) => self.vertex_on_face(portal, vertex, face),
            (Three(face), One(vertex)) => self.face_on_vertex(portal, face, vertex),
            (Two(edge_a), Two(edge_b)) => self.edge_on_edge(portal, edge_a, edge_b),
            _ => None,
        }
    }

    fn vertex_on_face(&self, portal: &Portal, vertex: u32, corners: [u32; 3]) -> Option<Touch> {
        let (a, b) = (&self.pair.a, &self.pair.b);
        let (face, normal) = b.face_through(corners, b.rotation.transpose() * portal.normal)?;
        let outward = b.rotation * normal;
        if !a.stand_out([vertex], -outward, FEATURE * a.radius) {
            return None;
        }
        let place = a.vertex(vertex);
        let height = |corner| normal.dot(b.local(corner));
        let top = corners.map(height).into_iter().fold(f64::MIN, f64::max);
        Some(Touch {
            time: self.time(portal, outward, top - outward.dot(place))?,
            normal: outward,
            features: [Feature::Vertex(vertex), Feature::Face(face)],
            point: Place::OnA(place),
            certain: true,
        })
    }

    fn face_on_vertex(&self, portal: &Portal, corners: [u32; 3], vertex: u32) -> Option<Touch> {
        let (a, b) = (&self.pair.a, &self.pair.b);
        let (face, normal) = a.face_through(corners, a.rotation.transpose() * -portal.normal)?;
        let outward = -(a.rotation * normal);
        if !b.stand_out([vertex], outward, FEATURE * b.radius) {
            return None;
        }
        let place = b.vertex(vertex);
        let height = |corner| normal.dot(a.local(corner));
        let top = corners.map(height).into_iter().fold(f64::MIN, f64::max);
        Some(Touch {
            time: self.time(portal, outward, outward.dot(place) + top)?,
            normal: outward,
            features: [Feature::Face(face), Feature::Vertex(vertex)],
            point: Place::OnB(place),
            certain: true,
        })
    }

    fn edge_on_edge(&self, portal: &Portal, ends_a: [u32; 2], ends_b: [u32; 2]) -> Option<Touch> {
        let (a, b) = (&self.pair.a, &self.pair.b);
        let SkewEdges {
            from: [from_a, from_b],
            along: [along_a, along_b],
            cross,
            square,
        } = SkewEdges::of(self.pair, ends_a, ends_b)?;
        let outward = cross * (1.0_f64.copysign(cross.dot(portal.normal)) / square.sqrt());
        if !(b.stand_out(ends_b, outward, FEATURE * b.radius)
            && a.stand_out(ends_a, -outward, FEATURE * a.radius))
        {
            return None;
        }
        let (edge_a, edge_b) = (a.edge_between(ends_a)?, b.edge_between(ends_b)?);
        let time = self.time(portal, outward, outward.dot(from_b - from_a))?;
        // Where B's edge crosses A's, seen along the normal.
        let to_a = self.pair.nearest + (time - self.pair.nearest_distance) * self.pair.motion;
        let share = along_a.cross(from_a + to_a - from_b).dot(cross) / square;
        let point = from_b + share.clamp(0.0, 1.0) * along_b;
        Some(Touch {
            time,
            normal: outward,
            features: [Feature::Edge(edge_a), Feature::Edge(edge_b)],
            point: Place::OnB(point),
            certain: true,
        })
    }

    /// When A reaches the plane that holds B back, if that agrees with the search; `height` is the
    /// difference's along the plane's normal.
    fn time(&self, portal: &Portal, outward: DVec3, height: f64) -> Option<f64> {
        let pair = self.pair;
        let speed = outward.dot(pair.motion);
        let time = (height - outward.dot(pair.offset)) / speed;
        let found = pair.nearest_distance + portal.time;
        // Features found a hair off the ray must not move it.
        let moved = (time - found) * speed.min(portal.normal.dot(pair.motion));
        let agrees =
            speed < 0.0 && outward.dot(portal.normal) > 0.999 && moved.abs() <= pair.doubt();
        // Of what is nearly along the motion rounding makes long times.
        agrees.then_some(if speed < -STEEP { time } else { found })
    }
}
