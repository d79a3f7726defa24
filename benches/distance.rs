//! Distances of pairs: in full, and between bounds, cold and from what the last search kept.

#![allow(missing_docs, reason = "criterion's macros make an undocumented item")]
#![allow(clippy::expect_used, reason = "fixed inputs")]

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use feeler::narrow_phase::distance::{Separator, closest_points};
use feeler::{Cuboid, Polytope, Pose, Shape, Sphere, Triangle};
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use std::hint::black_box;

/// Bounds within this share are what conservative advancement asks for.
const TOLERANCE: f64 = 1e-3;

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

fn distances(criterion: &mut Criterion) {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let sphere = Shape::from(Sphere::new(1.0).expect("a sphere"));
    let cuboid = Shape::from(Cuboid::new([0.5, 0.6, 0.7]).expect("a box"));
    let triangle = Shape::from(
        Triangle::new([-1.0, -0.5, 0.0], [1.0, -0.5, 0.0], [0.0, 1.0, 0.0]).expect("a triangle"),
    );
    let [hull12, hull100, hull1000] = [12, 100, 1000].map(|count| hull(&mut rng, count));
    let mut group = criterion.benchmark_group("distance");
    for (name, a, b) in [
        ("sphere-sphere", &sphere, &sphere),
        ("sphere-box", &sphere, &cuboid),
        ("sphere-hull1000", &sphere, &hull1000),
        ("box-box", &cuboid, &cuboid),
        ("triangle-triangle", &triangle, &triangle),
        ("hull12-hull12", &hull12, &hull12),
        ("hull100-hull100", &hull100, &hull100),
        ("hull1000-hull1000", &hull1000, &hull1000),
    ] {
        let reach = 1.2 * (a.max_dist() + b.max_dist());
        let poses: Vec<(Pose, Pose)> = (0..64)
            .map(|_| (pose(&mut rng, reach), pose(&mut rng, 0.0)))
            .collect();
        let mut next = 0;
        group.bench_function(BenchmarkId::new(name, "points"), |bencher| {
            bencher.iter(|| {
                next = (next + 1) % poses.len();
                let (pose_a, pose_b) = &poses[next];
                closest_points(black_box(a), pose_a, black_box(b), pose_b)
            });
        });
        let separators: Vec<Separator> = (poses.iter())
            .map(|(pose_a, pose_b)| Separator::new(a, pose_a.orientation, b, pose_b.orientation))
            .collect();
        group.bench_function(BenchmarkId::new(name, "cold"), |bencher| {
            bencher.iter(|| {
                next = (next + 1) % poses.len();
                let mut separator = separators[next].clone();
                separator.separation(poses[next].0.position, TOLERANCE)
            });
        });
        // Each pair by steps of a hundredth of its distance to and fro, and by turns of as much.
        let mut kept = separators.clone();
        let mut count = 0_usize;
        group.bench_function(BenchmarkId::new(name, "warm, moved"), |bencher| {
            bencher.iter(|| {
                count += 1;
                let index = count / 64 % poses.len();
                let share = 1.0 - 0.004 * (count % 64) as f64;
                kept[index].separation(share * poses[index].0.position, TOLERANCE)
            });
        });
        let mut kept = separators.clone();
        group.bench_function(BenchmarkId::new(name, "warm, turned"), |bencher| {
            bencher.iter(|| {
                count += 1;
                let index = count / 64 % poses.len();
                let (pose_a, pose_b) = &poses[index];
                let sine = 0.01 * (count % 64) as f64;
                let turn = DQuat::from_xyzw(0.0, 0.0, sine, (1.0 - sine * sine).sqrt());
                kept[index].turn(turn * pose_a.orientation, pose_b.orientation);
                kept[index].separation(pose_a.position, TOLERANCE)
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
        .measurement_time(std::time::Duration::from_millis(300));
    targets = distances
}
criterion_main!(benches);
