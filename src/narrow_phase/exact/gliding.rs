//! The first touch of two bodies on any course that do not turn.

use super::advance::Encounter;
use super::cubic::first_root;
use super::flight::Flight;
use super::gait::{Known, Motion};
use super::nearness::Nearness;
use super::parting::{BallAndBox, Balls, Boxes, Hulls, Parted, Parting};
use super::{Touching, aligned, cast};
use crate::curve::Section;
use crate::geometry::{Pose, Shape};
use crate::motion::{Course, Stretch};
use glam::{DQuat, DVec3};

/// How a search for bodies that do not turn ended.
pub(super) enum Glide {
    Found(Encounter),
    /// They are proven apart until then; what comes next is for the general search.
    Left(f64),
}

/// Looks at a pair of stretches, of which an ordinary query takes three to six.
///
/// What takes more is a graze or a slide, which the general search has a budget for.
const LOOKS: u32 = 40;

/// Share of the pair's size that a touch may be away along the motion.
const NEAR: f64 = 1e-6;

/// Cosine of the angle up to which a normal is the one that was expected.
const ALIKE: f64 = 0.99;

/// Share of the time in which courses turn by much, up to which a window is bounded as a whole.
const SHORT: f64 = 0.25;

/// Share of a frame that is rounding of the times at which pieces of paths meet.
const ROUNDING: f64 = 1e-12;

/// How two bodies come to touch that do not turn.
///
/// Seen from B, A is shifted, and so whatever plane parts the two in one place does so in
/// others as far as its gap, which changes as the shift along its normal: a number, for which
/// no support need be asked again. Of a body on a piece of a spline beside one at rest that
/// number is a cubic in the parameter, and its first root is where to look next. Of
/// others it is bounded by its value, slope and bend now and by how much the bend changes on a window,
/// and the plane is the one that parts the bodies where they are about to be.
///
/// No step jumps over a touch.
pub(super) fn glide(
    (a, b): (&Flight<'_>, &Flight<'_>),
    touch: Nearness,
    steps: &mut usize,
) -> Glide {
    let poses = [a, b].map(|flight| flight.pose_at(0.0));
    let [turned_a, turned_b] = poses.map(|pose| pose.orientation);
    let pair = Pair { a, b, touch };
    match (a.shape, b.shape) {
        (Shape::Sphere(ball), Shape::Sphere(other)) => {
            let radii = ball.radius() + other.radius();
            pair.search(poses, Balls { radii }, steps)
        }
        (Shape::Sphere(ball), Shape::Cuboid(cuboid)) => {
            let parting = BallAndBox::new(ball.radius(), cuboid, turned_b, 1.0);
            pair.search(poses, parting, steps)
        }
        (Shape::Cuboid(cuboid), Shape::Sphere(ball)) => {
            let parting = BallAndBox::new(ball.radius(), cuboid, turned_a, -1.0);
            pair.search(poses, parting, steps)
        }
        (Shape::Cuboid(of_a), Shape::Cuboid(of_b)) => {
            let parting = Boxes::new((of_a, turned_a), (of_b, turned_b));
            pair.search(poses, parting, steps)
        }
        _ => {
            let parting = Hulls::new((a.shape, &poses[0]), (b.shape, &poses[1]));
            pair.search(poses, parting, steps)
        }
    }
}

#[derive(Clone, Copy)]
struct Pair<'f, 'a> {
    a: &'f Flight<'a>,
    b: &'f Flight<'a>,
    touch: Nearness,
}

impl<'f, 'a> Pair<'f, 'a> {
    /// Whether one plane parts them all through the frame, by what they stray from their chords: no curve
    /// need be looked at.
    #[inline]
    fn is_parted<P: Parting>(&self, parting: &mut P) -> bool {
        let (a, b) = (self.a.frame, self.b.frame);
        let start = a.start - b.start;
        let way = a.displacement - b.displacement;
        let stray = a.deviation + b.deviation + self.touch.resting;
        // Both planes: where they begin, and half way.
        let centres = self.a.hub_shift() - self.b.hub_shift();
        [0.0, 0.5].into_iter().any(|share| {
            let between = start + share * way;
            // No gap is wider than centres are apart, and many are not worth looking for.
            let room = stray * stray < (between + centres).length_squared();
            let parted = if room { parting.part(between) } else { None };
            parted.is_some_and(|parted| {
                let slope = parted.normal.dot(way);
                let least = parted.gap + ((1.0 - share) * slope).min(-share * slope);
                least > stray
            })
        })
    }

