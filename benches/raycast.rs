//! Rays against each shape; each figure is one cast.
//!
//! "hits" aim at a point within half the shape's size of its middle, "mixed" at one within
//! twice its size, of which some two thirds miss.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use feeler::{Cuboid, Polytope, Pose, Ray, RayCast, Shape, Sphere, Triangle};
use glam::DVec3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use std::hint::black_box;

fn unit(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

fn ball(rng: &mut ChaCha8Rng) -> DVec3 {
    loop {
        let point = DVec3::from_array(std::array::from_fn(|_| 2.0 * unit(rng) - 1.0));
        if point.length_squared() <= 1.0 {
            return point;
        }
    }
}

fn rays(aim: f64) -> Vec<Ray> {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    (0..1024)
        .map(|_| {
            let origin = 4.0 * ball(&mut rng).normalize_or(DVec3::X);
            Ray::new(origin, aim * ball(&mut rng) - origin)
        })
        .collect()
}

fn shapes() -> Vec<(&'static str, Shape)> {
    let mut all: Vec<(&'static str, Shape)> = Vec::new();
    all.extend(Sphere::new(1.0).ok().map(|s| ("sphere", s.into())));
    all.extend(
        Cuboid::new([0.6, 0.6, 0.6])
            .ok()
            .map(|s| ("cuboid", s.into())),
    );
    let triangle = Triangle::new([-1.0, -0.8, 0.0], [1.0, -0.8, 0.1], [0.0, 1.0, 0.2]);
    all.extend(triangle.ok().map(|s| ("triangle", s.into())));
    for (name, count) in [("hull12", 12), ("hull100", 100), ("hull1000", 1000)] {
        let mut rng = ChaCha8Rng::seed_from_u64(2);
        let points = (0..count).map(|_| ball(&mut rng).normalize_or(DVec3::X));
        all.extend(Polytope::from_points(points).ok().map(|p| (name, p.into())));
    }
    all
}

fn raycast(criterion: &mut Criterion) {
    let (hits, mixed) = (rays(0.5), rays(2.0));
    let mut group = criterion.benchmark_group("raycast");
    for (name, shape) in shapes() {
        for (mix, rays) in [("hits", &hits), ("mixed", &mixed)] {
            let mut next = (0..rays.len()).cycle();
            group.bench_function(BenchmarkId::new(name, mix), |bencher| {
                bencher.iter(|| {
                    let ray = next.next().map(|index| &rays[index]);
                    ray.and_then(|ray| shape.first_hit(black_box(ray)))
                });
            });
        }
        let pose = Pose::new([0.1, 0.0, 0.0], glam::DQuat::from_rotation_y(0.3));
        let mut next = (0..mixed.len()).cycle();
        group.bench_function(BenchmarkId::new(name, "posed"), |bencher| {
            bencher.iter(|| {
                let ray = next.next().map(|index| &mixed[index]);
                ray.and_then(|ray| shape.first_hit_at(black_box(&pose), ray))
            });
        });
    }
    group.finish();
}

criterion_group!(benches, raycast);
criterion_main!(benches);
