//! A ball cast straight at every shape; each figure is one cast, the mean over hits and misses.

#![allow(missing_docs, reason = "criterion's macro makes undocumented items")]

#[allow(dead_code, reason = "each bench needs a part of it")]
mod draw;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use draw::{COUNT, Cast, Draw};
use feeler::Sphere;
use feeler::narrow_phase::exact::{ball_crossing, ball_touch};
use std::hint::black_box;

fn exact_ball(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("exact ball");
    for name in ["ball", "box", "triangle", "hull12", "hull100", "hull1000"] {
        let casts: Vec<(Sphere, Cast)> = (Draw::new(1).casts(name, true).into_iter())
            .filter_map(|cast| Some((Sphere::new(cast.radius).ok()?, cast)))
            .collect();
        let touch = |(ball, cast): &(Sphere, Cast)| {
            let position = cast.position - cast.pose.position;
            ball_touch(
                ball,
                position,
                &cast.shape,
                cast.pose.orientation,
                cast.motion,
            )
        };
        let crossing = |(ball, cast): &(Sphere, Cast)| {
            let position = cast.position - cast.pose.position;
            ball_crossing(
                ball,
                position,
                &cast.shape,
                cast.pose.orientation,
                cast.motion,
            )
        };
        let hits = casts.iter().filter(|cast| touch(cast).is_some()).count();
        let share = format!("{} % hit", 100 * hits / casts.len());
        group.bench_function(BenchmarkId::new(name, share), |bencher| {
            let mut next = 0;
            bencher.iter(|| {
                next = (next + 1) & (COUNT - 1);
                touch(black_box(&casts[next]))
            });
        });
        group.bench_function(BenchmarkId::new(name, "and out again"), |bencher| {
            let mut next = 0;
            bencher.iter(|| {
                next = (next + 1) & (COUNT - 1);
                crossing(black_box(&casts[next]))
            });
        });
    }
    group.finish();
}

criterion_group!(benches, exact_ball);
criterion_main!(benches);
