//! Curves, splines and paths against closed forms and a slow oracle.

use feeler::{ArcLengthRow, ArcLengthTable, CubicBezier, Path, PathError, Spline, ValueError};
use glam::DVec3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Length of a cubic by halving it (de Casteljau) until chord and control polygon,
/// between which every curve's length lies, all but agree; their mean is then
/// right to the square of what is left. Gravesen, *Adaptive subdivision and the
/// length and energy of Bézier curves* (1997).
fn oracle_length(control: [DVec3; 4]) -> f64 {
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
fn halves([a, b, c, d]: [DVec3; 4], u: f64) -> [[DVec3; 4]; 2] {
    let mix = |p: DVec3, q: DVec3| (1.0 - u) * p + u * q;
    let (ab, bc, cd) = (mix(a, b), mix(b, c), mix(c, d));
    let (abc, bcd) = (mix(ab, bc), mix(bc, cd));
    let middle = mix(abc, bcd);
    [[a, ab, abc, middle], [middle, bcd, cd, d]]
}

/// The oracle's length of a spline from its start to `u` on `piece`.
fn oracle_distance(spline: &Spline, piece: usize, u: f64) -> f64 {
    let before = spline.pieces()[..piece].iter();
    let before: f64 = before
        .map(|curve| oracle_length(curve.control_points()))
        .sum();
    let control = spline.pieces()[piece].control_points();
    before + oracle_length(halves(control.map(|point| point - control[0]), u)[0])
}

fn unit(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

fn log_uniform(rng: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    low * (high / low).powf(unit(rng))
}

fn in_cube(rng: &mut ChaCha8Rng, half_edge: f64) -> DVec3 {
    let mut side = || half_edge * (2.0 * unit(rng) - 1.0);
    DVec3::new(side(), side(), side())
}

fn curve(control: [DVec3; 4]) -> CubicBezier {
    CubicBezier::new(control).unwrap()
}

fn planar(control: [[f64; 2]; 4]) -> CubicBezier {
    curve(control.map(|[x, y]| DVec3::new(x, y, 0.0)))
}

/// A spline of one piece: the given curve.
fn spline_of(curve: &CubicBezier) -> Spline {
    let [b0, b1, b2, b3] = curve.control_points();
    Spline::with_tangents([b0, b3], [3.0 * (b1 - b0), 3.0 * (b3 - b2)]).unwrap()
}

fn eight() -> CubicBezier {
    planar([[-2.0, 2.0], [-2.0, -2.0], [2.0, -2.0], [2.0, 2.0]])
}

/// A curve with a cusp at `cusp`: its velocity is `t·(1, bend·t)` with
/// `t = u − cusp`.
fn cusped(cusp: f64, bend: f64, size: f64) -> CubicBezier {
    let velocity = |u: f64, v: f64| {
        let (s, t) = (u - cusp, v - cusp);
        size * DVec3::new(0.5 * (s + t), bend * s * t, 0.0)
    };
    let b1 = velocity(0.0, 0.0) / 3.0;
    let b2 = b1 + velocity(0.0, 1.0) / 3.0;
    curve([DVec3::ZERO, b1, b2, b2 + velocity(1.0, 1.0) / 3.0])
}

/// The length of [`cusped`] from the cusp to `u`, signed.
fn cusped_length(cusp: f64, bend: f64, size: f64, u: f64) -> f64 {
    let t = u - cusp;
    let k = (bend * t).powi(2);
    // ((1 + k)^(3/2) − 1) / (3·bend²) without cancellation.
    let length = t * t * (0.5 * k.ln_1p() * 3.0).exp_m1() / (3.0 * k);
    size * if k > 0.0 { length } else { 0.5 * t * t }.copysign(t)
}

/// Curves of every awkward kind, of size about 1.
fn awkward_curves() -> Vec<(String, CubicBezier)> {
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
fn random_curve(rng: &mut ChaCha8Rng, size: f64) -> CubicBezier {
    let mut control: [DVec3; 4] = std::array::from_fn(|_| in_cube(rng, size));
    if rng.next_u64() % 3 == 0 {
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

#[test]
fn the_eight_metre_curve_has_its_closed_form_length() {
    let spline = spline_of(&eight());
    assert!(
        (spline.length() - 8.0).abs() < 2e-15,
        "{:e}",
        spline.length() - 8.0
    );
    for step in 0..=1000 {
        let u = f64::from(step) / 1000.0;
        let want = 12.0 * (u - u * u + 2.0 * u * u * u / 3.0);
        let got = eight().length_between(0.0, u);
        assert!((got - want).abs() < 1e-14, "u {u}: {got} is not {want}");
        assert!((spline.distance_at(0, u) - want).abs() < 1e-14, "u {u}");
        let (_, found) = spline.locate(want);
        assert!((found - u).abs() < 1e-14, "u {u}: found {found}");
    }
    // Two boxes of edge 1, one on the curve, one at (0, −1, 0).
    let u = 0.5 - 10.0_f64.to_radians().sin();
    assert!((spline.distance_at(0, u) / 8.0 - 0.364_527_733_5).abs() < 1e-10);
}

#[test]
fn lengths_match_the_closed_form_beside_a_cusp() {
    for cusp in [0.0, 1e-12, 1e-3, 0.25, 1.0 / 3.0, 0.5, 0.9, 1.0 - 1e-9, 1.0] {
        for bend in [0.0, 1e-9, 0.1, 1.0, 10.0, 1e4] {
            for size in [1e-5, 1.0, 1e7] {
                let curve = cusped(cusp, bend, size);
                let spline = spline_of(&curve);
                let whole =
                    cusped_length(cusp, bend, size, 1.0) - cusped_length(cusp, bend, size, 0.0);
                for step in 0..=200 {
                    let u = f64::from(step) / 200.0;
                    let want =
                        cusped_length(cusp, bend, size, u) - cusped_length(cusp, bend, size, 0.0);
                    for got in [curve.length_between(0.0, u), spline.distance_at(0, u)] {
                        assert!(
                            (got - want).abs() < 1e-13 * whole,
                            "cusp {cusp}, bend {bend}, size {size}, u {u}: {got:e}, not {want:e}"
                        );
                    }
                    let found = spline.locate(want).1;
                    let back = cusped_length(cusp, bend, size, found)
                        - cusped_length(cusp, bend, size, 0.0);
                    assert!(
                        (back - want).abs() < 1e-13 * whole,
                        "cusp {cusp}, bend {bend}, size {size}, u {u}: found {found}"
                    );
                }
            }
        }
    }
}

#[test]
fn lengths_match_the_oracle_on_awkward_curves() {
    for (name, curve) in awkward_curves() {
        for size in [1e-6, 1.0, 1e6] {
            let curve = self::curve(curve.control_points().map(|p| size * p));
            let want = oracle_length(curve.control_points());
            let got = curve.length_between(0.0, 1.0);
            assert!(
                (got - want).abs() < 1e-12 * want,
                "{name}, size {size}: {got} is not {want}, off by {:e}",
                got / want - 1.0
            );
            for u in [1e-9, 0.1, 0.3, 0.5, 0.77, 1.0 - 1e-9] {
                let part = oracle_length(halves(curve.control_points(), u)[0]);
                let got = curve.length_between(0.0, u);
                assert!(
                    (got - part).abs() < 1e-12 * want,
                    "{name}, size {size}, u {u}"
                );
                let rest = curve.length_between(1.0, u);
                assert!(
                    (got + rest - want).abs() < 1e-12 * want,
                    "{name}, size {size}, u {u}"
                );
            }
        }
    }
}

#[test]
fn lengths_match_the_oracle_on_random_curves() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut slow = 0;
    for case in 0..300 {
        let size = log_uniform(&mut rng, 1e-6, 1e9);
        let curve = random_curve(&mut rng, size);
        let want = oracle_length(curve.control_points());
        let got = curve.length_between(0.0, 1.0);
        assert!(
            (got - want).abs() < 1e-12 * want,
            "case {case}: {got} is not {want}, off by {:e}",
            got / want - 1.0
        );
        let speeds = (0..=10_000).map(|i| curve.derivative(f64::from(i) / 1e4).length());
        slow += u32::from(speeds.fold(f64::INFINITY, f64::min) < 1e-3 * want);
    }
    assert!(
        (40..=150).contains(&slow),
        "inputs are lopsided: {slow} of 300 near a cusp"
    );
}

#[test]
fn every_size_has_a_length() {
    for exponent in -300..=11 {
        let size = 10.0_f64.powi(exponent);
        let curve = curve(eight().control_points().map(|p| size * p));
        let got = curve.length_between(0.0, 1.0) / size;
        assert!((got - 8.0).abs() < 1e-13, "size {size:e}: {got}");
        assert_eq!(curve.tangent(0.5), Some(DVec3::X), "size {size:e}");
    }
    let point = curve([DVec3::ONE; 4]);
    assert_eq!(point.length_between(0.0, 1.0), 0.0);
    assert_eq!(point.tangent(0.3), None);
}

#[test]
fn a_look_up_finds_the_distance_it_was_asked_for() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let awkward = awkward_curves()
        .into_iter()
        .map(|(name, curve)| (name, spline_of(&curve)));
    let random = (0..300).map(|case| {
        let size = log_uniform(&mut rng, 1e-6, 1e9);
        (
            format!("random {case}"),
            spline_of(&random_curve(&mut rng, size)),
        )
    });
    let splines: Vec<_> = awkward.chain(random).collect();
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    for (name, spline) in &splines {
        let length = spline.length();
        let spread = (0..=200).map(|i| f64::from(i) / 200.0);
        let tiny = (0..40).map(|i| 10.0_f64.powf(-0.5 * f64::from(i)));
        let shares = spread
            .chain(tiny.clone())
            .chain(tiny.map(|share| 1.0 - share));
        for share in shares {
            let distance = share * length;
            let (piece, u) = spline.locate(distance);
            let back = spline.distance_at(piece, u);
            assert!(
                (back - distance).abs() <= 1e-13 * length,
                "{name}, share {share:e}: u {u:e} is off by {:e}",
                (back - distance) / length
            );
        }
        // Against the oracle, in a few places.
        for _ in 0..3 {
            let distance = length * unit(&mut rng);
            let (piece, u) = spline.locate(distance);
            let want = oracle_distance(spline, piece, u);
            assert!(
                (want - distance).abs() < 1e-12 * length,
                "{name}, distance {distance}: off by {:e}",
                (want - distance) / length
            );
        }
    }
}

/// Points of a random walk and a spline through them.
fn random_spline(rng: &mut ChaCha8Rng, count: usize, steps: [f64; 2]) -> Spline {
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

#[test]
fn splines_match_the_oracle_from_piece_to_piece() {
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    // The last: pieces of a micrometre beside pieces of a thousand kilometres.
    for (count, steps) in [
        (2, [1.0, 2.0]),
        (3, [1.0, 1.0]),
        (30, [0.5, 2.0]),
        (40, [1e-6, 1e6]),
    ] {
        let spline = random_spline(&mut rng, count, steps);
        let length = spline.length();
        let mut before = 0.0;
        for (piece, curve) in spline.pieces().iter().enumerate() {
            assert!((spline.distance_at(piece, 0.0) - before).abs() < 1e-13 * length);
            for share in [1e-6, 0.2, 0.5, 0.9] {
                let own = oracle_length(curve.control_points());
                let distance = before + share * own;
                let (found, u) = spline.locate(distance);
                let want = oracle_distance(&spline, found, u);
                assert!(
                    (want - distance).abs() < 1e-12 * length,
                    "{count} points, piece {piece}, {share}: {want} is not {distance}"
                );
            }
            before += oracle_length(curve.control_points());
        }
        assert!((before - length).abs() < 1e-12 * length);
    }
}

#[test]
fn a_quarter_circle_is_as_long_as_a_dense_sum() {
    let k = 4.0 / 3.0 * (2.0_f64.sqrt() - 1.0);
    let curve = planar([[1.0, 0.0], [1.0, k], [k, 1.0], [0.0, 1.0]]);
    // Trapezoids of the speed with Richardson's step: error h⁴.
    let sum = |n: u32| {
        let speeds = (0..=n).map(|i| {
            let weight = if i == 0 || i == n { 0.5 } else { 1.0 };
            let (u, [a, b, c, d]) = (f64::from(i) / f64::from(n), curve.control_points());
            let v = 1.0 - u;
            weight * 3.0 * (v * v * (b - a) + 2.0 * u * v * (c - b) + u * u * (d - c)).length()
        });
        speeds.sum::<f64>() / f64::from(n)
    };
    let want = (4.0 * sum(4096) - sum(2048)) / 3.0;
    let got = curve.length_between(0.0, 1.0);
    assert!((got - want).abs() < 1e-13, "{got} is not {want}");
    assert!((got - std::f64::consts::FRAC_PI_2).abs() < 3e-4);
}

#[test]
fn speed_is_constant_along_smooth_splines_and_through_their_joints() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let step = 2e-5;
    for _ in 0..5 {
        // Even steps keep the curvature near 1 per metre, so that chord and arc
        // agree to 1e-10 on a step.
        let points: Vec<DVec3> = (0..20)
            .map(|i| DVec3::new(1.5 * f64::from(i), 0.0, 0.0) + in_cube(&mut rng, 0.05))
            .collect();
        let spline = Spline::through(points, DVec3::X, DVec3::X).unwrap();
        let joints = (1..19).map(|piece| spline.distance_at(piece, 0.0) - 0.5 * step);
        let even = (0..2000).map(|i| spline.length() * f64::from(i) / 2000.0);
        for distance in even.chain(joints) {
            let move_on = spline.position_at(distance + step) - spline.position_at(distance);
            let speed = move_on.length() / step;
            assert!((speed - 1.0).abs() < 1e-9, "at {distance}: {}", speed - 1.0);
            let tangent = spline.tangent_at(distance + 0.5 * step);
            assert!((move_on / step - tangent).length() < 1e-6, "at {distance}");
            assert!((tangent.length() - 1.0).abs() < 1e-15);
        }
    }
}

#[test]
fn speed_is_constant_through_a_cusp() {
    // On a straight line there and back, distance is position.
    let spline = Spline::with_tangents([[0.0; 3], [0.0; 3]], [[3.0, 0.0, 0.0], [-3.0, 0.0, 0.0]]);
    let spline = spline.unwrap();
    assert!((spline.length() - 1.5).abs() < 1e-15);
    for i in 0..=3000 {
        let distance = f64::from(i) / 2000.0;
        let want = 0.75 - (0.75 - distance).abs();
        let got = spline.position_at(distance);
        assert!(
            (got - want * DVec3::X).length() < 1e-15,
            "{distance}: {got}"
        );
        let direction = if distance < 0.75 {
            DVec3::X
        } else {
            DVec3::NEG_X
        };

        if (distance - 0.75).abs() > 1e-12 {
            assert!(
                (spline.tangent_at(distance) - direction).length() < 1e-15,
                "at {distance}"
            );
        }
    }
}

#[test]
fn tangents_are_unit_vectors_even_where_the_derivative_vanishes() {
    for (name, curve) in awkward_curves() {
        let spline = spline_of(&curve);
        for i in 0..=1000 {
            let share = f64::from(i) / 1000.0;
            let tangent = spline.tangent_at(share * spline.length());
            assert!(
                (tangent.length() - 1.0).abs() < 1e-15,
                "{name}, {share}: {tangent}"
            );
        }
    }
    let line = DVec3::new(1.0, 2.0, 2.0) / 3.0;
    for (leaving, arriving) in [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0)] {
        let ends = [DVec3::ZERO, 7.0 * line];
        let spline = Spline::through(ends, leaving * line, arriving * line).unwrap();
        for distance in [0.0, 1e-300, 1e-12, 1.0, 7.0 - 1e-12, 7.0] {
            let tangent = spline.tangent_at(distance);
            assert!(
                (tangent - line).length() < 1e-15,
                "{leaving}, {arriving}, {distance}"
            );
        }
    }
    // All of the derivative's terms but the third vanish.
    let cubic = |control: [[f64; 2]; 4], u: f64| planar(control).tangent(u).unwrap();
    assert_eq!(
        cubic([[0.0; 2], [0.0; 2], [0.0; 2], [1.0, 0.0]], 0.0),
        DVec3::X
    );
    assert_eq!(
        cubic([[0.0; 2], [1.0, 0.0], [1.0, 0.0], [1.0, 0.0]], 1.0),
        DVec3::X
    );
}

#[test]
fn the_ends_and_the_given_points_are_met_bit_for_bit() {
    let mut rng = ChaCha8Rng::seed_from_u64(6);
    for _ in 0..1000 {
        let size = log_uniform(&mut rng, 1e-3, 1e11);
        let points: [DVec3; 4] = std::array::from_fn(|_| in_cube(&mut rng, size));
        let [a, b, ..] = points;
        let line = Path::line(a, b).unwrap();
        let spline = Path::spline(points, a, b).unwrap();
        for (path, last) in [(&line, b), (&spline, points[3])] {
            for distance in [0.0, -0.0, -1.0, f64::NEG_INFINITY, f64::NAN] {
                assert_eq!(path.position_at(distance), a, "at {distance}");
            }
            for distance in [path.length(), 2.0 * path.length(), f64::INFINITY] {
                assert_eq!(path.position_at(distance), last, "at {distance}");
            }
            assert_eq!((path.start(), path.end()), (a, last));
            for distance in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                assert!((path.tangent_at(distance).length() - 1.0).abs() < 1e-15);
            }
        }
        let spline = spline.as_spline().unwrap();
        for (point, piece) in points[..3].iter().zip(spline.pieces()) {
            assert_eq!(piece.point(0.0), *point);
        }
        for (point, piece) in points[1..].iter().zip(spline.pieces()) {
            assert_eq!(piece.point(1.0), *point);
        }
    }
}

#[test]
fn a_line_is_walked_at_constant_speed() {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    for _ in 0..1000 {
        let size = log_uniform(&mut rng, 1e-6, 1e12);
        let (from, to) = (in_cube(&mut rng, size), in_cube(&mut rng, size));
        let path = Path::line(from, to).unwrap();
        assert!(path.is_straight() && path.as_spline().is_none());
        let share = unit(&mut rng);
        let got = path.position_at(share * path.length());
        let want = (1.0 - share) * from + share * to;
        assert!(
            (got - want).length() < 1e-15 * size,
            "{from} to {to}, {share}"
        );
        let tangent = path.tangent_at(share);
        assert!((tangent * path.length() - (to - from)).length() < 1e-15 * path.length());
    }
}

#[test]
fn derivatives_match_differences() {
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    for _ in 0..200 {
        let curve = random_curve(&mut rng, 1.0);
        let u = 0.01 + 0.98 * unit(&mut rng);
        let h = 1e-4;
        // Exact for a cubic but for its third derivative, 6·|…| ≤ 48·√3·1.
        let slope = (curve.point(u + h) - curve.point(u - h)) / (2.0 * h);
        assert!((slope - curve.derivative(u)).length() < 1e-4 * h * 1e4);
        let bend = (curve.derivative(u + h) - curve.derivative(u - h)) / (2.0 * h);
        assert!((bend - curve.second_derivative(u)).length() < 1e-8);
        // The point itself, by de Casteljau.
        let [_, [point, ..]] = halves(curve.control_points(), u);
        assert!((point - curve.point(u)).length() < 1e-14);
    }
    let curve = CubicBezier::from_hermite([1.0; 3], [2.0; 3], [3.0; 3], [4.0; 3]).unwrap();
    assert_eq!(curve.point(0.0), DVec3::splat(1.0));
    assert!((curve.derivative(0.0) - DVec3::splat(2.0)).length() < 1e-14);
    assert_eq!(curve.point(1.0), DVec3::splat(3.0));
    assert!((curve.derivative(1.0) - DVec3::splat(4.0)).length() < 1e-14);
}

#[test]
fn no_point_of_a_curve_lies_outside_its_extent_and_some_reach_it() {
    let mut rng = ChaCha8Rng::seed_from_u64(9);
    let awkward = awkward_curves().into_iter().map(|(_, curve)| curve);
    let random: Vec<_> = (0..500)
        .map(|_| {
            let size = log_uniform(&mut rng, 1e-6, 1e9);
            let offset = in_cube(&mut rng, 1e3 * size);
            let control = random_curve(&mut rng, size).control_points();
            curve(control.map(|p| p + offset))
        })
        .collect();
    let mut inside = 0;
    for curve in awkward.chain(random) {
        let axis = in_cube(&mut rng, 1.0).normalize();
        let control = curve.control_points();
        let (min, max) = curve.extent_along(axis);
        let size = control
            .iter()
            .fold(0.0, |s: f64, p| s.max((*p - control[0]).length()));
        let weight = control
            .iter()
            .fold(0.0, |s: f64, p| s.max(axis.abs().dot(p.abs())));
        let rounding = 8.0 * f64::EPSILON * weight;
        let steps = 4000;
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for i in 0..=steps {
            let [_, [point, ..]] = halves(control, f64::from(i) / f64::from(steps));
            low = low.min(axis.dot(point));
            high = high.max(axis.dot(point));
        }
        assert!(
            low >= min - rounding && high <= max + rounding,
            "{curve:?} along {axis}"
        );
        // Between samples a cubic rises by less than |B''|·h²/8.
        let slack = 24.0 * size / f64::from(steps).powi(2) + rounding;
        assert!(
            low <= min + slack && high >= max - slack,
            "{curve:?} along {axis}"
        );
        let ends = [axis.dot(control[0]), axis.dot(control[3])];
        inside += u32::from(min < ends[0].min(ends[1]) || max > ends[0].max(ends[1]));
    }
    assert!(
        inside > 100,
        "inputs are lopsided: {inside} extremes inside"
    );
}

/// Table 2.1 of the thesis.
const LENGTHS: [f64; 22] = [
    0.098821, 0.205607, 0.335634, 0.502465, 0.717651, 0.991541, 1.333926, 1.754365, 2.262342,
    2.867329, 3.283585, 3.575692, 3.760232, 3.927716, 4.204640, 4.640662, 5.256506, 6.066346,
    7.082381, 8.316070, 9.376211, 10.183034,
];

#[test]
fn the_tables_worked_example_comes_out_as_in_the_thesis() {
    let rows = LENGTHS
        .iter()
        .enumerate()
        .map(|(index, length)| ArcLengthRow {
            piece: index / 10,
            u: (index % 10 + 1) as f64 / 10.0,
            length: *length,
        });
    let table = ArcLengthTable::from_rows(rows).unwrap();
    let (piece, u) = table.locate(0.61);
    assert_eq!(piece, 0);
    assert!((u - 0.449_973_1).abs() < 1e-7, "{u}");
    assert!(((u - 0.4) / 0.1 - 0.499_730_5).abs() < 1e-6);
    // Between rows 10 and 11 u runs from 0 on the next piece.
    let (piece, u) = table.locate(0.5 * (2.867329 + 3.283585));
    assert_eq!(piece, 1);
    assert!((u - 0.05).abs() < 1e-12, "{u}");
    assert_eq!(table.locate(0.5 * 0.098821), (0, 0.05));
    assert_eq!(table.locate(-1.0), (0, 0.0));
    assert_eq!(table.locate(f64::NAN), (0, 0.0));
    assert_eq!(table.locate(99.0).0, 2);
    assert!((table.locate(99.0).1 - 0.2).abs() < 1e-15);
}

#[test]
fn the_table_errs_with_the_square_of_its_steps() {
    // Scene 7 of the thesis.
    let spline = Spline::with_tangents(
        [
            [-5.0, 5.0, 0.0],
            [0.0, 0.0, 0.0],
            [-5.0, -5.0, 0.0],
            [-10.0, 0.0, 0.0],
        ],
        [
            [1.0, 0.0, 0.0],
            [0.0, -1.0, 0.0],
            [-1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
        ],
    )
    .unwrap();
    let worst = |steps: usize| {
        let table = ArcLengthTable::from_spline(&spline, steps).unwrap();
        assert_eq!(table.rows().len(), 3 * steps);
        let worst = (0..=1000).map(|i| {
            let distance = f64::from(i) / 1000.0 * table.length();
            let (piece, u) = table.locate(distance);
            (spline.distance_at(piece, u) - distance).abs()
        });
        worst.fold(0.0, f64::max)
    };
    let errors = [10, 20, 40, 80, 160].map(worst);
    assert!((1e-3..0.2).contains(&errors[0]), "{errors:?}");
    for pair in errors.windows(2) {
        assert!((2.5..5.5).contains(&(pair[0] / pair[1])), "{errors:?}");
    }
}

#[test]
fn bad_input_stops_at_the_door() {
    let fine = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 1.0, 0.0]];
    let none = [0.0; 3];
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1.1e12, -1.1e12] {
        let point = [0.0, bad, 0.0];
        let mut points = fine;
        points[1] = point;
        for (route, error) in [
            ("line from", Path::line(point, none).err()),
            ("line to", Path::line(none, point).err()),
            ("points", Path::spline(points, none, none).err()),
            ("start", Path::spline(fine, point, none).err()),
            ("end", Path::spline(fine, none, point).err()),
            ("tangents", Path::spline_with_tangents(fine, points).err()),
            (
                "tangents' points",
                Path::spline_with_tangents(points, fine).err(),
            ),
            ("curve", CubicBezier::new([none, none, point, none]).err()),
            (
                "hermite",
                CubicBezier::from_hermite(none, point, none, none).err(),
            ),
        ] {
            match error {
                Some(PathError::Value(ValueError::NotFinite { .. })) if !bad.is_finite() => {}
                Some(PathError::Value(ValueError::TooLarge { value, max, .. })) => {
                    assert!(value == bad && max == 1e12, "{route}, {bad}");
                }
                other => panic!("{route}, {bad}: {other:?}"),
            }
        }
    }
    for count in 0..2 {
        let want = PathError::TooFewPoints { count, min: 2 };
        assert_eq!(Path::spline(fine[..count].to_vec(), none, none), Err(want));
        assert_eq!(
            Path::spline_with_tangents(fine[..count].to_vec(), fine),
            Err(want)
        );
    }
    assert_eq!(
        Path::spline_with_tangents(fine, [none; 2]),
        Err(PathError::TangentCount {
            points: 3,
            tangents: 2
        })
    );
    let twice = [fine[0], fine[1], fine[1], fine[2]];
    let short = Path::spline_with_tangents(twice, [none; 4]);
    assert!(
        matches!(short, Err(PathError::PieceTooShort { piece: 1, .. })),
        "{short:?}"
    );
    let short = Path::line([0.0; 3], [0.9e-9, 0.0, 0.0]);
    assert!(
        matches!(short, Err(PathError::PieceTooShort { piece: 0, .. })),
        "{short:?}"
    );
    assert!(Path::line([0.0; 3], [1.1e-9, 0.0, 0.0]).is_ok());

    let spline = Spline::through(fine, none, none).unwrap();
    assert!(ArcLengthTable::from_spline(&spline, 0).is_err());
    assert!(ArcLengthTable::from_spline(&spline, usize::MAX).is_err());
    let row = |piece, u, length| ArcLengthRow { piece, u, length };
    for (rows, wrong) in [
        (vec![], 0),
        (vec![row(0, f64::NAN, 1.0)], 0),
        (vec![row(0, 0.5, f64::NAN)], 0),
        (vec![row(0, 0.5, f64::INFINITY)], 0),
        (vec![row(0, 0.5, -1.0)], 0),
        (vec![row(0, 0.5, 1.0), row(0, 0.5, 1.0)], 1),
        (vec![row(0, 0.5, 1.0), row(0, 1.1, 2.0)], 1),
        (vec![row(0, 0.5, 1.0), row(2, 0.5, 2.0)], 1),
        (vec![row(1, 0.5, 1.0), row(0, 0.5, 2.0)], 1),
        (vec![row(0, 0.5, 1.0), row(1, 0.5, 0.9)], 1),
    ] {
        let got = ArcLengthTable::from_rows(rows.clone());
        assert_eq!(got, Err(PathError::TableRow { row: wrong }), "{rows:?}");
    }
}

