//! The first touch of two bodies on curves and in rotation.

use super::Touching;
use super::flight::{Flight, Instant};
use super::gliding::{Glide, glide};
use super::meeting::{Meeting, meet, strike};
use super::nearness::{Nearness, passes_by};
use super::parting::Parted;
use super::passages::{FLIP, Passages, Rates};
use super::planes::{Nearest, Place, Planes, TurningBall, TurningBoxes};
use super::revolved::{self, Patience};
use super::turner::Turner;
use super::window::{Plane, Side, Window};
use crate::geometry::Shape;
use crate::motion::{Course, Stretch};
use crate::narrow_phase::distance::closest_points;
use crate::narrow_phase::overlap::overlap;
use glam::DVec3;

/// What two bodies in flight do in a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Encounter {
    /// They touch.
    Touch {
        /// When; the point is an offset from the second body's position then.
        touching: Touching,
        /// Up to this fraction they are proven apart.
        clear_until: f64,
    },
    /// They touched already as the frame began, and go on into each other.
    Resting(Touching),
    /// Proven apart for the whole frame, or parting or sliding from touch.
    Apart,
    /// Out of budget: proven apart until this fraction.
    Undecided { clear_until: f64 },
}

/// Steps for the least of frames.
///
/// An ordinary query takes 5 to 15, a graze up to a hundred: two bodies that slide or run side by side
/// on curves for long are given up after them.
const STEPS: u32 = 400;

/// Steps for what is told quickly as a rule, before the search goes on that decides all.
const QUICK_STEPS: u32 = 60;

/// So many more for each stretch of a path and each radian turned.
const STEPS_PER_STRETCH: u32 = 32;

/// And for each cusp in which a body that faces its way turns round.
const STEPS_PER_CUSP: u32 = 128;

/// No more altogether: about a second's work.
const MOST_STEPS: u32 = 1_000_000;

/// Two spheres farther apart than this share of their radii are not looked into.
const FAR: f64 = 0.05;

/// Sine of the angle to the surface below which a motion slides along it.
const SLIDE: f64 = 1e-7;

/// Share of a gap that what closes it now must close of it while it is proven open, for a leap to be tried.
const TIGHT: f64 = 0.87;

/// Share of the bodies' own speeds below which they move alike.
const ALIKE: f64 = 1e-12;

/// Share of a frame that is rounding of the times at which pieces of paths meet.
const ROUNDING: f64 = 1e-12;

/// How deep a slide in touch may leave it unseen, as a share of the pair's size.
const UNSEEN: f64 = 1e-9;

/// How two bodies in flight come to touch in their frame.
///
/// Conservative advancement: the plane across the bodies' nearest points, turned along with the features
/// that are nearest there, parts them for a time that [`Window`] computes; then comes the next plane,
/// until they are nearer than `touch` metres, or than [`Nearness::meeting`] later on. No step jumps over a
/// touch, and each leaves about the square of the gap before. Where the closing rate vanishes, in a graze,
/// steps shrink in proportion to the time left.
///
/// Source: Mirtich, *Impulse-based Dynamic Simulation of Rigid Body Systems* (1996), for the
/// principle; the bounds are of the second order here.
pub(crate) fn encounter(
    (a, b): (&Flight<'_>, &Flight<'_>),
    touch: f64,
    steps: &mut usize,
) -> Encounter {
    if passes_by(a, b, touch) {
        *steps += 1;
        return Encounter::Apart;
    }
    let touch = Nearness::of((a, b), touch);
    let quick = if a.glides() && b.glides() {
        glide((a, b), touch, steps)
    } else {
        match (a.shape, b.shape) {
            (Shape::Cuboid(of_a), Shape::Cuboid(of_b)) => {
                search((a, b), TurningBoxes::new(of_a, of_b), touch, 0.0, steps)
            }
            (Shape::Sphere(ball), Shape::Cuboid(cuboid)) => {
                let planes = TurningBall::new(ball, cuboid, Place::First);
                search((a, b), planes, touch, 0.0, steps)
            }
            (Shape::Cuboid(cuboid), Shape::Sphere(ball)) => {
                let planes = TurningBall::new(ball, cuboid, Place::Second);
                search((a, b), planes, touch, 0.0, steps)
            }
            _ => Glide::Left(0.0),
        }
    };
    let time = match quick {
        Glide::Found(found) => return found,
        Glide::Left(time) => time,
    };
    match search((a, b), Nearest::new(a, b, time), touch, time, steps) {
        Glide::Found(found) => found,
        Glide::Left(clear_until) => Encounter::Undecided { clear_until },
    }
}

