//! Two bodies under way that do not turn.

use super::bridge::Bridge;
use super::gliding::{Glide, Search};
use super::parting::{Parted, Parting};
use crate::motion::{Course, Spot};
use glam::DVec3;

/// When a gap that goes on as told closes or is least; infinite if it only grows.
fn meeting(gap: f64, slope: f64, bend: f64) -> f64 {
    if slope >= 0.0 {
        return f64::INFINITY;
    }
    let least = slope * slope - 2.0 * bend * gap;
    // NaN is none.
    let root = if least > 0.0 { least.sqrt() } else { 0.0 };
    if root > 0.0 || bend <= 0.0 {
        2.0 * gap / (root - slope)
    } else {
        -slope / bend
    }
}

/// By so much a window must be longer than what speeds alone say.
const WORTH: f64 = 1.5;

/// Bodies that are about to meet are looked at until so much later than they seem to.
const SOON: f64 = 1.25;

/// Steps as long as speeds alone allow, before more is asked.
const HOPS: u32 = 12;

/// Windows tried at a time, each shorter than the one before.
const TRIES: u32 = 8;

/// A body where it is at a time.
#[derive(Clone, Copy)]
struct Look {
    position: DVec3,
    /// Per frame; not finite in a cusp.
    velocity: DVec3,
    /// Where on its curve, if it follows one.
    spot: Option<Spot>,
}

/// What a step leads to.
enum Next {
    /// Proven apart up to there, wherever it is.
    Clear([Look; 2]),
    /// The same where they are about to meet, and the way from B's position to A's there, with velocity and
    /// acceleration.
    Near([Look; 2], [DVec3; 3]),
    /// Where they touch, or may do so soon.
    Close([DVec3; 3]),
}

impl<P: Parting> Search<'_, '_, P> {
    /// Both bodies under way.
    pub(super) fn side_by_side(&mut self) -> Option<Glide> {
        let until = self.until();
        let mut looks = self.looks_at(self.time);
        // When they are about to meet, as far as is known.
        let mut soon = f64::INFINITY;
        loop {
            let between = looks[0].position - looks[1].position;
            let parted = self.parting.part(between);
            let touch = self.touch.at(self.time);
            let far = parted.filter(|parted| parted.distance > touch);
            if let Some(parted) = far
                && self.time >= until
            {
                return self.go_beyond(until, parted);
            }
            let floor = 0.5 * touch;
            let above = far.filter(|parted| parted.gap > floor && !self.is_weary());
            let Some(parted) = above else {
                return Some(if far.is_some() {
                    Glide::Left(self.time)
                } else {
                    let velocity = looks[0].velocity - looks[1].velocity;
                    self.touched(between, parted, velocity)
                });
            };
            looks = match self.advance(&looks, &parted, floor, soon) {
                Next::Clear(looks) => {
                    soon = f64::INFINITY;
                    looks
                }
                Next::Near(looks, way) => {
                    let parted = self.parting.part(way[0]);
                    soon = self.meeting(parted, &way);
                    looks
                }
                Next::Close(way) => {
                    let [between, velocity, _] = way;
                    let parted = self.parting.part(between);
                    if parted.is_none_or(|parted| parted.distance <= self.touch.at(self.time)) {
                        return Some(self.touched(between, parted, velocity));
                    }
                    soon = self.meeting(parted, &way);
                    self.looks_at(self.time)
                }
            };
        }
    }

    /// When they are about to meet, as far as is known from the way from B's position to A's with velocity and
    /// acceleration.
    fn meeting(&self, parted: Option<Parted>, [_, velocity, acceleration]: &[DVec3; 3]) -> f64 {
        parted.map_or(f64::INFINITY, |parted| {
            let bend = self.parting.rounding(&parted, *velocity);
            let bend = parted.normal.dot(*acceleration) + bend;
            meeting(parted.gap, parted.normal.dot(*velocity), bend)
        })
    }

    fn looks_at(&mut self, time: f64) -> [Look; 2] {
        [self.look(0, time), self.look(1, time)]
    }

