//! Ends, limits and bad input.

use crate::support::{in_cube, log_uniform, unit};
use feeler::{
    ArcLengthRow, ArcLengthTable, CubicBezier, Knots, Path, PathError, Spline, ValueError,
};
use glam::DVec3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

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
fn points_closer_than_any_square_can_tell_are_refused_at_once() {
    // Halving a piece of noise until it was smooth took half a minute.
    let corner = DVec3::new(1.8e7, -1.8e4, -3.4e8);
    for gap in [0.0, 1e-310, 2e-156, 1e-100, 1e-12] {
        let points = [
            corner,
            DVec3::ZERO,
            DVec3::new(gap, 0.0, 1e-310),
            DVec3::new(0.97, -2.0, 1.7e-5),
            corner,
        ];
        let refused = Spline::catmull_rom(points, Knots::Centripetal);
        assert!(
            matches!(refused, Err(PathError::PieceTooShort { piece: 1, .. })),
            "{gap:e}"
        );
    }
}

#[test]
fn a_piece_beyond_the_last_is_at_the_end() {
    let spline =
        Spline::catmull_rom([[0.0; 3], [1.0; 3], [2.0, 0.0, 0.0]], Knots::Uniform).unwrap();
    for piece in [2, 3, usize::MAX] {
        for u in [0.0, 0.5, 1.0] {
            assert_eq!(spline.distance_at(piece, u), spline.length());
        }
    }
}

#[test]
fn an_axis_that_is_not_finite_bounds_nothing() {
    let curve = CubicBezier::new([[0.0; 3], [1.0; 3], [2.0; 3], [3.0; 3]]).unwrap();
    for axis in [DVec3::splat(f64::NAN), DVec3::INFINITY] {
        assert_eq!(curve.extent_along(axis), (f64::NEG_INFINITY, f64::INFINITY));
    }
}
