//! Whole frames of the same crowd on straight paths, on splines, and spinning, on one thread.
//!
//! 5 % of a cube is filled, 60 frames a second. A body flies to and fro at constant speed between two
//! places, straight or by way of a third one beside; those that spin turn once a second or so.

#![allow(clippy::unwrap_used, reason = "the scenes are known to be valid")]

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use feeler::{Body, CollisionWorld, Cuboid, Knots, Motion, Path, Shape, Sphere};
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use std::hint::black_box;

const DT: f64 = 1.0 / 60.0;

#[derive(Clone, Copy, PartialEq)]
enum Way {
    Straight,
    Curved,
    StraightSpinning,
    CurvedSpinning,
}

fn unit(random: &mut ChaCha8Rng) -> f64 {
    (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

fn vector(random: &mut ChaCha8Rng) -> DVec3 {
    let mut coordinate = || 2.0 * unit(random) - 1.0;
    DVec3::new(coordinate(), coordinate(), coordinate())
}

fn crowd(way: Way, boxes: bool, count: usize) -> CollisionWorld {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let sizes: Vec<f64> = (0..count).map(|_| 0.3 + 0.4 * unit(&mut random)).collect();
    let volume: f64 = sizes.iter().map(|size| 4.19 * size.powi(3)).sum();
    let half = 0.5 * (volume / 0.05).cbrt();
    let mut world = CollisionWorld::default();
    for size in sizes {
        let shape: Shape = if boxes {
            Cuboid::new(DVec3::splat(0.8 * size)).unwrap().into()
        } else {
            Sphere::new(size).unwrap().into()
        };
        let from = half * vector(&mut random);
        let to = (from + 10.0 * vector(&mut random)).clamp(DVec3::splat(-half), DVec3::splat(half));
        let beside = 0.5 * (from + to) + 2.0 * vector(&mut random);
        let path = match way {
            Way::Straight | Way::StraightSpinning => Path::line(from, to),
            Way::Curved | Way::CurvedSpinning => {
                Path::catmull_rom([from, beside, to], Knots::Centripetal)
            }
        };
        let speed = 1.0 + 9.0 * unit(&mut random);
        let motion = Motion::along(path.unwrap(), speed).and_then(Motion::back_and_forth);
        let axis = vector(&mut random);
        let motion = motion.and_then(|motion| match way {
            Way::Straight | Way::Curved => Ok(motion),
            Way::StraightSpinning | Way::CurvedSpinning => motion.spin(axis, 6.0),
        });
        let turn = DQuat::from_axis_angle(vector(&mut random).normalize(), 3.0);
        let body = Body::moving(shape, motion.unwrap()).oriented(turn);
        world.insert(body).unwrap();
    }
    world
}

fn frames(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("frame_curved");
    group.sample_size(20);
    for (boxes, name) in [(false, "balls"), (true, "boxes")] {
        for (way, how) in [
            (Way::Straight, "on straights"),
            (Way::Curved, "on splines"),
            (Way::StraightSpinning, "spinning on straights"),
            (Way::CurvedSpinning, "spinning on splines"),
        ] {
            for count in [1_000, 10_000] {
                let mut world = None;
                group.bench_function(
                    BenchmarkId::new(format!("{name} {how}"), count),
                    |bencher| {
                        let world = world.get_or_insert_with(|| crowd(way, boxes, count));
                        bencher.iter(|| black_box(world.step(DT).unwrap().len()));
                    },
                );
            }
        }
    }
    group.finish();
}

fn on_one_thread(criterion: &mut Criterion) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1);
    pool.build_global().unwrap();
    frames(criterion);
}

criterion_group!(benches, on_one_thread);
criterion_main!(benches);
