//! A line against the points within a radius of a segment.

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

/// The line with the segment that begins at `from` and leads `along`.
///
/// Inside the cylinder around the whole segment's line; where that is entered beside an end,
/// only the sphere around the end can be met first.
#[inline]
pub(super) fn meet(line: &Line, from: DVec3, along: DVec3, radius: f64) -> Meeting {
    let start = line.origin - from;
    // Products with the segment's length, or its square, throughout: divided is once, at the end.
    let length = along.length_squared();
    let (rate, offset) = (line.direction.dot(along), start.dot(along));
    let turned = line.direction.cross(along);
    let across = turned.length_squared();
    if across <= PARALLEL * (line.square * length) {
        let inverse = 1.0 / length;
        let (rate, offset) = (rate * inverse, offset * inverse);
        let away = start - offset * along;
        return beside(line, [from, from + along], radius, away, (rate, offset));
    }
    let moment = start.dot(turned);
    let room = radius * radius * across - moment * moment;
    let half = (room.max(0.0) * length).sqrt();
    let hit = room >= 0.0;
    let fraction = -(start.cross(along).dot(turned) + half) / across;
    let share = offset + rate * fraction;
    if !(0.0..=length).contains(&share) {
        let end = usize::from(share > length);
        let point = if end == 0 { from } else { from + along };
        return meet_point(line, point, radius, end);
    }
    let away = (start - share / length * along) + fraction * line.direction;
    Meeting {
        hit,
        rank: if hit { fraction } else { away.length_squared() },
        fraction,
        away,
        place: Place::Inner,
    }
}

/// The line with one end.
#[inline]
pub(super) fn meet_point(line: &Line, point: DVec3, radius: f64, end: usize) -> Meeting {
    let start = line.origin - point;
    let moment = start.cross(line.direction);
    let room = radius * radius * line.square - moment.length_squared();
    let (hit, half) = (room >= 0.0, room.max(0.0).sqrt());
    let fraction = -(start.dot(line.direction) + half) / line.square;
    let away = start + fraction * line.direction;
    Meeting {
        hit,
        rank: if hit { fraction } else { away.length_squared() },
        fraction,
        away,
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
        return met;
    }
    // As near to the middle as to any other point.
    let fraction = (0.5 - offset) / rate;
    Meeting {
        hit: false,
        rank: away.length_squared(),
        fraction,
        away,
        place: Place::Inner,
    }
}
