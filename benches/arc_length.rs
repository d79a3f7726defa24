//! Splines: building them, and looking places up by distance.

#![allow(
    missing_docs,
    clippy::expect_used,
    reason = "criterion's macro makes undocumented items; the input is fixed and fine"
)]

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use feeler::{ArcLengthTable, Spline};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use std::hint::black_box;

fn unit(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

fn points(count: usize) -> Vec<[f64; 3]> {
    let mut rng = ChaCha8Rng::seed_from_u64(count as u64);
    let mut coordinate = || 100.0 * unit(&mut rng);
    (0..count)
        .map(|_| [coordinate(), coordinate(), coordinate()])
        .collect()
}

fn spline(count: usize) -> Spline {
    Spline::through(points(count), [50.0, 0.0, 0.0], [0.0, 50.0, 0.0]).expect("the points are fine")
}

fn arc_length(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("arc_length");
    for count in [4, 100, 10_000] {
        let spline = spline(count);
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let distances: Vec<f64> = (0..4096)
            .map(|_| spline.length() * unit(&mut rng))
            .collect();
        let mut next = 0;
        let mut distance = || {
            next = (next + 1) % distances.len();
            distances[next]
        };
        group.bench_function(BenchmarkId::new("locate", count), |bencher| {
            bencher.iter(|| black_box(&spline).locate(distance()));
        });
        group.bench_function(BenchmarkId::new("position", count), |bencher| {
            bencher.iter(|| black_box(&spline).position_at(distance()));
        });
        // As bodies fly: a little farther every time, and round again.
        let mut flown = 0.0;
        let ahead = 0.037 * spline.length() / count as f64;
        let mut onward = || {
            flown += ahead;
            if flown > spline.length() {
                flown = 0.0;
            }
            flown
        };
        group.bench_function(BenchmarkId::new("frames", count), |bencher| {
            bencher.iter(|| black_box(&spline).position_at(onward()));
        });
        let table = ArcLengthTable::from_spline(&spline, 10).expect("ten steps are fine");
        group.bench_function(BenchmarkId::new("table", count), |bencher| {
            bencher.iter(|| black_box(&table).locate(distance()));
        });
        let points = points(count);
        group.bench_function(BenchmarkId::new("build", count), |bencher| {
            bencher.iter(|| {
                Spline::through(
                    black_box(&points).iter().copied(),
                    [50.0, 0.0, 0.0],
                    [0.0; 3],
                )
            });
        });
    }
    group.finish();
}

criterion_group!(benches, arc_length);
criterion_main!(benches);
