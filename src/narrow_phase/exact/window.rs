//! How long a plane parts two bodies for certain.

use super::flight::{Heights, Instant};
use crate::curve::Sway;
use crate::motion::Bend;
use glam::DVec3;

/// A plane between two bodies whose normal turns as they move: `normal + σ · turn` at `σ` frames
/// from now.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plane {
    /// Unit vector out of B, towards A.
    pub(super) normal: DVec3,
    /// Across `normal`.
    pub(super) turn: DVec3,
}

/// What is known of the motion of one body on a window.
#[derive(Clone, Copy)]
pub(super) struct Side<'w, 'a> {
    pub(super) instant: &'w Instant<'a>,
    /// Angular velocity as the window begins, radians per frame.
    pub(super) spin: DVec3,
    /// How much that changes at most, per frame.
    pub(super) sway: Sway,
    /// No vertex of the core is farther from the axis, in metres.
    pub(super) arm: f64,
}

impl Side<'_, '_> {
    /// How fast turning moves a point of the core at most within `length`, metres per frame.
    pub(super) fn fastest(&self, length: f64) -> f64 {
        self.arm * (self.spin.length() + length * self.sway.most())
    }

    /// Upper bound of the share along `direction` of the acceleration that turning gives a point of the core
    /// within `length`.
    ///
    /// With the angular velocity `ω`, that of a point `a` seen from the hub is `ω×(ω×a) + ω'×a`, and
    /// `d·(ω×(ω×a)) = (d×ω)·(ω×a)`.
    fn acceleration(&self, direction: DVec3, length: f64) -> f64 {
        // One root instead of two.
        let cross = self.spin.cross(direction).length_squared();
        let even = (self.spin.length_squared() * cross).sqrt();
        if self.sway.most() <= 0.0 {
            return self.arm * even;
        }
        let (gain, across) = (length * self.sway.most(), self.sway.across(direction));
        let fastest = self.spin.length() + gain;
        self.arm * (even + gain * cross.sqrt() + (1.0 + fastest * length) * across)
    }
}

/// Two bodies on a window of a frame.
///
/// With the hubs' offset `D`, vertices `a` and `b` seen from the hubs, and the plane's normal
/// `n(σ) = n + σm`, the height of `a` above `b` is
/// `f(σ) = n(σ)·(D + a − b + σw + E(σ))`, where `w = v + ω_A×a − ω_B×b` is how fast `a` moves relative
/// to `b`, and `E` what accelerations do: `|E·n| ≤ ½σ²·(c|n| + Σ ω²ρ|n×e|)`. So
/// `f ≥ p + qσ − ½Mσ²` with `p = n·(D+a−b)`, `q = m·(D+a−b) + n·w`, and one `M` for all
/// vertices. The least of these parabolas over all vertices is concave: positive at both ends of an
/// interval, it is so in between, and its value at `σ` takes one support of each body, along
/// `n + σ(m + n×ω)`, because `n·(ω×a) = a·(n×ω)`.
#[derive(Clone, Copy)]
pub(super) struct Window<'w, 'a> {
    pub(super) a: Side<'w, 'a>,
    pub(super) b: Side<'w, 'a>,
    /// From B's hub to A's.
    pub(super) offset: DVec3,
    /// Of A's hub relative to B's, metres per frame.
    pub(super) velocity: DVec3,
    /// What bends the hubs' courses.
    pub(super) bends: [&'w Bend; 2],
    /// What else the hubs may do, upper bound, metres per frame.
    pub(super) stray: f64,
    /// What turning other than a spin may do, upper bound, metres per frame.
    pub(super) turning: f64,
    /// Sum of the radii around the cores.
    pub(super) radii: f64,
    /// How long it lasts, in frames.
    pub(super) length: f64,
    /// The fraction of the frame at which it ends.
    pub(super) to: f64,
}

/// The parabola `start + slope·σ − ½·bend·σ²`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Parabola {
    pub(super) start: f64,
    pub(super) slope: f64,
    pub(super) bend: f64,
}

impl Parabola {
    pub(super) fn at(&self, time: f64) -> f64 {
        self.start + time * (self.slope - 0.5 * time * self.bend)
    }

    /// Where it comes down to zero that begins above; infinite if never.
    pub(super) fn root(&self) -> f64 {
        let root = (self.slope * self.slope + 2.0 * self.bend * self.start).sqrt();
        let time = if self.slope > 0.0 {
            (self.slope + root) / self.bend
        } else {
            2.0 * self.start / (root - self.slope)
        };
        // 0/0 of what stays as it is.
        if time.is_nan() { f64::INFINITY } else { time }
    }
}

/// A window seen across a plane.
struct Outlook<'w, 'a> {
    a: Heights<'w, 'a>,
    b: Heights<'w, 'a>,
    /// What is the same for all pairs of vertices: height, slope and bend.
    base: Parabola,
}

