//! Bodies that run beside each other a nanometre apart, or slide in touch, beside ordinary queries.
//!
//! Each goes on for as long as it takes to circle a few times; what is told is the time of the whole query.

#![allow(clippy::unwrap_used, reason = "the scenes are fixed")]
#![allow(missing_docs, reason = "criterion's macros make public items")]

use criterion::{Criterion, criterion_group, criterion_main};
use feeler::{Body, Cuboid, Facing, Knots, Method, Motion, Path, Shape, Sphere, first_contact};
use glam::DVec3;
use std::hint::black_box;

const NANOMETRE: f64 = 1e-9;

fn winding(y: f64) -> Motion {
    let points = [
        [0.0, y, 0.0],
        [3.0, y + 2.0, 1.0],
        [6.0, y, 3.0],
        [9.0, y - 5.0, 0.0],
    ];
    let path = Path::catmull_rom(points, Knots::Uniform).unwrap();
    Motion::along(path, 1.0).unwrap()
}

/// Around on a floor, so high above it.
fn circling(above: f64) -> Motion {
    let corners = [[4.0, 0.0], [0.0, 4.0], [-4.0, 0.0], [0.0, -4.0], [4.0, 0.0]];
    let points = corners.map(|[x, y]| DVec3::new(x, y, 1.5 + above));
    let path = Path::catmull_rom(points, Knots::Uniform).unwrap();
    Motion::along(path, 5.0).unwrap().looping().unwrap()
}

fn spun(motion: Motion) -> Motion {
    motion.spin([0.0, 0.0, 1.0], 3.0).unwrap()
}

fn pairs(criterion: &mut Criterion) {
    let cube = Cuboid::new([0.5; 3]).unwrap();
    let ball = Sphere::new(0.5).unwrap();
    let body = |shape: Shape, motion: Motion| Body::moving(shape, motion);
    let floor = || Body::fixed(Cuboid::new([9.0, 9.0, 1.0]).unwrap(), [0.0; 3]);
    let ahead = || Body::fixed(cube, [6.0, 0.3, 3.4]);
    let nose = Facing {
        forward: DVec3::X,
        up: DVec3::Z,
        world_up: DVec3::Z,
    };
    let facing = |motion: Motion| motion.facing(nose).unwrap();
    let mut group = criterion.benchmark_group("exact_sliding");
    for (name, a, b) in [
        (
            "ordinary: box on a curve, box",
            body(cube.into(), winding(0.0)),
            ahead(),
        ),
        (
            "ordinary: box spinning on a curve, box",
            body(cube.into(), spun(winding(0.0))),
            ahead(),
        ),
        (
            "ordinary: box facing along a curve, box",
            body(cube.into(), facing(winding(0.0))),
            ahead(),
        ),
        (
            "balls side by side",
            body(ball.into(), winding(0.0)),
            body(ball.into(), winding(1.0 + NANOMETRE)),
        ),
        (
            "balls in touch side by side",
            body(ball.into(), winding(0.0)),
            body(ball.into(), winding(1.0)),
        ),
        (
            "box over a floor",
            body(cube.into(), circling(NANOMETRE)),
            floor(),
        ),
        ("box on a floor", body(cube.into(), circling(0.0)), floor()),
        (
            "box turning over a floor",
            body(cube.into(), spun(circling(NANOMETRE))),
            floor(),
        ),
        (
            "box turning on a floor",
            body(cube.into(), spun(circling(0.0))),
            floor(),
        ),
        (
            "box facing its way over a floor",
            body(cube.into(), facing(circling(NANOMETRE))),
            floor(),
        ),
        (
            "box facing its way on a floor",
            body(cube.into(), facing(circling(0.0))),
            floor(),
        ),
    ] {
        group.bench_function(name, |bencher| {
            bencher.iter(|| first_contact(black_box(&a), black_box(&b), 10.0, &Method::Exact));
        });
    }
    group.finish();
}

criterion_group!(benches, pairs);
criterion_main!(benches);
