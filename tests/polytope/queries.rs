//! Farthest vertices and bounding spheres.

use crate::points::{Source, cube, cylinder};
use feeler::Polytope;
use glam::DVec3;

#[test]
fn support_is_the_farthest_vertex() {
    let mut source = Source::new(31);
    for round in 0..120 {
        let count = [4, 12, 39, 45, 100, 400, 2000][round % 7];
        let scale = 10_f64.powf(3.5 * source.signed() + 1.5);
        let stretch = [
            DVec3::ONE,
            DVec3::new(1.0, 1.0, 1e-6),
            DVec3::new(1e-6, 1.0, 1e-6),
        ];
        let stretch = stretch[round % 3] * scale;
        let shift = source.in_cube() * [0.0, 1e3][round % 2] * scale;
        let points: Vec<DVec3> = match round % 5 {
            0 => cylinder(count as u32),
            1 => (0..count).map(|_| source.in_cube()).chain(cube()).collect(),
            _ => (0..count).map(|_| source.on_sphere()).collect(),
        };
        let points = points.into_iter().map(|p| p * stretch + shift);
        let hull = Polytope::from_points(points).unwrap();
        let vertices = hull.vertices();
        let (middle, size) = (hull.centre(), hull.max_dist());
        for i in 0..200 {
            let direction = match i % 4 {
                0 => source.on_sphere(),
                1 => source.on_sphere() / stretch,
                2 => hull.face_normals()[source.below(hull.faces().len() as u64) as usize],
                _ => DVec3::AXES[i % 3] * source.signed(),
            };
            let most = (vertices.iter())
                .map(|v| direction.dot(*v - middle))
                .fold(f64::NEG_INFINITY, f64::max);
            let found = hull.support(direction);
            let reach = direction.dot(vertices[found as usize] - middle);
            let rounding = 8.0 * f64::EPSILON * direction.length() * (size + shift.length());
            assert!(
                most - reach <= rounding,
                "round {round}: {:e}",
                most - reach
            );
            assert_eq!(found, hull.support(direction));
        }
    }
}

#[test]
fn support_takes_any_direction() {
    let mut source = Source::new(32);
    for count in [8, 500] {
        let hull = Polytope::from_points((0..count).map(|_| source.on_sphere())).unwrap();
        let odd = [
            0.0,
            -0.0,
            f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            1e308,
            5e-324,
        ];
        for x in odd {
            for y in odd {
                for z in odd {
                    assert!(hull.support(DVec3::new(x, y, z)) < count);
                }
            }
        }
    }
}

/// Smallest sphere by trying all spheres over two, three and four points.
fn smallest_radius(points: &[DVec3]) -> f64 {
    let mut best = f64::INFINITY;
    let mut try_centre = |centre: DVec3| {
        if centre.is_finite() {
            let radius = points
                .iter()
                .map(|p| p.distance(centre))
                .fold(0.0, f64::max);
            best = best.min(radius);
        }
    };
    for (i, &a) in points.iter().enumerate() {
        for (j, &b) in points.iter().enumerate().skip(i + 1) {
            try_centre((a + b) / 2.0);
            for (k, &c) in points.iter().enumerate().skip(j + 1) {
                // Equally far from a, b, c and in their plane.
                let rows = [b - a, c - a, (b - a).cross(c - a)];
                let sides = [
                    (b - a).length_squared() / 2.0,
                    (c - a).length_squared() / 2.0,
                    0.0,
                ];
                try_centre(a + solve(rows, sides));
                for &d in points.iter().skip(k + 1) {
                    let rows = [b - a, c - a, d - a];
                    try_centre(a + solve(rows, rows.map(|r| r.length_squared() / 2.0)));
                }
            }
        }
    }
    best
}

/// Cramer's rule.
fn solve(rows: [DVec3; 3], sides: [f64; 3]) -> DVec3 {
    let matrix = glam::DMat3::from_cols_array_2d(&rows.map(|r| r.to_array())).transpose();
    matrix.inverse() * DVec3::from_array(sides)
}

#[test]
fn the_bounding_sphere_is_the_smallest() {
    let mut source = Source::new(33);
    for round in 0..200 {
        let scale = 10_f64.powf(6.0 * source.signed());
        let count = 4 + source.below(12);
        let stretch = [
            DVec3::ONE,
            DVec3::new(1.0, 0.1, 0.1),
            DVec3::new(1.0, 1.0, 1e-2),
        ];
        let points: Vec<DVec3> = match round % 4 {
            0 => cube(),
            1 => cylinder(3 + count as u32 / 2),
            2 => (0..count).map(|_| source.on_sphere()).collect(),
            _ => (0..count).map(|_| source.in_cube()).collect(),
        };
        let points: Vec<DVec3> = (points.into_iter())
            .map(|p| p * stretch[round % 3] * scale)
            .collect();
        let hull = Polytope::from_points(points.iter().copied()).unwrap();
        let want = smallest_radius(hull.vertices());
        let ratio = hull.max_dist() / want;
        assert!((ratio - 1.0).abs() < 1e-12, "round {round}: {ratio}");
    }
}
