//! A ball cast at a box: a line against the rounded box.
//!
//! Along the line the squared distance to the box is convex, smooth and, between the places
//! where the line crosses one of the six planes, a parabola: the sum of the squares of what
//! sticks out on each axis. Going from piece to piece, beginning where the line comes into the
//! box pushed out by the radius, the first piece that holds a root gives the touch, and
//! the piece that holds the minimum without one says that there is none. Each piece
//! is a closest approach in one, two or three of the axes: to a face, an edge, a vertex.

use super::ball_approach::{Approach, ends};
use super::ball_line::{Line, Touch};
use crate::geometry::{Cuboid, Feature};
use glam::DVec3;

/// Speeds along an axis below this count as none, so that their inverses are finite. The
/// line's direction is 1e-60 m long at least: no body is so large that it would show.
const STANDSTILL: f64 = 1e-280;

/// Where the line comes in, mirrored so that it runs towards +x, +y and +z.
struct Entry {
    fraction: f64,
    /// From the box to the line's point there; exactly 0 along an axis where that lies
    /// between the planes.
    away: DVec3,
}

/// At most seven pieces each way.
pub(super) fn of_cuboid(line: &Line, cuboid: &Cuboid, radius: f64) -> Option<Touch> {
    let half_extents = cuboid.half_extents();
    let slack = line.slack(half_extents.max_element() + radius);
    let mirror = DVec3::ONE.copysign(line.direction);
    let (origin, speed) = (mirror * line.origin, line.direction.abs());
    let reach = Reach {
        half_extents,
        radius,
        slack,
    };
    let enter = reach.first(origin, speed)?;
    let leave = reach.first(-origin, speed).map(|entry| -entry.fraction);
    let away = mirror * enter.away;
    let point = line.origin + enter.fraction * line.direction;
    let inside = point.clamp(-half_extents, half_extents);
    let foot = DVec3::from_array(std::array::from_fn(|axis| {
        if away[axis] == 0.0 {
            inside[axis]
        } else {
            half_extents[axis].copysign(away[axis])
        }
    }));
    Some(Touch {
        enter: enter.fraction,
        leave: leave.unwrap_or(enter.fraction),
        foot,
        normal: away.normalize_or(DVec3::X),
        feature: feature(away),
    })
}

/// The feature from which a point sticks out along the axes where `away` is not zero.
fn feature(away: DVec3) -> Feature {
    let [x, y, z] = away.to_array().map(|out| u32::from(out > 0.0));
    match away.to_array().map(|out| out != 0.0) {
        [true, true, true] => Feature::Vertex(x + 2 * y + 4 * z),
        [false, true, true] => Feature::Edge(y + 2 * z),
        [true, false, true] => Feature::Edge(4 + x + 2 * z),
        [true, true, false] => Feature::Edge(8 + x + 2 * y),
        [_, false, false] => Feature::Face(x),
        [false, true, false] => Feature::Face(2 + y),
        [false, false, true] => Feature::Face(4 + z),
    }
}

struct Reach {
    half_extents: DVec3,
    radius: f64,
    slack: f64,
}

impl Reach {
    /// `speed` has no negative component.
    #[inline]
    fn first(&self, origin: DVec3, speed: DVec3) -> Option<Entry> {
        let grown = self.radius + self.slack;
        // From the planes that the line comes in by and goes out by.
        let (near, far) = (origin + self.half_extents, origin - self.half_extents);
        // When it crosses them.
        let (mut into, mut out) = ([0.0; 3], [0.0; 3]);
        let (mut start, mut end, mut first) = (f64::NEG_INFINITY, f64::INFINITY, 0);
        for axis in 0..3 {
            if speed[axis] > STANDSTILL {
                let inverse = 1.0 / speed[axis];
                (into[axis], out[axis]) = (-near[axis] * inverse, -far[axis] * inverse);
                let enter = (-grown - near[axis]) * inverse;
                end = end.min((grown - far[axis]) * inverse);
                if enter > start {
                    (start, first) = (enter, axis);
                }
            } else {
                if near[axis] < -grown || far[axis] > grown {
                    return None;
                }
                // Beside one of the planes, or between them, for ever.
                let side = |out: bool| {
                    if out {
                        f64::INFINITY
                    } else {
                        f64::NEG_INFINITY
                    }
                };
                (into[axis], out[axis]) = (side(near[axis] < 0.0), side(far[axis] <= 0.0));
            }
        }
        if start > end {
            return None;
        }
        let mut here = start;
        loop {
            let (mut from, mut direction, mut next) = (DVec3::ZERO, DVec3::ZERO, f64::INFINITY);
            for axis in 0..3 {
                if here < into[axis] {
                    (from[axis], direction[axis]) = (near[axis], speed[axis]);
                    next = next.min(into[axis]);
                } else if here < out[axis] {
                    next = next.min(out[axis]);
                } else {
                    (from[axis], direction[axis]) = (far[axis], speed[axis]);
                }
            }
            if from == DVec3::ZERO {
                // In the box: the radius is below rounding.
                from[first] = near[first];
                direction[first] = speed[first];
            }
            if let Some(decided) = self.in_piece(from, direction, here, next) {
                return decided;
            }
            here = next;
        }
    }

    /// What happens from `here` to `next`, where the line's point sticks out of the box by
    /// `from + fraction · direction`; none if that is for a later piece to say.
    #[inline]
    fn in_piece(
        &self,
        from: DVec3,
        direction: DVec3,
        here: f64,
        next: f64,
    ) -> Option<Option<Entry>> {
        let square = direction.length_squared();
        if square > 0.0 {
            let approach = Approach::new(from, direction, square, self.radius);
            if approach.room >= 0.0 {
                let half = approach.half(square);
                let fraction = approach.middle - half;
                if fraction <= next && approach.middle >= here {
                    let (fraction, _) = ends(&approach, half, from, square, self.radius);
                    // A line along the feature, but for rounding, has no fraction to speak of.
                    let fraction = fraction.max(here).min(next);
                    let away = approach.closest - half * direction;
                    return Some(Some(Entry { fraction, away }));
                }
            }
            if approach.middle > next {
                return None;
            }
            // The distance is least in this piece, or where it begins.
            return Some(self.graze(from, direction, approach.middle.max(here)));
        }
        // Going along what it is out from.
        Some(self.graze(from, direction, here))
    }

    #[inline]
    fn graze(&self, from: DVec3, direction: DVec3, fraction: f64) -> Option<Entry> {
        let away = from + fraction * direction;
        (away.length() <= self.radius + self.slack).then_some(Entry { fraction, away })
    }
}
