//! Times between which a moving point lies within slabs.

/// The largest entry and the smallest exit shown to it.
///
/// Heights are rounded, and what is nearly along the motion turns rounding
/// into long times. So times are compared at their most cautious: entries as
/// early, exits as late as rounding allows. Then a slab that says little
/// never outdoes one that says much, and what touches is not lost.
pub(super) struct Slabs<T> {
    pub(super) enter: f64,
    pub(super) leave: f64,
    /// Who gave the entry.
    pub(super) enter_by: Option<T>,
}

impl<T: Copy> Slabs<T> {
    pub(super) fn new() -> Self {
        Self {
            enter: f64::NEG_INFINITY,
            leave: f64::INFINITY,
            enter_by: None,
        }
    }

    /// The slab `|height| ≤ reach` around a point at `height` that moves by `speed`;
    /// `rounding` goes with both lengths.
    #[inline]
    pub(super) fn slab(&mut self, reach: f64, height: f64, speed: f64, rounding: f64, by: T) {
        let reach = reach + rounding;
        // A speed of zero gives infinities of the right signs, or NaN on the
        // very surface, which every comparison below passes over.
        let per_speed = 1.0 / speed.abs();
        let height = if speed < 0.0 { -height } else { height };
        self.enter_at((-reach - height) * per_speed, by);
        self.leave_at((reach - height) * per_speed);
    }

    /// The half-space in which the point lies `depth` deep and sinks by `speed`.
    pub(super) fn half_space(&mut self, depth: f64, speed: f64, rounding: f64, by: T) {
        let depth = depth + rounding;
        if speed > 0.0 {
            self.enter_at(-depth / speed, by);
        } else if speed < 0.0 {
            self.leave_at(depth / -speed);
        } else if depth < 0.0 {
            self.enter = f64::INFINITY;
        }
    }

    #[inline]
    fn enter_at(&mut self, time: f64, by: T) {
        if time > self.enter {
            self.enter = time;
            self.enter_by = Some(by);
        }
    }

    #[inline]
    fn leave_at(&mut self, time: f64) {
        if time < self.leave {
            self.leave = time;
        }
    }

    #[inline]
    pub(super) fn miss(&self) -> bool {
        self.enter > self.leave
    }

    /// Whether an entry at `time` would be the largest so far.
    pub(super) fn is_later(&self, time: f64) -> bool {
        time > self.enter
    }

    /// Whether an exit at `time` would be the smallest so far.
    pub(super) fn is_earlier(&self, time: f64) -> bool {
        time < self.leave
    }
}
