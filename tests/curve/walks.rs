//! Splines walked by distance.

use crate::support::{
    awkward_curves, in_cube, log_uniform, oracle_distance, oracle_length, planar, random_curve,
    random_spline, spline_of, unit,
};
use feeler::Spline;
use glam::DVec3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

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
