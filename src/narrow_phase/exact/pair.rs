//! Two bodies with flat faces and the line one moves along past the other.

use super::body::Body;
use crate::geometry::Shape;
use glam::{DQuat, DVec3};

/// Speed towards a plane, as a share of the largest component of the motion, up to which
/// the time of the search is kept: it minds the other planes too.
pub(super) const STEEP: f64 = 0.1;

/// A's motion past B, seen from B's centre along the world's axes.
///
/// Distances along the motion count in scaled motions: the largest component
/// of `motion` is 1, so that neither 1e-300 m nor 1e300 m overflows.
#[derive(Clone, Copy)]
pub(super) struct Pair<'a> {
    pub(super) a: Body<'a>,
    pub(super) b: Body<'a>,
    /// From B's centre to A's where the motion begins.
    pub(super) offset: DVec3,
    /// The same where A's centre is nearest to B's.
    pub(super) nearest: DVec3,
    /// Where that is, in scaled motions.
    pub(super) nearest_distance: f64,
    /// Scaled so that its largest component is 1.
    pub(super) motion: DVec3,
    /// Sum of the bounding radii, in metres.
    pub(super) size: f64,
    /// What rounding may do to a height of a vertex, in metres.
    pub(super) rounding: f64,
}

impl<'a> Pair<'a> {
    /// None if one of the shapes is a sphere.
    #[inline(always)]
    pub(super) fn new(
        (a, orientation_a): (&'a Shape, DQuat),
        (b, orientation_b): (&'a Shape, DQuat),
        between: DVec3,
        motion: DVec3,
    ) -> Option<Self> {
        let (a, b) = (Body::new(a, orientation_a)?, Body::new(b, orientation_b)?);
        let offset = between + (a.rotation * a.centre - b.rotation * b.centre);
        let nearest_distance = -offset.dot(motion) / motion.length_squared();
        let nearest = offset + nearest_distance * motion;
        let size = a.radius + b.radius;
        Some(Self {
            offset,
            nearest,
            nearest_distance,
            motion,
            size,
            rounding: 8.0 * f64::EPSILON * size,
            a,
            b,
        })
    }

    /// The same with time running backwards.
    pub(super) fn reversed(&self) -> Self {
        Self {
            motion: -self.motion,
            nearest_distance: -self.nearest_distance,
            ..*self
        }
    }

    /// Whether these are two triangles so nearly parallel that their difference has next to no
    /// thickness.
    pub(super) fn is_flat(&self) -> bool {
        /// Squared sine between them; more than rounding makes of parallel ones by far.
        const PARALLEL: f64 = 1e-12;
        let (Shape::Triangle(a), Shape::Triangle(b)) = (self.a.shape, self.b.shape) else {
            return false;
        };
        let (a, b) = (self.a.rotation * a.normal(), self.b.rotation * b.normal());
        a.cross(b).length_squared() < PARALLEL
    }

    /// Whether the bounding spheres pass each other by.
    #[inline]
    pub(super) fn spheres_miss(&self) -> bool {
        let reach = self.size + self.rounding;
        // Rounding of the offset grows with its length.
        let doubt = 4.0 * f64::EPSILON * self.nearest_distance.abs();
        self.nearest.length_squared() > (reach + doubt) * (reach + doubt)
    }

    /// The height of the difference B ⊕ (−A) above A's centre along a unit vector, where the
    /// motion begins, from a farthest vertex of each.
    pub(super) fn height(&self, normal: DVec3, vertices: [u32; 2]) -> f64 {
        let [a, b] = vertices;
        normal.dot(self.b.vertex(b) - self.a.vertex(a)) - normal.dot(self.offset)
    }

    /// Farthest vertices of A against the normal and of B along it.
    pub(super) fn supports(&self, normal: DVec3) -> [u32; 2] {
        [self.a.support(-normal), self.b.support(normal)]
    }

    /// When A, in scaled motions, passes the plane that holds B back; `cautious`, counted
    /// from where the two are nearest, is right but for rounding.
    ///
    /// What is nearly along the motion turns rounding into long times. The cautious time
    /// then is as good for that plane, and better for the others.
    pub(super) fn time(&self, normal: DVec3, cautious: f64) -> f64 {
        let speed = normal.dot(self.motion);
        if speed.abs() > STEEP {
            self.height(normal, self.supports(normal)) / speed
        } else {
            self.nearest_distance + cautious
        }
    }
}
