//! Casts whose answers are known.

use crate::contender::{double, single};
use crate::draw::{Cast, Flyer, Form};
use crate::table;
use feeler::{Body, Cuboid, Method, Motion, Path, Shape, Sphere, first_contact};
use glam::{DQuat, DVec3};
use std::f64::consts::{FRAC_PI_4, PI};
use std::hint::black_box;
use std::time::Instant;

/// The best mean of several passes.
fn timed(run: impl Fn()) -> f64 {
    const RUNS: u32 = 200;
    let pass = |_| {
        let start = Instant::now();
        for _ in 0..RUNS {
            run();
        }
        start.elapsed().as_secs_f64() / f64::from(RUNS)
    };
    (0..20).map(pass).fold(f64::INFINITY, f64::min)
}

/// A bar that spins in its middle, and a ball that is in its way.
pub fn bars() {
    let mut rows = vec![
        [
            "radians in 1 s",
            "touch at",
            "feeler",
            "parry f64",
            "parry f32",
            "feeler's error",
        ]
        .map(String::from)
        .to_vec(),
    ];
    for rate in [3.0, PI, 6.0, 2.0 * PI, 12.0, 31.4, 1000.0] {
        let place = 1.5 * DVec3::new(FRAC_PI_4.cos(), FRAC_PI_4.sin(), 0.0);
        let flyer = |form, position, spin| Flyer {
            form,
            position,
            orientation: DQuat::IDENTITY,
            velocity: DVec3::ZERO,
            spin,
        };
        let bar = flyer(
            Form::Cuboid(DVec3::new(2.0, 0.05, 0.05)),
            DVec3::ZERO,
            rate * DVec3::Z,
        );
        let ball = flyer(Form::Ball(0.1), place, DVec3::ZERO);
        let cast = Cast {
            flyers: [bar, ball],
            size: 2.2,
        };
        let motion = Motion::fixed([0.0; 3]).and_then(|motion| motion.spin([0.0, 0.0, 1.0], rate));
        let bar = Cuboid::new([2.0, 0.05, 0.05]).expect("in range");
        let bar = Body::moving(bar, motion.expect("in range"));
        let ball = Body::fixed(Sphere::new(0.1).expect("in range"), place);
        let found = first_contact(&bar, &ball, 1.0, &Method::Exact)
            .ok()
            .flatten();
        let want = (FRAC_PI_4 - 0.1_f64.asin()) / rate;
        let told = |time: Option<f64>| time.map_or("none".into(), |time| format!("{time:.7} s"));
        let found = found.map(|found| found.fraction);
        rows.push(vec![
            format!("{rate:.3}"),
            told(Some(want)),
            told(found),
            told(double::cast(&double::ready(&cast)).map(|(time, _)| time)),
            told(single::cast(&single::ready(&cast)).map(|(time, _)| time)),
            table::length(found.map(|found| (found - want).abs())),
        ]);
    }
    table::print(&rows);
}

/// What nobody else casts, and a spinning pair beside.
pub fn curves() {
    let arch = |turn: f64| {
        let points = [[-2.0, 2.0], [-2.0, -2.0], [2.0, -2.0], [2.0, 2.0]];
        Path::bezier(points.map(|[x, y]| DVec3::new(turn * x, turn * (y + 0.5) - 0.5, 0.0)))
    };
    let along = |shape: Shape, turn: f64| {
        let motion = arch(turn)
            .ok()
            .and_then(|path| Motion::along(path, 8.0).ok());
        Body::moving(shape, motion.expect("in range"))
    };
    let cube: Shape = Cuboid::new([0.5; 3]).expect("in range").into();
    let ball: Shape = Sphere::new(0.5).expect("in range").into();
    let spinning = |x: f64, speed: f64, spin: DVec3| Flyer {
        form: Form::Cuboid(DVec3::splat(0.5)),
        position: DVec3::new(x, 0.1, 0.25),
        orientation: DQuat::IDENTITY,
        velocity: DVec3::new(speed, 0.0, 0.0),
        spin,
    };
    let cast = Cast {
        flyers: [
            spinning(-2.0, 2.0, DVec3::new(0.75, 1.5, 2.25)),
            spinning(2.0, -2.0, DVec3::new(1.75, -0.5, 0.5)),
        ],
        size: 1.75,
    };
    let spinners = cast.flyers.each_ref().map(|flyer| {
        let motion = Motion::free(flyer.position, flyer.velocity)
            .and_then(|motion| motion.spin(flyer.spin, flyer.spin.length()));
        Body::moving(cube.clone(), motion.expect("in range"))
    });
    let feeler = |a: &Body, b: &Body| {
        timed(|| {
            let _ = black_box(first_contact(
                black_box(a),
                black_box(b),
                1.0,
                &Method::Exact,
            ));
        })
    };
    let fixed = Body::fixed(cube.clone(), [0.0, -1.0, 0.0]);
    let (in_double, in_single) = (double::ready(&cast), single::ready(&cast));
    let rows = [
        (
            "one pair",
            [
                Some("feeler".to_owned()),
                Some("parry f64".into()),
                Some("parry f32".into()),
            ],
        ),
        (
            "box on a Bézier, box",
            [
                Some(table::duration(feeler(&along(cube.clone(), 1.0), &fixed))),
                None,
                None,
            ],
        ),
        (
            "balls on two Béziers",
            [
                Some(table::duration(feeler(
                    &along(ball.clone(), 1.0),
                    &along(ball, -1.0),
                ))),
                None,
                None,
            ],
        ),
        (
            "spinning box–box",
            [
                Some(table::duration(feeler(&spinners[0], &spinners[1]))),
                Some(table::duration(timed(|| {
                    black_box(double::cast(black_box(&in_double)));
                }))),
                Some(table::duration(timed(|| {
                    black_box(single::cast(black_box(&in_single)));
                }))),
            ],
        ),
    ];
    let rows: Vec<Vec<String>> = rows
        .into_iter()
        .map(|(name, cells)| {
            let cells = cells.into_iter().map(|cell| cell.unwrap_or("–".into()));
            [name.to_owned()].into_iter().chain(cells).collect()
        })
        .collect();
    table::print(&rows);
}
