//! A ball cast at a box: a line against the rounded box.
//!
//! Along the line the squared distance to the box is convex, smooth and, between the places
//! where the line crosses one of the six planes, a parabola: the sum of the squares of what
//! sticks out on each axis. Going from piece to piece, beginning where the line comes into the
//! box pushed out by the radius, the first piece that holds a root gives the touch, and
//! the piece that holds the minimum without one says that there is none. Each piece
//! is a closest approach in one, two or three of the axes: to a face, an edge, a vertex.

use super::ball_approach::{Approach, normal};
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

/// At most seven pieces.
#[inline(always)]
pub(super) fn of_cuboid(line: &Line, cuboid: &Cuboid, radius: f64) -> Option<Touch> {
    let half_extents = cuboid.half_extents();
    let slack = line.slack(half_extents.max_element() + radius);
    if line.passes_by(line.origin, half_extents.length() + radius + 4.0 * slack) {
        return None;
    }
    let mirror = DVec3::ONE.copysign(line.direction);
    let reach = Reach {
        half_extents,
        radius,
        slack,
    };
    let enter = reach.first(mirror * line.origin, line.direction.abs())?;
    let away = mirror * enter.away;
    let point = line.origin + enter.fraction * line.direction;
    let inside = point.clamp(-half_extents, half_extents);
    // Which side the point sticks out on by next to nothing, rounding may tell wrongly.
    let plain = away.abs().cmpgt(DVec3::splat(slack));
    let corner = half_extents.copysign(DVec3::select(plain, away, inside));
    let foot = DVec3::select(away.cmpeq(DVec3::ZERO), inside, corner);
    Some(Touch {
        fraction: enter.fraction,
        foot,
        normal: normal(away, radius),
        feature: feature(away, corner),
    })
}

/// The feature from which a point sticks out along the axes where `away` is not zero, on the sides of
/// `corner`.
fn feature(away: DVec3, corner: DVec3) -> Feature {
    let [x, y, z] = corner.to_array().map(|side| u32::from(side > 0.0));
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

/// One axis of the line's way.
#[derive(Clone, Copy)]
struct Axis {
    speed: f64,
    /// From the planes that the line comes in by and goes out by, as it sets out.
    near: f64,
    far: f64,
    /// When it crosses them.
    into: f64,
    out: f64,
}

impl Reach {
    /// `speed` has no negative component.
    #[inline]
    fn first(&self, origin: DVec3, speed: DVec3) -> Option<Entry> {
        let grown = self.radius + self.slack;
        let (mut start, mut end, mut first) = (f64::NEG_INFINITY, f64::INFINITY, 0);
        let (near, far) = (
            (origin + self.half_extents).to_array(),
            (origin - self.half_extents).to_array(),
        );
        let speed = speed.to_array();
        let mut beside = false;
        let axes: [Axis; 3] = std::array::from_fn(|axis| {
            let (speed, near, far) = (speed[axis], near[axis], far[axis]);
            let (into, out) = if speed > STANDSTILL {
                let inverse = 1.0 / speed;
                let enter = (-grown - near) * inverse;
                end = end.min((grown - far) * inverse);
                if enter > start {
                    (start, first) = (enter, axis);
                }
                (-near * inverse, -far * inverse)
            } else {
                beside |= near < -grown || far > grown;
                // Beside one of the planes, or between them, for ever.
                let side = |out: bool| {
                    if out {
                        f64::INFINITY
                    } else {
                        f64::NEG_INFINITY
                    }
                };
                (side(near < 0.0), side(far <= 0.0))
            };
            Axis {
                speed,
                near,
                far,
                into,
                out,
            }
        });
        if beside || start > end {
            return None;
        }
        let mut here = start;
        loop {
            // What sticks out from here to the next plane.
            let (mut from, mut direction, mut next) = ([0.0; 3], [0.0; 3], f64::INFINITY);
            let mut is_outside = false;
            for (index, axis) in axes.iter().enumerate() {
                let (before, after) = (here < axis.into, here >= axis.out);
                let height = if before { axis.near } else { axis.far };
                let sticks_out = before || after;
                is_outside |= sticks_out;
                from[index] = if sticks_out { height } else { 0.0 };
                direction[index] = if sticks_out { axis.speed } else { 0.0 };
                let plane = if before { axis.into } else { axis.out };
                next = next.min(if after { f64::INFINITY } else { plane });
            }
            let (mut from, mut direction) = (DVec3::from(from), DVec3::from(direction));
            if !is_outside {
                // The radius is below rounding.
                let axis = axes[first];
                from = axis.near * DVec3::AXES[first];
                direction = axis.speed * DVec3::AXES[first];
            }
            // Still too far at the next plane, and coming nearer: for a later piece to say.
            let there = from + next * direction;
            let later =
                there.length_squared() > self.radius * self.radius && there.dot(direction) < 0.0;
            if !later {
                return self.in_piece(from, direction, [here, next]);
            }
            here = next;
        }
    }

    /// What happens in the piece between these fractions, where the line's point sticks out of the
    /// box by `from + fraction · direction`, and the touch or the closest approach is.
    #[inline]
    fn in_piece(&self, from: DVec3, direction: DVec3, [here, next]: [f64; 2]) -> Option<Entry> {
        let square = direction.length_squared();
        if square > 0.0 {
            let approach = Approach::new(from, direction, square, self.radius);
            let middle = approach.middle;
            if approach.room >= 0.0 && middle >= here {
                // A line along the feature, but for rounding, has no fraction to speak of.
                let fraction = approach.enter(from, square, self.radius);
                let away = approach.closest - approach.half(square) * direction;
                return Some(Entry {
                    fraction: fraction.max(here).min(next),
                    away,
                });
            }
            return self.graze(from, direction, middle.max(here));
        }
        // Going along what it is out from.
        self.graze(from, direction, here)
    }

    #[inline]
    fn graze(&self, from: DVec3, direction: DVec3, fraction: f64) -> Option<Entry> {
        let away = from + fraction * direction;
        (away.length() <= self.radius + self.slack).then_some(Entry { fraction, away })
    }
}