    #[inline]
    fn look(&mut self, side: usize, time: f64) -> Look {
        let (stretch, flight) = (&mut self.stretches[side], self.flights[side]);
        let share = stretch.share_at(time);
        match &mut stretch.course {
            Course::Curve(curve) => {
                let spot = curve.seek(share);
                let speed = if curve.is_forward() {
                    flight.speed
                } else {
                    -flight.speed
                };
                Look {
                    position: curve.piece.point(spot.u),
                    velocity: speed * curve.piece.leading(spot.u),
                    spot: Some(spot),
                }
            }
            Course::Straight(velocity) => Look {
                position: flight.frame.position_at(flight.motion, time),
                velocity: flight.frame.seconds() * *velocity,
                spot: None,
            },
            Course::Rest => Look {
                position: flight.frame.position_at(flight.motion, time),
                velocity: DVec3::ZERO,
                spot: None,
            },
        }
    }

    /// As far as they are apart for certain.
    fn advance(&mut self, looks: &[Look; 2], parted: &Parted, floor: f64, soon: f64) -> Next {
        let until = self.until();
        let gap = parted.gap - floor;
        // Nobody is faster than this; what is lost is rounding.
        let anyhow = gap / (self.flights[0].speed + self.flights[1].speed) * (1.0 - 1e-9);
        let (mut length, smooth) = self.smooth_window(looks, gap);
        let rough = length < WORTH * anyhow;
        if rough {
            self.hops += 1;
            // Beside a cusp little is known but of what is not quite there.
            length = if self.hops > HOPS { 4.0 * anyhow } else { 0.0 };
        } else {
            length = length.min(SOON * soon);
        }
        for _ in 0..TRIES {
            let end = if self.time + length >= until {
                until
            } else {
                self.time + length
            };
            length = end - self.time;
            if length <= anyhow {
                break;
            }
            let there = self.looks_at(end);
            let square = length * length;
            let jounce = if rough {
                self.jounce([looks, &there])
            } else {
                smooth
            };
            let stray = jounce * (square * square) / 144.0;
            if stray.is_nan() || stray > gap {
                length *= 0.5;
                continue;
            }
            let third = length / 3.0;
            let between = |[a, b]: &[Look; 2]| (a.position - b.position, a.velocity - b.velocity);
            let ((start, leaving), (last, arriving)) = (between(looks), between(&there));
            let bridge = Bridge {
                points: [
                    start,
                    start + third * leaving,
                    last - third * arriving,
                    last,
                ],
                stray,
            };
            let way = |share: f64| {
                let [between, velocity, acceleration] = bridge.at(share);
                [between, velocity / length, acceleration / square]
            };
            let Some(share) = self.parting.clear_on(&bridge, parted, floor) else {
                self.time = end;
                return if soon.is_finite() {
                    Next::Near(there, way(1.0))
                } else {
                    Next::Clear(there)
                };
            };
            if share > 0.0 {
                let by = (share * length).max(anyhow);
                self.go_on(by);
                return Next::Close(way(by / length));
            }
            length *= 1.0 / 16.0;
        }
        self.go_on(anyhow);
        Next::Clear(self.looks_at(self.time))
    }

    /// How long the error of a bridge from here on is no more than half of a gap; and the greatest fourth derivative of
    /// the way between them in that time.
    fn smooth_window(&self, looks: &[Look; 2], gap: f64) -> (f64, f64) {
        let root = (36.0 * gap).sqrt().sqrt();
        let (mut length, mut jounce) = (f64::INFINITY, 0.0);
        for (side, look) in looks.iter().enumerate() {
            if let (Course::Curve(curve), Some(spot)) = (&self.stretches[side].course, &look.spot) {
                let speed = self.flights[side].speed;
                let (way, smooth) = curve.smooth_way(spot, root);
                length = length.min(way / speed);
                let rate = speed / smooth;
                jounce += (rate * rate) * (rate * rate);
            }
        }
        (length, jounce)
    }

    /// Time stands still where a step is less than its rounding.
    fn go_on(&mut self, by: f64) {
        let next = self.time + by;
        self.time = if next > self.time {
            next
        } else {
            self.time.next_up()
        }
        .min(self.until());
    }

    /// How much the fourth derivative of the way between them is at most between two times.
    fn jounce(&self, [from, to]: [&[Look; 2]; 2]) -> f64 {
        let mut sum = 0.0;
        for side in 0..2 {
            if let Course::Curve(curve) = &self.stretches[side].course
                && let (Some(from), Some(to)) = (&from[side].spot, &to[side].spot)
            {
                let square = self.flights[side].speed * self.flights[side].speed;
                sum += curve.jounce([from, to]) * (square * square);
            }
        }
        sum
    }
}
