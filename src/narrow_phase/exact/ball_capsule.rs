//! A line against the points within a radius of a segment.

use super::ball_approach::Approach;
use super::ball_line::Line;
use glam::DVec3;

/// Which part of a segment a line comes to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// Between the ends.
    Inner,
    /// The first end or the second.
    End(usize),
}

/// How a line meets a segment: where it comes within the radius, or else how near it passes.
///
/// Vectors lead from the segment's point to the line's.
#[derive(Clone, Copy)]
pub(super) struct Meeting {
    /// Whether the line comes within the radius.
    pub(super) hit: bool,
    /// The fraction of the hit, or the square of the least distance.
    pub(super) rank: f64,
    /// The line's fraction, of the hit or of the closest approach.
    pub(super) fraction: f64,
    /// When the line leaves the radius again.
    pub(super) leave: f64,
    pub(super) away: DVec3,
    pub(super) place: Place,
}

impl Meeting {
    /// Earlier, or nearer if both pass by. A hit comes before all that pass by.
    #[inline]
    pub(super) fn before(&self, other: &Self) -> bool {
        match (self.hit, other.hit) {
            (true, false) => true,
            (false, true) => false,
            _ => self.rank < other.rank,
        }
    }
}

/// Lines turned less than this away from a segment count as parallel to it, by the square
/// of the sine: what is left of the direction is rounding.
const PARALLEL: f64 = 1e-30;

/// The line with the segment from `from` to `to`.
///
/// Inside the cylinder around the whole segment's line; where that is entered beside an end,
/// only the sphere around the end can be met first.
#[inline]
pub(super) fn meet(line: &Line, from: DVec3, to: DVec3, radius: f64) -> Meeting {
    let along = to - from;
    let start = line.origin - from;
    let inverse = 1.0 / along.length_squared();
    let (rate, offset) = (
        line.direction.dot(along) * inverse,
        start.dot(along) * inverse,
    );
    let direction = line.direction - rate * along;
    let origin = start - offset * along;
    let square = direction.length_squared();
    if square <= PARALLEL * line.square {
        return beside(line, [from, to], radius, origin, (rate, offset));
    }
    let approach = Approach::new(origin, direction, square, radius);
    if approach.room >= 0.0 {
        let half = approach.half(square);
        let fraction = approach.middle - half;
        let share = offset + rate * fraction;
        let end = if share < 0.0 {
            0
        } else if share > 1.0 {
            1
        } else {
            let leave = approach.middle + half;
            let share = offset + rate * leave;
            return Meeting {
                hit: true,
                rank: fraction,
                fraction,
                leave: if (0.0..=1.0).contains(&share) {
                    leave
                } else {
                    // It was in the capsule, so it goes out through the end's sphere.
                    let end = if share < 0.0 { from } else { to };
                    meet_point(line, end, radius, 0).leave.min(leave)
                },
                away: approach.closest - half * direction,
                place: Place::Inner,
            };
        };
        let mut meeting = meet_point(line, [from, to][end], radius, end);
        // Through the first sphere into the cylinder and on.
        let share = offset + rate * (approach.middle + half);
        if meeting.hit && (0.0..=1.0).contains(&share) {
            meeting.leave = meeting.leave.max(approach.middle + half);
        } else if meeting.hit {
            let other = meet_point(line, [to, from][end], radius, 1 - end);
            if other.hit {
                meeting.leave = meeting.leave.max(other.leave);
            }
        }
        return meeting;
    }
    let share = offset + rate * approach.middle;
    if share < 0.0 {
        meet_point(line, from, radius, 0)
    } else if share > 1.0 {
        meet_point(line, to, radius, 1)
    } else {
        Meeting {
            hit: false,
            rank: approach.closest.length_squared(),
            fraction: approach.middle,
            leave: approach.middle,
            away: approach.closest,
            place: Place::Inner,
        }
    }
}

/// The line with one end.
#[inline]
pub(super) fn meet_point(line: &Line, point: DVec3, radius: f64, end: usize) -> Meeting {
    let approach = Approach::new(line.origin - point, line.direction, line.square, radius);
    let hit = approach.room >= 0.0;
    let half = approach.half(line.square);
    let fraction = approach.middle - half;
    Meeting {
        hit,
        rank: if hit {
            fraction
        } else {
            approach.closest.length_squared()
        },
        fraction,
        leave: approach.middle + half,
        away: approach.closest - half * line.direction,
        place: Place::End(end),
    }
}

/// A line parallel to the segment, `away` from it.
#[cold]
fn beside(
    line: &Line,
    ends: [DVec3; 2],
    radius: f64,
    away: DVec3,
    (rate, offset): (f64, f64),
) -> Meeting {
    let first = usize::from(rate < 0.0);
    let met = meet_point(line, ends[first], radius, first);
    if met.hit {
        let other = meet_point(line, ends[1 - first], radius, 1 - first);
        let leave = if other.hit { other.leave } else { met.leave };
        return Meeting {
            leave: met.leave.max(leave),
            ..met
        };
    }
    // As near to the middle as to any other point.
    let fraction = (0.5 - offset) / rate;
    Meeting {
        hit: false,
        rank: away.length_squared(),
        fraction,
        leave: fraction,
        away,
        place: Place::Inner,
    }
}
