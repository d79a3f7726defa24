//! Whole frames of a crowd of balls beside parry's: `cargo run --release --bin frames`.
//!
//! The same balls, the same walls, which nobody is charged for. Parry's tree is kept
//! as its users keep it: leaves updated, refitted and optimised in every frame, pairs
//! from its traversal of itself, each pair cast; feeler steps its world. They take
//! turns frame by frame. Since feeler finds pairs for several frames at once, what
//! counts is the mean of sixteen frames in a row, of which the median is taken; the
//! median single frame and the slowest are told beside it. Both report balls that
//! overlap as the frame begins, as most of the contacts do: nobody throws balls back.
//! One thread. Arguments: how many balls, instead of 1000, 10 000 and 100 000.

use feeler::{Body, BodyId, CollisionWorld, Motion, QueryFilter, Sphere};
use glam::DVec3;
use parry3d::bounding_volume::Aabb;
use parry3d::math::{Pose, Vector};
use parry3d::partitioning::{Bvh, BvhWorkspace};
use parry3d::query::{Ray, ShapeCastOptions, cast_shapes};
use parry3d::shape::Ball;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

const DT: f64 = 1.0 / 60.0;

fn unit(random: &mut ChaCha8Rng) -> f64 {
    (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

fn vector(random: &mut ChaCha8Rng) -> DVec3 {
    let mut coordinate = || 2.0 * unit(random) - 1.0;
    DVec3::new(coordinate(), coordinate(), coordinate())
}

fn single(vector: DVec3) -> Vector {
    Vector::new(vector.x as f32, vector.y as f32, vector.z as f32)
}

struct Mote {
    id: BodyId,
    radius: f64,
    place: DVec3,
    velocity: DVec3,
}

/// What parry keeps from frame to frame.
#[derive(Default)]
struct Peer {
    bvh: Bvh,
    workspace: BvhWorkspace,
    pairs: Vec<(u32, u32)>,
}

impl Peer {
    /// Pairs looked at, and hits.
    fn step(&mut self, motes: &[(Vector, Vector, f32)]) -> (usize, usize) {
        let dt = DT as f32;
        for (index, (place, velocity, radius)) in (0..).zip(motes) {
            let to = *place + *velocity * dt;
            let aabb = Aabb::new(place.min(to) - *radius, place.max(to) + *radius);
            self.bvh.insert_or_update_partially(aabb, index, 0.0);
        }
        self.bvh.refit(&mut self.workspace);
        self.bvh.optimize_incremental(&mut self.workspace);
        let pairs = &mut self.pairs;
        pairs.clear();
        self.bvh
            .traverse_bvtt_single_tree::<false>(&mut self.workspace, &mut |a, b| {
                pairs.push((a, b));
            });
        let options = ShapeCastOptions::with_max_time_of_impact(dt);
        let cast = |&&(a, b): &&(u32, u32)| {
            let ((place_a, velocity_a, a), (place_b, velocity_b, b)) =
                (motes[a as usize], motes[b as usize]);
            let (pose_a, pose_b) = (Pose::from_translation(place_a), Pose::from_translation(place_b));
            let (a, b) = (Ball::new(a), Ball::new(b));
            cast_shapes(&pose_a, velocity_a, &a, &pose_b, velocity_b, &b, options)
                .is_ok_and(|hit| black_box(hit).is_some())
        };
        (pairs.len(), pairs.iter().filter(cast).count())
    }
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or(f64::NAN)
}

/// The median of the means of sixteen in a row, in milliseconds, and in words with
/// the median and the largest.
fn told(times: &[f64]) -> (f64, String) {
    let means = times.chunks_exact(16).map(|times| 1e3 * times.iter().sum::<f64>() / 16.0);
    let mean = median(means.collect());
    let middle = 1e3 * median(times.to_vec());
    let slowest = 1e3 * times.iter().copied().fold(0.0, f64::max);
    (mean, format!("{mean:.3} ms (median {middle:.3}, slowest {slowest:.3})"))
}

fn crowd(count: usize, frames: usize) -> Result<(), Box<dyn Error>> {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let radii: Vec<f64> = (0..count).map(|_| 0.3 + 0.4 * unit(&mut random)).collect();
    let volume: f64 = radii.iter().map(|radius| 4.19 * radius.powi(3)).sum();
    let half = 0.5 * (volume / 0.05).cbrt();
    let (mut world, mut peer) = (CollisionWorld::default(), Peer::default());
    let mut motes = Vec::new();
    for radius in radii {
        let place = half * vector(&mut random);
        let velocity = 10.0 * unit(&mut random) * vector(&mut random).normalize();
        let ball = Body::moving(Sphere::new(radius)?, Motion::free(place, velocity)?);
        motes.push(Mote {
            id: world.insert(ball)?,
            radius,
            place,
            velocity,
        });
    }
    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    let (mut contacts, mut hits, mut looked) = (0, 0, [0, 0]);
    for _ in 0..frames {
        let singles: Vec<_> = motes
            .iter()
            .map(|mote| (single(mote.place), single(mote.velocity), mote.radius as f32))
            .collect();
        let start = Instant::now();
        contacts += black_box(world.step(DT)?).len();
        let middle = Instant::now();
        let found = peer.step(&singles);
        theirs.push(middle.elapsed().as_secs_f64());
        ours.push((middle - start).as_secs_f64());
        looked[0] += world.stats().pairs;
        looked[1] += found.0;
        hits += found.1;
        for mote in &mut motes {
            mote.place += DT * mote.velocity;
            let outside = mote.place.abs().cmpgt(DVec3::splat(half));
            let inwards = DVec3::select(outside, -mote.place.signum(), mote.velocity.signum());
            let turned = mote.velocity.abs() * inwards;
            if turned != mote.velocity {
                mote.velocity = turned;
                world.set_velocity(mote.id, turned)?;
            }
        }
    }
    let ((ours, in_words), (theirs, beside)) = (told(&ours), told(&theirs));
    println!(
        "{count:>8} balls: feeler {in_words}, parry f32 {beside}, ratio {:.2}; pairs {} and {}, contacts {} and {} a frame",
        theirs / ours,
        looked[0] / frames,
        looked[1] / frames,
        contacts / frames,
        hits / frames,
    );

    let rays: Vec<_> = (0..2000)
        .map(|_| (half * vector(&mut random), vector(&mut random).normalize()))
        .collect();
    let all = QueryFilter::default();
    let cast_ours: Vec<_> = rays.iter().map(|&(from, way)| feeler::Ray::new(from, way)).collect();
    let cast_theirs: Vec<_> = rays.iter().map(|&(from, way)| Ray::new(single(from), single(way))).collect();
    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    for _ in 0..9 {
        let start = Instant::now();
        black_box(world.cast_rays(&cast_ours, f64::INFINITY, &all)?);
        let middle = Instant::now();
        for ray in &cast_theirs {
            black_box(peer.bvh.cast_ray(ray, f32::MAX, |leaf, best| {
                let mote = &motes[leaf as usize];
                let pose = Pose::from_translation(single(mote.place));
                let ball = Ball::new(mote.radius as f32);
                parry3d::query::RayCast::cast_ray(&ball, &pose, ray, best, true)
            }));
        }
        theirs.push(middle.elapsed().as_secs_f64());
        ours.push((middle - start).as_secs_f64());
    }
    let per_ray = 1e9 / rays.len() as f64;
    let (ours, theirs) = (per_ray * median(ours), per_ray * median(theirs));
    println!(
        "{count:>8} balls: a ray: feeler {ours:.0} ns, parry f32 {theirs:.0} ns, ratio {:.2}",
        theirs / ours
    );
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut counts: Vec<usize> = std::env::args().skip(1).flat_map(|count| count.parse()).collect();
    if counts.is_empty() {
        counts = vec![1_000, 10_000, 100_000];
    }
    for count in counts {
        crowd(count, (8_000_000 / count).clamp(96, 800))?;
    }
    Ok(())
}
