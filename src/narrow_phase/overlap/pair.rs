//! Two hulls in one frame, and their Minkowski difference.

use super::expand::{self, Expansion};
use super::hull::Hull;
use super::{Width, enclose, faces};
use crate::geometry::{Pose, Shape};
use glam::DVec3;

/// Two hulls seen from B's centre, along the world's axes.
pub(super) struct Pair<'a> {
    pub(super) a: Hull<'a>,
    pub(super) b: Hull<'a>,
    /// From B's centre to A's, in metres.
    pub(super) offset: DVec3,
    /// The pair's origin in the world: B's centre.
    pub(super) origin: DVec3,
    /// The sum of the bounding radii, in metres.
    pub(super) size: f64,
    /// Overlaps up to this depth in metres count as touch.
    pub(super) touch: f64,
}

impl<'a> Pair<'a> {
    /// None if one of the shapes is a sphere.
    pub(super) fn new(
        a: &'a Shape,
        pose_a: &Pose,
        b: &'a Shape,
        pose_b: &Pose,
        touch: f64,
    ) -> Option<Self> {
        let centre_b = pose_b.direction(b.centre());
        // The positions first: far from the origin their difference is exact.
        let offset =
            (pose_a.position - pose_b.position) + (pose_a.direction(a.centre()) - centre_b);
        let a = Hull::new(a, pose_a, offset)?;
        let b = Hull::new(b, pose_b, DVec3::ZERO)?;
        let size = a.radius + b.radius;
        Some(Self {
            a,
            b,
            offset,
            origin: pose_b.position + centre_b,
            size,
            touch,
        })
    }

    /// The point of the Minkowski difference farthest along `direction`.
    pub(super) fn support(&self, direction: DVec3) -> DVec3 {
        self.b.support(direction) - self.a.support(-direction)
    }

    /// How far A must move along `direction` to part the two; negative if they are apart.
    pub(super) fn width(&self, direction: DVec3) -> Width {
        Width {
            direction,
            width: self.support(direction).dot(direction),
        }
    }

    /// Widths that differ by less are the same but for rounding.
    pub(super) fn rounding(&self) -> f64 {
        8.0 * f64::EPSILON * (self.size + self.offset.length())
    }

    /// The least width over all directions; none if the pair is apart or in touch.
    pub(super) fn least(&self) -> Option<Width> {
        let least = match enclose::tetrahedron(self).map(|start| expand::least(self, start)) {
            Some(Expansion::Apart) => return None,
            Some(Expansion::Least(near)) => faces::sharpened(self, near),
            // The Minkowski difference is flat, or out of the budget.
            Some(Expansion::Undecided) | None => faces::least(self),
        }?;
        (least.width > self.touch).then_some(least)
    }
}
