//! For how long boxes hold.

use crate::world::tracks::Span;

/// At most so many frames.
const MOST: u32 = 16;

/// What is done takes times in these proportions, in nanoseconds as measured on
/// 100 000 balls: a box compared with eight, a box fitted, a pair found and looked at for all
/// of the horizon, a pair looked at in one frame.
const TEST: f64 = 7.0;
const FIT: f64 = 20.0;
const FOUND: f64 = 12.0;
const PAIR: f64 = 25.0;

/// After so many horizons it is tried anew how long they should be.
const PATIENCE: u32 = 32;

/// For how long the boxes of bodies hold, so that pairs are found once for several
/// frames.
///
/// The longer they do, the more pairs there are to look at in each frame. How long
/// is best depends on how fast bodies are for their size, and on how many are given
/// other motions meanwhile; it is tried out, by counts, so that the same calls give the
/// same results.
#[derive(Debug, Clone, Copy)]
pub(super) struct Horizon {
    /// By the world's clock; before any time if there is no horizon.
    until: f64,
    /// What was looked ahead to as it began.
    ahead: Span,
    frames: u32,
    /// Steps since it began.
    steps: u32,
    /// Bodies that were given a motion meanwhile.
    restless: usize,
    /// So many are too many.
    limit: usize,
    bodies: usize,
    /// What a frame costs with a horizon of half the length.
    shorter: f64,
    /// What it cost with this one.
    cost: f64,
    /// Horizons until it is tried anew.
    patience: u32,
}

impl Default for Horizon {
    fn default() -> Self {
        Self {
            until: f64::NEG_INFINITY,
            ahead: Span::at(0.0),
            frames: 1,
            steps: 0,
            restless: 0,
            limit: 0,
            bodies: 0,
            shorter: f64::INFINITY,
            cost: f64::INFINITY,
            patience: 0,
        }
    }
}

impl Horizon {
    /// Whether boxes hold until a frame ends.
    pub(super) fn holds(&mut self, span: Span) -> bool {
        self.steps += 1;
        span.time + span.dt <= self.until
    }

    /// Whether boxes hold beyond `time`.
    pub(super) fn is_beyond(&self, time: f64) -> bool {
        time < self.until
    }

    /// Takes note of a body that has another motion.
    pub(super) fn disturb(&mut self) {
        self.restless += 1;
        if self.restless > self.limit {
            self.until = f64::NEG_INFINITY;
        }
    }

    /// Begins another horizon: the time that boxes are to hold for.
    pub(super) fn begin(&mut self, span: Span, bodies: usize, may_last: bool) -> Span {
        let steps = self.steps.max(1) as usize;
        let is_calm = self.restless <= bodies * steps / 32;
        if !may_last || !is_calm {
            (self.frames, self.shorter) = (1, f64::INFINITY);
        } else if self.frames > 1 && (self.cost > self.shorter || 2 * steps <= self.frames as usize)
        {
            // The longer one did not pay, or was cut off half way by bodies that turned.
            self.shorten();
            self.patience = PATIENCE;
        } else if self.patience > 0 {
            self.patience -= 1;
            if self.patience == 0 {
                self.shorten();
            }
        } else if self.frames < MOST {
            self.frames *= 2;
            self.shorter = self.cost;
        }
        // A little more, so that rounding of the clock does not cost the last frame.
        let dt = span.dt * f64::from(self.frames) * (1.0 + 1e-9);
        let dt = if self.frames == 1 { span.dt } else { dt };
        (self.steps, self.restless, self.bodies) = (0, 0, bodies);
        self.limit = bodies / 4 + 8;
        self.until = if may_last {
            span.time + dt
        } else {
            f64::NEG_INFINITY
        };
        self.ahead = Span { dt, ..span };
        self.ahead
    }

    /// What was looked ahead to as the present horizon began.
    pub(super) fn ahead(&self) -> Span {
        self.ahead
    }

    /// What is left of it as a frame begins.
    pub(super) fn rest(&self, span: Span) -> Span {
        let end = self.ahead.time + self.ahead.dt;
        Span {
            dt: (end - span.time).max(span.dt),
            ..span
        }
    }

    fn shorten(&mut self) {
        self.frames = (self.frames / 2).max(1);
        self.shorter = f64::INFINITY;
    }

    /// Takes note of what the first frame cost: of tests, of pairs found and of pairs kept.
    pub(super) fn note(&mut self, tests: u64, (found, kept): (usize, usize)) {
        if self.steps == 0 {
            let frames = f64::from(self.frames);
            let finding = TEST * tests as f64 + FIT * self.bodies as f64 + FOUND * found as f64;
            self.cost = finding / frames + PAIR * kept as f64;
        }
    }
}
