//! Straight casts between shapes with flat faces, hits and misses mixed.

#![allow(clippy::expect_used, reason = "the shapes are given here")]
#![allow(missing_docs, reason = "criterion's macros document nothing")]

use criterion::{Criterion, criterion_group, criterion_main};
use feeler::narrow_phase::exact::flat_touch;
use feeler::{Cuboid, Polytope, Shape, Triangle};
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use std::hint::black_box;

fn signed(rng: &mut ChaCha8Rng) -> f64 {
    2.0 * ((rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64) - 1.0
}

fn direction(rng: &mut ChaCha8Rng) -> DVec3 {
    loop {
        let v = DVec3::new(signed(rng), signed(rng), signed(rng));
        if (0.1..1.0).contains(&v.length()) {
            return v.normalize();
        }
    }
}

fn turn(rng: &mut ChaCha8Rng) -> DQuat {
    DQuat::from_axis_angle(direction(rng), 3.0 * signed(rng))
}

fn hull(rng: &mut ChaCha8Rng, count: usize) -> Shape {
    let points: Vec<DVec3> = (0..count).map(|_| direction(rng)).collect();
    Polytope::from_points(points).expect("a hull").into()
}

fn crossings(criterion: &mut Criterion) {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let cuboid = Shape::from(Cuboid::new([0.5, 0.6, 0.7]).expect("a box"));
    let triangle = Shape::from(
        Triangle::new([-1.0, -0.5, 0.0], [1.0, -0.5, 0.0], [0.0, 1.0, 0.0]).expect("a triangle"),
    );
    let [hull12, hull100, hull1000] = [12, 100, 1000].map(|count| hull(&mut rng, count));
    let mut group = criterion.benchmark_group("exact flat");
    for (name, a, b) in [
        ("box-box", &cuboid, &cuboid),
        ("triangle-box", &triangle, &cuboid),
        ("triangle-triangle", &triangle, &triangle),
        ("hull12-box", &hull12, &cuboid),
        ("hull12-hull12", &hull12, &hull12),
        ("hull100-hull100", &hull100, &hull100),
        ("hull1000-hull1000", &hull1000, &hull1000),
    ] {
        let reach = a.max_dist() + b.max_dist();
        // Aimed within the bounding spheres: some half of them touch.
        let casts: Vec<(DQuat, DQuat, DVec3, DVec3)> = (0..256)
            .map(|_| {
                let from = 3.0 * reach * direction(&mut rng);
                let aim = 0.9 * reach * direction(&mut rng);
                (turn(&mut rng), turn(&mut rng), from, 2.0 * (aim - from))
            })
            .collect();
        let cast = |&(turn_a, turn_b, from, motion): &(DQuat, DQuat, DVec3, DVec3)| {
            flat_touch(black_box(a), turn_a, black_box(b), turn_b, from, motion)
        };
        let share = casts.iter().filter_map(cast).count() * 100 / casts.len();
        let mut next = 0;
        group.bench_function(format!("{name}, {share} % hit"), |bencher| {
            bencher.iter(|| {
                next = (next + 1) % casts.len();
                cast(&casts[next])
            });
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(std::time::Duration::from_millis(100))
        .measurement_time(std::time::Duration::from_millis(400));
    targets = crossings
}
criterion_main!(benches);
