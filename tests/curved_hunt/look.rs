//! The first time at which two bodies touch, by looking ever closer.

use crate::course::{Course, Stand};
use crate::gap::{Placed, apart, gap, widest};
use crate::solid::Solid;
use glam::DVec3;

/// A shape that moves.
pub(crate) struct Actor {
    pub(crate) solid: Solid,
    pub(crate) course: Course,
}

impl Actor {
    pub(crate) fn placed(&self, time: f64) -> Placed<'_> {
        Placed::new(&self.solid, self.course.at(time))
    }

    fn arm(&self) -> f64 {
        self.solid.reach(self.course.pivot())
    }
}

/// Bodies that face their way, whose rate is not known, are looked at so often at least.
const LOOKS: f64 = 4096.0;

/// Looks after which it is given up: they slide along each other.
const MOST: usize = 50_000;

/// What was seen of two bodies.
pub(crate) struct Look {
    /// The first touch.
    pub(crate) touch: Option<f64>,
    /// The least distance seen before it, when, and in which direction.
    pub(crate) least: (f64, f64, DVec3),
    /// Whether all was seen.
    pub(crate) resolved: bool,
    pub(crate) looks: usize,
}

struct Sample {
    time: f64,
    stands: [Stand; 2],
    apart: Option<f64>,
}

struct Eye<'a> {
    actors: [&'a Actor; 2],
    horizon: f64,
    arms: [f64; 2],
    /// Direction along which the last two measured were apart.
    hint: DVec3,
    look: Look,
}

impl Eye<'_> {
    fn sample(&self, time: f64) -> Sample {
        let stands = self.actors.map(|actor| actor.course.at(time));
        Sample {
            time,
            stands,
            apart: None,
        }
    }

    /// A lower bound of the distance, exact if it is not `enough`.
    fn measure(&mut self, sample: &mut Sample, enough: f64) -> f64 {
        if let Some(apart) = sample.apart {
            return apart;
        }
        let [a, b] = [0, 1].map(|i| Placed::new(&self.actors[i].solid, sample.stands[i]));
        let quick = gap(&a, &b, self.hint);
        self.look.looks += 1;
        if quick > enough {
            return quick;
        }
        let (apart, normal) = apart(&a, &b);
        self.hint = normal;
        sample.apart = Some(apart);
        if apart < self.look.least.0 {
            self.look.least = (apart, sample.time, normal);
        }
        apart
    }

    /// How fast hubs may come together between two samples.
    fn speed(&self, from: &Sample, to: &Sample) -> f64 {
        let speed = |actor: &Actor| actor.course.speed_between(from.time, to.time);
        self.actors.into_iter().map(speed).sum()
    }

    /// How far points may come together between two samples, hubs and all.
    fn sweep(&self, from: &Sample, to: &Sample) -> Option<f64> {
        let width = to.time - from.time;
        let mut sweep = self.speed(from, to) * width;
        for i in 0..2 {
            sweep += self.arms[i]
                * match self.actors[i].course.rate() {
                    Some(rate) => rate * width,
                    None if width > 1.001 * self.horizon / LOOKS => return None,
                    None => {
                        let (from, to) = (from.stands[i].turned, to.stands[i].turned);
                        let off = [0, 1, 2].map(|axis| from.col(axis).distance(to.col(axis)));
                        2.0 * off.into_iter().sum::<f64>()
                    }
                };
        }
        Some(sweep)
    }
}

impl Look {
    /// Sees every overlap deeper than about `blur`.
    pub(crate) fn at(a: &Actor, b: &Actor, horizon: f64, blur: f64) -> Self {
        let mut eye = Eye {
            actors: [a, b],
            horizon,
            arms: [a.arm(), b.arm()],
            hint: DVec3::X,
            look: Self {
                touch: None,
                least: (f64::MAX, 0.0, DVec3::X),
                resolved: true,
                looks: 0,
            },
        };
        let (mut start, end) = (eye.sample(0.0), eye.sample(horizon));
        if eye.measure(&mut start, f64::MAX) <= 0.0 {
            eye.look.touch = Some(0.0);
            return eye.look;
        }
        // The rest of the time, the nearest last.
        let mut ends = vec![end];
        while let Some(mut end) = ends.pop() {
            if eye.look.looks > MOST {
                eye.look.resolved = false;
                break;
            }
            let width = end.time - start.time;
            let hubs = |sample: &Sample| sample.stands[0].hub.distance(sample.stands[1].hub);
            let room = 0.5 * (hubs(&start) + hubs(&end) - eye.speed(&start, &end) * width);
            if room > eye.arms[0] + eye.arms[1] {
                start = end;
                continue;
            }
            let sweep = eye.sweep(&start, &end);
            if let Some(sweep) = sweep {
                let left = eye.measure(&mut start, sweep);
                let right = eye.measure(&mut end, sweep);
                if left + right > sweep {
                    start = end;
                    continue;
                }
                if sweep < blur || width < 1e-12 * horizon {
                    if right <= 0.0 {
                        eye.look.touch = Some(first(a, b, start.time, end.time));
                        break;
                    }
                    start = end;
                    continue;
                }
            }
            let mut middle = eye.sample(0.5 * (start.time + end.time));
            let met = sweep.is_some_and(|sweep| eye.measure(&mut middle, sweep) <= 0.0);
            if !met {
                ends.push(end);
            } else {
                // Whatever comes later is not the first.
                ends.clear();
            }
            ends.push(middle);
        }
        eye.look
    }
}

/// Between a time at which they are apart and one at which they are not.
fn first(a: &Actor, b: &Actor, mut low: f64, mut high: f64) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if above(a, b, middle) <= 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}

/// Zero as they touch, below as they overlap; changes evenly there.
pub(crate) fn above(a: &Actor, b: &Actor, time: f64) -> f64 {
    let (a_placed, b_placed) = (a.placed(time), b.placed(time));
    if a.solid.is_ball() || b.solid.is_ball() {
        apart(&a_placed, &b_placed).0
    } else {
        widest(&a_placed, &b_placed).0
    }
}
