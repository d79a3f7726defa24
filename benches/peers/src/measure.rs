//! What the answers are worth, and how long they take.

use crate::casts::CastSet;
use crate::contender::{Answer, Contender, Ready};
use crate::oracle::{Oracle, Truth};
use std::ops::Range;
use std::time::Instant;

/// How right a contender's answers are.
#[derive(Debug, Clone, Default)]
pub struct Score {
    pub casts: usize,
    /// Hits that it calls clear.
    pub misses: usize,
    /// Clear casts that it calls hits.
    pub ghosts: usize,
    /// Normals more than 1° off.
    pub normals: usize,
    /// Of the hits both know of, in metres along the motion, ascending.
    pub errors: Vec<f64>,
    /// The largest gap or overlap left at the time reported, in metres.
    pub gap: f64,
}

impl Score {
    /// The error that this share of the hits keeps below.
    pub fn quantile(&self, share: f64) -> Option<f64> {
        let last = self.errors.len().checked_sub(1)?;
        self.errors
            .get((share * last as f64).round() as usize)
            .copied()
    }
}

/// Compares answers with the truth.
///
/// What depends on less than the contender's precision counts neither way: a hit
/// or a miss when the motion had to shift by less to make it the other, and a
/// normal along which the bodies overlap by less at the time of contact, for then
/// they touch in two places at once.
pub fn score(
    set: &CastSet,
    oracle: &Oracle,
    truths: &[Truth],
    contender: &Contender,
    answers: &[Option<Answer>],
) -> Score {
    let mut score = Score {
        casts: answers.len(),
        ..Score::default()
    };
    for ((cast, truth), answer) in set.casts.iter().zip(truths).zip(answers) {
        let coordinates = cast.a.position.length() + cast.b.position.length();
        let blur = contender.precision * (set.size(cast) + coordinates);
        match (truth, answer) {
            (Truth::Hit { .. }, None) => score.misses += usize::from(truth.margin() > blur),
            (Truth::Clear { .. }, Some(_)) => score.ghosts += usize::from(truth.margin() > blur),
            (Truth::Clear { .. }, None) => {}
            (Truth::Hit { .. }, Some(answer)) if !answer.fraction.is_finite() => score.misses += 1,
            (
                Truth::Hit {
                    fraction, normal, ..
                },
                Some(answer),
            ) => {
                let error = (answer.fraction - fraction).abs() * cast.motion.length();
                score.errors.push(error);
                let closing = -normal.dot(cast.motion.normalize());
                score.gap = score.gap.max(error * closing);
                let off = answer.normal.angle_between(*normal).to_degrees();
                // A normal of length zero is neither.
                let right = off <= 1.0;
                let supports =
                    oracle.separation(cast, answer.normal.normalize(), *fraction) >= -blur;
                if !right && !supports {
                    score.normals += 1;
                }
            }
        }
    }
    score.errors.sort_by(f64::total_cmp);
    score
}

/// How many casts are timed: more than a branch predictor learns by heart, few
/// enough that all stay in the cache.
const TIMED: usize = 1000;

/// One pass over them takes no longer than this; fewer casts are timed otherwise.
const PASS: f64 = 0.06;

/// One stretch of a pass lasts about as long as this, and no longer than a
/// scheduler lets a thread run undisturbed.
const STRETCH: f64 = 5e-4;

/// The best of so many passes.
const PASSES: usize = 9;

/// Time per cast of each, in seconds: the same casts several times over, in
/// stretches that are timed one by one, and the best time of each stretch. The
/// contenders take turns, so that a busy moment hits everyone; at the start of its turn each
/// runs its casts once untimed, so that what is timed finds its data in the cache.
pub fn time(ready: &[&dyn Ready], casts: usize) -> Vec<f64> {
    let mut plans: Vec<(usize, Vec<f64>)> = ready
        .iter()
        .map(|ready| {
            let rough = rough_time(*ready, casts);
            let timed = ((PASS / rough) as usize).clamp(1, casts.min(TIMED));
            let stretch = ((STRETCH / rough) as usize).clamp(1, 100).min(timed);
            (stretch, vec![f64::INFINITY; timed / stretch])
        })
        .collect();
    for _ in 0..PASSES {
        for (ready, (stretch, best)) in ready.iter().zip(&mut plans) {
            ready.run(0..*stretch * best.len());
            for (number, best) in best.iter_mut().enumerate() {
                let start = number * *stretch;
                *best = best.min(seconds(*ready, start..start + *stretch));
            }
        }
    }
    let mean = |(stretch, best): &(usize, Vec<f64>)| {
        best.iter().sum::<f64>() / (stretch * best.len()) as f64
    };
    plans.iter().map(mean).collect()
}

/// Also warms up.
fn rough_time(ready: &dyn Ready, casts: usize) -> f64 {
    let mut count = 1;
    loop {
        let took = seconds(ready, 0..count);
        if took > 2e-3 || count == casts {
            return (took / count as f64).max(1e-9);
        }
        count = (2 * count).min(casts);
    }
}

fn seconds(ready: &dyn Ready, casts: Range<usize>) -> f64 {
    let start = Instant::now();
    ready.run(casts);
    start.elapsed().as_secs_f64()
}
