//! A ball cast at a box: a line against the rounded box.
//!
//! Along the line the squared distance to the box is convex, smooth and, between the places
//! where the line crosses one of the six planes, a parabola: the sum of the squares of what
//! sticks out on each axis. Going from piece to piece, beginning where the line comes into the
//! box pushed out by the radius, the first piece that holds a root gives the touch, and
//! the piece that holds the minimum without one says that there is none. Each piece
//! is a closest approach in one, two or three of the axes: to a face, an edge, a vertex.
//!
//! As a rule the piece is guessed in single precision, and what is found in it proves the guess.

use super::ball_approach::{Approach, normal};
use super::ball_ball::{NEAR, STEEP, steep_normal};
use super::ball_line::{Line, Touch};
use crate::geometry::{Cuboid, Feature};
use glam::{DVec3, Vec3A};

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

/// One piece as a rule, at most seven.
#[inline(always)]
pub(super) fn of_cuboid(line: &Line, cuboid: &Cuboid, radius: f64) -> Option<Touch> {
    if passes_by(line, cuboid, radius) {
        return None;
    }
    of_near_cuboid(line, cuboid, radius)
}

/// Whether the line surely passes by the sphere around the box, however that is turned.
#[inline(always)]
pub(super) fn passes_by(line: &Line, cuboid: &Cuboid, radius: f64) -> bool {
    line.passes_by_all(cuboid.half_extents().length() + radius)
}

/// [`of_cuboid`] of a line that comes near.
#[inline(always)]
pub(super) fn of_near_cuboid(line: &Line, cuboid: &Cuboid, radius: f64) -> Option<Touch> {
    match by_guess(line, cuboid.half_extents(), radius) {
        Guess::Touch(touch) => Some(touch),
        Guess::Miss => None,
        Guess::Unclear => with_care(line, cuboid, radius),
    }
}

/// What a piece that was guessed says.
enum Guess {
    Touch(Touch),
    Miss,
    Unclear,
}

/// By how much single precision may be wrong about where the line is, in shares of how far it and the box
/// reach: twice what rounding the numbers, adding and dividing come to.
const ERROR: f32 = 1.0 / 1_048_576.0;

/// Squared distance, in shares of the squared size, from beyond which guesses are poor.
const FAR: f64 = 1e4;

/// Pieces that are looked at for a guess.
const STEPS: u32 = 7;

/// The piece with the touch or the closest approach is found in single precision, what happens there is worked
/// out in double, and that this is in the piece proves it: the distance is convex.
///
/// There the touch is that of a ball with a point, in cross products as in
/// [`two_balls`](super::two_balls): one after the other divisions and roots would take longer than all else.
#[inline(always)]
fn by_guess(line: &Line, half_extents: DVec3, radius: f64) -> Guess {
    let Line {
        origin, direction, ..
    } = *line;
    let size = half_extents.max_element() + radius;
    // False for NaN too.
    let near = origin.length_squared() <= FAR * (size * size);
    if !near {
        return Guess::Unclear;
    }
    let Some((keep, side, feature)) = piece(line, half_extents, radius, size) else {
        return Guess::Miss;
    };
    let corner = side * half_extents;
    let (from, along) = (keep * origin - corner, keep * direction);
    let square = along.length_squared();
    let moment = from.cross(along);
    let (near, closing, off) = (radius * radius, -from.dot(along), moment.length_squared());
    // Where the line is then along the other axes, and by how much it is in the piece at least.
    let beside = |fraction: f64| (DVec3::ONE - keep) * (origin + fraction * direction);
    let inside = |away: DVec3, point: DVec3| {
        ((away * side - point.abs()) + (half_extents - corner.abs())).min_element()
    };
    let room = near * square - off;
    if room >= 0.0 {
        let (apart, half) = (from.length_squared() - near, room.sqrt());
        let plain = apart > 1e-12 * near && apart <= NEAR * near && half > STEEP * closing;
        let fraction = apart / (closing + half);
        let normal = steep_normal(along, moment, half, radius * square);
        let point = beside(fraction);
        // False for NaN too.
        let right = plain && closing > 0.0 && inside(radius * normal, point) > 0.0;
        return if right {
            Guess::Touch(Touch {
                fraction,
                foot: corner + point,
                normal,
                feature,
            })
        } else {
            Guess::Unclear
        };
    }
    let fraction = closing / square;
    let reach = radius + line.slack(size);
    // What is left is well beyond the rounding of the squares.
    let misses = off > reach * reach * square * (1.0 + 32.0 * f64::EPSILON)
        && inside(from + fraction * along, beside(fraction)) > 0.0;
    if misses { Guess::Miss } else { Guess::Unclear }
}

