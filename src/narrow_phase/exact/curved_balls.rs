//! The first touch of two balls of which one at least is on a curve.

use super::Touching;
use super::advance::Encounter;
use super::flight::Flight;
use super::gliding::Glide;
use super::nearness::Nearness;
use super::sextic::Sextic;
use crate::geometry::Feature;
use crate::motion::{Milestone, Track};
use glam::DVec3;

/// Moments looked at on a pair of tracks, of which an ordinary query takes four to six.
const LOOKS: u32 = 40;

/// By so much a window must be longer than what speeds alone say.
const WORTH: f64 = 1.5;

/// Balls that are about to meet are looked at until so much later than they seem to.
const SOON: f64 = 1.1;

/// Steps as long as speeds alone allow, before others take over who know about cusps.
const HOPS: u32 = 12;

/// Share of a frame that is rounding of the times at which pieces of paths meet.
const ROUNDING: f64 = 1e-12;

/// Share of the pair's size that a touch may be away along the motion.
const NEAR: f64 = 1e-6;

/// Share of a gap that may be left open by what is known from one look, for the next one to be like it.
const SURE: f64 = 1e-3;

/// How two balls come to touch that move as their carried points do.
///
/// Between two moments the way from one to the other is a cubic that meets places and velocities at both, but for
/// an error that is known from how much the fourth derivatives are at most; so the square of their distance is no
/// less than a polynomial in time. Where that comes down to the square of their radii, which is no later than they
/// touch, the way is looked up again: from there on its second derivative is known, but for an error that falls with
/// the square of the window. Each such look leaves about the square of the gap before, and the last touch is
/// computed from it.
///
/// `Glide::Left` where they are in touch as the frame begins, graze for too long, or come by a cusp.
pub(super) fn meet(
    (a, b): (&Flight<'_>, &Flight<'_>),
    radii: [f64; 2],
    touch: Nearness,
    steps: &mut usize,
) -> Glide {
    let speed = a.speed + b.speed;
    // The first step is as long as speeds allow: no place need be looked up for it.
    let gap = (a.frame.start - b.frame.start).length() - (radii[0] + radii[1]);
    // NaN, too.
    if gap.is_nan() || gap <= touch.resting {
        return Glide::Left(0.0);
    }
    let time = (gap - touch.resting) / speed * (1.0 - 1e-9);
    if time >= 1.0 {
        *steps += 1;
        return Glide::Found(Encounter::Apart);
    }
    let (track_a, near_a) = a.frame.track_at(a.motion, time);
    let (track_b, near_b) = b.frame.track_at(b.motion, time);
    let mut chase = Chase {
        flights: [a, b],
        tracks: [track_a, track_b],
        radii: radii[0] + radii[1],
        radius: radii[1],
        speed,
        touch,
        time,
        looks: 0,
        hops: 0,
        allowance: LOOKS,
    };
    let mut near = [near_a, near_b];
    let found = loop {
        if let Some(found) = chase.stretch(near) {
            break found;
        }
        near = chase.renew();
    };
    *steps += chase.looks as usize;
    found
}

struct Chase<'f, 'a> {
    flights: [&'f Flight<'a>; 2],
    tracks: [Track<'a>; 2],
    radii: f64,
    /// The second one's.
    radius: f64,
    /// No gap closes faster, in metres per frame.
    speed: f64,
    touch: Nearness,
    /// They are proven apart until then.
    time: f64,
    looks: u32,
    hops: u32,
    allowance: u32,
}

/// Two balls at a moment.
#[derive(Clone, Copy)]
struct Moment {
    /// From B's centre to A's, and how that changes in a frame.
    between: DVec3,
    velocity: DVec3,
    near: [Milestone; 2],
}

/// The way from B's centre to A's as a polynomial, and by how much its second derivative may be off.
#[derive(Clone, Copy)]
struct Forecast {
    second: DVec3,
    third: DVec3,
    off: f64,
    /// Until then.
    to: f64,
}

impl Chase<'_, '_> {
    fn at(&self, time: f64, near: &[Milestone; 2]) -> Moment {
        let a = self.tracks[0].at(time, &near[0]);
        let b = self.tracks[1].at(time, &near[1]);
        Moment {
            between: a.position - b.position,
            velocity: a.velocity - b.velocity,
            near: [a.milestone, b.milestone],
        }
    }