/// The general search from `time` on, until which they are proven apart.
#[inline(never)]
fn search<P: Planes>(
    (a, b): (&Flight<'_>, &Flight<'_>),
    planes: P,
    touch: Nearness,
    time: f64,
    steps: &mut usize,
) -> Glide {
    let mut search = Search {
        a,
        b,
        planes,
        stretches: [
            a.frame.stretch_at(a.motion, time),
            b.frame.stretch_at(b.motion, time),
        ],
        turners: if P::DECIDES {
            [None, None]
        } else {
            [Turner::of(a), Turner::of(b)]
        },
        touch,
        time,
        longest: 1.0,
        patience: Patience::NEW,
        allowance: if P::DECIDES { STEPS } else { QUICK_STEPS },
        sliding: false,
        leap_below: f64::INFINITY,
    };
    let mut used = 0;
    let found = loop {
        used += 1;
        if used > search.allowance.min(MOST_STEPS) {
            break Glide::Left(search.time);
        }
        if let Some(found) = search.step() {
            break found;
        }
    };
    *steps += used as usize;
    found
}

pub(super) struct Search<'f, 'a, P> {
    pub(super) a: &'f Flight<'a>,
    pub(super) b: &'f Flight<'a>,
    pub(super) planes: P,
    pub(super) stretches: [Stretch<'a>; 2],
    /// Not of a spin where the planes ask for orientations.
    turners: [Option<Turner>; 2],
    pub(super) touch: Nearness,
    /// The bodies are proven apart until then.
    pub(super) time: f64,
    /// The longest window worth looking at.
    longest: f64,
    patience: Patience,
    allowance: u32,
    /// Whether they were in touch at the last step.
    sliding: bool,
    /// Gaps above this are not leapt over: it was tried not long ago.
    pub(super) leap_below: f64,
}

impl<'a, P: Planes> Search<'_, 'a, P> {
    fn reach(&self) -> f64 {
        self.a.reach + self.b.reach
    }

    /// Where a motion has carried a body, on the stretch at hand.
    #[inline]
    pub(super) fn carried_at(&self, side: usize, time: f64) -> DVec3 {
        let (flight, stretch) = ([self.a, self.b][side], &self.stretches[side]);
        match stretch.course {
            Course::Straight(velocity) if stretch.from <= 0.0 => {
                flight.frame.start + (time * flight.frame.seconds()) * velocity
            }
            Course::Rest if stretch.from <= 0.0 => flight.frame.start,
            _ => flight.carried_at(time),
        }
    }