    #[inline]
    fn search<P: Parting>(self, poses: [Pose; 2], parting: P, steps: &mut usize) -> Glide {
        let mut parting = parting;
        if self.is_parted(&mut parting) {
            *steps += 1;
            return Glide::Found(Encounter::Apart);
        }
        let stretch = |flight: &'f Flight<'a>| flight.frame.stretch_at(flight.motion, 0.0);
        let mut search = Search {
            flights: [self.a, self.b],
            turned: poses.map(|pose| pose.orientation),
            stretches: [stretch(self.a), stretch(self.b)],
            parting,
            touch: self.touch,
            time: 0.0,
            known: Known::NOTHING,
            longest: 1.0,
            looks: 0,
            allowance: LOOKS,
        };
        let found = loop {
            if let Some(found) = search.stretch() {
                break found;
            }
        };
        *steps += search.looks as usize;
        found
    }
}

/// A body where it is at a time.
#[derive(Clone, Copy)]
struct Place {
    position: DVec3,
    /// The parameter of its curve, if it follows one.
    u: f64,
}

struct Search<'f, 'a, P> {
    flights: [&'f Flight<'a>; 2],
    turned: [DQuat; 2],
    stretches: [Stretch<'a>; 2],
    parting: P,
    touch: Nearness,
    /// The bodies are proven apart until then.
    time: f64,
    known: Known,
    /// The longest window worth looking at.
    longest: f64,
    looks: u32,
    allowance: u32,
}

impl<P: Parting> Search<'_, '_, P> {
    /// Until a stretch of one of the paths ends; what was found, if that is the end.
    fn stretch(&mut self) -> Option<Glide> {
        for (stretch, flight) in self.stretches.iter_mut().zip(self.flights) {
            if self.time >= stretch.to && stretch.to < 1.0 {
                *stretch = flight.frame.stretch_at(flight.motion, self.time);
                // Where pieces meet, and where a frame ends as a path does, rounding may find one for an
                // ulp again and again.
                stretch.to = stretch.to.max(self.time + ROUNDING).min(1.0);
                self.known = Known::NOTHING;
                self.allowance = self.allowance.saturating_add(LOOKS);
            }
        }
        match [&self.stretches[0].course, &self.stretches[1].course] {
            [Course::Curve(_), Course::Rest] => self.along(0),
            [Course::Rest, Course::Curve(_)] => self.along(1),
            _ => self.side_by_side(),
        }
    }

    fn until(&self) -> f64 {
        self.stretches[0].to.min(self.stretches[1].to)
    }

    /// Beyond this no look is worth it: bodies graze or slide.
    fn is_weary(&mut self) -> bool {
        self.looks += 1;
        self.looks > self.allowance
    }

    /// One body on a curve, the other at rest.
    fn along(&mut self, side: usize) -> Option<Glide> {
        let (stretch, other) = (self.stretches[side], self.flights[1 - side]);
        let Course::Curve(curve) = &stretch.course else {
            return Some(Glide::Left(self.time));
        };
        let until = self.until();
        let rest = other.frame.position_at(other.motion, self.time);
        let sense = if side == 0 { 1.0 } else { -1.0 };
        let last = curve.u_at(stretch.share_at(until));
        let mut u = curve.u_at(stretch.share_at(self.time));
        let velocity = curve.piece.velocity();
        let mut touch = self.touch.at(self.time);
        loop {
            let between = sense * (curve.piece.point(u) - rest);
            let parted = self.parting.part(between);
            let far = parted.filter(|parted| parted.distance > touch);
            if far.is_some() && (u - last).abs() <= 0.0 {
                self.time = until;
                let ends = until >= 1.0;
                return ends.then_some(Glide::Found(Encounter::Apart));
            }
            let floor = 0.5 * touch;
            let above = far.filter(|parted| parted.gap > floor && !self.is_weary());
            let Some(parted) = above else {
                let share = curve.share_at(u);
                let time = stretch.from + share * (stretch.to - stretch.from);
                // Rounding does not lead back.
                self.time = time.max(self.time).min(until);
                if far.is_some() {
                    return Some(Glide::Left(self.time));
                }
                let speed = if curve.is_forward() { sense } else { -sense };
                let speed = speed * self.flights[side].speed;
                let motion = speed * curve.piece.heading(u).0;
                return Some(self.touched(between, parted, motion));
            };
            let height = |velocity: DVec3| sense * parted.normal.dot(velocity);
            let [a, b, c] = velocity.map(height);
            touch = self.touch.meeting;
            let third = (last - u) / 3.0;
            let mix = |u: f64, a: f64, b: f64| (1.0 - u) * a + u * b;
            let blossom = |u: f64, v: f64| mix(v, mix(u, a, b), mix(u, b, c));
            let c0 = parted.gap - floor;
            let c1 = c0 + third * blossom(u, u);
            let c2 = c1 + third * blossom(u, last);
            let c3 = c2 + third * blossom(last, last);
            let Some(share) = first_root([c0, c1, c2, c3], 0.25 * floor) else {
                u = last;
                continue;
            };
            let next = u + share * (last - u);
            if (next - u).abs() <= 0.0 {
                // Less than rounding of the parameter is left.
                self.allowance = 0;
            }
            u = next;
        }
    }

