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
    let inverse = 1.0 / along.length_squared();
    let (rate, offset) = (
        line.direction.dot(along) * inverse,
        start.dot(along) * inverse,
    );
    let direction = line.direction - rate * along;
    let origin = start - offset * along;
    let square = direction.length_squared();
    if square <= PARALLEL * line.square {
        return beside(line, [from, from + along], radius, origin, (rate, offset));
    }
    let approach = Approach::new(origin, direction, square, radius);
    let (hit, half) = (approach.room >= 0.0, approach.half(square));
    let fraction = approach.middle - half;
    let share = offset + rate * fraction;
    if !(0.0..=1.0).contains(&share) {
        let end = usize::from(share > 1.0);
        let point = if end == 0 { from } else { from + along };
        return meet_point(line, point, radius, end);
    }
    let away = approach.closest - half * direction;
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
    let approach = Approach::new(line.origin - point, line.direction, line.square, radius);
    let (hit, half) = (approach.room >= 0.0, approach.half(line.square));
    let fraction = approach.middle - half;
    let away = approach.closest - half * line.direction;
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
