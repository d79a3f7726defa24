//! Curves with answers in closed form.

use feeler::{
    Body, CollisionWorld, Cuboid, Facing, FirstContactError, Knots, Method, Motion, Path, Polytope,
    Shape, Sphere, first_contact,
};
use glam::{DQuat, DVec3};

/// Length 8; `s(u) = 12 (u − u² + 2u³/3)`.
fn arch() -> Path {
    Path::bezier([
        [-2.0, 2.0, 0.0],
        [-2.0, -2.0, 0.0],
        [2.0, -2.0, 0.0],
        [2.0, 2.0, 0.0],
    ])
    .unwrap()
}

fn point(u: f64) -> DVec3 {
    DVec3::new(
        -2.0 + 12.0 * u * u - 8.0 * u * u * u,
        2.0 - 12.0 * u + 12.0 * u * u,
        0.0,
    )
}

fn share(u: f64) -> f64 {
    12.0 * (u - u * u + 2.0 * u * u * u / 3.0) / 8.0
}

fn along(shape: impl Into<Shape>, turn: DQuat) -> Body {
    Body::moving(shape, Motion::along(arch(), 8.0).unwrap()).oriented(turn)
}

#[test]
fn a_box_on_a_curve_meets_a_box() {
    let cube = Cuboid::new([0.5; 3]).unwrap();
    let fixed = Body::fixed(cube, [0.0, -1.0, 0.0]);
    let found = first_contact(&along(cube, DQuat::IDENTITY), &fixed, 1.0, &Method::Exact);
    let found = found.unwrap().unwrap();
    let u = 0.5 - 10_f64.to_radians().sin();
    assert!((u - 0.326_351_822_3).abs() < 1e-10);
    assert!(
        (found.fraction - 0.364_527_733_5).abs() < 1e-10,
        "{}",
        found.fraction
    );
    assert!(
        (found.fraction - share(u)).abs() < 1e-13,
        "{}",
        found.fraction - share(u)
    );
    assert_eq!(found.normal, DVec3::NEG_X);
    assert!((found.point.x + 0.5).abs() < 1e-12 && found.point.y.abs() <= 1.5);
}

#[test]
fn a_ball_on_a_curve_meets_a_ball() {
    let ball = Sphere::new(0.5).unwrap();
    let fixed = Body::fixed(ball, [0.0, -1.0, 0.0]);
    let found = first_contact(&along(ball, DQuat::IDENTITY), &fixed, 1.0, &Method::Exact);
    let found = found.unwrap().unwrap();
    let u = 0.336_332_987_1;
    assert!((point(u).distance(DVec3::NEG_Y) - 1.0).abs() < 1e-9);
    assert!(
        (found.fraction - 0.372_865_609_9).abs() < 1e-10,
        "{}",
        found.fraction
    );
    let centre = arch().position_at(8.0 * found.fraction);
    assert!((centre.distance(DVec3::NEG_Y) - 1.0).abs() < 1e-13);
    assert!(found.normal.distance(centre - DVec3::NEG_Y) < 1e-12);
    assert!(found.point.distance(0.5 * (centre + DVec3::NEG_Y)) < 1e-12);
}

