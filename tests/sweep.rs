//! Boxes around motions: dense samples of the moving body must stay inside.

#![allow(
    clippy::unwrap_used,
    reason = "planted input that is refused shall fail the test"
)]

use feeler::sweep::{along_line, along_spline, around_static, swept_aabb};
use feeler::{Cuboid, Obb, Polytope, Pose, Shape, Sphere, Spline, Triangle};
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

struct Random(ChaCha8Rng);

impl Random {
    fn seeded(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    fn within(&mut self, min: f64, max: f64) -> f64 {
        min + (max - min) * (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn scale(&mut self, decades: f64) -> f64 {
        10_f64.powf(self.within(-decades, decades))
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(
            self.within(-1.0, 1.0),
            self.within(-1.0, 1.0),
            self.within(-1.0, 1.0),
        )
    }

    fn pose(&mut self, decades: f64) -> Pose {
        let axis = self.vector().normalize_or(DVec3::X);
        let orientation = DQuat::from_axis_angle(axis, self.within(0.0, 6.0));
        Pose::new(self.scale(decades) * self.vector(), orientation)
    }
}

/// How far `point` is outside the box, in metres; negative if inside.
fn outside(obb: &Obb, point: DVec3) -> f64 {
    (0..3)
        .map(|i| (point - obb.centre).dot(obb.axes[i]).abs() - obb.half_extents[i])
        .fold(f64::NEG_INFINITY, f64::max)
}

fn surface(half: DVec3) -> f64 {
    half.x * half.y + half.y * half.z + half.z * half.x
}

fn assert_holds(obb: &Obb, point: DVec3, what: &str) {
    assert!(
        obb.contains(point),
        "{what}: {point} is {:e} outside {obb:?}",
        outside(obb, point)
    );
}

/// As far as the margins of the boxes and of the overlap test rely on.
fn assert_orthonormal(obb: &Obb) {
    for i in 0..3 {
        for j in 0..3 {
            let expected = if i == j { 1.0 } else { 0.0 };
            assert!(
                (obb.axes[i].dot(obb.axes[j]) - expected).abs() < 32.0 * 0.5 * f64::EPSILON,
                "{obb:?}"
            );
        }
    }
}

#[test]
fn a_cuboid_gets_itself_back() {
    let mut random = Random::seeded(1);
    for _ in 0..10_000 {
        let half = random.scale(6.0) * (random.vector().abs() + 1e-3);
        let pose = random.pose(9.0);
        let cuboid = Cuboid::new(half).unwrap();
        let obb = around_static(&cuboid.into(), &pose);
        for vertex in cuboid.vertices() {
            assert_holds(&obb, pose.point(vertex), "cuboid");
        }
        let rounding = 4e-14 * (half.element_sum() + pose.position.length());
        assert!((obb.half_extents - half).abs().max_element() <= rounding);
        assert_eq!(obb.centre, pose.position);
        assert_orthonormal(&obb);
    }
}

#[test]
fn a_sphere_gets_the_cube_around_it() {
    let pose = Pose::new([5.0, 0.0, 0.0], DQuat::from_rotation_x(1.0));
    let obb = around_static(&Sphere::new(2.0).unwrap().into(), &pose);
    assert_eq!(obb.axes, [DVec3::X, DVec3::Y, DVec3::Z]);
    assert!((obb.half_extents - 2.0).abs().max_element() < 1e-12);
    assert_holds(&obb, DVec3::new(7.0, 2.0, 2.0), "sphere");
}

#[test]
fn triangles_and_polytopes_stay_inside_and_fit() {
    let mut random = Random::seeded(2);
    let mut polytopes = 0;
    for case in 0..10_000 {
        let size = random.scale(5.0);
        let points: Vec<DVec3> = (0..6).map(|_| size * random.vector()).collect();
        let shape: Shape = if case % 2 == 0 {
            match Triangle::new(points[0], points[1], points[2]) {
                Ok(triangle) => triangle.into(),
                Err(_) => continue,
            }
        } else {
            match Polytope::from_points(points.clone()) {
                Ok(polytope) => polytope.into(),
                Err(_) => continue,
            }
        };
        let vertices = match &shape {
            Shape::Triangle(triangle) => triangle.vertices().to_vec(),
            Shape::Polytope(polytope) => {
                polytopes += 1;
                polytope.vertices().to_vec()
            }
            _ => unreachable!("only those were made"),
        };
        let pose = random.pose(8.0);
        let obb = around_static(&shape, &pose);
        assert_orthonormal(&obb);
        for &vertex in &vertices {
            assert_holds(&obb, pose.point(vertex), "vertex");
        }
        // Every side is touched, and the axis-aligned box is no smaller.
        let rounding = 1e-13 * (size + pose.position.length());
        for axis in 0..3 {
            for side in [1.0, -1.0] {
                let reach = vertices
                    .iter()
                    .map(|&v| side * (pose.point(v) - obb.centre).dot(obb.axes[axis]))
                    .fold(f64::NEG_INFINITY, f64::max);
                assert!(obb.half_extents[axis] - reach < rounding, "{obb:?}");
            }
        }
        let own = shape.aabb(&Pose::IDENTITY).half_extents();
        let slack = rounding * (6.0 * size + rounding);
        assert!(surface(obb.half_extents) <= surface(own) + slack);
    }
    assert!(
        (4_000..6_000).contains(&polytopes),
        "lopsided: {polytopes} polytopes"
    );
}

/// Points on a sphere, the six tips first.
fn on_sphere(random: &mut Random, obb: &Obb, centre: DVec3, radius: f64) -> Vec<DVec3> {
    let mut points: Vec<_> = obb
        .axes
        .iter()
        .flat_map(|&axis| [centre + radius * axis, centre - radius * axis])
        .collect();
    points.extend((0..4).map(|_| centre + radius * random.vector().normalize_or(DVec3::X)));
    points
}

#[test]
fn a_straight_path_stays_inside_and_fits() {
    let mut random = Random::seeded(3);
    for case in 0..5_000 {
        let from = random.scale(8.0) * random.vector();
        let to = match case % 4 {
            0 => from,
            1 => from + random.scale(8.0) * DVec3::Y,
            _ => from + random.scale(8.0) * random.vector(),
        };
        let offset = random.scale(4.0) * random.vector();
        let radius = random.scale(6.0);
        let obb = along_line(from, to, offset, radius);
        assert_orthonormal(&obb);
        for step in 0..=8 {
            let centre = from.lerp(to, f64::from(step) / 8.0) + offset;
            for point in on_sphere(&mut random, &obb, centre, radius) {
                assert_holds(&obb, point, "line");
            }
        }
        let size = from.length() + to.length() + offset.length() + radius;
        let expected = DVec3::new(0.5 * from.distance(to), 0.0, 0.0) + radius;
        assert!((obb.half_extents - expected).abs().max_element() <= 4e-14 * size);
    }
}

/// Splines that bend, close, turn back, run straight, and at any size and place.
fn spline(random: &mut Random, kind: u32) -> Spline {
    let size = random.scale(5.0);
    let origin = random.scale(7.0) * random.vector();
    let x = random.vector();
    let scalar = |random: &mut Random| size * random.within(-1.0, 1.0);
    let points: Vec<DVec3> = match kind {
        // Closed, closed but for a hair, straight, there and back, anything.
        0 | 1 => {
            let mut points: Vec<_> = (0..4).map(|_| origin + size * random.vector()).collect();
            let gap = if kind == 1 { 1e-12 * size } else { 0.0 };
            points.push(points[0] + gap * random.vector());
            points
        }
        2 => (0..4).map(|i| origin + f64::from(i) * size * x).collect(),
        3 => (0..5).map(|_| origin + scalar(random) * x).collect(),
        _ => (0..5).map(|_| origin + size * random.vector()).collect(),
    };
    let (start, end) = match kind {
        2 | 3 => (scalar(random) * x, scalar(random) * x),
        _ => (3.0 * size * random.vector(), 3.0 * size * random.vector()),
    };
    Spline::through(points, start, end).unwrap()
}

#[test]
fn a_spline_stays_inside_and_fits() {
    let mut random = Random::seeded(4);
    for case in 0..2_000 {
        let spline = spline(&mut random, case % 5);
        let offset = random.scale(4.0) * random.vector();
        let radius = random.scale(6.0);
        let obb = along_spline(&spline, offset, radius);
        assert_orthonormal(&obb);
        let mut reach = [DVec3::NEG_INFINITY; 2];
        let mut size = offset.length() + radius;
        for piece in spline.pieces() {
            for step in 0..=100 {
                let point = piece.point(f64::from(step) / 100.0);
                size = size.max(point.length() + offset.length() + radius);
                let centre = point + offset;
                let along = obb.axes.map(|axis| (centre - obb.centre).dot(axis));
                reach[0] = reach[0].max(DVec3::from_array(along));
                reach[1] = reach[1].max(-DVec3::from_array(along));
                if step % 10 == 0 {
                    for point in on_sphere(&mut random, &obb, centre, radius) {
                        assert_holds(&obb, point, "spline");
                    }
                }
                assert_holds(&obb, centre + radius * obb.axes[0], "spline");
            }
        }
        // Samples come within a share (1/200)² of the curve's bends.
        let slack = 1e-3 * spline.length() + 4e-14 * size;
        for side in reach {
            let fit = obb.half_extents - radius - side;
            assert!(fit.max_element() <= slack, "{fit} {slack:e} {obb:?}");
        }
    }
}

#[test]
fn a_straight_spline_gets_the_box_of_the_line() {
    let mut random = Random::seeded(5);
    for _ in 0..1_000 {
        let (from, way) = (random.vector(), random.vector());
        let points = [from, from + 0.4 * way, from + way];
        let spline = Spline::through(points, way, way).unwrap();
        let obb = along_spline(&spline, DVec3::ZERO, 0.5);
        let line = along_line(from, from + way, DVec3::ZERO, 0.5);
        assert!((obb.half_extents - line.half_extents).abs().max_element() < 1e-12);
        assert!((obb.centre - line.centre).length() < 1e-12);
    }
}

#[test]
fn a_loop_is_not_boxed_as_if_it_ended_where_it_ends() {
    // A long thin loop: the way from its start to its end says nothing.
    let points = [
        [0.0; 3],
        [10.0, 0.1, 0.0],
        [20.0, 0.0, 0.0],
        [0.0, 1e-9, 1e-9],
    ];
    let spline = Spline::through(points, [1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]).unwrap();
    let obb = along_spline(&spline, DVec3::ZERO, 0.1);
    let along = obb.axes.map(|axis| axis.x.abs());
    assert!(along.iter().any(|&cosine| cosine > 0.99), "{obb:?}");
}

#[test]
fn a_frame_stays_inside_and_fits() {
    let mut random = Random::seeded(6);
    for _ in 0..20_000 {
        let from = random.scale(12.0) * random.vector();
        let to = from + random.scale(12.0) * random.vector();
        let radius = random.scale(9.0);
        let aabb = swept_aabb(from, to, radius);
        for axis in 0..3 {
            // Exactly: what an outward rounding of the sum encloses, the sum's error tells.
            for (end, sign) in [(aabb.max[axis], 1.0), (-aabb.min[axis], -1.0)] {
                let tip = (sign * from[axis]).max(sign * to[axis]);
                let sum = tip + radius;
                let part = sum - tip;
                let error = (tip - (sum - part)) + (radius - part);
                assert!(end > sum || (end >= sum && error <= 0.0));
                assert!(end <= sum.next_up());
            }
        }
    }
}
