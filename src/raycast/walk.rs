//! The way over a polytope's faces to the one that a line enters by.
//!
//! Each face that looks towards the ray crosses the line at some fraction; the
//! line enters the polytope at the largest. Finding it is a linear programme
//! over the corners of the dual polytope, and those are the faces: as long as a face's
//! crossing is not the largest, one of its neighbours has a larger one, or is
//! a face that the line has left by before, in which case it misses. So it
//! suffices to step from neighbour to neighbour, and the face map starts the
//! walk nearby.

use super::line::Line;
use crate::geometry::Polytope;
use glam::DVec3;

/// Where a line crosses the plane of the face it enters or leaves by.
pub(super) struct Crossing {
    pub(super) fraction: f64,
    pub(super) face: u32,
    /// A neighbouring face passes within rounding of the same point.
    pub(super) tied: bool,
}

/// Whether `line` passes the polytope's bounding sphere by.
#[inline]
pub(super) fn passes_by(polytope: &Polytope, line: &Line, growth: f64) -> bool {
    let reach = polytope.max_dist() + 4.0 * growth;
    line.passes_by(line.origin - polytope.centre(), reach)
}

/// Whether the ray has left the polytope's bounding sphere behind.
#[inline]
pub(super) fn is_behind(polytope: &Polytope, line: &Line, growth: f64) -> bool {
    let offset = line.origin - polytope.centre();
    let radius = polytope.max_dist() + 4.0 * growth;
    let distance = offset.length_squared() * (1.0 - 32.0 * f64::EPSILON);
    offset.dot(line.direction) > 0.0 && distance > radius * radius
}

/// Where `line` enters the polytope whose planes are moved out by `growth`, if it does.
#[inline]
pub(super) fn enter(polytope: &Polytope, line: &Line, growth: f64) -> Option<Crossing> {
    first(polytope, line.origin, line.direction, growth)
}

/// Where it leaves: where the reversed line enters.
#[inline]
pub(super) fn leave(polytope: &Polytope, line: &Line, growth: f64) -> Option<Crossing> {
    let crossing = first(polytope, line.origin, -line.direction, growth)?;
    Some(Crossing {
        fraction: -crossing.fraction,
        ..crossing
    })
}

#[inline]
fn first(polytope: &Polytope, origin: DVec3, direction: DVec3, growth: f64) -> Option<Crossing> {
    let map = polytope.face_map();
    // How fast the line nears the face's grown plane (negative), and its room before it.
    let approach = |face: u32| {
        let (normal, offset) = map.plane(face);
        let room = offset + growth - normal.dot(origin);
        (normal.dot(direction), room)
    };
    let mut face = map.against(direction, map.entry(origin, direction));
    let (rate, room) = approach(face);
    if rate >= 0.0 {
        return None;
    }
    let mut fraction = room / rate;
    loop {
        let current = face;
        let here = fraction;
        let mut tied = false;
        for side in map.sides(current) {
            let neighbour = side.face;
            let (rate, room) = approach(neighbour);
            // What is left of the room at the current crossing.
            let left = room - here * rate;
            if left > 2.0 * growth {
                continue;
            }
            if rate < 0.0 {
                tied = true;
                // Strictly larger, so that no face comes twice and the walk ends.
                let crossing = room / rate;
                if crossing > fraction {
                    (face, fraction) = (neighbour, crossing);
                }
            } else if left < 0.0 {
                return None;
            }
        }
        if face == current {
            return Some(Crossing {
                fraction,
                face,
                tied,
            });
        }
    }
}
