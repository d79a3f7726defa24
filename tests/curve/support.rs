//! What the tests share: a slow oracle, awkward curves, random ones.

use feeler::{CubicBezier, Spline};
use glam::DVec3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;

/// Length of a cubic by halving it (de Casteljau) until chord and control polygon,
/// between which every curve's length lies, all but agree; their mean is then
/// right to the square of what is left. Gravesen, *Adaptive subdivision and the
/// length and energy of Bézier curves* (1997).
pub(crate) fn oracle_length(control: [DVec3; 4]) -> f64 {
    fn add(control: [DVec3; 4], tolerance: f64, depth: u32, sum: &mut [f64; 2]) {
        let [a, b, c, d] = control;
        let chord = (d - a).length();
        let polygon = (b - a).length() + (c - b).length() + (d - c).length();
        if polygon - chord <= tolerance || depth == 60 {
            let total = sum[0] + 0.5 * (chord + polygon);
            sum[1] += (sum[0] - total) + 0.5 * (chord + polygon);
            sum[0] = total;
            return;
        }
        let [left, right] = halves(control, 0.5);
        add(left, tolerance, depth + 1, sum);
        add(right, tolerance, depth + 1, sum);
    }
    // Seen from its first point: far from the origin halving would round.
    let control = control.map(|point| point - control[0]);
    let size = control
        .iter()
        .fold(0.0, |size: f64, p| size.max(p.length()));
    let mut sum = [0.0; 2];
    add(control, 1e-13 * size, 0, &mut sum);
    sum[0] + sum[1]
}

/// Both parts of a cubic cut at `u`.
pub(crate) fn halves([a, b, c, d]: [DVec3; 4], u: f64) -> [[DVec3; 4]; 2] {
    let mix = |p: DVec3, q: DVec3| (1.0 - u) * p + u * q;
    let (ab, bc, cd) = (mix(a, b), mix(b, c), mix(c, d));
    let (abc, bcd) = (mix(ab, bc), mix(bc, cd));
    let middle = mix(abc, bcd);
    [[a, ab, abc, middle], [middle, bcd, cd, d]]
}

/// The oracle's length of a spline from its start to `u` on `piece`.
pub(crate) fn oracle_distance(spline: &Spline, piece: usize, u: f64) -> f64 {
    let before = spline.pieces()[..piece].iter();
    let before: f64 = before
        .map(|curve| oracle_length(curve.control_points()))
        .sum();
    let control = spline.pieces()[piece].control_points();
    before + oracle_length(halves(control.map(|point| point - control[0]), u)[0])
}