    fn place(&mut self, side: usize, time: f64) -> Place {
        let (stretch, flight) = (&mut self.stretches[side], self.flights[side]);
        let share = stretch.share_at(time);
        match &mut stretch.course {
            Course::Curve(curve) => {
                let u = curve.seek(share);
                Place {
                    position: curve.piece.point(u),
                    u,
                }
            }
            Course::Rest | Course::Straight(_) => Place {
                position: flight.frame.position_at(flight.motion, time),
                u: 0.0,
            },
        }
    }

    /// Velocity and acceleration, per frame; not finite in a cusp.
    fn pace(&self, side: usize, place: &Place) -> (DVec3, DVec3) {
        match &self.stretches[side].course {
            Course::Curve(curve) => {
                let speed = self.flights[side].speed;
                let (tangent, bend) = curve.piece.heading(place.u);
                let sense = if curve.is_forward() { speed } else { -speed };
                (sense * tangent, speed * speed * bend)
            }
            Course::Straight(velocity) => {
                (self.flights[side].frame.seconds() * *velocity, DVec3::ZERO)
            }
            Course::Rest => (DVec3::ZERO, DVec3::ZERO),
        }
    }

    /// Both bodies under way.
    fn side_by_side(&mut self) -> Option<Glide> {
        let until = self.until();
        loop {
            let places = [0, 1].map(|side| self.place(side, self.time));
            let between = places[0].position - places[1].position;
            let parted = self.parting.part(between);
            let touch = self.touch.at(self.time);
            let far = parted.filter(|parted| parted.distance > touch);
            let paces = [0, 1].map(|side| self.pace(side, &places[side]));
            let motion = Motion::of(&paces);
            if far.is_some() && self.time >= until {
                let ends = until >= 1.0;
                return ends.then_some(Glide::Found(Encounter::Apart));
            }
            let floor = 0.5 * touch;
            let above = far.filter(|parted| parted.gap > floor && !self.is_weary());
            let Some(parted) = above else {
                return Some(if far.is_some() {
                    Glide::Left(self.time)
                } else {
                    self.touched(between, parted, motion.velocity)
                });
            };
            self.advance(&places, between, &parted, &motion, until);
        }
    }

    /// As far as planes part the bodies for certain.
    fn advance(
        &mut self,
        places: &[Place; 2],
        between: DVec3,
        parted: &Parted,
        motion: &Motion,
        until: f64,
    ) {
        let floor = 0.5 * self.touch.at(self.time);
        let start = parted.gap - floor;
        // Nobody is faster than this; what is lost is rounding.
        let anyhow = start / (self.flights[0].speed + self.flights[1].speed) * (1.0 - 1e-9);
        let ahead = motion.ahead(start, parted.normal);
        if self.known.until <= self.time {
            let longest = self.longest.max(2.0 * anyhow);
            let length = (1.5 * ahead).min(longest).min(motion.straight_for);
            self.known = self.bounds(places, length, SHORT * motion.straight_for, until);
        }
        let window = self.known.until - self.time;
        let mut by = 0.0;
        if window > 0.0 {
            by = motion.clear_for(start, parted.normal, self.known, window);
            // The plane where they are about to be does for longer. It is asked for without waiting for how
            // far this one does.
            let there = motion.offset_after(ahead.min(window));
            if by < window
                && let Some(next) = self.parting.part(between + there)
            {
                let start = next.gap - next.normal.dot(there) - floor;
                if start > 0.0 {
                    let longer = motion.clear_for(start, next.normal, self.known, window);
                    by = by.max(longer);
                }
            }
        }
        if anyhow >= by {
            by = anyhow.min(until - self.time);
        }
        // Where the bounds are what ends it, and not the bodies, tighter ones are next.
        self.longest = if by < 0.25 * window && by < 0.5 * ahead {
            self.known.until = f64::NEG_INFINITY;
            4.0 * by
        } else {
            (2.0 * self.longest).min(1.0)
        };
        // Time stands still where a step is less than its rounding.
        let next = if by >= window && self.known.until > self.time + by {
            self.known.until
        } else {
            self.time + by
        };
        self.time = if next > self.time {
            next
        } else {
            self.time.next_up()
        }
        .min(until);
    }

