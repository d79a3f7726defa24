//! Where bodies fly, as the broad phase and the early-outs see them.

use crate::early_out::{self, Rejection};
use crate::geometry::{Aabb, Pose, Ray, Shape};
use crate::motion::FrameMotion;
use crate::tolerance::{MAX_COORDINATE, TOUCH};
use crate::world::slots::Resident;
use crate::world::{Body, Groups};
use glam::{DQuat, DVec3};

/// The frame at hand, in seconds of the world's clock.
#[derive(Debug, Clone, Copy)]
pub(super) struct Span {
    pub(super) time: f64,
    pub(super) dt: f64,
}

impl Span {
    /// Seconds of a motion that began at `since` that are over, and that the
    /// frame lasts.
    ///
    /// By the clock, which moves on by `dt` to rounding only: the next frame shall
    /// begin where this one ends.
    #[inline]
    pub(super) fn of_motion(&self, since: f64) -> (f64, f64) {
        let elapsed = self.time - since;
        (elapsed, (self.time + self.dt - since) - elapsed)
    }
}

impl Span {
    /// No time at all.
    pub(super) fn at(time: f64) -> Self {
        Self { time, dt: 0.0 }
    }
}

/// A sphere, and a box within it, that fly straight and hold a body.
///
/// Small, and kept apart from the rest of the body: what looks at all bodies or at
/// all pairs of a frame reads nothing else. A track is written when a body is given
/// its motion, and holds until it gets another; only that of a body on a path is
/// written anew in every frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Track {
    /// Of the sphere, at `since`.
    pub(super) centre: DVec3,
    pub(super) velocity: DVec3,
    pub(super) since: f64,
    /// Radius of the sphere: for a ball, its own to the bit.
    pub(super) reach: f64,
    /// Half the edges of the box.
    half: [f32; 3],
    pub(super) course: Course,
    /// Whether the body is a ball in straight flight, or at rest: there is no more to it.
    pub(super) is_ball: bool,
    /// Whether its axes are those of the world, as its motion begins.
    pub(super) is_unturned: bool,
    pub(super) groups: Groups,
}

/// Why two bodies cannot touch: at most one is true.
#[derive(Debug, Clone, Copy)]
pub(super) struct KeepsOff {
    pub(super) too_far: bool,
    pub(super) moving_away: bool,
    pub(super) passing_by: bool,
}

/// What is known of a body's motion without looking at it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Course {
    Fixed,
    Free,
    /// Along a path.
    Path,
}

/// Half extents around the centre of the body's [`hub`](Body::hub), however it turns.
pub(super) fn half_extents(body: &Body, centre_offset: DVec3) -> DVec3 {
    let (_, reach) = body.hub();
    let reach = DVec3::splat(reach);
    if matches!(body.shape, Shape::Sphere(_)) || body.motion.turns() {
        return reach;
    }
    let aabb = body.shape.aabb(&Pose::new(DVec3::ZERO, body.orientation));
    let half = (aabb.max - centre_offset).max(centre_offset - aabb.min);
    // Turned by a rounded quaternion; the sphere holds the body as well.
    let rounding = 32.0 * f64::EPSILON * (reach + centre_offset.abs());
    half.max(DVec3::ZERO).min(reach) + rounding
}

fn rounded_up(half: DVec3) -> [f32; 3] {
    half.to_array()
        .map(|half| (half * (1.0 + f64::from(f32::EPSILON))) as f32)
}

