//! Overlap of two shapes, overlapping and apart.

#![allow(clippy::expect_used, reason = "the shapes are given here")]
#![allow(missing_docs, reason = "criterion's macros document nothing")]

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use feeler::{Cuboid, Polytope, Pose, Shape, Sphere, Triangle, overlap};
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

fn pose(rng: &mut ChaCha8Rng, distance: f64) -> Pose {
    let turn = DQuat::from_axis_angle(direction(rng), 3.0 * signed(rng));
    Pose::new(distance * direction(rng), turn)
}

fn hull(rng: &mut ChaCha8Rng, count: usize) -> Shape {
    let points: Vec<DVec3> = (0..count).map(|_| direction(rng)).collect();
    Polytope::from_points(points).expect("a hull").into()
}

fn overlaps(criterion: &mut Criterion) {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let sphere = Shape::from(Sphere::new(1.0).expect("a sphere"));
    let cuboid = Shape::from(Cuboid::new([0.5, 0.6, 0.7]).expect("a box"));
    let triangle = Shape::from(
        Triangle::new([-1.0, -0.5, 0.0], [1.0, -0.5, 0.0], [0.0, 1.0, 0.0]).expect("a triangle"),
    );
    let [hull12, hull100, hull1000] = [12, 100, 1000].map(|count| hull(&mut rng, count));
    let mut group = criterion.benchmark_group("overlap");
    for (name, a, b) in [
        ("sphere-sphere", &sphere, &sphere),
        ("sphere-box", &sphere, &cuboid),
        ("sphere-hull1000", &sphere, &hull1000),
        ("box-box", &cuboid, &cuboid),
        ("triangle-box", &triangle, &cuboid),
        ("hull12-hull12", &hull12, &hull12),
        ("hull100-hull100", &hull100, &hull100),
        ("hull1000-hull1000", &hull1000, &hull1000),
    ] {
        let reach = a.max_dist() + b.max_dist();
        for (place, share) in [("apart", 1.01), ("shallow", 0.8), ("deep", 0.1)] {
            let poses: Vec<(Pose, Pose)> = (0..64)
                .map(|_| (pose(&mut rng, share * reach), pose(&mut rng, 0.0)))
                .collect();
            let mut next = 0;
            group.bench_function(BenchmarkId::new(name, place), |bencher| {
                bencher.iter(|| {
                    next = (next + 1) % poses.len();
                    let (pose_a, pose_b) = &poses[next];
                    overlap(black_box(a), pose_a, black_box(b), pose_b)
                });
            });
        }
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(std::time::Duration::from_millis(100))
        .measurement_time(std::time::Duration::from_millis(400));
    targets = overlaps
}
criterion_main!(benches);
