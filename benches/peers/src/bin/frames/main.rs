//! Whole frames of crowds beside parry's: `cargo run --release --bin frames`.
//!
//! The same bodies, the same walls, which nobody is charged for. Parry's tree is kept
//! as its users keep it: leaves updated, refitted and optimised in every frame, pairs
//! from its traversal of itself, each pair cast; feeler steps its world. They take
//! turns frame by frame. Since feeler finds pairs for several frames at once, what
//! counts is the mean of sixteen frames in a row, of which the median is taken; the
//! median single frame and the slowest are told beside it. Both report bodies that
//! overlap as the frame begins, as most of the contacts do: nobody throws them back.
//! One thread; times are those of its own clock, which stands still while others have
//! the core.
//!
//! Arguments: workloads by name, and how many bodies; without any, balls in three
//! numbers and 10 000 bodies of the others, of which 99 % stand 100 000.

mod crowd;
mod peer;

use cpu_time::ThreadTime;
use crowd::{Crowd, DT, Kind, vector};
use feeler::QueryFilter;
use glam::DVec3;
use parry3d::math::Vector;
use parry3d::query::Ray;
use peer::Peer;
use std::error::Error;
use std::hint::black_box;

fn single(vector: DVec3) -> Vector {
    Vector::new(vector.x as f32, vector.y as f32, vector.z as f32)
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or(f64::NAN)
}

/// The median of the means of sixteen in a row, in milliseconds, and in words with
/// the median and the largest.
fn told(times: &[f64]) -> (f64, String) {
    let means = times
        .chunks_exact(16)
        .map(|times| 1e3 * times.iter().sum::<f64>() / 16.0);
    let mean = median(means.collect());
    let middle = 1e3 * median(times.to_vec());
    let slowest = 1e3 * times.iter().copied().fold(0.0, f64::max);
    (
        mean,
        format!("{mean:.3} ms (median {middle:.3}, slowest {slowest:.3})"),
    )
}

fn frames(
    name: &str,
    crowd: &mut Crowd,
    peer: &mut Peer,
    frames: usize,
) -> Result<(), Box<dyn Error>> {
    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    let (mut contacts, mut hits, mut looked) = (0, 0, [0, 0]);
    for _ in 0..frames {
        peer.follow(&crowd.motes);
        let clock = ThreadTime::now();
        contacts += black_box(crowd.world.step(DT)?).len();
        ours.push(clock.elapsed().as_secs_f64());
        let clock = ThreadTime::now();
        let found = peer.step();
        theirs.push(clock.elapsed().as_secs_f64());
        looked[0] += crowd.world.stats().pairs;
        looked[1] += found.0;
        hits += found.1;
        crowd.reflect()?;
    }
    let ((ours, in_words), (theirs, beside)) = (told(&ours), told(&theirs));
    println!(
        "{name}: feeler {in_words}, parry f32 {beside}, ratio {:.2}; pairs {} and {}, contacts {} and {} a frame; {} bytes a body",
        theirs / ours,
        looked[0] / frames,
        looked[1] / frames,
        contacts / frames,
        hits / frames,
        crowd.world.memory() / crowd.motes.len().max(1),
    );
    Ok(())
}

fn rays(name: &str, crowd: &mut Crowd, peer: &mut Peer) -> Result<(), Box<dyn Error>> {
    // Both see bodies as they are after a step.
    peer.follow(&crowd.motes);
    let rays: Vec<_> = (0..2000)
        .map(|_| {
            (
                crowd.half * vector(&mut crowd.random),
                vector(&mut crowd.random).normalize(),
            )
        })
        .collect();
    let all = QueryFilter::default();
    let cast_ours: Vec<_> = rays
        .iter()
        .map(|&(from, way)| feeler::Ray::new(from, way))
        .collect();
    let cast_theirs: Vec<_> = rays
        .iter()
        .map(|&(from, way)| Ray::new(single(from), single(way)))
        .collect();
    let (mut one_by_one, mut batch, mut theirs) = (Vec::new(), Vec::new(), Vec::new());
    let (mut hits, mut their_hits) = (0, 0);
    for _ in 0..9 {
        let clock = ThreadTime::now();
        for ray in &cast_ours {
            hits += usize::from(crowd.world.cast_ray(ray, f64::INFINITY, &all)?.is_some());
        }
        one_by_one.push(clock.elapsed().as_secs_f64());
        let clock = ThreadTime::now();
        black_box(crowd.world.cast_rays(&cast_ours, f64::INFINITY, &all)?);
        batch.push(clock.elapsed().as_secs_f64());
        let clock = ThreadTime::now();
        for ray in &cast_theirs {
            their_hits += usize::from(black_box(peer.cast_ray(ray)).is_some());
        }
        theirs.push(clock.elapsed().as_secs_f64());
    }
    let per_ray = 1e9 / rays.len() as f64;
    let [one_by_one, batch, theirs] =
        [one_by_one, batch, theirs].map(|times| per_ray * median(times));
    println!(
        "{name}: a ray: feeler {one_by_one:.0} ns, in a batch {batch:.0} ns, parry f32 {theirs:.0} ns, \
         ratio {:.2} and {:.2}; hits {} and {}",
        theirs / one_by_one,
        theirs / batch,
        hits / 9,
        their_hits / 9,
    );
    Ok(())
}

fn run(name: &str, kind: Kind, count: usize) -> Result<(), Box<dyn Error>> {
    let name = format!("{count:>8} {name}");
    let mut crowd = Crowd::new(kind, count)?;
    let mut peer = Peer::new(kind, &crowd.motes);
    let least = if kind == Kind::Balls { 96 } else { 160 };
    let most = if kind == Kind::Balls { 800 } else { 160 };
    frames(
        &name,
        &mut crowd,
        &mut peer,
        (8_000_000 / count).clamp(least, most),
    )?;
    rays(&name, &mut crowd, &mut peer)
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let counts: Vec<usize> = arguments.iter().flat_map(|count| count.parse()).collect();
    let is_named = |name: &str| arguments.iter().any(|argument| argument == name);
    let is_any_named = Kind::ALL.iter().any(|(name, _)| is_named(name));
    for (name, kind) in Kind::ALL {
        let wanted = is_named(name) || !is_any_named && (counts.is_empty() || kind == Kind::Balls);
        if !wanted {
            continue;
        }
        let counts = match (counts.is_empty(), kind) {
            (false, _) => counts.clone(),
            (true, Kind::Balls) => vec![1_000, 10_000, 100_000],
            (true, Kind::Still) => vec![100_000],
            (true, _) => vec![10_000],
        };
        for count in counts {
            run(name, kind, count)?;
        }
    }
    Ok(())
}
