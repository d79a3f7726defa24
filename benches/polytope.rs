//! Building hulls and finding their farthest vertices.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use feeler::Polytope;
use glam::DVec3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use std::hint::black_box;

const COUNTS: [usize; 7] = [12, 24, 40, 60, 100, 1000, 10_000];

fn on_sphere(rng: &mut ChaCha8Rng) -> DVec3 {
    let mut signed = || (rng.next_u64() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0;
    loop {
        let point = DVec3::new(signed(), signed(), signed());
        if (0.01..1.0).contains(&point.length_squared()) {
            return point.normalize();
        }
    }
}

fn from_points(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("polytope/from_points");
    for count in COUNTS {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let points: Vec<DVec3> = (0..count).map(|_| on_sphere(&mut rng)).collect();
        group.bench_function(BenchmarkId::from_parameter(count), |bencher| {
            bencher.iter(|| Polytope::from_points(black_box(&points).iter().copied()));
        });
    }
}

fn support(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("polytope/support");
    for count in COUNTS {
        let mut rng = ChaCha8Rng::seed_from_u64(2);
        let Ok(hull) = Polytope::from_points((0..count).map(|_| on_sphere(&mut rng))) else {
            continue;
        };
        let directions: Vec<DVec3> = (0..1024).map(|_| on_sphere(&mut rng)).collect();
        let mut next = 0;
        group.bench_function(BenchmarkId::from_parameter(count), |bencher| {
            bencher.iter(|| {
                next = (next + 1) % directions.len();
                hull.support(black_box(directions[next]))
            });
        });
    }
}

criterion_group!(benches, from_points, support);
criterion_main!(benches);