#[test]
fn the_widest_and_the_smallest_paths_work() {
    let far = 1e12;
    let corners = [
        [-far, far, -far],
        [far, -far, far],
        [far, far, far],
        [-far, -far, far],
    ];
    let spline = Spline::through(corners, [far; 3], [-far; 3]).unwrap();
    assert!(spline.length() > 1e12 && spline.length() < 1e14);
    let small = Spline::through([[0.0; 3], [1e-8, 0.0, 0.0]], [0.0, 1e-8, 0.0], [0.0; 3]).unwrap();
    // A tenth of a metre out at 1e12 m, and one piece 1e-8 m beside 1e12 m.
    let mixed = Spline::through(
        [[0.0; 3], [1e-8, 0.0, 0.0], [0.0, far, 0.0], [0.1, far, 0.0]],
        [0.0; 3],
        [0.0; 3],
    )
    .unwrap();
    for spline in [spline, small, mixed] {
        let mut last = spline.position_at(0.0);
        for i in 0..=10_000 {
            let distance = f64::from(i) / 1e4 * spline.length();
            let (piece, u) = spline.locate(distance);
            let back = spline.distance_at(piece, u);
            assert!(
                (back - distance).abs() <= 1e-13 * spline.length(),
                "{distance}"
            );
            let point = spline.position_at(distance);
            assert!(point.is_finite() && spline.tangent_at(distance).is_normalized());
            // Nobody moves farther than flown.
            assert!((point - last).length() <= spline.length() * (1e-4 + 1e-13));
            last = point;
        }
    }
}

