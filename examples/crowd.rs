//! A crowd of balls in a box, and what a frame of it costs.
//!
//! `cargo run --release --example crowd -- --bodies 100000 --frames 120`

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "an example talks to its user"
)]

#[path = "crowd/hall.rs"]
mod hall;
#[path = "crowd/options.rs"]
mod options;

use feeler::{PhaseTimes, StepStats};
use hall::Hall;
use options::Options;
use std::error::Error;
use std::io::{IsTerminal, Write};
use std::time::{Duration, Instant};

/// Frames a second.
const RATE: f64 = 60.0;

/// Sums over all frames.
#[derive(Default)]
struct Totals {
    frames: u32,
    times: PhaseTimes,
    worst: Duration,
    walls: Duration,
    pairs: usize,
    examined: usize,
    contacts: usize,
}

impl Totals {
    fn add(&mut self, stats: &StepStats, walls: Duration) {
        self.frames += 1;
        let (sum, times) = (&mut self.times, &stats.times);
        sum.motions += times.motions;
        sum.broad_phase += times.broad_phase;
        sum.early_outs += times.early_outs;
        sum.narrow_phase += times.narrow_phase;
        sum.advance += times.advance;
        self.worst = self.worst.max(times.total());
        self.walls += walls;
        self.pairs += stats.pairs;
        self.examined += stats.examined;
        self.contacts += stats.contacts;
    }

    fn print(&self, bodies: usize, memory: usize) {
        let frames = self.frames.max(1);
        let line = |name: &str, time: Duration| {
            let mean = time.as_secs_f64() / f64::from(frames);
            let body = 1e9 * mean / bodies.max(1) as f64;
            println!("{name:<24}{:>10.3} ms{body:>10.1} ns a body", 1e3 * mean);
        };
        line("motions", self.times.motions);
        line("broad phase", self.times.broad_phase);
        line("early-outs", self.times.early_outs);
        line("narrow phase", self.times.narrow_phase);
        line("sorting the contacts", self.times.advance);
        line("the whole step", self.times.total());
        line("walls, by the caller", self.walls);
        println!(
            "{:<24}{:>10.3} ms",
            "the slowest step",
            1e3 * self.worst.as_secs_f64()
        );
        let mean = |count: usize| count / frames as usize;
        println!("{:<24}{:>10} a frame", "candidate pairs", mean(self.pairs));
        println!(
            "{:<24}{:>10} a frame",
            "pairs examined",
            mean(self.examined)
        );
        println!("{:<24}{:>10} a frame", "contacts", mean(self.contacts));
        println!(
            "{:<24}{:>10.1} MB{:>10} bytes a body",
            "memory",
            memory as f64 / 1e6,
            memory / bodies.max(1)
        );
    }
}

fn main() -> Result<(), Box<dyn Error + Send + Sync>> {
    let Some(options) = Options::from_arguments()? else {
        return Ok(());
    };
    println!(
        "{} balls in a box, {} frames of 1/{RATE} s, {} thread(s)",
        options.bodies, options.frames, options.threads
    );
    options.in_threads(|| run(&options))?
}

fn run(options: &Options) -> Result<(), Box<dyn Error + Send + Sync>> {
    let start = Instant::now();
    let mut hall = Hall::new(options.bodies)?;
    println!(
        "{:<24}{:>10.3} ms",
        "inserting the balls",
        1e3 * start.elapsed().as_secs_f64()
    );
    let shows_progress = std::io::stderr().is_terminal();
    let mut totals = Totals::default();
    for frame in 0..options.frames {
        hall.world.step(1.0 / RATE)?;
        let walls = Instant::now();
        hall.reflect(1.0 / RATE)?;
        totals.add(hall.world.stats(), walls.elapsed());
        if shows_progress {
            eprint!("\rframe {} of {}", frame + 1, options.frames);
            std::io::stderr().flush()?;
        }
    }
    if shows_progress {
        eprintln!();
    }
    totals.print(options.bodies, hall.world.memory());
    Ok(())
}
