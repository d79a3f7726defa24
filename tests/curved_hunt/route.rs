//! Curves and their lengths, by brute force.

use glam::DVec3;

/// A cubic by its Bézier control points.
pub(crate) type Cubic = [DVec3; 4];

fn derivative([a, b, c, d]: &Cubic, u: f64) -> DVec3 {
    let v = 1.0 - u;
    3.0 * (v * v * (*b - *a) + 2.0 * u * v * (*c - *b) + u * u * (*d - *c))
}

fn point([a, b, c, d]: &Cubic, u: f64) -> DVec3 {
    // De Casteljau.
    let v = 1.0 - u;
    let between = |from: DVec3, to: DVec3| v * from + u * to;
    let (ab, bc, cd) = (between(*a, *b), between(*b, *c), between(*c, *d));
    between(between(ab, bc), between(bc, cd))
}

/// Panels into which every cubic is cut.
const PANELS: usize = 256;

/// Cubics in a row, walked by length.
pub(crate) struct Route {
    cubics: Vec<Cubic>,
    /// Length up to the end of each panel of each cubic.
    ends: Vec<f64>,
}

impl Route {
    pub(crate) fn new(cubics: Vec<Cubic>) -> Self {
        let mut ends = Vec::with_capacity(PANELS * cubics.len());
        // Neumaier's sum.
        let (mut sum, mut lost) = (0.0_f64, 0.0);
        for cubic in &cubics {
            for panel in 0..PANELS {
                let [from, to] = [panel, panel + 1].map(|end| end as f64 / PANELS as f64);
                let length = length(cubic, from, to);
                let next = sum + length;
                lost += if sum >= length {
                    (sum - next) + length
                } else {
                    (length - next) + sum
                };
                sum = next;
                ends.push(sum + lost);
            }
        }
        Self { cubics, ends }
    }

    pub(crate) fn length(&self) -> f64 {
        self.ends[self.ends.len() - 1]
    }

    /// Point and unit tangent.
    pub(crate) fn at(&self, distance: f64) -> (DVec3, DVec3) {
        let distance = distance.clamp(0.0, self.length());
        let panel = self.ends.partition_point(|&end| end <= distance);
        let panel = panel.min(self.ends.len() - 1);
        let cubic = &self.cubics[panel / PANELS];
        let start = if panel == 0 {
            0.0
        } else {
            self.ends[panel - 1]
        };
        let from = (panel % PANELS) as f64 / PANELS as f64;
        let u = invert(cubic, from, distance - start, self.ends[panel] - start);
        let mut tangent = derivative(cubic, u);
        if tangent.length_squared() < 1e-300 {
            let aside = if u < 0.5 { u + 1e-9 } else { u - 1e-9 };
            tangent = derivative(cubic, aside);
        }
        (point(cubic, u), tangent.normalize_or(DVec3::X))
    }
}

/// The parameter at `rest` metres from the start of a panel that is `whole` metres long.
fn invert(cubic: &Cubic, from: f64, rest: f64, whole: f64) -> f64 {
    let width = 1.0 / PANELS as f64;
    let (mut low, mut high) = (from, from + width);
    let mut u = from + width * (rest / whole).clamp(0.0, 1.0);
    for _ in 0..80 {
        let off = length(cubic, from, u) - rest;
        if off > 0.0 {
            high = u;
        } else {
            low = u;
        }
        let newton = u - off / derivative(cubic, u).length();
        let next = if newton > low && newton < high {
            newton
        } else {
            0.5 * (low + high)
        };
        if (next - u).abs() <= 1e-16 {
            return next;
        }
        u = next;
    }
    u
}

/// Arc length between two parameters.
pub(crate) fn length(cubic: &Cubic, from: f64, to: f64) -> f64 {
    let speed = |u: f64| derivative(cubic, u).length();
    let size =
        cubic[0].distance(cubic[1]) + cubic[1].distance(cubic[2]) + cubic[2].distance(cubic[3]);
    let (left, middle, right) = (speed(from), speed(0.5 * (from + to)), speed(to));
    simpson(&speed, [from, to], [left, middle, right], 1e-17 * size, 40)
}

/// Simpson's rule, halved until both halves agree with the whole.
fn simpson(
    speed: &impl Fn(f64) -> f64,
    [from, to]: [f64; 2],
    [left, middle, right]: [f64; 3],
    tolerance: f64,
    depth: u32,
) -> f64 {
    let width = to - from;
    let half = 0.5 * (from + to);
    let (first, third) = (speed(0.5 * (from + half)), speed(0.5 * (half + to)));
    let whole = width / 6.0 * (left + 4.0 * middle + right);
    let halves = width / 12.0 * (left + 4.0 * first + 2.0 * middle + 4.0 * third + right);
    let off = (halves - whole) / 15.0;
    if off.abs() <= tolerance + 1e-16 * halves.abs() || depth == 0 {
        return halves + off;
    }
    simpson(
        speed,
        [from, half],
        [left, first, middle],
        tolerance,
        depth - 1,
    ) + simpson(
        speed,
        [half, to],
        [middle, third, right],
        tolerance,
        depth - 1,
    )
}

/// From points and derivatives.
pub(crate) fn hermite(points: &[DVec3], tangents: &[DVec3]) -> Vec<Cubic> {
    (points.windows(2).zip(tangents.windows(2)))
        .map(|(p, d)| [p[0], p[0] + d[0] / 3.0, p[1] - d[1] / 3.0, p[1]])
        .collect()
}

/// Derivatives inside are from the point before to the point after.
pub(crate) fn through(points: &[DVec3], [start, end]: [DVec3; 2]) -> Vec<Cubic> {
    let mut tangents = vec![start];
    for index in 1..points.len() - 1 {
        tangents.push(points[index + 1] - points[index - 1]);
    }
    tangents.push(end);
    hermite(points, &tangents)
}

/// Barry and Goldman's pyramid at four parameters, and the cubic through what comes out.
pub(crate) fn catmull_rom(points: &[DVec3], power: f64) -> Vec<Cubic> {
    let last = points.len() - 1;
    let closed = last > 1 && points[0] == points[last];
    let mut all = Vec::with_capacity(points.len() + 2);
    all.push(if closed {
        points[last - 1]
    } else {
        2.0 * points[0] - points[1]
    });
    all.extend_from_slice(points);
    all.push(if closed {
        points[1]
    } else {
        2.0 * points[last] - points[last - 1]
    });
    let pyramid = |p: &[DVec3], share: f64| {
        let mut t = [0.0; 4];
        for index in 1..4 {
            t[index] = t[index - 1] + p[index - 1].distance(p[index]).powf(power);
        }
        let at = t[1] + share * (t[2] - t[1]);
        let mix = |p: DVec3, q: DVec3, from: f64, to: f64| {
            ((to - at) * p + (at - from) * q) / (to - from)
        };
        let a = [0, 1, 2].map(|i| mix(p[i], p[i + 1], t[i], t[i + 1]));
        let b = [0, 1].map(|i| mix(a[i], a[i + 1], t[i], t[i + 2]));
        mix(b[0], b[1], t[1], t[2])
    };
    all.windows(4)
        .map(|p| {
            let [low, high] = [1.0 / 3.0, 2.0 / 3.0].map(|share| pyramid(p, share));
            let (start, end) = (p[1], p[2]);
            let second = (-5.0 * start + 18.0 * low - 9.0 * high + 2.0 * end) / 6.0;
            let third = (2.0 * start - 9.0 * low + 18.0 * high - 5.0 * end) / 6.0;
            [start, second, third, end]
        })
        .collect()
}
