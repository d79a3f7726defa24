//! Rays against time: a whole frame of the thesis's two timing scenes, at the
//! frame in which most bodies meet.
//!
//! Source: the thesis, tables 4.9 and 4.10.

#![allow(clippy::print_stderr, reason = "a bench that cannot set up says why")]
#![allow(missing_docs, reason = "criterion makes a public function")]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use feeler::{
    Body, BroadPhase, CollisionWorld, Method, Motion, Path, RayConfig, Sphere, WorldConfig,
};
use glam::DVec3;
use std::error::Error;
use std::hint::black_box;

const FRAME: f64 = 1.0 / 24.0;
const RAYS: [u32; 5] = [1, 10, 100, 400, 1000];

fn ball(from: DVec3, to: DVec3) -> Result<Body, Box<dyn Error>> {
    Ok(Body::moving(
        Sphere::new(1.0)?,
        Motion::along(Path::line(from, to)?, 1.0)?,
    ))
}

/// Scene 10: twenty balls from the corners and edge midpoints of a cube to its middle.
fn scene_10() -> Result<Vec<Body>, Box<dyn Error>> {
    let mut bodies = Vec::new();
    for x in -1..=1 {
        for y in -1..=1 {
            for z in -1..=1_i32 {
                let zeros = [x, y, z].iter().filter(|&&side| side == 0).count();
                if zeros <= 1 {
                    let from = 10.0 * DVec3::new(f64::from(x), f64::from(y), f64::from(z));
                    bodies.push(ball(from, DVec3::ZERO)?);
                }
            }
        }
    }
    Ok(bodies)
}

/// Scene 11: two columns of six balls that pass through each other.
fn scene_11() -> Result<Vec<Body>, Box<dyn Error>> {
    let mut bodies = Vec::new();
    for row in 0..6 {
        for (side, top) in [(-10.0, 7.5), (10.0, 9.0)] {
            let y = top - 3.0 * f64::from(row);
            bodies.push(ball(DVec3::new(side, y, 0.0), DVec3::new(-side, y, 0.0))?);
        }
    }
    Ok(bodies)
}

/// Time of the frame in which most rays are cast.
fn busiest(bodies: &[Body], config: WorldConfig) -> Result<f64, Box<dyn Error>> {
    let mut world = world(bodies, config)?;
    let (mut time, mut most) = (0.0, 0);
    for _ in 0..480 {
        let before = world.time();
        world.step(FRAME)?;
        if world.stats().rays > most {
            (time, most) = (before, world.stats().rays);
        }
    }
    Ok(time)
}

fn world(bodies: &[Body], config: WorldConfig) -> Result<CollisionWorld, Box<dyn Error>> {
    let mut world = CollisionWorld::new(config)?;
    for body in bodies {
        world.insert(body.clone())?;
    }
    Ok(world)
}

/// The frame in which most rays are cast, again and again: the world is set
/// back by giving every body the motion it had left.
fn frames(
    c: &mut Criterion,
    name: &str,
    bodies: &[Body],
    broad_phase: BroadPhase,
) -> Result<(), Box<dyn Error>> {
    let mut group = c.benchmark_group(name);
    for rays in RAYS {
        let method = Method::Rays(RayConfig {
            rays,
            ..RayConfig::default()
        });
        let config = WorldConfig {
            method,
            broad_phase,
        };
        let start = busiest(bodies, config)?;
        let mut moved = Vec::new();
        for body in bodies {
            let (from, velocity) = (
                body.motion().position_after(start),
                body.motion().velocity_after(start),
            );
            // Some rest at the end of their paths by then.
            moved.push(if velocity == DVec3::ZERO {
                Body::fixed(body.shape().clone(), from)
            } else {
                ball(from, from + 20.0 * velocity)?
            });
        }
        group.throughput(Throughput::Elements(u64::from(rays)));
        group.bench_function(BenchmarkId::from_parameter(rays), |b| {
            b.iter_batched_ref(
                || {
                    let mut fresh = world(&moved, config).unwrap_or_default();
                    // The first step lists the pairs, which is done once, not every frame.
                    fresh
                        .step(feeler::tolerance::MIN_TIME_STEP)
                        .map(<[_]>::len)
                        .unwrap_or(0);
                    fresh
                },
                |world| world.step(black_box(FRAME)).map(<[_]>::len),
                criterion::BatchSize::SmallInput,
            );
        });
    }
    group.finish();
    Ok(())
}

fn rays_against_time(c: &mut Criterion) {
    let run = |c: &mut Criterion| -> Result<(), Box<dyn Error>> {
        frames(c, "scene 10, 20 balls", &scene_10()?, BroadPhase::default())?;
        frames(
            c,
            "scene 11, swept boxes",
            &scene_11()?,
            BroadPhase::default(),
        )?;
        frames(c, "scene 11, all pairs", &scene_11()?, BroadPhase::AllPairs)
    };
    if let Err(error) = run(c) {
        eprintln!("{error}");
        std::process::exit(1);
    }
}

criterion_group!(benches, rays_against_time);
criterion_main!(benches);
