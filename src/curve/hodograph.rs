//! The velocity along a cubic, and its integral.

use crate::curve::quadratic;
use glam::DVec3;

/// Nodes and weights of the Gauss–Legendre rule on `0..=1`.
///
/// Eight nodes: where the rule resolves a span to 1e-15 the nearest complex zero
/// of the speed lies more than three half-widths off. Fewer nodes need shorter
/// spans and so more memory, more nodes make every look-up dearer; 6 to 12 lie
/// within a few per cent of one another.
const NODES: [f64; 8] = [
    0.019_855_071_751_231_884,
    0.101_666_761_293_186_64,
    0.237_233_795_041_835_5,
    0.408_282_678_752_175_1,
    0.591_717_321_247_825,
    0.762_766_204_958_164_5,
    0.898_333_238_706_813_4,
    0.980_144_928_248_768_1,
];
const WEIGHTS: [f64; 8] = [
    0.050_614_268_145_188_13,
    0.111_190_517_226_687_24,
    0.156_853_322_938_943_63,
    0.181_341_891_689_181,
    0.181_341_891_689_181,
    0.156_853_322_938_943_63,
    0.111_190_517_226_687_24,
    0.050_614_268_145_188_13,
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
    pub(crate) fn velocity(&self, x: f64) -> DVec3 {
        self.at_start + x * (self.linear + x * self.quadratic)
    }

    /// The speed at `x` and its first two derivatives, which are not finite at a
    /// cusp.
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
    #[inline]
    pub(crate) fn length_to(&self, x: f64) -> f64 {
        // One lane a node and one component after the other, summed only afterwards and in a
        // tree: it vectorises.
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
        let [a, b, c, d, e, f, g, h] = std::array::from_fn(|i| WEIGHTS[i] * speeds[i].sqrt());
        x * (((a + h) + (b + g)) + ((c + f) + (d + e)))
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