/// The piece where the line touches or comes closest, as far as single precision can tell: 1 for each axis
/// that it sticks out along, the sides that it is on there, and the feature. None if it passes by for certain.
#[inline(always)]
fn piece(
    line: &Line,
    half_extents: DVec3,
    radius: f64,
    size: f64,
) -> Option<(DVec3, DVec3, Feature)> {
    let far = size + line.origin.abs().max_element();
    // A power of two, so that motions of any length are told alike.
    let exponent = (line.square.to_bits() >> 52) as i64 - 1023;
    let pace = f64::from_bits(((1023 - (exponent >> 1)) as u64) << 52);
    let (origin, direction) = (line.origin.as_vec3a(), (pace * line.direction).as_vec3a());
    let (half, ball) = (half_extents.as_vec3a(), radius as f32);
    let mirror = Vec3A::ONE.copysign(direction);
    let (origin, speed) = (mirror * origin, direction.abs());
    // What is hardly moved along counts as moved along a little.
    let per_speed = (Vec3A::ONE / speed).min(Vec3A::splat(f32::MAX));
    let grown = half + Vec3A::splat(ball + ERROR * far as f32);
    let mut here = ((-grown - origin) * per_speed).max_element();
    if here > ((grown - origin) * per_speed).min_element() {
        return None;
    }
    let (near, far) = (origin + half, origin - half);
    let (into, out) = (-near * per_speed, -far * per_speed);
    let square = ball * ball;
    let mut steps = 0;
    loop {
        // What sticks out from here to the next plane.
        let now = Vec3A::splat(here);
        let (before, after) = (now.cmplt(into), now.cmpge(out));
        let outside = before | after;
        let from = Vec3A::select(outside, Vec3A::select(before, near, far), Vec3A::ZERO);
        let along = Vec3A::select(outside, speed, Vec3A::ZERO);
        let plane = Vec3A::select(before, into, out);
        let next = Vec3A::select(after, Vec3A::INFINITY, plane).min_element();
        let there = from + next * along;
        // Still too far at the next plane, and coming nearer.
        let later = there.length_squared() > square && there.dot(along) < 0.0;
        steps += 1;
        if !later || steps == STEPS {
            let keep = Vec3A::select(outside, Vec3A::ONE, Vec3A::ZERO);
            let side = Vec3A::select(before, -mirror, mirror) * keep;
            let feature = feature(outside.bitmask(), side.cmpgt(Vec3A::ZERO).bitmask());
            return Some((keep.as_dvec3(), side.as_dvec3(), feature));
        }
        here = next;
    }
}

/// By all pieces in turn.
#[cold]
#[inline(never)]
fn with_care(line: &Line, cuboid: &Cuboid, radius: f64) -> Option<Touch> {
    let half_extents = cuboid.half_extents();
    let slack = line.slack(half_extents.max_element() + radius);
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
    let outside = away.cmpne(DVec3::ZERO).bitmask();
    Some(Touch {
        fraction: enter.fraction,
        foot,
        normal: normal(away, radius),
        feature: feature(outside, corner.cmpgt(DVec3::ZERO).bitmask()),
    })
}

/// The feature from which a point sticks out along some axes, on the positive sides of some: bits 0 to 2 of
/// each.
#[inline(always)]
fn feature(outside: u32, positive: u32) -> Feature {
    FEATURES[((outside | positive << 3) & 63) as usize]
}

/// A table, as no processor foresees which it is.
const FEATURES: [Feature; 64] = {
    let mut features = [Feature::Surface; 64];
    let mut index = 0;
    while index < 64 {
        let (x, y, z) = (index >> 3 & 1, index >> 4 & 1, index >> 5 & 1);
        features[index as usize] = match index & 7 {
            6 => Feature::Edge(y + 2 * z),
            5 => Feature::Edge(4 + x + 2 * z),
            3 => Feature::Edge(8 + x + 2 * y),
            7 => Feature::Vertex(x + 2 * y + 4 * z),
            2 => Feature::Face(2 + y),
            4 => Feature::Face(4 + z),
            // Of next to no radius, along x.
            _ => Feature::Face(x),
        };
        index += 1;
    }
    features
};

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

#[cfg(test)]
mod tests {
    use super::{Guess, by_guess, with_care};
    use crate::geometry::Cuboid;
    use crate::narrow_phase::exact::ball_line::Line;
    use glam::DVec3;

    /// What a guess is proven to be is what all pieces tell.
    #[test]
    fn guesses_are_what_all_pieces_tell() {
        let mut state = 3_u64;
        let mut next = || {
            state = (state.wrapping_mul(6_364_136_223_846_793_005)).wrapping_add(1);
            (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        let mut vector = || DVec3::new(next(), next(), next());
        let (mut touches, mut misses, mut unclear) = (0, 0, 0);
        for _ in 0..20_000 {
            let scale = vector();
            let half = (3.0 * vector()).exp2();
            let radius = (3.0 * scale.x).exp2();
            let Ok(cuboid) = Cuboid::new(half) else {
                panic!("the box has a size");
            };
            let size = half.max_element() + radius;
            let motion = vector() * 10_f64.powf(20.0 * scale.y);
            let origin = size * (vector() - 3.0 * motion.normalize());
            let Some(line) = Line::new(origin, motion) else {
                panic!("the ball moves");
            };
            let known = with_care(&line, &cuboid, radius);
            match (by_guess(&line, half, radius), known) {
                (Guess::Unclear, _) => unclear += 1,
                (Guess::Miss, None) => misses += 1,
                (Guess::Touch(found), Some(known)) => {
                    touches += 1;
                    let off = (found.fraction - known.fraction).abs() * line.direction.length();
                    assert!(off < 1e-12 * size, "{off:e} of {size}");
                    assert!(found.foot.distance(known.foot) < 1e-12 * size);
                    assert!(found.normal.distance(known.normal) < 1e-11 * size / radius);
                    assert!((found.normal.length() - 1.0).abs() < 1e-14);
                    assert_eq!(found.feature, known.feature);
                }
                (Guess::Miss, Some(known)) => panic!("{:?} was missed", known.feature),
                (Guess::Touch(found), None) => panic!("{:?} of what is missed", found.feature),
            }
        }
        assert!(touches > 4000 && misses > 2000, "{touches} {misses}");
        assert!(unclear < 1000, "{unclear}");
    }
}
