//! Feeler beside its peers: the same random straight casts, in one run, against an
//! oracle that shares no code with any of them.
//!
//! `cargo run --release` in this folder prints the tables as Markdown in under two
//! minutes; `--casts N` and `--seed S` change the casts, `--only NAME` leaves only
//! the pairs whose name contains NAME, `--by NAME` only the contenders. A million casts of
//! every pair are `cargo run --release -- --casts 1000000 --by exact`. `cargo test` tests the oracle.
//!
//! To enter a further contender, add a function to `contender/` and a line to
//! [`contender::all`].

mod casts;
mod contender;
mod measure;
mod oracle;
mod random;
mod table;

use casts::{CastSet, Kind};
use contender::{Contender, Ready};
use measure::Score;
use oracle::{Oracle, Truth};
use std::collections::BTreeSet;
use std::process::{Command, ExitCode};
use std::time::Instant;

/// How long a contender may take for each of a set's answers, in seconds. The slow
/// ones are asked less, and the table says how much.
const PATIENCE: f64 = 7e-5;

/// A pair, and the share of the casts that the oracle has time for.
type Pair = ([Kind; 2], f64);

/// The sets: a title, how large bodies are in metres, and the pairs.
fn sets() -> Vec<(&'static str, f64, Vec<Pair>)> {
    use Kind::{Ball, Box, Hull, Point, Slab, Triangle};
    vec![
        (
            "Bodies of about 1 m",
            1.0,
            vec![
                ([Ball, Ball], 1.0),
                ([Ball, Box], 1.0),
                ([Ball, Triangle], 1.0),
                ([Ball, Hull(12)], 1.0),
                ([Box, Box], 1.0),
                ([Hull(12), Hull(12)], 1.0),
                ([Hull(100), Hull(100)], 1.0),
                ([Hull(1000), Hull(1000)], 0.1),
                ([Point, Hull(12)], 1.0),
                ([Point, Hull(100)], 1.0),
                ([Point, Hull(1000)], 0.2),
            ],
        ),
        (
            "Slabs, a hundred times as wide as thick",
            1.0,
            vec![
                ([Ball, Slab], 1.0),
                ([Slab, Slab], 1.0),
                ([Slab, Hull(12)], 1.0),
            ],
        ),
        (
            "Bodies of about 1 mm",
            1e-3,
            vec![
                ([Ball, Ball], 1.0),
                ([Ball, Box], 1.0),
                ([Ball, Hull(12)], 1.0),
                ([Box, Box], 1.0),
                ([Hull(12), Hull(12)], 1.0),
                ([Point, Hull(12)], 1.0),
            ],
        ),
    ]
}

struct Options {
    casts: usize,
    seed: u64,
    only: String,
    by: String,
}

fn options() -> Result<Options, String> {
    let mut options = Options {
        casts: 10_000,
        seed: 1,
        only: String::new(),
        by: String::new(),
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
            "--only" => options.only = value,
            "--by" => options.by = value,
            _ => {
                return Err(format!(
                    "{name}: the options are --casts, --seed, --only and --by"
                ));
            }
        }
    }
    if options.casts < 100 {
        return Err(format!("--casts {}: at least 100", options.casts));
    }
    Ok(options)
}

/// What one contender did in one set.
struct Line {
    contender: usize,
    seconds: f64,
    score: Score,
}

/// Every contender that knows the set's pair, and how many of the casts hit.
fn run(set: &CastSet, contenders: &[Contender]) -> (Vec<Line>, usize) {
    let oracle = Oracle::new(set);
    let truths: Vec<Truth> = set.casts.iter().map(|cast| oracle.truth(cast)).collect();
    let hits = truths
        .iter()
        .filter(|truth| matches!(truth, Truth::Hit { .. }))
        .count();
    let prepared: Vec<(usize, Box<dyn Ready>)> = contenders
        .iter()
        .enumerate()
        .filter_map(|(number, contender)| Some((number, (contender.prepare)(set)?)))
        .collect();
    let ready: Vec<&dyn Ready> = prepared.iter().map(|(_, ready)| ready.as_ref()).collect();
    let times = measure::time(&ready, set.casts.len());
    let lines = prepared
        .iter()
        .zip(times)
        .map(|((number, ready), seconds)| {
            let casts = set.casts.len();
            let affordable = (PATIENCE / seconds * casts as f64) as usize;
            let answers = ready.answers(casts.min(affordable.max(10)));
            Line {
                contender: *number,
                seconds,
                score: measure::score(set, &oracle, &truths, &contenders[*number], &answers),
            }
        })
        .collect();
    (lines, hits)
}

