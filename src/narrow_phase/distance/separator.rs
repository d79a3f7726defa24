//! Two shapes and the plane that parts them.

use super::body::Body;
use super::simplex::{Nearest, Probe, Simplex};
use crate::geometry::Shape;
use glam::{DQuat, DVec3};

/// Steps after which a search counts as stalled.
///
/// Hulls of 10 000 vertices take some 15; more come of rounding only.
const MAX_STEPS: usize = 64;

/// How far apart two bodies are, between two bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Separation {
    /// Unit vector out of B, towards A: across the plane that parts the two.
    pub normal: DVec3,
    /// How far the two are apart along the normal, in metres: they are at least this far apart.
    pub gap: f64,
    /// Two points of them are this far apart, in metres: they are at most this far apart.
    pub distance: f64,
}

/// A pair of shapes whose distance is asked for again and again while they move.
///
/// It keeps the vertices that were nearest and begins the next search with them.
#[derive(Clone)]
pub struct Separator<'a> {
    pub(super) a: Body<'a>,
    pub(super) b: Body<'a>,
    kept: [[u32; 2]; 3],
    count: usize,
}

/// How a search ended; the vertices where it did are kept.
pub(super) enum End {
    /// The cores share a point, or the shapes are nearer than rounding.
    Touching,
    /// The bounds are as close as was asked for.
    Settled(Found),
    /// Rounding let the search get no further.
    Stalled(Found),
}

/// Where a search ended.
pub(super) struct Found {
    /// The nearest point of the cores' difference.
    pub(super) nearest: DVec3,
    pub(super) separation: Separation,
}

impl<'a> Separator<'a> {
    /// `a` and `b`, turned but not yet placed.
    #[must_use]
    pub fn new(a: &'a Shape, orientation_a: DQuat, b: &'a Shape, orientation_b: DQuat) -> Self {
        Self {
            a: Body::new(a, orientation_a),
            b: Body::new(b, orientation_b),
            kept: [[0; 2]; 3],
            count: 0,
        }
    }

    /// Turns both shapes anew.
    pub fn turn(&mut self, orientation_a: DQuat, orientation_b: DQuat) {
        self.a.turn(orientation_a);
        self.b.turn(orientation_b);
    }

    /// How far the two are apart along a unit vector out of B, towards A; negative if they overlap
    /// along it. No translation across `normal` changes it.
    ///
    /// `between` leads from B's position to A's, along the world's axes.
    #[must_use]
    pub fn gap(&self, between: DVec3, normal: DVec3) -> f64 {
        self.gap_at(self.offset(between), normal)
    }

    /// The same, `offset` from B's centre to A's.
    pub(super) fn gap_at(&self, offset: DVec3, normal: DVec3) -> f64 {
        let probe = self.probe_along(offset, normal, None);
        normal.dot(probe.point) - self.radii()
    }

    /// The distance of the two and the plane that parts them, to within a share `tolerance` of it.
    ///
    /// `between` leads from B's position to A's, along the world's axes. None if the two are nearer than
    /// rounding or overlap beyond doubt, or if a number or its square is not finite. Where rounding stops
    /// the search, the bounds are farther apart than asked for, but bounds: a gap that is not
    /// positive leaves it open whether the two touch.
    pub fn separation(&mut self, between: DVec3, tolerance: f64) -> Option<Separation> {
        match self.search(between, tolerance) {
            End::Touching => None,
            End::Settled(found) | End::Stalled(found) => Some(found.separation),
        }
    }

    /// Vertices that were nearest, pairs of A's and B's.
    pub(in crate::narrow_phase) fn nearest_vertices(&self) -> &[[u32; 2]] {
        &self.kept[..self.count]
    }

    /// From B's centre to A's.
    #[inline]
    pub(super) fn offset(&self, between: DVec3) -> DVec3 {
        between + (self.a.shift - self.b.shift)
    }

