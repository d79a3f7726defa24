//! A crowd's frames and batches of rays on one thread and on two.
//!
//! Both numbers of threads take turns, frame by frame, so that a host that changes its
//! speed is as fast for one as for the other; what is told is the time of one of them.

#![allow(clippy::unwrap_used, reason = "the scenes are known to be valid")]

#[path = "../examples/crowd/hall.rs"]
mod hall;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use feeler::{QueryFilter, Ray};
use glam::DVec3;
use hall::Hall;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use rayon::ThreadPool;
use std::hint::black_box;
use std::time::{Duration, Instant};

const DT: f64 = 1.0 / 60.0;
const BODIES: usize = 100_000;
const THREADS: [usize; 2] = [1, 2];

/// The work of each pool, one after the other, as often as asked for, of which one's time is told.
fn in_turns(
    pools: &[ThreadPool],
    (told, times): (usize, u64),
    mut work: impl FnMut(usize) -> Duration + Send,
) -> Duration {
    let mut sum = Duration::ZERO;
    for _ in 0..times {
        for (index, pool) in pools.iter().enumerate() {
            let took = pool.install(|| work(index));
            if index == told {
                sum += took;
            }
        }
    }
    sum
}

fn pools() -> Vec<ThreadPool> {
    let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    THREADS
        .into_iter()
        .map(|threads| pool(threads).unwrap())
        .collect()
}

fn vector(random: &mut ChaCha8Rng) -> DVec3 {
    let mut coordinate = || (random.next_u64() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0;
    DVec3::new(coordinate(), coordinate(), coordinate())
}

fn threads(criterion: &mut Criterion) {
    let pools = pools();
    // The same world for each pool, since a world's frames differ.
    let mut halls = None;
    let mut group = criterion.benchmark_group("threads");
    group.sample_size(10);
    for (told, threads) in THREADS.into_iter().enumerate() {
        group.bench_function(
            BenchmarkId::new("frame of 100000 balls", threads),
            |bencher| {
                let halls =
                    halls.get_or_insert_with(|| THREADS.map(|_| Hall::new(BODIES).unwrap()));
                bencher.iter_custom(|times| {
                    in_turns(&pools, (told, times), |index| {
                        let start = Instant::now();
                        black_box(halls[index].world.step(DT).unwrap());
                        let took = start.elapsed();
                        halls[index].reflect(DT).unwrap();
                        took
                    })
                });
            },
        );
    }
    let mut random = ChaCha8Rng::seed_from_u64(2);
    let rays: Vec<Ray> = (0..10_000)
        .map(|_| Ray::new(80.0 * vector(&mut random), vector(&mut random)))
        .collect();
    let all = QueryFilter::default();
    for (told, threads) in THREADS.into_iter().enumerate() {
        group.bench_function(BenchmarkId::new("10000 rays at them", threads), |bencher| {
            let halls = halls.get_or_insert_with(|| THREADS.map(|_| Hall::new(BODIES).unwrap()));
            bencher.iter_custom(|times| {
                in_turns(&pools, (told, times), |index| {
                    let start = Instant::now();
                    let hits = halls[index].world.cast_rays(&rays, f64::INFINITY, &all);
                    black_box(hits.unwrap());
                    start.elapsed()
                })
            });
        });
    }
}

criterion_group!(benches, threads);
criterion_main!(benches);