fn print_conditions(options: &Options) {
    let cpu = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = cpu
        .lines()
        .find_map(|line| line.strip_prefix("model name")?.split(": ").nth(1))
        .unwrap_or("unknown processor");
    let rustc = Command::new("rustc").arg("--version").output();
    let rustc = rustc.map_or_else(
        |_| "rustc unknown".into(),
        |output| String::from_utf8_lossy(&output.stdout).trim().to_owned(),
    );
    println!("Conditions: {model}, one thread; {rustc}, release, fat LTO;");
    println!(
        "up to {} casts a pair, seed {}; parry 0.31, box3d-rust 0.5.\n",
        options.casts, options.seed
    );
}

fn print_set(title: &str, results: &[(String, Vec<Line>, usize, usize)], all: &[Contender]) {
    println!("## {title}\n");
    let seen: BTreeSet<usize> = results
        .iter()
        .flat_map(|(_, lines, ..)| lines.iter().map(|line| line.contender))
        .collect();
    let names = seen.iter().map(|&number| all[number].name.to_owned());
    let mut rows = vec![["time per cast".into()].into_iter().chain(names).collect()];
    for (name, lines, ..) in results {
        let cells = seen.iter().map(|&number| {
            let line = lines.iter().find(|line| line.contender == number);
            line.map_or_else(|| "–".into(), |line| table::duration(line.seconds))
        });
        rows.push([name.clone()].into_iter().chain(cells).collect());
    }
    table::print(&rows);
    println!();

    let head = "pair (hits)|contender|casts|misses|ghosts|normals off|median|99 %|worst|worst gap";
    let mut rows: Vec<Vec<String>> = vec![head.split('|').map(str::to_owned).collect()];
    for (name, lines, hits, casts) in results {
        for (number, line) in lines.iter().enumerate() {
            let score = &line.score;
            let share = 100.0 * *hits as f64 / *casts as f64;
            let pair = if number == 0 {
                format!("{name} ({share:.0} %)")
            } else {
                String::new()
            };
            rows.push(vec![
                pair,
                all[line.contender].name.into(),
                score.casts.to_string(),
                score.misses.to_string(),
                score.ghosts.to_string(),
                score.normals.to_string(),
                table::length(score.quantile(0.5)),
                table::length(score.quantile(0.99)),
                table::length(score.quantile(1.0)),
                table::length((!score.errors.is_empty()).then_some(score.gap)),
            ]);
        }
    }
    table::print(&rows);
    println!();
}

fn main() -> ExitCode {
    let options = match options() {
        Ok(options) => options,
        Err(message) => {
            eprintln!("{message}");
            return ExitCode::FAILURE;
        }
    };
    let start = Instant::now();
    print_conditions(&options);
    let mut contenders = contender::all();
    contenders.retain(|contender| contender.name.contains(&options.by));
    for (title, unit, pairs) in sets() {
        let mut results = Vec::new();
        for (kinds, share) in pairs {
            let count = (share * options.casts as f64) as usize;
            let set = CastSet::new(kinds, unit, count, options.seed);
            if set.name().contains(&options.only) {
                let (lines, hits) = run(&set, &contenders);
                results.push((set.name(), lines, hits, count));
            }
        }
        if !results.is_empty() {
            print_set(title, &results, &contenders);
        }
    }
    println!("{}", include_str!("legend.md"));
    eprintln!("{:.0} s in all", start.elapsed().as_secs_f64());
    ExitCode::SUCCESS
}