    #[inline]
    pub(super) fn radii(&self) -> f64 {
        self.a.radius + self.b.radius
    }

    /// What rounding may do to a distance, in metres.
    pub(super) fn rounding(&self, between: DVec3) -> f64 {
        let reach = self.offset(between).abs().element_sum();
        4.0 * f64::EPSILON * (self.a.size + self.b.size + reach)
    }

    #[inline]
    pub(super) fn probe(&self, offset: DVec3, vertices: [u32; 2]) -> Probe {
        let (a, b) = (self.a.vertex(vertices[0]), self.b.vertex(vertices[1]));
        Probe {
            vertices,
            a,
            b,
            point: offset + (a - b),
        }
    }

    /// The point of A − B that lies least far along a direction.
    #[inline]
    fn probe_along(&self, offset: DVec3, normal: DVec3, near: Option<[u32; 2]>) -> Probe {
        let vertices = [
            self.a.support(-normal, near.map(|near| near[0])),
            self.b.support(normal, near.map(|near| near[1])),
        ];
        self.probe(offset, vertices)
    }

    /// The vertices that were nearest.
    #[inline]
    pub(super) fn kept(&self, offset: DVec3) -> Simplex {
        let mut simplex = Simplex::default();
        for &vertices in &self.kept[..self.count] {
            simplex.push(self.probe(offset, vertices));
        }
        simplex
    }

    #[inline]
    pub(super) fn keep(&mut self, simplex: &Simplex) {
        self.count = 0;
        for (place, probe) in self.kept.iter_mut().zip(simplex.probes()) {
            *place = probe.vertices;
            self.count += 1;
        }
    }

    #[inline]
    pub(super) fn keep_only(&mut self, vertices: &[[u32; 2]]) {
        self.count = 0;
        for (place, &vertices) in self.kept.iter_mut().zip(vertices) {
            *place = vertices;
            self.count += 1;
        }
    }

    /// Gilbert, Johnson & Keerthi's search from what is kept.
    pub(super) fn search(&mut self, between: DVec3, tolerance: f64) -> End {
        let offset = self.offset(between);
        if !offset.is_finite() {
            return End::Touching;
        }
        let (radii, rounding) = (self.radii(), self.rounding(between));
        if let Some(end) = self.ball(offset, rounding) {
            return end;
        }
        let mut simplex = self.kept(offset);
        if self.count == 0 {
            simplex.push(self.probe_along(offset, offset, None));
        }
        let mut found = Found {
            nearest: DVec3::ZERO,
            separation: Separation {
                normal: DVec3::X,
                gap: f64::NEG_INFINITY,
                distance: f64::INFINITY,
            },
        };
        for _ in 0..MAX_STEPS {
            let best = &mut found.separation;
            let Some(Nearest { point, square, .. }) = simplex.reduce() else {
                if best.gap > rounding {
                    // What a plane parts shares no point.
                    break;
                }
                return End::Touching;
            };
            let height = square.sqrt();
            let distance = height - radii;
            // Nothing is said of numbers whose squares overflow, or of NaN.
            if !(distance > rounding && distance < f64::INFINITY) {
                return End::Touching;
            }
            // A touch beside a corner or an edge may lower the distance by less than rounding,
            // and yet the normal needs it.
            if distance > best.distance + rounding {
                break;
            }
            best.distance = distance;
            found.nearest = point;
            self.keep(&simplex);
            let normal = point / height;
            let near = simplex.probes().last().map(|probe| probe.vertices);
            let probe = self.probe_along(offset, normal, near);
            let gap = normal.dot(probe.point) - radii;
            if gap > best.gap {
                (best.gap, best.normal) = (gap, normal);
            }
            if distance - gap <= rounding.max(tolerance * distance) {
                return End::Settled(found);
            }
            if simplex
                .probes()
                .iter()
                .any(|p| p.vertices == probe.vertices)
            {
                break;
            }
            simplex.push(probe);
        }
        End::Stalled(found)
    }
}