    /// What bounds the motion for `length` at most, of which less than `short` is short; nothing beside a cusp.
    fn bounds(&self, places: &[Place; 2], length: f64, short: f64, until: f64) -> Known {
        /// Each a quarter of the one before.
        const TRIES: u32 = 6;
        let mut length = length;
        for _ in 0..TRIES {
            let end = if self.time + length >= until {
                until
            } else {
                self.time + length
            };
            let mut known = Known {
                until: end,
                bend: 0.0,
                rise: 0.0,
            };
            let mut bounded = end > self.time;
            for (side, place) in places.iter().enumerate() {
                let stretch = &self.stretches[side];
                if let Course::Curve(curve) = &stretch.course {
                    let speed = self.flights[side].speed;
                    let leave =
                        curve.u_after(place.u, speed * (end - self.time), end >= stretch.to);
                    let section = Section::of(curve.piece, [place.u, leave], curve.is_forward());
                    // What bounds halves does so far better than what bounds the whole, if that is long.
                    let limits = if length > short {
                        let [first, second] = section.halves().map(|half| half.limits());
                        first.zip(second).map(|(first, second)| first.and(&second))
                    } else {
                        section.limits()
                    };
                    match limits {
                        Some(limits) => {
                            let square = speed * speed;
                            known.bend += square * limits.curvature;
                            known.rise += square * speed * limits.rise;
                            if (leave - curve.u[1]).abs() > 0.0 {
                                // Where it leaves was guessed; it is not there before.
                                known.until = known.until.min(self.time + limits.length / speed);
                            }
                        }
                        None => bounded = false,
                    }
                }
            }
            if bounded && known.rise.is_finite() {
                return known;
            }
            length = 0.25 * (end - self.time);
        }
        Known::NOTHING
    }

    /// How they touch on a straight way.
    fn cast(&self, between: DVec3, motion: DVec3) -> Option<Touching> {
        let (shapes, [a, b]) = (self.flights.map(|flight| flight.shape), self.turned);
        if let (Shape::Cuboid(of_a), Shape::Cuboid(of_b)) = (shapes[0], shapes[1])
            && a == b
            && let Some(touching) = aligned::touch([of_a, of_b], a, between, motion)
        {
            return Some(touching);
        }
        let poses = [Pose::new(between, a), Pose::new(DVec3::ZERO, b)];
        cast::touch(shapes[0], &poses[0], shapes[1], &poses[1], motion)
    }

    /// The touch of bodies that are nearer than what counts.
    ///
    /// The last bit of the way is straight: one exact cast gives time, point, normal and features.
    fn touched(&self, between: DVec3, parted: Option<Parted>, motion: DVec3) -> Glide {
        let left = Glide::Left(self.time);
        if !(self.time > 0.0 && motion.is_finite()) {
            return left;
        }
        let Some(mut touching) = self.cast(between, motion) else {
            return left;
        };
        let reach = self.flights[0].reach + self.flights[1].reach;
        let speed = motion.length();
        let way = touching.fraction * speed;
        let near = way.abs() <= NEAR * reach;
        let steep = -touching.normal.dot(motion) > NEAR * speed;
        let alike = parted.is_none_or(|parted| parted.normal.dot(touching.normal) > ALIKE);
        if !(near && steep && alike) {
            return left;
        }
        let late = if way > 0.0 { touching.fraction } else { 0.0 };
        touching.fraction = (self.time + late).min(1.0);
        Glide::Found(Encounter::Touch {
            touching,
            clear_until: self.time,
        })
    }
}
