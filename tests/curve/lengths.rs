//! One curve: length, derivatives, extent.

use crate::support::{
    awkward_curves, curve, cusped, cusped_length, eight, halves, in_cube, log_uniform,
    oracle_length, planar, random_curve, spline_of, unit,
};
use feeler::CubicBezier;
use glam::DVec3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

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
fn derivatives_match_differences() {
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    for _ in 0..200 {
        let curve = random_curve(&mut rng, 1.0);
        let u = 0.01 + 0.98 * unit(&mut rng);
        let h = 1e-4;
        // Exact but for the third derivative times h²/6: 1e-8 times at most 6·|…| ≤ 48·√3·1.
        let slope = (curve.point(u + h) - curve.point(u - h)) / (2.0 * h);
        assert!((slope - curve.derivative(u)).length() < 1e-6);
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

/// Before the first node of a rule a kink is seen neither by the rule over the whole
/// nor by the rule over its halves; both were wrong by the same 1e-6.
#[test]
fn a_cusp_before_the_first_node_is_not_missed() {
    for cusp in [1e-5, 1e-4, 1e-3, 0.009] {
        for cusp in [cusp, 1.0 - cusp] {
            let want = 0.5 * (cusp * cusp + (1.0 - cusp) * (1.0 - cusp));
            let got = cusped(cusp, 0.0, 1.0).length_between(0.0, 1.0);
            assert!(
                (got - want).abs() < 1e-15,
                "cusp {cusp}: {got} is not {want}"
            );
        }
    }
}
