//! The first touch of two bodies on any course that do not turn.

use super::advance::Encounter;
use super::cubic::first_root;
use super::curved_balls;
use super::flight::Flight;
use super::nearness::Nearness;
use super::parting::{AlignedBoxes, BallAndBox, Balls, Boxes, Hulls, Parted, Parting};
use super::{Touching, aligned, cast};
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

/// Share of a frame that is rounding of the times at which pieces of paths meet.
const ROUNDING: f64 = 1e-12;

/// How two bodies come to touch that do not turn.
///
/// Seen from B, A is shifted, and so whatever plane parts the two in one place does so in
/// others as far as its gap, which changes as the shift along its normal: a number, for which
/// no support need be asked again. Of a body on a piece of a spline beside one at rest that
/// number is a cubic in the parameter, and its first root is where to look next. The motion of
/// others is a cubic in time but for an error that is known, on windows as long as that is small.
///
/// No step jumps over a touch.
pub(super) fn glide(
    (a, b): (&Flight<'_>, &Flight<'_>),
    touch: Nearness,
    steps: &mut usize,
) -> Glide {
    let pair = Pair { a, b, touch };
    let mut from = 0.0;
    if let (Shape::Sphere(ball), Shape::Sphere(other)) = (a.shape, b.shape) {
        let radii = [ball.radius(), other.radius()];
        match curved_balls::meet((a, b), radii, touch, steps) {
            Glide::Left(time) => from = time,
            found @ Glide::Found(_) => return found,
        }
    }
    let poses = [a, b].map(|flight| flight.pose_at(0.0));
    let [turned_a, turned_b] = poses.map(|pose| pose.orientation);
    match (a.shape, b.shape) {
        (Shape::Sphere(ball), Shape::Sphere(other)) => {
            let radii = ball.radius() + other.radius();
            let radius = other.radius();
            pair.search_from(from, poses, Balls { radii, radius }, steps)
        }
        (Shape::Sphere(ball), Shape::Cuboid(cuboid)) => {
            let parting = BallAndBox::new(ball.radius(), cuboid, turned_b, 1.0);
            pair.search(poses, parting, steps)
        }
        (Shape::Cuboid(cuboid), Shape::Sphere(ball)) => {
            let parting = BallAndBox::new(ball.radius(), cuboid, turned_a, -1.0);
            pair.search(poses, parting, steps)
        }
        (Shape::Cuboid(of_a), Shape::Cuboid(of_b)) if turned_a == turned_b => {
            pair.search(poses, AlignedBoxes::new(of_a, of_b, turned_a), steps)
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
    fn search<P: Parting>(self, poses: [Pose; 2], mut parting: P, steps: &mut usize) -> Glide {
        if self.is_parted(&mut parting) {
            *steps += 1;
            return Glide::Found(Encounter::Apart);
        }
        self.search_from(0.0, poses, parting, steps)
    }

    /// From `time` on, until which they are proven apart.
    #[inline]
    fn search_from<P: Parting>(
        self,
        time: f64,
        poses: [Pose; 2],
        mut parting: P,
        steps: &mut usize,
    ) -> Glide {
        let stretch = |flight: &'f Flight<'a>| flight.frame.stretch_at(flight.motion, time);
        let mut search = Search {
            flights: [self.a, self.b],
            turned: poses.map(|pose| pose.orientation),
            stretches: [stretch(self.a), stretch(self.b)],
            parting: &mut parting,
            touch: self.touch,
            time,
            hops: 0,
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

pub(super) struct Search<'f, 'a, P> {
    pub(super) flights: [&'f Flight<'a>; 2],
    turned: [DQuat; 2],
    pub(super) stretches: [Stretch<'a>; 2],
    pub(super) parting: &'f mut P,
    pub(super) touch: Nearness,
    /// The bodies are proven apart until then.
    pub(super) time: f64,
    /// Steps on which nothing but speeds was known.
    pub(super) hops: u32,
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
                self.allowance = self.allowance.saturating_add(LOOKS);
            }
        }
        match [&self.stretches[0].course, &self.stretches[1].course] {
            [Course::Curve(_), Course::Rest] => self.along(0),
            [Course::Rest, Course::Curve(_)] => self.along(1),
            _ => self.side_by_side(),
        }
    }

    pub(super) fn until(&self) -> f64 {
        self.stretches[0].to.min(self.stretches[1].to)
    }

    /// Beyond this no look is worth it: bodies graze or slide.
    pub(super) fn is_weary(&mut self) -> bool {
        self.looks += 1;
        self.looks > self.allowance
    }

    /// Where a stretch ends, as far into those that follow as speeds alone say: one lap may be very short.
    pub(super) fn go_beyond(&mut self, until: f64, parted: Parted) -> Option<Glide> {
        let gap = parted.gap - self.touch.at(until);
        let speed = self.flights[0].speed + self.flights[1].speed;
        let anyhow = (gap / speed * (1.0 - 1e-9)).max(0.0);
        self.time = (until + anyhow).min(1.0);
        (self.time >= 1.0).then_some(Glide::Found(Encounter::Apart))
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
            if let Some(parted) = far
                && (u - last).abs() <= 0.0
            {
                return self.go_beyond(until, parted);
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
    pub(super) fn touched(&self, between: DVec3, parted: Option<Parted>, motion: DVec3) -> Glide {
        let left = Glide::Left(self.time);
        if !(self.time > 0.0 && motion.is_finite()) {
            return left;
        }
        let reach = self.flights[0].reach + self.flights[1].reach;
        let speed = motion.length();
        let found = self.cast(between, motion).filter(|touching| {
            let near = (touching.fraction * speed).abs() <= NEAR * reach;
            let steep = -touching.normal.dot(motion) > NEAR * speed;
            let alike = parted.is_none_or(|parted| parted.normal.dot(touching.normal) > ALIKE);
            near && steep && alike
        });
        let touch = self.touch.at(self.time);
        let beside = parted.filter(|parted| parted.distance >= -touch);
        let grazed = || {
            let parted = beside?;
            let fraction = parted.distance / -parted.normal.dot(motion);
            let soon = fraction > 0.0 && fraction * speed <= NEAR * reach;
            let fraction = if soon { fraction } else { 0.0 };
            let touching = self.parting.grazed(&parted)?;
            Some(Touching {
                fraction,
                ..touching
            })
        };
        let Some(mut touching) = found.or_else(grazed) else {
            return left;
        };
        let way = touching.fraction * speed;
        let late = if way > 0.0 { touching.fraction } else { 0.0 };
        touching.fraction = (self.time + late).min(1.0);
        Glide::Found(Encounter::Touch {
            touching,
            clear_until: self.time,
        })
    }
}