    /// The tracks at hand, where one has ended.
    #[cold]
    fn renew(&mut self) -> [Milestone; 2] {
        // Milestones of a track that goes on would do as well, but none is known where speeds alone led.
        std::array::from_fn(|side| {
            let flight = self.flights[side];
            let (mut track, near) = flight.frame.track_at(flight.motion, self.time);
            // Where pieces meet, and where a frame ends as a path does, rounding may find one for an
            // ulp again and again.
            track.to = track.to.max(self.time + ROUNDING).min(1.0);
            self.tracks[side] = track;
            self.allowance = self.allowance.saturating_add(LOOKS);
            near
        })
    }

    /// Until one of the tracks ends; what was found, if that is the end.
    fn stretch(&mut self, near: [Milestone; 2]) -> Option<Glide> {
        let until = self.tracks[0].to.min(self.tracks[1].to);
        let mut here = self.at(self.time, &near);
        loop {
            let distance = here.between.length();
            let gap = distance - self.radii;
            let touch = self.touch.meeting;
            if gap <= touch {
                return Some(self.touched(&here));
            }
            self.looks += 1;
            let floor = 0.5 * touch;
            let room = gap - floor;
            // Nobody is faster than this; what is lost is rounding.
            let anyhow = room / self.speed * (1.0 - 1e-9);
            if self.time + anyhow >= until {
                self.time = (self.time + anyhow).max(until);
                return (self.time >= 1.0).then_some(Glide::Found(Encounter::Apart));
            }
            let stuck = anyhow.is_nan() || anyhow <= 0.0;
            if stuck || self.looks > self.allowance {
                return Some(Glide::Left(self.time));
            }
            let (length, jounce) = self.smooth_window(&here, room);
            if length < WORTH * anyhow {
                self.hops += 1;
                if self.hops > HOPS {
                    return Some(Glide::Left(self.time));
                }
                self.go_on(anyhow);
                here = self.at(self.time, &here.near);
                continue;
            }
            let length = length.min(SOON * self.meeting(&here, distance));
            let length = length.max(WORTH * anyhow);
            let end = if self.time + length >= until {
                until
            } else {
                self.time + length
            };
            let there = self.at(end, &here.near);
            let Some((by, mut forecast)) = self.window([&here, &there], end - self.time, jounce)
            else {
                self.time = end;
                here = there;
                continue;
            };
            if !forecast.second.is_finite() {
                // It ends in a cusp.
                return Some(Glide::Left(self.time));
            }
            self.go_on(by.max(anyhow));
            here = self.at(self.time, &here.near);
            if let Some(found) = self.close_in(&mut here, &there, &mut forecast) {
                return Some(found);
            }
        }
    }

    /// How long they are apart for certain in a window and what is known there of how they go on; none if they are so
    /// all the time.
    fn window(
        &self,
        [here, there]: [&Moment; 2],
        length: f64,
        jounce: f64,
    ) -> Option<(f64, Forecast)> {
        let (leaving, arriving) = (length * here.velocity, length * there.velocity);
        let way = there.between - here.between;
        let square = 3.0 * way - 2.0 * leaving - arriving;
        let cube = leaving + arriving - 2.0 * way;
        let fourth = length * length * jounce * (length * length);
        let distance = self.radii + 0.5 * self.touch.meeting;
        let sextic = Sextic::of([here.between, leaving, square, cube], distance);
        // Off by a share of x²(1 − x)², which is no more than a sixteenth.
        let off = fourth / 24.0;
        let bend = (2.0 * distance + off / 16.0) * off;
        let sextic = sextic.less([bend, -2.0 * bend, bend]);
        let share = sextic.first_fall(self.close(distance))?;
        let per_length = 1.0 / length;
        let per_square = per_length * per_length;
        let forecast = Forecast {
            second: per_square * (2.0 * square + (6.0 * share) * cube),
            third: (6.0 * per_square * per_length) * cube,
            off: fourth / 12.0 * per_square,
            to: self.time + length,
        };
        Some((share * length, forecast))
    }

    /// By how much the squared distance may be above what it is looked for.
    fn close(&self, distance: f64) -> f64 {
        0.5 * distance * self.touch.meeting
    }

