//! Slow and obvious answers, in `f64`, sharing no code with any contender.
//!
//! - [`faces`]: the faces of a hull, by trying every three points;
//! - [`rounded`]: a ball against triangles, edges and corners, one by one;
//! - [`axes`]: two polytopes, by every axis that could separate them;
//! - [`cuts`]: two hulls of any size, by cutting planes.
//!
//! Where two of them answer the same question the tests compare them.

pub mod axes;
pub mod cuts;
pub mod faces;
pub mod rounded;

use crate::casts::{Cast, CastSet, Placed, Solid};
use axes::Flat;
use faces::Triple;
use glam::DVec3;

/// What happens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Truth {
    /// They touch within the motion.
    Hit {
        /// When, in motions.
        fraction: f64,
        /// Unit normal, out of `b` towards `a`.
        normal: DVec3,
        /// How far the motion may shift aside, or shorten, and still hit: at
        /// least so many metres.
        margin: f64,
    },
    /// They do not.
    Clear {
        /// How far the motion may shift aside, or lengthen, and still miss: at
        /// least so many metres.
        margin: f64,
    },
}

impl Truth {
    pub fn margin(&self) -> f64 {
        match self {
            Self::Hit { margin, .. } | Self::Clear { margin } => *margin,
        }
    }
}

/// A hull of more points goes to the cutting planes.
const FEW: usize = 16;

/// The truth about the casts of one set.
pub struct Oracle<'a> {
    set: &'a CastSet,
    corners: Vec<Vec<DVec3>>,
    /// For solids of few corners only.
    triples: Vec<Vec<Triple>>,
}

impl<'a> Oracle<'a> {
    pub fn new(set: &'a CastSet) -> Self {
        let corners: Vec<_> = set.solids.iter().map(Solid::corners).collect();
        let triples = corners.iter().map(|corners| {
            if corners.len() <= FEW {
                faces::supporting_triples(corners)
            } else {
                Vec::new()
            }
        });
        Self {
            set,
            triples: triples.collect(),
            corners,
        }
    }

    pub fn truth(&self, cast: &Cast) -> Truth {
        let from = cast.b.position;
        let [a, b] = [&cast.a, &cast.b].map(|placed| self.corners_at(placed, from));
        let motion = cast.motion;
        let radius = |placed: &Placed| self.set.solids[placed.solid].radius();
        let radii = radius(&cast.a) + radius(&cast.b);
        if radii > 0.0 {
            // One ball, or two: the sum of the radii against the rest.
            return rounded::truth(a[0], radii, &b, &self.triples[cast.b.solid], motion);
        }
        if a.len().max(b.len()) > FEW {
            return cuts::truth(&a, &b, motion);
        }
        let flat = |corners, placed: &Placed| Flat::new(corners, &self.triples[placed.solid]);
        axes::truth(&flat(a, &cast.a), &flat(b, &cast.b), motion)
    }

    /// How far the two are apart along `normal` at `fraction`; overlaps are negative.
    pub fn separation(&self, cast: &Cast, normal: DVec3, fraction: f64) -> f64 {
        let from = cast.b.position;
        let [a, b] = [&cast.a, &cast.b].map(|placed| self.corners_at(placed, from));
        let radius = |placed: &Placed| self.set.solids[placed.solid].radius();
        axes::separation(&a, &b, normal) + fraction * normal.dot(cast.motion)
            - (radius(&cast.a) + radius(&cast.b)) * normal.length()
    }

    fn corners_at(&self, placed: &Placed, from: DVec3) -> Vec<DVec3> {
        let (position, turn) = (placed.position - from, placed.unit_orientation());
        let corner = |&corner: &DVec3| position + turn * corner;
        self.corners[placed.solid].iter().map(corner).collect()
    }
}

#[cfg(test)]
mod tests;