#[test]
fn a_path_of_ten_thousand_points_keeps_its_digits() {
    let mut rng = ChaCha8Rng::seed_from_u64(10);
    let spline = random_spline(&mut rng, 10_000, [1e-3, 1e3]);
    assert_eq!(spline.pieces().len(), 9_999);
    let pieces = spline.pieces().iter();
    let exact: f64 = pieces.map(|curve| curve.length_between(0.0, 1.0)).sum();
    assert!((spline.length() - exact).abs() < 1e-12 * exact);
    for _ in 0..10_000 {
        let distance = spline.length() * unit(&mut rng);
        let (piece, u) = spline.locate(distance);
        assert!((spline.distance_at(piece, u) - distance).abs() < 1e-14 * spline.length());
    }
    for piece in 0..9_999 {
        let (found, u) = spline.locate(spline.distance_at(piece, 0.0));
        assert_eq!((found, u), (piece, 0.0));
    }
}

#[test]
fn parameters_beyond_the_ends_are_clamped() {
    let curve = eight();
    let spline = spline_of(&curve);
    for (beyond, within) in [
        (-1.0, 0.0),
        (f64::NAN, 0.0),
        (f64::NEG_INFINITY, 0.0),
        (2.0, 1.0),
    ] {
        assert_eq!(curve.point(beyond), curve.point(within));
        assert_eq!(curve.derivative(beyond), curve.derivative(within));
        assert_eq!(
            curve.second_derivative(beyond),
            curve.second_derivative(within)
        );
        assert_eq!(curve.tangent(beyond), curve.tangent(within));
        assert_eq!(curve.length_between(beyond, within), 0.0);
        assert_eq!(spline.distance_at(0, beyond), spline.distance_at(0, within));
    }
    assert_eq!(spline.distance_at(7, 0.0), spline.length());
    assert_eq!(spline.distance_at(0, 1.0), spline.length());
}
