//! Rays against each shape; each figure is one cast, the mean over hits and misses.

#![allow(missing_docs, reason = "criterion's macro makes undocumented items")]

#[allow(dead_code, reason = "each bench needs a part of it")]
mod draw;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use draw::{COUNT, Cast, Draw};
use feeler::{Ray, RayCast};
use std::hint::black_box;

fn raycast(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("raycast");
    for name in ["ball", "box", "triangle", "hull12", "hull100", "hull1000"] {
        let casts: Vec<(Ray, Cast)> = (Draw::new(1).casts(name, false).into_iter())
            .map(|cast| (Ray::new(cast.position, cast.motion), cast))
            .collect();
        let hit = |(ray, cast): &(Ray, Cast)| cast.shape.first_hit_at(&cast.pose, ray);
        let span = |(ray, cast): &(Ray, Cast)| cast.shape.line_span_at(&cast.pose, ray);
        let hits = casts.iter().filter(|cast| hit(cast).is_some()).count();
        let share = format!("{} % hit", 100 * hits / casts.len());
        group.bench_function(BenchmarkId::new(name, share), |bencher| {
            let mut next = 0;
            bencher.iter(|| {
                next = (next + 1) & (COUNT - 1);
                hit(black_box(&casts[next]))
            });
        });
        group.bench_function(BenchmarkId::new(name, "and out again"), |bencher| {
            let mut next = 0;
            bencher.iter(|| {
                next = (next + 1) & (COUNT - 1);
                span(black_box(&casts[next]))
            });
        });
    }
    group.finish();
}

criterion_group!(benches, raycast);
criterion_main!(benches);
