//! The touch afresh from plain features: a vertex on a face, or an edge across an edge.

use super::pair::STEEP;
use super::portal::{Portal, Shadow};
use super::snap::{Place, Touch};
use crate::geometry::Feature;
use glam::DVec3;

/// Squared sine between two edges below which `snap` computes their normal with more care.
const PARALLEL: f64 = 1e-4;

/// The different ones of three numbers.
enum Different {
    One(u32),
    Two([u32; 2]),
    Three([u32; 3]),
}

impl Different {
    fn of([p, q, r]: [u32; 3]) -> Self {
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
        let (face, normal) = b.face_through(corners, portal.normal)?;
        if !a.peaks_at(vertex, self.turn.transpose() * -normal) {
            return None;
        }
        let height = |corner| normal.dot(b.local(corner));
        let top = corners.map(height).into_iter().fold(f64::MIN, f64::max);
        let local = a.local(vertex);
        let height = top - normal.dot(self.turn * local);
        let (time, normal) = self.time(portal, normal, height)?;
        Some(Touch {
            time,
            normal,
            features: [Feature::Vertex(vertex), Feature::Face(face)],
            point: Place::OnA(a.rotation * local),
            certain: true,
        })
    }

    fn face_on_vertex(&self, portal: &Portal, corners: [u32; 3], vertex: u32) -> Option<Touch> {
        let (a, b) = (&self.pair.a, &self.pair.b);
        let (face, outward) = a.face_through(corners, self.turn.transpose() * -portal.normal)?;
        let normal = -(self.turn * outward);
        if !b.peaks_at(vertex, normal) {
            return None;
        }
        let height = |corner| outward.dot(a.local(corner));
        let top = corners.map(height).into_iter().fold(f64::MIN, f64::max);
        let local = b.local(vertex);
        let height = top + normal.dot(local);
        let (time, normal) = self.time(portal, normal, height)?;
        Some(Touch {
            time,
            normal,
            features: [Feature::Face(face), Feature::Vertex(vertex)],
            point: Place::OnB(b.rotation * local),
            certain: true,
        })
    }

    fn edge_on_edge(&self, portal: &Portal, ends_a: [u32; 2], ends_b: [u32; 2]) -> Option<Touch> {
        let (a, b) = (&self.pair.a, &self.pair.b);
        let [from_a, to_a] = ends_a.map(|vertex| self.turn * a.local(vertex));
        let [from_b, to_b] = ends_b.map(|vertex| b.local(vertex));
        let (along_a, along_b) = (to_a - from_a, to_b - from_b);
        let cross = along_a.cross(along_b);
        let square = cross.length_squared();
        if square <= PARALLEL * along_a.length_squared() * along_b.length_squared() {
            return None;
        }
        let normal = cross * (1.0_f64.copysign(cross.dot(portal.normal)) / square.sqrt());
        let edge_b = b.crests_at(ends_b, normal)?;
        let edge_a = a.crests_at(ends_a, self.turn.transpose() * -normal)?;
        let height = normal.dot(from_b - from_a);
        let (time, normal) = self.time(portal, normal, height)?;
        // Where B's edge crosses A's, seen along the normal.
        let to_a = self.nearest + (time - self.pair.nearest_distance) * self.along;
        let share = along_a.cross(from_a + to_a - from_b).dot(cross) / square;
        let point = from_b + share.clamp(0.0, 1.0) * along_b;
        Some(Touch {
            time,
            normal,
            features: [Feature::Edge(edge_a), Feature::Edge(edge_b)],
            point: Place::OnB(b.rotation * point),
            certain: true,
        })
    }

    /// When A reaches the plane that holds B back, and its normal along the world's axes, if
    /// that agrees with the search; `height` is the difference's above its middle.
    fn time(&self, portal: &Portal, normal: DVec3, height: f64) -> Option<(f64, DVec3)> {
        let pair = self.pair;
        let outward = pair.b.rotation * normal;
        let speed = outward.dot(pair.motion);
        let time = (height - outward.dot(pair.offset)) / speed;
        let found = pair.nearest_distance + portal.time;
        // Features found a hair off the ray must not move it.
        let moved = (time - found) * speed.min(portal.normal.dot(self.along));
        let agrees =
            speed < 0.0 && normal.dot(portal.normal) > 0.999 && moved.abs() <= pair.doubt();
        // Of what is nearly along the motion rounding makes long times.
        agrees.then_some((if speed < -STEEP { time } else { found }, outward))
    }
}
