//! Bodies that spin, beside parry's nonlinear cast: `cargo run --release --bin spins`.
//!
//! The same random casts for everyone, in one run: both bodies fly freely for a second and spin
//! about their middles. The oracle is that of the crate's own hunt for wrong contacts: it
//! moves bodies by formulas of its own, measures distances feature by feature, and bisects time until
//! nothing can hide between two looks. `--casts N` and `--seed S` change the casts.

mod contender;
mod draw;
mod planted;
mod score;

#[allow(dead_code, reason = "the hunt uses more of it")]
#[path = "../../../../../tests/curved_hunt/course.rs"]
mod course;
#[allow(dead_code, reason = "the hunt uses more of it")]
#[path = "../../../../../tests/curved_hunt/gap.rs"]
mod gap;
#[allow(dead_code, reason = "the hunt uses more of it")]
#[path = "../../../../../tests/curved_hunt/look.rs"]
mod look;
#[allow(dead_code, reason = "the casts use more of it")]
#[path = "../../random.rs"]
mod random;
#[allow(dead_code, reason = "the hunt uses more of it")]
#[path = "../../../../../tests/curved_hunt/route.rs"]
mod route;
#[path = "../../../../../tests/curved_hunt/solid.rs"]
mod solid;
#[allow(dead_code, reason = "the casts use more of it")]
#[path = "../../table.rs"]
mod table;

use contender::Contender;
use draw::{Cast, Kind};
use random::Random;
use score::{Score, Truth};
use std::process::ExitCode;
use std::time::Instant;

/// A title, the kinds of both bodies, and their fastest spins, in radians.
fn sets() -> Vec<(&'static str, [Kind; 2], f64)> {
    use Kind::{Ball, Bar, Box, Hull, Slab};
    vec![
        ("box–box", [Box, Box], 6.0),
        ("ball–box", [Ball, Box], 6.0),
        ("ball–bar", [Ball, Bar], 6.0),
        ("bar–bar", [Bar, Bar], 6.0),
        ("slab–hull12", [Slab, Hull], 6.0),
        ("hull12–hull12", [Hull, Hull], 6.0),
        ("box–box, many turns", [Box, Box], 60.0),
        ("ball–bar, many turns", [Ball, Bar], 60.0),
    ]
}

struct Options {
    casts: usize,
    seed: u64,
}

fn options() -> Result<Options, String> {
    let mut options = Options {
        casts: 1000,
        seed: 1,
    };
    let mut arguments = std::env::args().skip(1);
    while let Some(name) = arguments.next() {
        let value = arguments
            .next()
            .ok_or_else(|| format!("{name} needs a value"))?;
        let bad = |error| format!("{name} {value}: {error}");
        match name.as_str() {
            "--casts" => options.casts = value.parse().map_err(bad)?,
            "--seed" => options.seed = value.parse().map_err(bad)?,
            _ => return Err(format!("{name}: the options are --casts and --seed")),
        }
    }
    if options.casts < 100 {
        return Err(format!("--casts {}: at least 100", options.casts));
    }
    Ok(options)
}

/// Mean seconds a cast: stretches timed one by one, the best of several passes each, all taking turns.
fn times(contenders: &[Contender]) -> Vec<f64> {
    const STRETCH: usize = 50;
    const PASSES: usize = 9;
    let mut best = vec![Vec::new(); contenders.len()];
    for _ in 0..PASSES {
        for (contender, best) in contenders.iter().zip(&mut best) {
            let count = contender.count.min(500);
            best.resize(count / STRETCH, f64::INFINITY);
            for (stretch, best) in best.iter_mut().enumerate() {
                let start = Instant::now();
                for index in stretch * STRETCH..(stretch + 1) * STRETCH {
                    (contender.run)(index);
                }
                *best = best.min(start.elapsed().as_secs_f64());
            }
        }
    }
    let mean = |best: &Vec<f64>| best.iter().sum::<f64>() / (STRETCH * best.len()) as f64;
    best.iter().map(mean).collect()
}

fn main() -> ExitCode {
    let options = match options() {
        Ok(options) => options,
        Err(message) => {
            eprintln!("{message}");
            return ExitCode::FAILURE;
        }
    };
    println!(
        "Up to {} casts a pair, seed {}; parry 0.31.\n",
        options.casts, options.seed
    );
    let head =
        "pair (hits)|contender|time per cast|misses|ghosts|normals off|median|99 %|worst|worst gap";
    let mut rows: Vec<Vec<String>> = vec![head.split('|').map(str::to_owned).collect()];
    for (name, kinds, rate) in sets() {
        let mut random = Random::new(options.seed);
        let casts: Vec<Cast> = (0..options.casts)
            .map(|_| Cast::new(&mut random, kinds, rate))
            .collect();
        let truths: Vec<Truth> = casts.iter().map(Truth::of).collect();
        let hits = truths.iter().filter(|truth| truth.touch.is_some()).count();
        let contenders = contender::all(&casts);
        let times = times(&contenders);
        for (number, (contender, seconds)) in contenders.iter().zip(times).enumerate() {
            let mut score = Score::default();
            for (index, (cast, truth)) in casts.iter().zip(&truths).enumerate() {
                score.add(cast, truth, contender.precision, (contender.answer)(index));
            }
            let share = 100.0 * hits as f64 / casts.len() as f64;
            let pair = if number == 0 {
                format!("{name} ({share:.0} %)")
            } else {
                String::new()
            };
            let mut row = vec![pair, contender.name.into(), table::duration(seconds)];
            row.extend(score.cells());
            rows.push(row);
        }
    }
    table::print(&rows);
    println!();
    planted::bars();
    println!();
    planted::curves();
    println!("\n{}", include_str!("legend.md"));
    ExitCode::SUCCESS
}
