//! Splines from control points and from points alone.

use crate::support::{in_cube, log_uniform};
use feeler::{Knots, Path, PathError, Spline};
use glam::DVec3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// Barry and Goldman's pyramid: the Catmull–Rom piece from `p[1]` to `p[2]`.
fn pyramid(p: [DVec3; 4], exponent: f64, share: f64) -> DVec3 {
    let mut t = [0.0; 4];
    for i in 1..4 {
        t[i] = t[i - 1] + p[i].distance(p[i - 1]).powf(exponent);
    }
    let at = t[1] + share * (t[2] - t[1]);
    let mix = |a: DVec3, b: DVec3, ta: f64, tb: f64| ((tb - at) * a + (at - ta) * b) / (tb - ta);
    let a: [DVec3; 3] = std::array::from_fn(|i| mix(p[i], p[i + 1], t[i], t[i + 1]));
    let b: [DVec3; 2] = std::array::from_fn(|i| mix(a[i], a[i + 1], t[i], t[i + 2]));
    mix(b[0], b[1], t[1], t[2])
}

#[test]
fn catmull_rom_is_barry_and_goldmans_pyramid() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for case in 0..200 {
        let size = log_uniform(&mut rng, 1e-3, 1e6);
        let mut points: Vec<DVec3> = (0..6).map(|_| in_cube(&mut rng, size)).collect();
        let closed = case % 2 == 0;
        if closed {
            points.push(points[0]);
        }
        for (knots, exponent) in [(Knots::Uniform, 0.0), (Knots::Centripetal, 0.5)] {
            let spline = Spline::catmull_rom(points.clone(), knots).unwrap();
            assert!(spline.points().eq(points.iter().copied()));
            let (first, last) = (points[0], points[points.len() - 1]);
            let mut all = points.clone();
            if closed {
                all.insert(0, points[points.len() - 2]);
                all.push(points[1]);
            } else {
                all.insert(0, 2.0 * first - points[1]);
                all.push(2.0 * last - points[points.len() - 2]);
            }
            for (four, piece) in all.windows(4).zip(spline.pieces()) {
                for share in [0.1, 0.5, 0.8] {
                    let want = pyramid([four[0], four[1], four[2], four[3]], exponent, share);
                    let off = piece.point(share).distance(want);
                    assert!(off < 1e-13 * size, "{knots:?}: {off:e} of {size:e}");
                }
            }
            // Smooth in every joint, and through the closed one.
            for pair in spline.pieces().windows(2) {
                let [arriving, leaving] = [pair[0].tangent(1.0), pair[1].tangent(0.0)];
                assert!(arriving.unwrap().distance(leaving.unwrap()) < 1e-12);
            }
            if closed {
                let ends = [0.0, spline.length()].map(|at| spline.tangent_at(at));
                assert!(ends[0].distance(ends[1]) < 1e-12);
            }
        }
    }
}

#[test]
fn control_points_come_back_as_they_were_given() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    for count in [4, 7, 31] {
        let points: Vec<DVec3> = (0..count).map(|_| in_cube(&mut rng, 10.0)).collect();
        let spline = Spline::bezier(points.clone()).unwrap();
        for (index, piece) in spline.pieces().iter().enumerate() {
            assert_eq!(piece.control_points()[..], points[3 * index..3 * index + 4]);
        }
        let lengths = spline
            .pieces()
            .iter()
            .map(|piece| piece.length_between(0.0, 1.0));
        let length: f64 = lengths.sum();
        assert!((spline.length() - length).abs() < 1e-13 * length);
    }
}

#[test]
fn bad_control_points_are_refused() {
    for count in [0, 1, 2, 3, 5, 6, 8] {
        let points = vec![[0.0; 3]; count];
        assert_eq!(
            Path::bezier(points),
            Err(PathError::ControlPointCount { count })
        );
    }
    let same = Path::bezier([[1.0; 3]; 4]);
    assert!(matches!(
        same,
        Err(PathError::PieceTooShort { piece: 0, .. })
    ));
    for bad in [f64::NAN, f64::INFINITY, 1.1e12] {
        let points = [[0.0; 3], [1.0; 3], [bad; 3], [2.0; 3]];
        assert!(matches!(Path::bezier(points), Err(PathError::Value(_))));
        assert!(matches!(
            Path::catmull_rom(points, Knots::Uniform),
            Err(PathError::Value(_))
        ));
    }
    for knots in [Knots::Uniform, Knots::Centripetal] {
        let twice = [[0.0; 3], [1.0; 3], [1.0; 3], [2.0; 3]];
        let _never_panics = Path::catmull_rom(twice, knots);
        assert!(Path::catmull_rom([[0.0; 3]], knots).is_err());
        // Two points make a straight line.
        let line = Path::catmull_rom([[0.0; 3], [3.0, 4.0, 0.0]], knots).unwrap();
        assert!((line.length() - 5.0).abs() < 1e-14);
    }
}
