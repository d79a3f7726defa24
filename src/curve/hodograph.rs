//! The velocity along a cubic, and its integral.

use crate::curve::quadratic;
use glam::DVec3;

/// Nodes and weights of the Gauss–Legendre rule on `0..=1`.
///
/// Twelve nodes: where the rule resolves a span to rounding the nearest complex zero
/// of the speed lies more than two half-widths off. Fewer nodes need shorter
/// spans and so more memory (eight, half as many again), more nodes make every look-up dearer.
const NODES: [f64; 12] = [
    0.009_219_682_876_640_375,
    0.047_941_371_814_762_57,
    0.115_048_662_902_847_65,
    0.206_341_022_856_691_3,
    0.316_084_250_500_909_9,
    0.437_383_295_744_265_54,
    0.562_616_704_255_734_5,
    0.683_915_749_499_090_1,
    0.793_658_977_143_308_7,
    0.884_951_337_097_152_3,
    0.952_058_628_185_237_5,
    0.990_780_317_123_359_7,
];
const WEIGHTS: [f64; 12] = [
    0.023_587_668_193_255_914,
    0.053_469_662_997_659_21,
    0.080_039_164_271_673_11,
    0.101_583_713_361_532_96,
    0.116_746_268_269_177_4,
    0.124_573_522_906_701_39,
    0.124_573_522_906_701_39,
    0.116_746_268_269_177_4,
    0.101_583_713_361_532_96,
    0.080_039_164_271_673_11,
    0.053_469_662_997_659_21,
    0.023_587_668_193_255_914,
];

/// The velocity `at_start + x·(linear + x·quadratic)` along a stretch of a
/// cubic, per unit of `x`, which runs over `0..=1` on the stretch.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hodograph {
    at_start: DVec3,
    linear: DVec3,
    quadratic: DVec3,
}

impl Hodograph {
    /// The hodograph over `u_start..=u_start + width` of the cubic whose velocity
    /// is the quadratic Bézier curve with the control points `velocity`.
    ///
    /// Taken from derivatives at the stretch's start and not from differences of
    /// its ends, so that a stretch of width 1e-8 beside a cusp keeps its digits.
    pub(crate) fn over(velocity: &[DVec3; 3], u_start: f64, width: f64) -> Self {
        let [v0, v1, v2] = *velocity;
        let (u, rest) = (u_start, 1.0 - u_start);
        let first = v1 - v0;
        let second = v2 - v1;
        Self {
            at_start: width * (rest * (rest * v0 + 2.0 * u * v1) + u * u * v2),
            linear: 2.0 * width * width * (rest * first + u * second),
            quadratic: width * width * width * (second - first),
        }
    }

    /// The velocity at `x`.
    #[inline]
    pub(crate) fn velocity(&self, x: f64) -> DVec3 {
        self.at_start + x * (self.linear + x * self.quadratic)
    }

    /// The speed at `x` and its first two derivatives, which are not finite at a
    /// cusp.
    #[inline]
    pub(crate) fn speed(&self, x: f64) -> (f64, f64, f64) {
        let velocity = self.velocity(x);
        let bend = self.linear + 2.0 * x * self.quadratic;
        let speed = velocity.length();
        let per_speed = 1.0 / speed;
        let first = velocity.dot(bend) * per_speed;
        let twist = 2.0 * velocity.dot(self.quadratic);
        let second = (bend.length_squared() + twist - first * first) * per_speed;
        (speed, first, second)
    }

    /// The arc length over `0..=x` by one Gauss–Legendre rule.
    #[inline(always)]
    pub(crate) fn length_to(&self, x: f64) -> f64 {
        // One lane a node and one component after the other, summed only afterwards and by fours: it
        // vectorises.
        let places = NODES.map(|node| x * node);
        let mut speeds = [0.0; NODES.len()];
        for axis in 0..3 {
            let (start, linear) = (self.at_start[axis], self.linear[axis]);
            let quadratic = self.quadratic[axis];
            for (speed, x) in speeds.iter_mut().zip(places) {
                let component = start + x * (linear + x * quadratic);
                *speed += component * component;
            }
        }
        let mut sums = [0.0; 4];
        for (four, weights) in speeds.chunks_exact(4).zip(WEIGHTS.chunks_exact(4)) {
            for lane in 0..4 {
                sums[lane] += weights[lane] * four[lane].sqrt();
            }
        }
        x * ((sums[0] + sums[1]) + (sums[2] + sums[3]))
    }

    /// Where inside `0..1` the speed is least, in ascending order: at most two
    /// places. All cusps are among them.
    pub(crate) fn slowest(&self) -> impl Iterator<Item = f64> {
        // Half the derivative of the squared speed: a cubic that rises through
        // zero at every minimum.
        let (a, b, c) = (self.at_start, self.linear, self.quadratic);
        let coefficients = [
            a.dot(b),
            2.0 * a.dot(c) + b.dot(b),
            3.0 * b.dot(c),
            2.0 * c.dot(c),
        ];
        let [c0, c1, c2, c3] = coefficients;
        let slope = move |x: f64| c0 + x * (c1 + x * (c2 + x * c3));
        let mut turns = [0.0; 4];
        for (slot, root) in turns[1..3]
            .iter_mut()
            .zip(quadratic::roots(3.0 * c3, c2, c1))
        {
            *slot = root.clamp(0.0, 1.0);
        }
        turns[3] = 1.0;
        turns.sort_by(f64::total_cmp);
        (0..3).filter_map(move |i| rising_root(&slope, turns[i], turns[i + 1]))
    }
}

/// The root of `function` in `low..high`, where it rises monotonically; none if
/// it does not change sign.
///
/// Bisection to neighbouring numbers: some 50 evaluations of a cubic, once per
/// curve.
fn rising_root(function: &impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> Option<f64> {
    if !(function(low) < 0.0 && function(high) > 0.0) {
        return None;
    }
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return Some(middle);
        }
        if function(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
}