pub(crate) fn unit(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

pub(crate) fn log_uniform(rng: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    low * (high / low).powf(unit(rng))
}

pub(crate) fn in_cube(rng: &mut ChaCha8Rng, half_edge: f64) -> DVec3 {
    let mut side = || half_edge * (2.0 * unit(rng) - 1.0);
    DVec3::new(side(), side(), side())
}

pub(crate) fn curve(control: [DVec3; 4]) -> CubicBezier {
    CubicBezier::new(control).unwrap()
}

pub(crate) fn planar(control: [[f64; 2]; 4]) -> CubicBezier {
    curve(control.map(|[x, y]| DVec3::new(x, y, 0.0)))
}

/// A spline of one piece: the given curve.
pub(crate) fn spline_of(curve: &CubicBezier) -> Spline {
    let [b0, b1, b2, b3] = curve.control_points();
    Spline::with_tangents([b0, b3], [3.0 * (b1 - b0), 3.0 * (b3 - b2)]).unwrap()
}

pub(crate) fn eight() -> CubicBezier {
    planar([[-2.0, 2.0], [-2.0, -2.0], [2.0, -2.0], [2.0, 2.0]])
}

/// A curve with a cusp at `cusp`: its velocity is `t·(1, bend·t)` with
/// `t = u − cusp`.
pub(crate) fn cusped(cusp: f64, bend: f64, size: f64) -> CubicBezier {
    let velocity = |u: f64, v: f64| {
        let (s, t) = (u - cusp, v - cusp);
        size * DVec3::new(0.5 * (s + t), bend * s * t, 0.0)
    };
    let b1 = velocity(0.0, 0.0) / 3.0;
    let b2 = b1 + velocity(0.0, 1.0) / 3.0;
    curve([DVec3::ZERO, b1, b2, b2 + velocity(1.0, 1.0) / 3.0])
}

/// The length of [`cusped`] from the cusp to `u`, signed.
pub(crate) fn cusped_length(cusp: f64, bend: f64, size: f64, u: f64) -> f64 {
    let t = u - cusp;
    let k = (bend * t).powi(2);
    // ((1 + k)^(3/2) − 1) / (3·bend²) without cancellation.
    let length = t * t * (0.5 * k.ln_1p() * 3.0).exp_m1() / (3.0 * k);
    size * if k > 0.0 { length } else { 0.5 * t * t }.copysign(t)
}

/// Curves of every awkward kind, of size about 1.
pub(crate) fn awkward_curves() -> Vec<(String, CubicBezier)> {
    let mut curves: Vec<(String, CubicBezier)> = [
        (
            "eight",
            [[-2.0, 2.0], [-2.0, -2.0], [2.0, -2.0], [2.0, 2.0]],
        ),
        (
            "straight, even",
            [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [3.0, 3.0]],
        ),
        (
            "straight, uneven",
            [[0.0, 0.0], [0.1, 0.0], [0.2, 0.0], [3.0, 0.0]],
        ),
        (
            "there and back",
            [[0.0, 0.0], [3.0, 0.0], [-2.0, 0.0], [1.0, 0.0]],
        ),
        (
            "zero tangents",
            [[0.0, 0.0], [0.0, 0.0], [1.0, 2.0], [1.0, 2.0]],
        ),
        (
            "three at the start",
            [[0.0, 0.0], [0.0, 0.0], [0.0, 0.0], [1.0, 2.0]],
        ),
        (
            "three at the end",
            [[0.0, 0.0], [1.0, 2.0], [1.0, 2.0], [1.0, 2.0]],
        ),
        (
            "zero start tangent",
            [[0.0, 0.0], [0.0, 0.0], [1.0, 2.0], [3.0, 0.0]],
        ),
        (
            "zero end tangent",
            [[0.0, 0.0], [1.0, 2.0], [3.0, 0.0], [3.0, 0.0]],
        ),
        (
            "middle points meet",
            [[0.0, 0.0], [1.0, 2.0], [1.0, 2.0], [3.0, 0.0]],
        ),
        (
            "ends meet",
            [[0.0, 0.0], [1.0, 2.0], [2.0, -1.0], [0.0, 0.0]],
        ),
        ("loop", [[0.0, 0.0], [4.0, 3.0], [-3.0, 3.0], [1.0, 0.0]]),
        ("cusp", [[0.0, 0.0], [1.0, 1.0], [0.0, 1.0], [1.0, 0.0]]),
        (
            "inflection",
            [[0.0, 0.0], [1.0, 2.0], [2.0, -2.0], [3.0, 0.0]],
        ),
        (
            "hairpin",
            [[0.0, 0.0], [1.0, 1e-7], [1.0, -1e-7], [0.0, 1e-9]],
        ),
    ]
    .map(|(name, control)| (name.to_owned(), planar(control)))
    .into();
    for exponent in 1..=16 {
        for sign in [-1.0, 1.0] {
            let off = sign * 10.0_f64.powi(-exponent);
            curves.push((
                format!("cusp missed by {off:e}"),
                planar([[0.0, 0.0], [1.0 + off, 1.0], [0.0, 1.0], [1.0, 0.0]]),
            ));
            curves.push((
                format!("lopsided cusp missed by {off:e}"),
                cusped(0.3 + off.min(0.1), 2.0, 1.0),
            ));
            curves.push((
                format!("start tangent {off:e}"),
                planar([[0.0, 0.0], [off, 0.0], [1.0, 2.0], [3.0, 0.0]]),
            ));
        }
    }
    curves
}

/// A random curve, a third of them with a cusp or nearly one.
pub(crate) fn random_curve(rng: &mut ChaCha8Rng, size: f64) -> CubicBezier {
    let mut control: [DVec3; 4] = std::array::from_fn(|_| in_cube(rng, size));
    if rng.next_u64().is_multiple_of(3) {
        // B1 so that the velocity at a random u vanishes, up to `off`.
        let u = 0.05 + 0.9 * unit(rng);
        let rest = 1.0 - u;
        let [b0, _, b2, b3] = control;
        let off = size * log_uniform(rng, 1e-16, 1e-1);
        // rest²(B1−B0) + 2·u·rest(B2−B1) + u²(B3−B2) = 0
        let weight = rest * rest - 2.0 * u * rest;
        if weight.abs() > 0.05 {
            control[1] = (rest * rest * b0 - 2.0 * u * rest * b2 - u * u * (b3 - b2)) / weight
                + in_cube(rng, off);
        }
    }
    curve(control)
}

/// Points of a random walk and a spline through them.
pub(crate) fn random_spline(rng: &mut ChaCha8Rng, count: usize, steps: [f64; 2]) -> Spline {
    let mut at = DVec3::ZERO;
    let points: Vec<DVec3> = (0..count)
        .map(|_| {
            let step = log_uniform(rng, steps[0], steps[1]);
            at += in_cube(rng, step);
            at
        })
        .collect();
    let (start, end) = (in_cube(rng, steps[0]), in_cube(rng, steps[0]));
    Spline::through(points, start, end).unwrap()
}