    /// A body that its motion has carried to `carried` by then. Unless the planes ask for it, its orientation is not
    /// told but by the rotation.
    #[inline]
    pub(super) fn at(&self, side: usize, time: f64, carried: DVec3) -> Instant<'a> {
        let flight = [self.a, self.b][side];
        match &self.turners[side] {
            Some(turner) => turner.at(flight, time, carried),
            None => flight.at(time, carried),
        }
    }

    /// Metres below which they touch.
    fn touch(&self) -> f64 {
        if self.sliding {
            self.touch.resting
        } else {
            self.touch.at(self.time)
        }
    }

    /// One plane further; what was found, if that is the end.
    fn step(&mut self) -> Option<Glide> {
        for (stretch, flight) in self.stretches.iter_mut().zip([self.a, self.b]) {
            if self.time >= stretch.to && stretch.to < 1.0 {
                *stretch = flight.frame.stretch_at(flight.motion, self.time);
                // Where pieces meet, and where a frame ends as a path does, rounding may find one for an
                // ulp again and again.
                stretch.to = stretch.to.max(self.time + ROUNDING).min(1.0);
                self.allowance = self.allowance.saturating_add(STEPS_PER_STRETCH);
            }
        }
        let (at_a, at_b) = (self.carried_at(0, self.time), self.carried_at(1, self.time));
        let offset = (at_a - at_b) + (self.a.hub_shift() - self.b.hub_shift());
        let distance = offset.length();
        let room = distance - self.reach();
        if room > FAR * self.reach() && self.time < 1.0 {
            self.approach(offset, distance, room);
            return None;
        }
        let a = self.at(0, self.time, at_a);
        let b = self.at(1, self.time, at_b);
        let between = a.pose.position - b.pose.position;
        let offset = between + (a.hub_offset() - b.hub_offset());
        // What is kept from before is of bodies that do not turn, and even of these only if it was
        // told once.
        if !P::DECIDES || self.a.turns() || self.b.turns() {
            self.planes.turn(&a, &b);
        }
        let found = self.planes.part(between);
        let rates = Rates::on((self.a, self.b), &self.stretches, (self.time, self.longest));
        let Rates {
            passages,
            spins,
            sways,
            turning,
        } = &rates;
        let window = Window {
            a: Side {
                instant: &a,
                spin: spins[0],
                sway: sways[0],
                arm: self.a.arm,
            },
            b: Side {
                instant: &b,
                spin: spins[1],
                sway: sways[1],
                arm: self.b.arm,
            },
            offset,
            velocity: passages.velocity,
            bends: [&passages.bends[0], &passages.bends[1]],
            stray: passages.stray,
            turning: *turning,
            radii: self.a.radius + self.b.radius,
            length: passages.length,
            to: passages.to,
        };
        let far = |parted: &Parted| parted.distance > self.touch();
        if let Some(parted) = found.filter(far) {
            if self.time >= 1.0 {
                return Some(Glide::Found(Encounter::Apart));
            }
            self.sliding = false;
            return self.advance(&window, &parted);
        }
        if P::DECIDES {
            let normal = found.map(|parted| parted.normal);
            self.in_touch(&window, normal).map(Glide::Found)
        } else {
            let struck = found.and_then(|parted| {
                let flights = (self.a, self.b);
                strike(flights, &window, parted.normal, self.time)
            });
            Some(struck.map_or(Glide::Left(self.time), |touching| {
                Glide::Found(Encounter::Touch {
                    touching,
                    clear_until: self.time,
                })
            }))
        }
    }

    /// Time passes; where a window ends, to the bit.
    fn go_on(&mut self, by: f64, (length, to): (f64, f64)) {
        let next = if by >= length { to } else { self.time + by };
        // Time stands still where a step is less than its rounding.
        self.time = if next > self.time {
            next.min(1.0)
        } else {
            self.time.next_up()
        };
    }

    /// Far from each other the spheres around the hubs are enough.
    fn approach(&mut self, offset: DVec3, distance: f64, room: f64) {
        let normal = offset / distance;
        let passages = self.passages(1.0);
        let parabola = passages.parabola(normal, room - 0.5 * FAR * self.reach());
        let along = parabola.root().min(passages.length);
        // Whatever the directions; what is lost is rounding.
        let anyhow = room / (self.a.speed + self.b.speed) * (1.0 - 1e-9);
        self.go_farther((along, (passages.length, passages.to)), anyhow);
    }

    /// As far as a window says, or beyond it as far as speeds alone do.
    fn go_farther(&mut self, (by, window): (f64, (f64, f64)), anyhow: f64) {
        if anyhow > by {
            self.go_on(anyhow, (1.0 - self.time, 1.0));
        } else {
            self.go_on(by, window);
        }
    }

    /// How both hubs go on for `length` at most.
    fn passages(&self, length: f64) -> Passages {
        let to = (self.time + length).min(1.0);
        Passages::between((self.a, self.b), &self.stretches, [self.time, to])
    }

    /// As far as planes across the normal part the bodies.
    fn advance(&mut self, window: &Window<'_, '_>, parted: &Parted) -> Option<Glide> {
        let Parted {
            normal,
            gap,
            distance,
        } = *parted;
        let floor = 0.5 * self.touch();
        let (mut by, slope) = self.plane_advance(window, normal, floor);
        if by <= 0.0 && !P::DECIDES {
            return Some(Glide::Left(self.time));
        }
        if by <= 0.0 {
            // The plane does not say what the distance does; that of the features may.
            let (a, b) = (&window.a.instant.pose, &window.b.instant.pose);
            if let Some(closest) = closest_points(self.a.shape, a, self.b.shape, b) {
                (by, _) = self.plane_advance(window, closest.normal, floor);
            }
        }
        let jumps = window.turning.is_infinite() && by <= 0.0;
        if jumps || by < ROUNDING && window.length <= FLIP && window.may_turn_round() {
            // Nothing is known of a jump, but where it ends; beside it windows are short on both sides.
            by = window.length;
            self.allowance = self.allowance.saturating_add(STEPS_PER_CUSP);
        }
        if by < ROUNDING {
            // Nobody is faster than this; beside a cusp accelerations say less.
            let speed = self.a.speed
                + self.b.speed
                + window.turning
                + window.a.fastest(window.length)
                + window.b.fastest(window.length);
            by = by.max((0.5 * distance / speed).min(window.length));
        }
        // Nearly all of the gap closes by then: bounds are tight.
        let tight = -slope * by > TIGHT * distance;
        if !P::DECIDES && tight && by < window.length && self.leap(window, distance, slope, by) {
            return None;
        }
        self.longest = if by < 0.25 * window.length {
            4.0 * by
        } else {
            2.0 * self.longest
        };
        // Below rounding of the time it would have to be doubled a hundred times to matter again.
        self.longest = self.longest.clamp(ROUNDING, 1.0);
        let turned = |side: &Side<'_, '_>| side.spin.length() * by;
        let radians = turned(&window.a) + turned(&window.b);
        // Of long windows more than anyone can use; the cast saturates.
        self.allowance = self
            .allowance
            .saturating_add((radians * f64::from(STEPS_PER_STRETCH)) as u32);
        // Past cusps and laps that the window ends at.
        let fastest = self.a.fastest() + self.b.fastest();
        let anyhow = (gap - floor) / fastest * (1.0 - 1e-9);
        let mut farthest = (by, (window.length, window.to));
        if let Some(filled) = self.clear_of_solids(window, normal, floor, by.max(anyhow)) {
            farthest = filled;
        }
        self.go_farther(farthest, anyhow);
        None
    }

    /// How long the solids that turning bodies fill stay apart, where that is longer than `by`, and the window
    /// that says so.
    fn clear_of_solids(
        &mut self,
        window: &Window<'_, '_>,
        normal: DVec3,
        floor: f64,
        by: f64,
    ) -> Option<(f64, (f64, f64))> {
        if !(self.patience.is_over() && (self.a.turns() || self.b.turns())) {
            return None;
        }
        let (normal, gap) = revolved::apart((self.a, self.b), window, normal)?;
        if gap <= floor {
            return None;
        }
        let passages = self.passages(1.0);
        let along = passages.parabola(normal, gap - floor).root();
        let along = along.min(passages.length);
        let anyhow = (gap - floor) / (self.a.speed + self.b.speed) * (1.0 - 1e-9);
        let found = if anyhow > along {
            (anyhow, (1.0 - self.time, 1.0))
        } else {
            (along, (passages.length, passages.to))
        };
        (found.0 > by).then(|| {
            self.patience.paid();
            found
        })
    }

    /// What bodies in touch do: at the frame's start they may part or slide, later they have met.
    fn in_touch(&mut self, window: &Window<'_, '_>, normal: Option<DVec3>) -> Option<Encounter> {
        let met = meet((self.a, self.b), window, normal, self.time, self.touch());
        let Meeting {
            touching,
            closing,
            speed,
        } = met?;
        if self.time > 0.0 && !self.sliding {
            return Some(Encounter::Touch {
                touching,
                clear_until: self.time,
            });
        }
        let (pose_a, pose_b) = (&window.a.instant.pose, &window.b.instant.pose);
        let deep = || overlap(self.a.shape, pose_a, self.b.shape, pose_b).is_some();
        // Of bodies that go the same way the difference of their velocities is rounding.
        let turning = |side: &Side<'_, '_>| side.arm * side.spin.length();
        let own = self.a.speed + self.b.speed + turning(&window.a) + turning(&window.b);
        if closing > SLIDE * speed + ALIKE * own || self.sliding && deep() {
            return Some(if self.time > 0.0 {
                Encounter::Touch {
                    touching,
                    clear_until: self.time,
                }
            } else {
                Encounter::Resting(touching)
            });
        }
        if self.time >= 1.0 {
            return Some(Encounter::Apart);
        }
        self.sliding = true;
        // Such a step takes three times as long as others.
        self.allowance = self.allowance.saturating_sub(2);
        let turn = self.planes.turning(window, touching.normal);
        let plane = Plane {
            normal: touching.normal,
            turn,
        };
        if let Some(by) = window.parted_after(&plane, self.touch.resting) {
            self.sliding = false;
            self.go_on(by, (window.length, window.to));
            return None;
        }
        let bend = window.now(&plane).bend;
        let by = (2.0 * UNSEEN * self.reach() / bend).sqrt();
        self.go_on(by.min(window.length), (window.length, window.to));
        None
    }
}