impl Outlook<'_, '_> {
    /// The lowest pair of vertices at `time` from now.
    #[inline]
    fn lowest(&self, time: f64) -> Parabola {
        let ((a, rise_a), (b, rise_b)) = (self.a.lowest(time), self.b.lowest(time));
        Parabola {
            start: self.base.start + (a + b),
            slope: self.base.slope + (rise_a + rise_b),
            bend: self.base.bend,
        }
    }
}

impl<'a> Window<'_, 'a> {
    /// Whether a body that faces its way may turn round before the window ends.
    pub(super) fn may_turn_round(&self) -> bool {
        let sway = self.a.sway.most().max(self.b.sway.most());
        let arm = self.a.arm + self.b.arm;
        sway * self.length * self.length > 1.0 || self.turning * self.length > arm
    }

    /// Heights above `floor` across a plane, for `length` frames.
    fn across(&self, plane: &Plane, floor: f64, length: f64) -> Outlook<'_, 'a> {
        let Plane { normal, turn } = *plane;
        let along = |side: &Side<'_, '_>| turn + normal.cross(side.spin);
        let stray = match self.stray + self.turning {
            stray if stray > 0.0 => stray * (1.0 + length * turn.length()),
            _ => 0.0,
        };
        Outlook {
            a: self.a.instant.heights(normal, along(&self.a)),
            b: self.b.instant.heights(-normal, -along(&self.b)),
            base: Parabola {
                start: normal.dot(self.offset) - self.radii - floor,
                slope: turn.dot(self.offset) + normal.dot(self.velocity) - stray,
                bend: self.bend(plane, length),
            },
        }
    }

    /// The least height of a pair of vertices now, and how it changes at least.
    pub(super) fn now(&self, plane: &Plane) -> Parabola {
        self.across(plane, 0.0, self.length).lowest(0.0)
    }

    /// Upper bound of the hubs' acceleration's share along a vector, metres per frame and frame.
    pub(super) fn acceleration(&self, direction: DVec3) -> f64 {
        let [a, b] = &self.bends;
        a.along(direction) + b.along(direction)
    }

    /// `M`.
    fn bend(&self, plane: &Plane, length: f64) -> f64 {
        let curved = |direction: DVec3| {
            let turned = |side: &Side<'_, '_>| side.acceleration(direction, length);
            self.acceleration(direction) + turned(&self.a) + turned(&self.b)
        };
        let turn = plane.turn;
        let mut bend = curved(plane.normal);
        if turn != DVec3::ZERO {
            let sway = |side: &Side<'_, '_>| side.arm * side.spin.cross(turn).length();
            let closing = (-turn.dot(self.velocity)).max(0.0) + sway(&self.a) + sway(&self.b);
            // A normal that turns grows, as √(1 + σ²m²) at most.
            bend += length * curved(turn) + 2.0 * closing + self.radii * turn.length_squared();
        }
        bend * (1.0 + 16.0 * f64::EPSILON)
    }

    /// How long the plane parts the bodies by more than about `floor` for certain, up to `length`, which is
    /// no more than the window's; 0 if it does not.
    pub(super) fn clear_for(&self, plane: &Plane, floor: f64, length: f64) -> f64 {
        self.clear(plane, floor, length).0
    }

    /// The same, with how the lowest height changes as the window begins.
    pub(super) fn clear(&self, plane: &Plane, floor: f64, length: f64) -> (f64, f64) {
        /// Each settles which vertices are lowest; two or three do as a rule.
        const ROUNDS: u32 = 6;
        let outlook = self.across(plane, floor, length);
        let Parabola { start, slope, .. } = outlook.lowest(0.0);
        // Where a body may jump, slopes are infinite, and no plane says anything.
        if start.is_nan() || start <= 0.0 || self.turning.is_infinite() {
            return (0.0, slope);
        }
        let mut end = length;
        for _ in 0..ROUNDS {
            let parabola = outlook.lowest(end);
            let low = parabola.at(end);
            if low >= -0.25 * floor {
                return (end, slope);
            }
            // The lowest pair there meets the ground before, and the lowest of all not later.
            let root = parabola.root();
            if !(parabola.start > 0.0 && root < end) {
                // Concave: above its chord.
                return (end * (start / (start - low)), slope);
            }
            end = root;
        }
        let low = outlook.lowest(end).at(end);
        if low >= 0.0 {
            (end, slope)
        } else {
            (end * (start / (start - low)), slope)
        }
    }

    /// A time until which two bodies part that touch now; none if it is not certain that they do.
    ///
    /// The least parabola is concave and begins near zero: where it is positive later it
    /// was so all the time but for the very beginning.
    pub(super) fn parted_after(&self, plane: &Plane, floor: f64) -> Option<f64> {
        /// Each a quarter of the one before.
        const TRIES: u32 = 16;
        let outlook = self.across(plane, floor, self.length);
        let mut time = self.length;
        for _ in 0..TRIES {
            if outlook.lowest(time).at(time) >= floor {
                return Some(time);
            }
            time *= 0.25;
        }
        None
    }
}
