//! A touch proven by itself: plain features that meet well inside, and on their normal nothing
//! farther.
//!
//! Where the vertex lies in the face, or the edges cross, a point of A is a point of B; that all other
//! vertices lie clearly lower along the normal makes it the first. So whoever guesses the features
//! need not be believed.

use super::pair::{Pair, STEEP};
use super::settle::{Different, SkewEdges};
use super::snap::{FEATURE, Place, Touch};
use crate::geometry::Feature;
use glam::DVec3;

impl Pair<'_> {
    /// The touch of the features that three pairs of vertices of A and B make up; none if rounding
    /// might decide.
    #[inline]
    pub(super) fn prove(&self, [p, q, r]: [[u32; 2]; 3]) -> Option<Touch> {
        use Different::{One, Three, Two};
        match (
            Different::of([p[0], q[0], r[0]]),
            Different::of([p[1], q[1], r[1]]),
        ) {
            (One(vertex), Three(face)) => self.vertex_in_face(vertex, face),
            (Three(face), One(vertex)) => self.face_around_vertex(face, vertex),
            (Two(edge_a), Two(edge_b)) => self.edges_cross(edge_a, edge_b),
            _ => None,
        }
    }

    fn vertex_in_face(&self, vertex: u32, corners: [u32; 3]) -> Option<Touch> {
        let (a, b) = (&self.a, &self.b);
        let [p, q, r] = corners.map(|corner| b.local(corner));
        let back = b.rotation.transpose();
        let area = (q - p).cross(r - p);
        let against = if area.dot(back * self.motion) < 0.0 {
            area
        } else {
            -area
        };
        let (face, normal) = b.face_through(corners, against)?;
        let outward = b.rotation * normal;
        let place = a.vertex(vertex);
        let top = normal.dot(p).max(normal.dot(q)).max(normal.dot(r));
        let time = self.steep_time(outward, top - outward.dot(place))?;
        let met = back * (place + self.way(time));
        let proven = self.is_inside([p, q, r].map(|corner| corner - met), normal)
            && a.stand_out([vertex], -outward, FEATURE * a.radius);
        proven.then_some(Touch {
            time,
            normal: outward,
            features: [Feature::Vertex(vertex), Feature::Face(face)],
            point: Place::OnA(place),
            certain: true,
        })
    }

    fn face_around_vertex(&self, corners: [u32; 3], vertex: u32) -> Option<Touch> {
        let (a, b) = (&self.a, &self.b);
        let [p, q, r] = corners.map(|corner| a.local(corner));
        let back = a.rotation.transpose();
        let area = (q - p).cross(r - p);
        let against = if area.dot(back * self.motion) > 0.0 {
            area
        } else {
            -area
        };
        let (face, normal) = a.face_through(corners, against)?;
        let outward = -(a.rotation * normal);
        let place = b.vertex(vertex);
        let top = normal.dot(p).max(normal.dot(q)).max(normal.dot(r));
        let time = self.steep_time(outward, outward.dot(place) + top)?;
        let met = back * (place - self.way(time));
        let proven = self.is_inside([p, q, r].map(|corner| corner - met), normal)
            && b.stand_out([vertex], outward, FEATURE * b.radius);
        proven.then_some(Touch {
            time,
            normal: outward,
            features: [Feature::Face(face), Feature::Vertex(vertex)],
            point: Place::OnB(place),
            certain: true,
        })
    }

    fn edges_cross(&self, ends_a: [u32; 2], ends_b: [u32; 2]) -> Option<Touch> {
        let (a, b) = (&self.a, &self.b);
        let SkewEdges {
            from: [from_a, from_b],
            along: [along_a, along_b],
            cross,
            square,
        } = SkewEdges::of(self, ends_a, ends_b)?;
        let against = -1.0_f64.copysign(cross.dot(self.motion));
        let outward = cross * (against / square.sqrt());
        let time = self.steep_time(outward, outward.dot(from_b - from_a))?;
        // Where the edges cross, seen along the normal, in shares of them.
        let between = from_a + self.way(time) - from_b;
        let share_a = along_b.cross(between).dot(cross);
        let share_b = along_a.cross(between).dot(cross);
        let margin = self.margin() * square.sqrt();
        let inner = |share: f64| share > margin && share < square - margin;
        let proven = inner(share_a)
            && inner(share_b)
            && b.stand_out(ends_b, outward, FEATURE * b.radius)
            && a.stand_out(ends_a, -outward, FEATURE * a.radius);
        if !proven {
            return None;
        }
        let (edge_a, edge_b) = (a.edge_between(ends_a)?, b.edge_between(ends_b)?);
        Some(Touch {
            time,
            normal: outward,
            features: [Feature::Edge(edge_a), Feature::Edge(edge_b)],
            point: Place::OnB(from_b + (share_b / square) * along_b),
            certain: true,
        })
    }

    /// When A reaches a plane that holds B back, unless that is nearly along the motion; `height` is
    /// the difference's along the plane's normal.
    #[inline]
    fn steep_time(&self, outward: DVec3, height: f64) -> Option<f64> {
        let speed = outward.dot(self.motion);
        (speed < -STEEP).then(|| (height - outward.dot(self.offset)) / speed)
    }

    /// From B's centre to A's then.
    #[inline]
    fn way(&self, time: f64) -> DVec3 {
        self.nearest + (time - self.nearest_distance) * self.motion
    }

    /// More than rounding may do to an area, in square metres.
    #[inline]
    fn margin(&self) -> f64 {
        self.doubt() * self.size
    }

    /// Whether a point lies within a triangle for certain, which is given as seen from there.
    #[inline]
    fn is_inside(&self, [p, q, r]: [DVec3; 3], normal: DVec3) -> bool {
        let (pq, qr, rp) = (
            normal.dot(p.cross(q)),
            normal.dot(q.cross(r)),
            normal.dot(r.cross(p)),
        );
        let margin = self.margin();
        pq.min(qr).min(rp) > margin || pq.max(qr).max(rp) < -margin
    }
}
