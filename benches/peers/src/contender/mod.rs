//! Who takes part.
//!
//! A contender is a name, the precision it computes in, and a function that gets a
//! set of casts ready: everything a user would do once per shape or body is done
//! there, and the cast itself is what is timed.

mod box3d;
mod feeler;
mod parry;

use crate::casts::CastSet;
use glam::DVec3;
use std::hint::black_box;
use std::ops::Range;

/// What a contender says of a cast that hits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Answer {
    /// When, in motions.
    pub fraction: f64,
    /// Out of `b` towards `a`, along the world's axes.
    pub normal: DVec3,
}

/// A library, with settings.
pub struct Contender {
    pub name: &'static str,
    /// Share of size and coordinates below which it cannot tell a hit from a miss.
    pub precision: f64,
    /// The casts of a set made ready, unless it has no such cast.
    pub prepare: fn(&CastSet) -> Option<Box<dyn Ready>>,
}

/// Casts ready to run.
pub trait Ready {
    /// Runs these casts and drops the answers: the part that is timed.
    fn run(&self, casts: Range<usize>);

    /// The answers to the first `count` casts.
    fn answers(&self, count: usize) -> Vec<Option<Answer>>;
}

/// Inputs, the call that is timed, and how its result is read afterwards.
struct Casts<I, C, R> {
    inputs: Vec<I>,
    cast: C,
    read: R,
}

impl<I, O, C, R> Ready for Casts<I, C, R>
where
    C: Fn(&I) -> O,
    R: Fn(&I, O) -> Option<Answer>,
{
    fn run(&self, casts: Range<usize>) {
        for input in self.inputs.get(casts).into_iter().flatten() {
            // By reference: by value it would be copied, which takes as long as a cast of balls.
            black_box(&(self.cast)(black_box(input)));
        }
    }

    fn answers(&self, count: usize) -> Vec<Option<Answer>> {
        let inputs = self.inputs.iter().take(count);
        inputs
            .map(|input| (self.read)(input, (self.cast)(input)))
            .collect()
    }
}

/// Everyone, in the order of the tables. A further one is a further entry.
pub fn all() -> Vec<Contender> {
    const DOUBLE: f64 = 1e-9;
    const SINGLE: f64 = 1e-6;
    let contender = |name, precision, prepare| Contender {
        name,
        precision,
        prepare,
    };
    vec![
        contender("feeler ray", DOUBLE, feeler::ray),
        contender("feeler exact", DOUBLE, feeler::exact),
        contender("feeler first_contact", DOUBLE, feeler::first),
        contender("feeler 100 rays", DOUBLE, feeler::hundred_rays),
        contender("parry f64", DOUBLE, parry::double::prepare),
        contender("parry f32", SINGLE, parry::single::prepare),
        contender("box3d f32", SINGLE, box3d::prepare),
    ]
}