impl Track {
    /// The track of a body, from when it was given its motion; for one on a path,
    /// [`in_frame`](Self::in_frame) has to follow.
    pub(super) fn new(resident: &Resident) -> Self {
        let motion = resident.body.motion();
        let position = motion.position_after(0.0);
        let centre = position + resident.centre_offset;
        // Once rounded here where the narrow phase does not; nothing for a sphere,
        // whose centre is its position.
        let rounding = if resident.centre_offset == DVec3::ZERO {
            0.0
        } else {
            4.0 * f64::EPSILON * (position.abs() + resident.centre_offset.abs()).max_element()
        };
        Self {
            centre,
            velocity: motion.velocity_after(0.0),
            since: resident.since,
            reach: resident.reach + rounding,
            half: rounded_up(resident.half + rounding),
            course: match (motion.is_fixed(), motion.is_free()) {
                (true, _) => Course::Fixed,
                (_, true) => Course::Free,
                _ => Course::Path,
            },
            groups: resident.body.groups,
            is_unturned: resident.body.orientation == DQuat::IDENTITY,
            is_ball: matches!(resident.body.shape, Shape::Sphere(_))
                && motion.path().is_none()
                && !motion.turns(),
        }
    }

    /// Reads a number from either end of the record, so that all of it is in the cache.
    #[inline]
    pub(super) fn touch(&self) -> f64 {
        self.centre.x + self.reach + f64::from(self.half[0])
    }

    /// The track in one frame of a body whose motion in it has been worked out.
    pub(super) fn in_frame(resident: &Resident, frame: &FrameMotion, span: Span) -> Self {
        let FrameMotion {
            start,
            displacement,
            deviation,
            ..
        } = *frame;
        let (_, duration) = span.of_motion(span.time);
        let velocity = displacement / duration;
        // A frame too short for the clock lasts no time, in which nobody flies.
        let (velocity, lost) = if velocity.is_finite() {
            (velocity, 4.0 * f64::EPSILON)
        } else {
            (DVec3::ZERO, 1.0)
        };
        let offset = resident.centre_offset;
        let rounding = 4.0 * f64::EPSILON * (start.abs() + offset.abs()).max_element();
        let growth = deviation + lost * displacement.length() + rounding;
        Self {
            centre: start + offset,
            velocity,
            since: span.time,
            reach: resident.reach + growth,
            half: rounded_up(resident.half + growth),
            course: Course::Path,
            is_ball: false,
            is_unturned: false,
            groups: resident.body.groups,
        }
    }

    /// Until when, by the world's clock, the body surely keeps within the domain of
    /// coordinates; before any time if it is half way out.
    pub(super) fn safe_until(&self) -> f64 {
        let room = 0.5 * MAX_COORDINATE - self.centre.abs().max_element() - self.reach;
        let speed = self.velocity.abs().max_element();
        if room < 0.0 {
            f64::NEG_INFINITY
        } else if speed > 0.0 {
            self.since + room / speed
        } else {
            f64::INFINITY
        }
    }

    /// Where the sphere's centre is as the frame begins, and by how much it moves.
    #[inline]
    pub(super) fn flight(&self, span: Span) -> (DVec3, DVec3) {
        let (elapsed, duration) = span.of_motion(self.since);
        (
            self.centre + elapsed * self.velocity,
            duration * self.velocity,
        )
    }

    /// The box around all places where the body is during the frame.
    #[inline]
    pub(super) fn swept(&self, span: Span) -> Aabb {
        let (from, displacement) = self.flight(span);
        let to = from + displacement;
        let (low, high) = (from.min(to), from.max(to));
        // What comes as near as this in the frame counts as touching.
        let largest = low.abs().max(high.abs()).max_element();
        let touch = 2.0 * TOUCH * (self.reach + largest);
        // In parts of the time the flight is rounded otherwise.
        let rounding = 16.0 * f64::EPSILON * (largest + self.centre.abs().max_element());
        let half = DVec3::from_array(self.half.map(f64::from)) + (touch + rounding);
        Aabb {
            min: low - half,
            max: high + half,
        }
    }

    /// Whether an early-out test shows that two bodies cannot touch in the frame.
    #[inline]
    pub(super) fn reject(&self, other: &Self, span: Span) -> Option<Rejection> {
        let ((a, motion_a), (b, motion_b)) = (self.flight(span), other.flight(span));
        // Centres are rounded where the narrow phase's differences are not.
        let rounding = 8.0 * f64::EPSILON * a.abs().max(b.abs()).max_element();
        let reach = self.reach + other.reach + rounding;
        early_out::reject(b - a, motion_a - motion_b, reach)
    }