/// The thesis's scene 7's path, on which a ball of radius 1 comes by (0, 0, 0) straight down.
fn scene_7(at: DVec3) -> (Body, Body, f64) {
    let path = Path::spline_with_tangents(
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
    let horizon = path.length();
    let ball = Sphere::new(1.0).unwrap();
    let mover = Body::moving(ball, Motion::along(path, 1.0).unwrap());
    (mover, Body::fixed(ball, at), horizon)
}

#[test]
fn scene_8_is_found_to_the_nanometre() {
    for (x, want) in [
        (2.0 - 1e-9, true),
        (2.0, true),
        (2.0 + 1e-9, false),
        (2.1, false),
        (1.9, true),
    ] {
        let (mover, fixed, horizon) = scene_7(DVec3::new(x, 0.0, 0.0));
        for (a, b) in [(&mover, &fixed), (&fixed, &mover)] {
            let found = first_contact(a, b, horizon, &Method::Exact).unwrap();
            assert_eq!(found.is_some(), want, "{x}");
        }
        for frames in [1.0, 24.0, 1000.0] {
            let mut world = CollisionWorld::default();
            world.insert(mover.clone()).unwrap();
            world.insert(fixed.clone()).unwrap();
            let mut touches = 0;
            while world.time() < horizon {
                world.step(1.0 / frames).unwrap();
                touches += world.contacts().iter().filter(|c| c.is_touch()).count();
                assert_eq!(world.stats().undecided, 0);
            }
            assert_eq!(touches, usize::from(want), "{x} at {frames} Hz");
        }
    }
}

/// A ball that circles above a floor at a nanometre, and in touch.
#[test]
fn what_runs_beside_ends_in_bounded_time() {
    let floor = Body::fixed(Cuboid::new([9.0, 9.0, 1.0]).unwrap(), [0.0; 3]);
    for above in [1e-9, 0.0] {
        let height = 1.5 + above;
        let ring: Vec<DVec3> = [[4.0, 0.0], [0.0, 4.0], [-4.0, 0.0], [0.0, -4.0], [4.0, 0.0]]
            .map(|[x, y]| DVec3::new(x, y, height))
            .to_vec();
        let path = Path::catmull_rom(ring, Knots::Uniform).unwrap();
        let motion = Motion::along(path, 5.0).unwrap().looping().unwrap();
        for body in [
            Body::moving(Sphere::new(0.5).unwrap(), motion.clone()),
            Body::moving(Cuboid::new([0.5; 3]).unwrap(), motion.clone()),
            Body::moving(
                Cuboid::new([0.5; 3]).unwrap(),
                motion.clone().spin([0.0, 0.0, 1.0], 3.0).unwrap(),
            ),
        ] {
            match first_contact(&body, &floor, 100.0, &Method::Exact) {
                Ok(found) => assert!(found.is_none(), "{above}: {found:?}"),
                Err(FirstContactError::Undecided { clear_until }) => {
                    panic!("{above}: {clear_until}")
                }
                Err(other) => panic!("{other}"),
            }
        }
    }
    // Two balls that follow one path side by side.
    let side_by_side = |apart: f64| {
        let path = |y: f64| {
            let points = [
                [0.0, y, 0.0],
                [3.0, y + 2.0, 1.0],
                [6.0, y, 3.0],
                [9.0, y - 5.0, 0.0],
            ];
            Path::catmull_rom(points, Knots::Uniform).unwrap()
        };
        let ball = Sphere::new(0.5).unwrap();
        let body = |y: f64| Body::moving(ball, Motion::along(path(y), 1.0).unwrap());
        first_contact(&body(0.0), &body(1.0 + apart), 10.0, &Method::Exact)
    };
    assert_eq!(side_by_side(1e-2), Ok(None));
    for apart in [1e-6, 1e-9] {
        let found = side_by_side(apart);
        assert!(
            matches!(found, Ok(None) | Err(FirstContactError::Undecided { .. })),
            "{found:?}"
        );
    }
}

/// Level flight a millimetre above a floor was given up, when of turning with the path only the speed was known.
#[test]
fn who_faces_its_way_in_level_flight_passes_over_a_floor() {
    let floor = Body::fixed(Cuboid::new([9.0, 9.0, 1.0]).unwrap(), [0.0; 3]);
    let facing = Facing {
        forward: DVec3::X,
        up: DVec3::Z,
        world_up: DVec3::Z,
    };
    for (above, touches) in [(1e-3, false), (1e-6, false), (-1e-3, true)] {
        let height = 1.5 + above;
        let ring = [[4.0, 0.0], [0.0, 3.0], [-4.0, 0.0], [0.0, -3.0], [4.0, 0.0]];
        let ring = ring.map(|[x, y]| [x, y, height]);
        let path = Path::catmull_rom(ring, Knots::Centripetal).unwrap();
        let motion = Motion::along(path, 2.0)
            .and_then(Motion::looping)
            .and_then(|motion| motion.facing(facing));
        let plane = Body::moving(Cuboid::new([0.7, 0.2, 0.5]).unwrap(), motion.unwrap());
        let found = first_contact(&plane, &floor, 10.0, &Method::Exact);
        assert_eq!(found.map(|found| found.is_some()), Ok(touches), "{above}");
    }
}

/// Bodies that change places: the same touch to the bit, but for which is first.
#[test]
fn exchanged_bodies_mirror_the_contact_to_the_bit() {
    let arch = [[-2.0, 2.0], [-2.0, -2.0], [2.0, -2.0], [2.0, 2.0]];
    let paths = [1.0, -1.0].map(|turn| {
        let point = |[x, y]: [f64; 2]| [turn * x, turn * (y + 0.5) - 0.5, 0.05 * x * y];
        Path::bezier(arch.map(point)).unwrap()
    });
    let cube = Cuboid::new([0.5, 0.4, 0.3]).unwrap();
    let hull = [
        [0.5, 0.0, 0.0],
        [0.0, 0.4, 0.1],
        [-0.3, 0.0, 0.2],
        [0.1, -0.2, 0.5],
    ];
    let shapes: [Shape; 3] = [
        Sphere::new(0.4).unwrap().into(),
        cube.into(),
        Polytope::from_points(hull).unwrap().into(),
    ];
    let mut met = 0;
    for (index, a) in shapes.iter().enumerate() {
        for (other, b) in shapes.iter().enumerate() {
            let body = |shape: &Shape, side: usize, rate: f64| {
                let motion = Motion::along(paths[side].clone(), 8.0 - 2.0 * side as f64).unwrap();
                let motion = if index + other == 0 {
                    Ok(motion)
                } else {
                    motion.spin([1.0, 2.0, 3.0], rate)
                };
                Body::moving(shape.clone(), motion.unwrap())
            };
            let rate = (index + other) as f64;
            let (a, b) = (body(a, 0, rate), body(b, 1, -0.5 * rate));
            let tell = |a: &Body, b: &Body| first_contact(a, b, 1.0, &Method::Exact).unwrap();
            let (Some(there), Some(back)) = (tell(&a, &b), tell(&b, &a)) else {
                continue;
            };
            met += 1;
            assert_eq!(there.fraction.to_bits(), back.fraction.to_bits());
            assert_eq!(there.normal, -back.normal);
            assert_eq!(there.point, back.point);
            assert_eq!(there.features, [back.features[1], back.features[0]]);
        }
    }
    assert!(met >= 6, "{met}");
}
