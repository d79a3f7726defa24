//! How one body moves relative to another, and how long a gap stays open.

use super::window::Parabola;
use glam::DVec3;

/// What bounds the motion of A relative to B until some time, per frame.
#[derive(Clone, Copy)]
pub(super) struct Known {
    pub(super) until: f64,
    /// Of the acceleration.
    pub(super) bend: f64,
    /// Of its change.
    pub(super) rise: f64,
}

impl Known {
    pub(super) const NOTHING: Self = Self {
        until: f64::NEG_INFINITY,
        bend: f64::INFINITY,
        rise: f64::INFINITY,
    };
}

/// How A moves relative to B at a time, per frame.
pub(super) struct Motion {
    pub(super) velocity: DVec3,
    pub(super) acceleration: DVec3,
    /// How long neither body turns by more than [`TURN`], at the present rate.
    pub(super) straight_for: f64,
}

/// Radians that a body's course may turn on a window, as far as that is known when it begins: much more, and
/// the bounds are poor.
const TURN: f64 = 0.5;

impl Motion {
    /// Of the velocities and accelerations of both.
    pub(super) fn of([(v, a), (w, b)]: &[(DVec3, DVec3); 2]) -> Self {
        let square = |v: &DVec3, a: &DVec3| v.length_squared() / a.length_squared();
        // NaN, of a body at rest, never counts.
        let least = square(v, a).min(square(w, b));
        Self {
            velocity: *v - *w,
            acceleration: *a - *b,
            straight_for: if least.is_nan() {
                f64::INFINITY
            } else {
                TURN * least.sqrt()
            },
        }
    }

    /// Where it leads, as far as is known.
    pub(super) fn offset_after(&self, time: f64) -> DVec3 {
        time * (self.velocity + 0.5 * time * self.acceleration)
    }

    /// When a gap of `start` along `normal` may be closed within `window` at the earliest.
    ///
    /// The acceleration changes by `rise · σ` at most until `σ`, which takes `rise · σ³/6 ≤ ½σ² ·
    /// rise · window/3` off the gap; and it is `bend` at most.
    fn root(&self, start: f64, normal: DVec3, known: Known, window: f64) -> f64 {
        let bend = known.rise * window / 3.0 - normal.dot(self.acceleration);
        self.parabola(start, normal, bend.min(known.bend))
    }

    /// When the gap may be closed as far as is known now.
    pub(super) fn ahead(&self, start: f64, normal: DVec3) -> f64 {
        self.parabola(start, normal, -normal.dot(self.acceleration))
    }

    #[inline]
    fn parabola(&self, start: f64, normal: DVec3, bend: f64) -> f64 {
        let slope = normal.dot(self.velocity);
        if slope.is_nan() || bend.is_nan() {
            // Of a body in a cusp nothing is known.
            return 0.0;
        }
        if slope >= 0.0 && bend <= 0.0 {
            return f64::INFINITY;
        }
        let root = Parabola { start, slope, bend }.root();
        // As of bodies that never come so near.
        if root.is_nan() { f64::INFINITY } else { root }
    }

    /// How long a gap of `start` along `normal` stays open for certain, up to `window`.
    pub(super) fn clear_for(&self, start: f64, normal: DVec3, known: Known, window: f64) -> f64 {
        // The shorter the window, the better the bound: the longest that is clear to its end lies
        // between the root for the whole and the root for that one.
        let by = self.root(start, normal, known, window);
        if by >= window {
            return window;
        }
        let longer = self.root(start, normal, known, by).min(window);
        by.max(self.root(start, normal, known, longer).min(longer))
    }
}