    /// Which early-out tests show that two bodies cannot touch in any frame of a time ahead; what
    /// [`meets_ahead`](Self::meets_ahead) says, and without a branch, but for pairs that hardly miss.
    #[inline]
    pub(super) fn keeps_off(&self, other: &Self, ahead: Span) -> KeepsOff {
        let (between, motion, reach) = self.approach(other, ahead);
        let (closing, square) = (between.dot(motion), motion.length_squared());
        // The nearest place on the way. No NaN, also of those that do not move relative to each other;
        // by rounding it is beside the nearest by less than the reach was grown for.
        let at = closing / square;
        let at = if at > 0.0 { at.min(1.0) } else { 0.0 };
        let nearest = (between - at * motion).length_squared();
        let reach = reach * reach * (1.0 + 1e-9);
        let is_off = nearest > reach;
        let far = between.length_squared();
        let left = far - closing;
        let is_far = closing >= square || left > 0.0 && left * left > reach * far;
        KeepsOff {
            moving_away: is_off & (closing < 0.0),
            too_far: is_off & (closing >= 0.0) & is_far,
            passing_by: is_off & (closing >= 0.0) & !is_far,
        }
    }

    /// From a body's centre to another's as a time ahead begins, how the first moves relative to the
    /// other, and how near may count as touching in any frame of it, for all that these are
    /// rounded otherwise.
    #[inline]
    fn approach(&self, other: &Self, ahead: Span) -> (DVec3, DVec3, f64) {
        let ((a, motion_a), (b, motion_b)) = (self.flight(ahead), other.flight(ahead));
        let far = (a.abs().max(b.abs()) + motion_a.abs().max(motion_b.abs())).max_element();
        let begun = self.centre.abs().max(other.centre.abs()).max_element();
        let reach = self.reach + other.reach;
        // What comes as near as this counts as touching.
        let touch = 4.0 * TOUCH * (reach + far);
        let rounding = 64.0 * f64::EPSILON * (far + begun);
        (b - a, motion_a - motion_b, reach + (touch + rounding))
    }

    /// When two bodies may touch first in any frame of a time ahead, for all that these are
    /// rounded otherwise: as a share of that time, right to 1e-7; or why they cannot.
    #[inline]
    pub(super) fn meets_ahead(&self, other: &Self, ahead: Span) -> Result<f64, Rejection> {
        let (between, motion, reach) = self.approach(other, ahead);
        if let Some(rejection) = early_out::reject(between, motion, reach) {
            return Err(rejection);
        }
        // The first root of |between − f · motion| = reach, in the form that divides by
        // a sum; with a reach so much larger that what rounding does to it is covered.
        let apart = between.length_squared() - reach * reach * (1.0 + 1e-8);
        let closing = between.dot(motion);
        let square = closing * closing - motion.length_squared() * apart;
        let fraction = apart / (closing + square.max(0.0).sqrt());
        // They overlap, or it cannot be told: at once.
        Ok(if apart > 0.0 && fraction > 0.0 {
            fraction * (1.0 - 1e-7)
        } else {
            0.0
        })
    }

    /// Whether a ray surely passes the sphere by where it is at `time`, up to fraction `until`.
    #[inline]
    pub(super) fn is_passed_by(&self, ray: &Ray, until: f64, time: f64) -> bool {
        let (centre, _) = self.flight(Span::at(time));
        let size = centre.abs().max(ray.origin.abs()).max_element();
        // Grazes are forgiving: see the module `raycast`.
        let reach = self.reach + 64.0 * f64::EPSILON * (size + self.reach);
        early_out::reject(centre - ray.origin, until * ray.direction, reach).is_some()
    }
}
