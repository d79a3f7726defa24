//! Whole frames of crowds, on one thread.
//!
//! 5 % of a cube is filled, 60 frames a second; walls throw bodies back, which is the
//! caller's work and not timed.

#![allow(clippy::unwrap_used, reason = "the scenes are known to be valid")]

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use feeler::{
    Body, BodyId, CollisionWorld, Cuboid, Motion, Polytope, QueryFilter, Ray, Shape, Sphere,
};
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use std::hint::black_box;
use std::time::{Duration, Instant};

const DT: f64 = 1.0 / 60.0;

#[derive(Clone, Copy, PartialEq)]
enum Crowd {
    Balls,
    Boxes,
    Hulls,
    Sizes,
    Cluster,
    Still,
    Fast,
}

fn unit(random: &mut ChaCha8Rng) -> f64 {
    (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

fn vector(random: &mut ChaCha8Rng) -> DVec3 {
    let mut coordinate = || 2.0 * unit(random) - 1.0;
    DVec3::new(coordinate(), coordinate(), coordinate())
}

/// A world, and what its caller knows of it.
struct Hall {
    world: CollisionWorld,
    half: f64,
    moving: Vec<(BodyId, DVec3, DVec3)>,
}

impl Hall {
    fn new(crowd: Crowd, count: usize) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let sizes: Vec<f64> = (0..count)
            .map(|_| match crowd {
                Crowd::Sizes => 2.0 * 10_f64.powf(-3.0 * unit(&mut random)),
                _ => 0.3 + 0.4 * unit(&mut random),
            })
            .collect();
        let volume: f64 = sizes.iter().map(|size| 4.19 * size.powi(3)).sum();
        let half = 0.5 * (volume / 0.05).cbrt();
        let mut hall = Self {
            world: CollisionWorld::default(),
            half,
            moving: Vec::new(),
        };
        for (number, size) in sizes.into_iter().enumerate() {
            let shape: Shape = match crowd {
                Crowd::Boxes => Cuboid::new(DVec3::splat(0.8 * size)).unwrap().into(),
                Crowd::Hulls => {
                    let points = (0..12).map(|_| size * vector(&mut random).normalize());
                    Polytope::from_points(points.collect::<Vec<_>>())
                        .unwrap()
                        .into()
                }
                _ => Sphere::new(size).unwrap().into(),
            };
            let mut place = half * vector(&mut random);
            if crowd == Crowd::Cluster {
                // 1 % of the space.
                place *= 0.01_f64.cbrt();
            }
            let speed = match crowd {
                Crowd::Still if !number.is_multiple_of(100) => 0.0,
                Crowd::Fast => 1000.0,
                _ => 10.0 * unit(&mut random),
            };
            let velocity = speed * vector(&mut random).normalize();
            let motion = if speed > 0.0 {
                Motion::free(place, velocity).unwrap()
            } else {
                Motion::fixed(place).unwrap()
            };
            let turn = DQuat::from_axis_angle(vector(&mut random).normalize(), 3.0);
            let body = Body::moving(shape, motion).oriented(turn);
            let id = hall.world.insert(body).unwrap();
            if speed > 0.0 {
                hall.moving.push((id, place, velocity));
            }
        }
        hall
    }

    /// The time that a frame takes.
    fn frame(&mut self) -> Duration {
        let start = Instant::now();
        black_box(self.world.step(DT).unwrap());
        let took = start.elapsed();
        for (id, place, velocity) in &mut self.moving {
            *place += DT * *velocity;
            let outside = place.abs().cmpgt(DVec3::splat(self.half));
            let inwards = DVec3::select(outside, -place.signum(), velocity.signum());
            let turned = velocity.abs() * inwards;
            if turned != *velocity {
                *velocity = turned;
                self.world.set_velocity(*id, turned).unwrap();
            }
        }
        took
    }
}

fn frames(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("frame");
    group.sample_size(10);
    let mut bench = |name: &str, crowd: Crowd, count: usize| {
        let mut hall = None;
        group.bench_function(BenchmarkId::new(name, count), |bencher| {
            let hall = hall.get_or_insert_with(|| Hall::new(crowd, count));
            bencher.iter_custom(|frames| (0..frames).map(|_| hall.frame()).sum());
        });
    };
    bench("balls", Crowd::Balls, 1_000);
    bench("balls", Crowd::Balls, 10_000);
    bench("balls", Crowd::Balls, 100_000);
    bench("boxes", Crowd::Boxes, 10_000);
    bench("12-point hulls", Crowd::Hulls, 10_000);
    bench("radii 1 : 1000", Crowd::Sizes, 10_000);
    bench("in 1 % of the space", Crowd::Cluster, 10_000);
    bench("99 % static", Crowd::Still, 100_000);
    bench("at 1000 m/s", Crowd::Fast, 10_000);
}

fn rays(criterion: &mut Criterion) {
    let mut hall = None;
    criterion.bench_function("rays ×1000 into 100000 balls", |bencher| {
        let hall = hall.get_or_insert_with(|| Hall::new(Crowd::Balls, 100_000));
        let mut random = ChaCha8Rng::seed_from_u64(2);
        let rays: Vec<Ray> = (0..1000)
            .map(|_| Ray::new(hall.half * vector(&mut random), vector(&mut random)))
            .collect();
        let all = QueryFilter::default();
        bencher.iter(|| hall.world.cast_rays(black_box(&rays), f64::INFINITY, &all));
    });
}

fn on_one_thread(criterion: &mut Criterion) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1);
    pool.build_global().unwrap();
    frames(criterion);
    rays(criterion);
}

criterion_group!(benches, on_one_thread);
criterion_main!(benches);
