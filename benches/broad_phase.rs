//! Early-outs, box against box, and whole pair lists.

#![allow(clippy::unwrap_used, reason = "the scenes are known to be valid")]

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use feeler::broad_phase::{
    BroadPhase, ObbTest, PairList, Volume, obb_overlap_by_axes, obb_overlap_by_rays,
};
use feeler::early_out::reject;
use feeler::sweep::{along_line, around_static};
use feeler::{Cuboid, Obb, Pose};
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use std::hint::black_box;

fn vector(random: &mut ChaCha8Rng) -> DVec3 {
    let mut unit = || (random.next_u64() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0;
    DVec3::new(unit(), unit(), unit())
}

/// A resting box or a moving one: the thesis's two halves, a few metres each way
/// in a hall that leaves every body about the same room.
fn volume(random: &mut ChaCha8Rng, bodies: usize, moving: bool) -> Volume {
    let from = 4.0 * (bodies as f64).cbrt() * vector(random);
    let obb = if moving {
        along_line(from, from + 6.0 * vector(random), DVec3::ZERO, 1.0)
    } else {
        let cuboid = Cuboid::new(DVec3::splat(0.2) + vector(random).abs()).unwrap();
        let axis = vector(random).normalize();
        let orientation = DQuat::from_axis_angle(axis, random.next_u32() as f64);
        around_static(&cuboid.into(), &Pose::new(from, orientation))
    };
    Volume {
        obb: Some(obb),
        moving,
    }
}

fn volumes(bodies: usize) -> Vec<Option<Volume>> {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    (0..bodies)
        .map(|slot| Some(volume(&mut random, bodies, slot % 2 == 0)))
        .collect()
}

fn early_out(criterion: &mut Criterion) {
    let mut random = ChaCha8Rng::seed_from_u64(2);
    let cases: Vec<_> = (0..1000)
        .map(|_| (5.0 * vector(&mut random), 5.0 * vector(&mut random)))
        .collect();
    criterion.bench_function("early-out ×1000", |bencher| {
        bencher.iter(|| {
            black_box(&cases)
                .iter()
                .filter(|(between, motion)| reject(*between, *motion, 1.0).is_some())
                .count()
        });
    });
}

/// Boxes that overlap, that are close, and that are far apart.
fn box_pairs(spread: f64) -> Vec<(Obb, Obb)> {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let mut one = || {
        let axis = vector(&mut random).normalize();
        let turn = DQuat::from_axis_angle(axis, random.next_u32() as f64);
        Obb {
            centre: spread * vector(&mut random),
            axes: [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| turn * axis),
            half_extents: DVec3::splat(0.2) + vector(&mut random).abs(),
        }
    };
    (0..1000).map(|_| (one(), one())).collect()
}

fn overlap(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("box–box ×1000");
    for (name, spread) in [("overlapping", 0.3), ("close", 1.2), ("far", 6.0)] {
        let pairs = box_pairs(spread);
        let mut bench = |test: &str, overlap: &dyn Fn(&Obb, &Obb) -> bool| {
            group.bench_function(BenchmarkId::new(test, name), |bencher| {
                let pairs = black_box(&pairs).iter();
                bencher.iter(|| pairs.clone().filter(|(a, b)| overlap(a, b)).count());
            });
        };
        bench("axes", &obb_overlap_by_axes);
        bench("16 rays", &|a, b| obb_overlap_by_rays(a, b, 16, 10));
    }
}

fn lists(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("swept-OBB list");
    group.sample_size(20);
    for bodies in [100, 500, 2000] {
        let volumes = volumes(bodies);
        group.bench_function(BenchmarkId::new("axes", bodies), |bencher| {
            bencher
                .iter(|| PairList::build(BroadPhase::SweptObb(ObbTest::Axes), black_box(&volumes)));
        });
        let rays = BroadPhase::SweptObb(ObbTest::Rays { rays: 16, seed: 10 });
        group.bench_function(BenchmarkId::new("16 rays", bodies), |bencher| {
            bencher.iter(|| PairList::build(rays, black_box(&volumes)));
        });
        group.bench_function(BenchmarkId::new("all pairs", bodies), |bencher| {
            bencher.iter(|| PairList::build(BroadPhase::AllPairs, black_box(&volumes)));
        });
        let mut pairs = PairList::build(BroadPhase::SweptObb(ObbTest::Axes), &volumes);
        group.bench_function(BenchmarkId::new("one changed", bodies), |bencher| {
            bencher.iter(|| pairs.update(black_box(&[7]), black_box(&volumes)));
        });
    }
}

criterion_group!(benches, early_out, overlap, lists);
criterion_main!(benches);
