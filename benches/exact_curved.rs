//! First contact on curves and in rotation, one pair at a time.

#![allow(clippy::unwrap_used, reason = "the scenes are fixed")]
#![allow(missing_docs, reason = "criterion's macros make public items")]

use criterion::{Criterion, criterion_group, criterion_main};
use feeler::{Body, Cuboid, Method, Motion, Path, Shape, Sphere, first_contact};
use glam::{DQuat, DVec3};
use std::hint::black_box;

fn arch(turn: f64) -> Path {
    let points = [[-2.0, 2.0], [-2.0, -2.0], [2.0, -2.0], [2.0, 2.0]];
    Path::bezier(points.map(|[x, y]| DVec3::new(turn * x, turn * (y + 0.5) - 0.5, 0.0))).unwrap()
}

fn along(shape: impl Into<Shape>, turn: f64) -> Body {
    Body::moving(shape, Motion::along(arch(turn), 8.0).unwrap())
}

fn along_slower(shape: impl Into<Shape>, turn: f64) -> Body {
    Body::moving(shape, Motion::along(arch(turn), 6.0).unwrap())
}

fn spinning(from: [f64; 3], velocity: [f64; 3], axis: [f64; 3], rate: f64) -> Body {
    let motion = Motion::free(from, velocity).and_then(|motion| motion.spin(axis, rate));
    Body::moving(Cuboid::new([0.5; 3]).unwrap(), motion.unwrap())
}

fn pairs(criterion: &mut Criterion) {
    let cube = Cuboid::new([0.5; 3]).unwrap();
    let ball = Sphere::new(0.5).unwrap();
    let bar = Motion::fixed([0.0; 3]).and_then(|motion| motion.spin([0.0, 0.0, 1.0], 6.0));
    let bar = Body::moving(Cuboid::new([2.0, 0.05, 0.05]).unwrap(), bar.unwrap());
    let place = 1.5 * DVec3::new(0.5_f64.sqrt(), 0.5_f64.sqrt(), 0.0);
    let mut group = criterion.benchmark_group("exact_curved");
    for (name, a, b) in [
        (
            "box on a Bézier, box",
            along(cube, 1.0),
            Body::fixed(cube, [0.0, -1.0, 0.0]),
        ),
        (
            "ball on a Bézier, ball",
            along(ball, 1.0),
            Body::fixed(ball, [0.0, -1.0, 0.0]),
        ),
        (
            "balls on two Béziers that meet",
            along(ball, 1.0),
            along_slower(ball, -1.0),
        ),
        (
            "balls on two Béziers that graze",
            along(ball, 1.0),
            along(ball, -1.0),
        ),
        (
            "ball on a Bézier, ball on a line",
            along(ball, 1.0),
            Body::moving(
                ball,
                Motion::free([0.0, 1.0, 0.0], [0.0, -4.0, 0.0]).unwrap(),
            ),
        ),
        (
            "box on a Bézier, turned box",
            along(cube, 1.0),
            Body::fixed(cube, [0.0, -1.0, 0.0]).oriented(DQuat::from_rotation_y(0.5)),
        ),
        (
            "boxes on two Béziers",
            along(cube, 1.0),
            along_slower(cube, -1.0),
        ),
        (
            "spinning bar, ball",
            bar,
            Body::fixed(Sphere::new(0.1).unwrap(), place),
        ),
        (
            "spinning boxes that meet",
            spinning([-2.0, 0.1, 0.2], [2.0, 0.0, 0.0], [1.0, 2.0, 3.0], 3.0),
            spinning([2.0, 0.0, 0.0], [-2.0, 0.0, 0.0], [3.0, -1.0, 1.0], 2.0),
        ),
        (
            "spinning boxes that pass",
            spinning([-2.0, 1.6, 0.2], [4.0, 0.0, 0.0], [1.0, 2.0, 3.0], 3.0),
            spinning([2.0, 0.0, 0.0], [-4.0, 0.0, 0.0], [3.0, -1.0, 1.0], 2.0),
        ),
        (
            "the same straight",
            spinning([-2.0, 0.1, 0.2], [2.0, 0.0, 0.0], [1.0, 2.0, 3.0], 0.0),
            spinning([2.0, 0.0, 0.0], [-2.0, 0.0, 0.0], [3.0, -1.0, 1.0], 0.0),
        ),
    ] {
        group.bench_function(name, |bencher| {
            bencher.iter(|| first_contact(black_box(&a), black_box(&b), 1.0, &Method::Exact));
        });
    }
    group.finish();
}

criterion_group!(benches, pairs);
criterion_main!(benches);
