//! The thesis's scenes: what it found, and what this crate finds.
//!
//! `cargo run --release --example thesis` runs every file of `examples/scenes`, prints
//! both side by side and writes `accuracy.csv`, `timing.csv` and plots to `target/thesis`.
//! `cargo run --release --example thesis -- my-scene.toml` runs a file and prints its contacts.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "printing is what it is for"
)]

mod accuracy;
mod agreement;
mod as_printed;
mod csv;
mod errors;
mod plots;
mod report;
mod scene_file;
mod timing;

use accuracy::{Run, SEEDS, Settings, exact, frames, representative, run, runs};
use plots::{BLUE, GREEN, ORANGE, PURPLE, Plot, Series};
use scene_file::{Acceleration, SceneFile};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use timing::FrameTimes;

fn main() -> ExitCode {
    let mut arguments = std::env::args_os().skip(1);
    let done = match (arguments.next(), arguments.next()) {
        (None, _) => run_all(),
        (Some(path), None) => run_file(Path::new(&path)),
        (Some(_), Some(_)) => Err("one scene file at a time, or none for all".into()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Every scene of the thesis.
fn run_all() -> Result<(), Box<dyn Error>> {
    let files = SceneFile::read_all()?;
    let folder = output_folder();
    std::fs::create_dir_all(&folder)?;
    let (mut accuracy, mut all_times) = (csv::Accuracy::new(), Vec::new());
    for file in &files {
        eprintln!("{} ...", file.scene.name);
        report::heading(file);
        compare(file, &mut accuracy, &folder)?;
        place(file, &mut accuracy)?;
        speed_up(file, &mut accuracy)?;
        if !file.thesis.timing.is_empty() {
            let times = timing::time(file)?;
            report::times(&times);
            plot_times(file, &times, &folder)?;
            all_times.extend(times);
        }
    }
    eprintln!("errors against rays ...");
    errors::plot(&files, &folder.join("errors.svg"))?;
    std::fs::write(folder.join("accuracy.csv"), &accuracy.0)?;
    std::fs::write(folder.join("timing.csv"), csv::timing(&all_times))?;
    eprintln!("written to {}", folder.display());
    Ok(())
}

/// One scene file: its contacts.
fn run_file(path: &Path) -> Result<(), Box<dyn Error>> {
    let file = SceneFile::read(path)?;
    report::heading(&file);
    let (mut world, bodies) = file.scene.world()?;
    let name = |id| {
        let index = bodies.iter().position(|&body| body == id);
        let named = index.and_then(|index| file.scene.bodies.get(index));
        named.map_or_else(String::new, |named| named.name.clone())
    };
    let mut contacts = Vec::new();
    for _ in 0..frames(&file.scene) {
        for contact in world.step(file.scene.time_step())? {
            // Who overlaps does so frame after frame.
            if contact.is_touch() || contact.time <= 0.0 {
                contacts.push((*contact, [name(contact.a), name(contact.b)]));
            }
        }
    }
    report::contacts(&file, &contacts);
    Ok(())
}

fn output_folder() -> PathBuf {
    let target = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    target
        .unwrap_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("target"))
        .join("thesis")
}

/// Every number of rays of the thesis's table, with both settings.
fn compare(
    file: &SceneFile,
    accuracy: &mut csv::Accuracy,
    folder: &Path,
) -> Result<(), Box<dyn Error>> {
    // Scenes with positions to try or speeds to vary have their own tables.
    let counts = file.ray_counts();
    if counts.is_empty() {
        return Ok(());
    }
    let mut by_rays = Vec::new();
    for rays in counts {
        let both = [
            runs(file, Settings::Thesis, rays)?,
            runs(file, Settings::Rays, rays)?,
        ];
        let printed = file.row(rays).map(|row| row.point);
        for run in both.iter().flatten() {
            accuracy.push(&file.id, run, printed);
        }
        by_rays.push((rays, both));
    }
    let exact = exact(file, &file.scene)?;
    accuracy.push(&file.id, &exact, None);
    report::agreements(file, &by_rays, &exact);
    if by_rays.len() > 8 {
        plot_agreements(file, &by_rays, folder)?;
    }
    Ok(())
}

fn plot_agreements(
    file: &SceneFile,
    by_rays: &[(u32, [Vec<Run>; 2])],
    folder: &Path,
) -> Result<(), Box<dyn Error>> {
    // A contact that was not found agrees with nothing: it has no point in the plot.
    let found =
        |points: Vec<(f64, f64)>| points.into_iter().filter(|point| point.1 > 0.0).collect();
    let ours = |which: usize| {
        let points = by_rays.iter().filter_map(|(rays, both)| {
            let agreement = representative(file, both.get(which)?)?.point?;
            Some((f64::from(*rays), agreement))
        });
        found(points.collect())
    };
    let rows = file.thesis.table.iter();
    let printed = found(rows.map(|row| (f64::from(row.rays), row.point)).collect());
    let series = |name: &str, colour, foreign, points| Series {
        name: name.to_owned(),
        colour,
        foreign,
        points,
    };
    let plot = Plot {
        title: &format!(
            "{}: agreement of the contact point with the exact one",
            file.scene.name
        ),
        unit: "agreement in %",
        logarithmic: false,
        series: vec![
            series("printed in the thesis", ORANGE, true, printed),
            series("its method, run here", BLUE, false, ours(0)),
            series("aimed rays", GREEN, false, ours(1)),
        ],
    };
    plot.draw(&folder.join(format!("{}.svg", file.id)))
}

/// The scene with a body placed here and there.
fn place(file: &SceneFile, accuracy: &mut csv::Accuracy) -> Result<(), Box<dyn Error>> {
    let Some(positions) = &file.thesis.positions else {
        return Ok(());
    };
    let mut variants = Vec::new();
    for &at in &positions.at {
        let scene = file.placed(&positions.body, at)?;
        let id = format!("{} at {}", file.id, at[0]);
        for &rays in &positions.rays {
            for settings in Settings::SAMPLED {
                for seed in SEEDS {
                    let run = run(file, &scene, settings, rays, seed)?;
                    accuracy.push(&id, &run, None);
                    if seed == *SEEDS.start() {
                        variants.push((at[0].to_string(), run));
                    }
                }
            }
        }
        let exact = exact(file, &scene)?;
        accuracy.push(&id, &exact, None);
        variants.push((at[0].to_string(), exact));
    }
    report::variants("x", &variants);
    Ok(())
}

/// The scene with a body at several speeds.
fn speed_up(file: &SceneFile, accuracy: &mut csv::Accuracy) -> Result<(), Box<dyn Error>> {
    let Some(speeds) = &file.thesis.speeds else {
        return Ok(());
    };
    let mut variants = Vec::new();
    for &speed in &speeds.speeds {
        let scene = file.sped(&speeds.body, speed)?;
        let id = format!("{} at {speed}", file.id);
        for settings in Settings::SAMPLED {
            let run = run(file, &scene, settings, 1, *SEEDS.start())?;
            accuracy.push(&id, &run, None);
            variants.push((speed.to_string(), run));
        }
        let exact = exact(file, &scene)?;
        accuracy.push(&id, &exact, None);
        variants.push((speed.to_string(), exact));
    }
    report::variants("m/s", &variants);
    Ok(())
}

fn plot_times(file: &SceneFile, times: &[FrameTimes], folder: &Path) -> Result<(), Box<dyn Error>> {
    /// Of many numbers of bodies three are drawn.
    const BODIES: [usize; 4] = [2, 8, 12, 20];
    let mut groups: Vec<(usize, Acceleration)> = Vec::new();
    for time in times {
        let group = (time.bodies, time.broad_phase);
        if BODIES.contains(&time.bodies) && !groups.contains(&group) {
            groups.push(group);
        }
    }
    let colours = [BLUE, GREEN, PURPLE, ORANGE];
    let alone = groups.iter().all(|group| group.0 == groups[0].0);
    let series = |foreign: bool| {
        let groups: Vec<_> = groups.iter().zip(colours).collect();
        groups
            .into_iter()
            .map(move |(&(bodies, broad_phase), colour)| {
                let who = if foreign { "thesis" } else { "here" };
                let what = if alone {
                    report::broad_phase(broad_phase).to_owned()
                } else {
                    format!("{bodies} bodies")
                };
                let points = (times.iter())
                    .filter(|time| (time.bodies, time.broad_phase) == (bodies, broad_phase))
                    .filter_map(|time| {
                        let ms = if foreign {
                            time.thesis_ms?
                        } else {
                            time.worst_ms
                        };
                        Some((f64::from(time.rays), ms))
                    });
                Series {
                    name: format!("{what}, {who}"),
                    colour,
                    foreign,
                    points: points.collect(),
                }
            })
    };
    let plot = Plot {
        title: &format!(
            "{}: the worst frame (at 24 a second a frame has 42 ms)",
            file.scene.name
        ),
        unit: "ms",
        logarithmic: true,
        series: series(true).chain(series(false)).collect(),
    };
    plot.draw(&folder.join(format!("{}.svg", file.id)))
}
