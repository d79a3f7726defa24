//! Pairs of bodies with vertices: read ahead, and told apart before more of them is read.
//!
//! A small polytope's numbers fill some thirty lines of cache, in several places, wherever it was made.
//! What looks at one pair after the other waits for memory again and again; reads that nothing
//! depends on are waited for together.

use crate::broad_phase::{Leaf, LeafId};
use crate::geometry::{Polytope, Shape};
use crate::narrow_phase::overlap::keep_apart;
use crate::tolerance::TOUCH;
use crate::world::Method;
use crate::world::finding::Frame;
use crate::world::slots::Resident;
use crate::world::tracks::{Course, Span, Track};
use std::hint::black_box;

/// So many pairs at a time: few enough that they stay in the nearest caches.
pub(super) const SIFTED: usize = 16;

/// So many lines of cache of each kind are worth reading ahead.
const LINES: usize = 16;

/// The pairs that are left.
pub(super) type Left = [(LeafId, LeafId); SIFTED];

impl Frame<'_> {
    /// Leaves out the pairs, of up to [`SIFTED`], that surely keep apart; reads what the narrow phase looks at
    /// of the others, which come first in `left`. Answers how many they are.
    pub(super) fn sift<'a>(
        &self,
        pairs: &[(LeafId, LeafId)],
        at: &impl Fn(LeafId) -> Option<Leaf<'a, Track>>,
        left: &mut Left,
    ) -> usize {
        let count = pairs.len().min(SIFTED);
        for (place, pair) in left.iter_mut().zip(pairs) {
            *place = *pair;
        }
        // Rays take so long that memory is not what they wait for.
        if self.config.method != Method::Exact {
            return count;
        }
        let is_ball = |id: &LeafId| at(*id).is_none_or(|leaf| leaf.data.is_ball);
        if pairs.iter().all(|(a, b)| is_ball(a) && is_ball(b)) {
            return count;
        }
        let resident = |id: LeafId| {
            let leaf = at(id)?;
            self.slots.at(leaf.slot).filter(|_| !leaf.data.is_ball)
        };
        // What is read in one round leads to what is read in the next.
        let read = |pairs: &[(LeafId, LeafId)], read: fn(&Resident) -> f64| {
            let bodies = pairs.iter().flat_map(|&(a, b)| [a, b]);
            black_box(bodies.filter_map(resident).map(read).sum::<f64>());
        };
        let given = left.get(..count).unwrap_or_default();
        read(given, record);
        read(given, |body| polytope(body).map_or(0.0, head));
        read(given, |body| polytope(body).map_or(0.0, vertices));
        let mut kept = 0;
        for index in 0..count {
            let pair = left[index];
            if !self.keep_apart(pair, at) {
                left[kept] = pair;
                kept += 1;
            }
        }
        let rest = left.get(..kept).unwrap_or_default();
        read(rest, |body| polytope(body).map_or(0.0, the_rest));
        kept
    }

    /// Whether two polytopes in straight flight surely keep apart all through the frame.
    fn keep_apart<'a>(
        &self,
        (first, second): (LeafId, LeafId),
        at: &impl Fn(LeafId) -> Option<Leaf<'a, Track>>,
    ) -> bool {
        let (Some(a), Some(b)) = (at(first), at(second)) else {
            return false;
        };
        let (Some(body_a), Some(body_b)) = (self.slots.at(a.slot), self.slots.at(b.slot)) else {
            return false;
        };
        let is_straight = |leaf: &Leaf<'_, Track>, resident: &Resident| {
            leaf.data.course != Course::Path && !resident.body.motion().turns()
        };
        let (Some(hull_a), Some(hull_b)) = (polytope(body_a), polytope(body_b)) else {
            return false;
        };
        if !is_straight(&a, body_a) || !is_straight(&b, body_b) {
            return false;
        }
        let (offset, motion, slack) = approach(a.data, b.data, self.span);
        let of_a = (hull_a, body_a.body.orientation());
        keep_apart(
            of_a,
            (hull_b, body_b.body.orientation()),
            offset,
            motion,
            slack,
        )
    }
}

/// From the second's centre to the first's, how the first moves relative to the second, and how near
/// may count as touching, for all that these are rounded otherwise than the narrow phase does.
fn approach(a: &Track, b: &Track, span: Span) -> (glam::DVec3, glam::DVec3, f64) {
    let ((from_a, motion_a), (from_b, motion_b)) = (a.flight(span), b.flight(span));
    let flown = motion_a.abs().max(motion_b.abs());
    let far = (from_a.abs().max(from_b.abs()) + flown).max_element();
    let begun = a.centre.abs().max(b.centre.abs()).max_element();
    let touch = 4.0 * TOUCH * (a.reach + b.reach + far);
    let rounding = 64.0 * f64::EPSILON * (far + begun);
    (from_a - from_b, motion_a - motion_b, touch + rounding)
}

fn polytope(resident: &Resident) -> Option<&Polytope> {
    match resident.body.shape() {
        Shape::Polytope(polytope) => Some(polytope),
        _ => None,
    }
}

/// Reads from all over a body's record.
fn record(resident: &Resident) -> f64 {
    resident.since
        + resident.reach
        + resident.half.z
        + resident.body.orientation().x
        + f64::from(u8::from(resident.body.motion().is_free()))
}

/// Reads from either end of a polytope.
fn head(polytope: &Polytope) -> f64 {
    let ends = polytope.edges().len() + polytope.face_offsets().len();
    polytope.max_dist() + ends as f64
}

/// Reads what is looked at of polytopes that are told apart: a number from each line of cache.
fn vertices(polytope: &Polytope) -> f64 {
    match polytope.sketch() {
        Some(sketch) => f64::from(sketch.read_vertices()),
        None => corners(polytope),
    }
}

/// Reads what is looked at of the others besides.
fn the_rest(polytope: &Polytope) -> f64 {
    match polytope.sketch() {
        Some(sketch) => f64::from(sketch.read()) + corners(polytope),
        None => faces_and_edges(polytope),
    }
}

/// Every other vertex begins another line.
fn corners(polytope: &Polytope) -> f64 {
    let lines = polytope.vertices().chunks(2).take(LINES);
    lines.fold(0.0, |sum, line| sum + line[0].x)
}

fn faces_and_edges(polytope: &Polytope) -> f64 {
    let normals = polytope.face_normals().chunks(2).take(LINES);
    let offsets = polytope.face_offsets().chunks(8).take(LINES);
    let edges = polytope.edges().chunks(4).take(LINES);
    let sum = normals.fold(0.0, |sum, line| sum + line[0].x);
    let sum = offsets.fold(sum, |sum, line| sum + line[0]);
    edges.fold(sum, |sum, line| sum + f64::from(line[0].faces[0]))
}
