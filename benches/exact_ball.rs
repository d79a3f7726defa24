//! A ball cast straight at every shape: hits and misses of one stream of drawn casts.

#![allow(
    missing_docs,
    clippy::unwrap_used,
    reason = "criterion's macro makes undocumented items; the shapes are known to be valid"
)]

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use feeler::narrow_phase::exact::{ball_ball, ball_crossing};
use feeler::{Cuboid, Polytope, Shape, Sphere, Triangle};
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use std::hint::black_box;

/// A power of two.
const COUNT: usize = 4096;

fn unit(random: &mut ChaCha8Rng) -> f64 {
    (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

fn cube(random: &mut ChaCha8Rng) -> DVec3 {
    DVec3::new(unit(random), unit(random), unit(random)) * 2.0 - 1.0
}

/// Position, orientation, motion; about half of them hit.
fn casts() -> Vec<(DVec3, DQuat, DVec3)> {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    (0..COUNT)
        .map(|_| {
            let from = 4.0 * cube(&mut random).normalize();
            let to = 1.2 * cube(&mut random);
            let axis = cube(&mut random).normalize();
            let turn = DQuat::from_axis_angle(axis, 6.0 * unit(&mut random));
            (from, turn, 2.0 * (to - from))
        })
        .collect()
}

fn hull(count: usize) -> Shape {
    let mut random = ChaCha8Rng::seed_from_u64(count as u64);
    let points = (0..count).map(|_| cube(&mut random).normalize());
    Polytope::from_points(points).unwrap().into()
}

fn exact_ball(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("exact ball");
    let casts = casts();
    let ball = Sphere::new(0.5).unwrap();
    group.bench_function("ball–ball", |bencher| {
        let mut next = 0;
        bencher.iter(|| {
            next = (next + 1) & (COUNT - 1);
            let (position, _, motion) = casts[next];
            ball_ball(black_box(0.5), 0.7, -position, motion)
        });
    });
    let shapes: [(&str, Shape); 6] = [
        ("box", Cuboid::new([0.5, 0.7, 0.9]).unwrap().into()),
        (
            "triangle",
            Triangle::new([-1.0, -1.0, 0.0], [1.0, -1.0, 0.2], [0.0, 1.0, 0.1])
                .unwrap()
                .into(),
        ),
        ("ball as a shape", Sphere::new(0.7).unwrap().into()),
        ("hull of 12", hull(12)),
        ("hull of 100", hull(100)),
        ("hull of 1000", hull(1000)),
    ];
    for (name, shape) in shapes {
        let cast = |&(position, turn, motion): &(DVec3, DQuat, DVec3)| {
            ball_crossing(&ball, position, black_box(&shape), turn, motion)
        };
        let hits = casts.iter().filter(|&c| cast(c).is_some()).count();
        let share = format!("{} % hit", 100 * hits / casts.len());
        group.bench_function(BenchmarkId::new(name, share), |bencher| {
            let mut next = 0;
            bencher.iter(|| {
                next = (next + 1) & (COUNT - 1);
                cast(&casts[next])
            });
        });
    }
    group.finish();
}

criterion_group!(benches, exact_ball);
criterion_main!(benches);