    /// Look by look towards the touch, as long as one tells much; what was found, if that is the end.
    ///
    /// Where they miss each other for as long as the forecast goes, it is from `there` that they go on.
    fn close_in(
        &mut self,
        here: &mut Moment,
        there: &Moment,
        forecast: &mut Forecast,
    ) -> Option<Glide> {
        loop {
            let gap = here.between.length() - self.radii;
            if gap <= self.touch.meeting {
                return Some(self.touched(here));
            }
            let rest = forecast.to - self.time;
            if rest <= 0.0 || !gap.is_finite() {
                return None;
            }
            let distance = self.radii + 0.5 * self.touch.meeting;
            let (first, second) = (rest * here.velocity, 0.5 * rest * rest * forecast.second);
            let third = rest * rest * rest / 6.0 * forecast.third;
            let off = 0.5 * forecast.off * (rest * rest);
            let bend = (2.0 * distance + off) * off;
            let sextic = Sextic::of([here.between, first, second, third], distance);
            let fall = sextic
                .less([bend, 0.0, 0.0])
                .first_fall(self.close(distance));
            let Some(share) = fall else {
                self.time = forecast.to;
                *here = *there;
                return None;
            };
            let by = share * rest;
            let off = off * (share * share);
            if off <= 0.125 * self.touch.meeting {
                let between = here.between + share * (first + share * (second + share * third));
                let velocity = here.velocity + by * (forecast.second + 0.5 * by * forecast.third);
                if between.length() - self.radii <= self.touch.meeting {
                    self.go_on(by);
                    let moment = Moment {
                        between,
                        velocity,
                        ..*here
                    };
                    return Some(self.touched(&moment));
                }
            }
            let sure = off <= SURE * gap && by > 0.0;
            if !sure || self.looks >= self.allowance {
                return None;
            }
            self.looks += 1;
            self.go_on(by);
            forecast.second += by * forecast.third;
            *here = self.at(self.time, &here.near);
        }
    }

    /// When they are about to meet or pass near by, if they go on with an acceleration as now; infinite if they do
    /// neither.
    fn meeting(&self, here: &Moment, distance: f64) -> f64 {
        let slope = here.between.dot(here.velocity);
        if slope >= 0.0 {
            return f64::INFINITY;
        }
        let [a, b] = [0, 1].map(|side: usize| self.tracks[side].acceleration(&here.near[side]));
        let acceleration = a - b;
        let bend = here.velocity.length_squared() + here.between.dot(acceleration);
        let gap = (distance - self.radii) * (distance + self.radii);
        let least = slope * slope - bend * gap;
        if least > 0.0 {
            gap / (least.sqrt() - slope)
        } else if least > -0.05 * bend * gap {
            -slope / bend
        } else {
            f64::INFINITY
        }
    }

    /// How long the error of a window from here on is no more than a fifth of a gap; and the greatest fourth derivative
    /// of the way between them in that time.
    fn smooth_window(&self, here: &Moment, gap: f64) -> (f64, f64) {
        let root = (36.0 * gap).sqrt().sqrt();
        let (a, of_a) = self.tracks[0].smooth_time(&here.near[0], root);
        let (b, of_b) = self.tracks[1].smooth_time(&here.near[1], root);
        (a.min(b), of_a + of_b)
    }

    /// Time stands still where a step is less than its rounding.
    fn go_on(&mut self, by: f64) {
        let next = self.time + by;
        let next = if next > self.time {
            next
        } else {
            self.time.next_up()
        };
        self.time = next.min(1.0);
    }

    /// The touch of balls that are nearer than what counts. The last bit of the way is straight.
    fn touched(&self, here: &Moment) -> Glide {
        let Moment {
            between, velocity, ..
        } = *here;
        let slope = between.dot(velocity);
        let distance = between.length();
        let square = velocity.length_squared();
        let above = (distance - self.radii) * (distance + self.radii);
        let root = (slope * slope - square * above).max(0.0).sqrt();
        let late = above / (root - slope);
        // NaN, too.
        let soon = late > 0.0 && late * square.sqrt() <= NEAR * self.radii;
        let (late, between) = if soon {
            (late, between + late * velocity)
        } else {
            (0.0, between)
        };
        let length = between.length();
        if !(length > 0.0 && length < f64::INFINITY) {
            return Glide::Left(self.time);
        }
        let normal = between / length;
        Glide::Found(Encounter::Touch {
            touching: Touching {
                fraction: (self.time + late).min(1.0),
                point: self.radius * normal,
                normal,
                features: [Feature::Surface; 2],
            },
            clear_until: self.time,
        })
    }
}
