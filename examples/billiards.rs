//! A break: nine balls in a diamond, each touching its neighbours, struck by
//! the cue ball at 12 m/s, on a table without friction and without loss.
//!
//! The world finds out what touches when; how balls bounce is up to its user,
//! and stands in `billiards/table.rs`.
//!
//! `cargo run --example billiards` prints what happens and draws it.
#![allow(clippy::print_stdout, reason = "an example talks to its reader")]

#[path = "billiards/picture.rs"]
mod picture;
#[path = "billiards/table.rs"]
mod table;

use feeler::{Cuboid, Pose, Sphere, overlap};
use glam::DVec3;
use std::error::Error;
use table::{Hit, LENGTH, MASS, RADIUS, Table, Target};

/// Frames as long as in a film: 1/30 s.
const FRAME: f64 = 1.0 / 30.0;

fn main() -> Result<(), Box<dyn Error>> {
    let cue_velocity = DVec3::new(12.0, 0.06, 0.0);
    let mut table = Table::new(cue_velocity)?;
    let (energy, momentum) = (table.energy()?, table.momentum()?);

    let mut deepest = table.deepest()?;
    for frame in 1..=1800 {
        table.play_until(f64::from(frame) * FRAME)?;
        deepest = deepest.max(table.deepest()?);
        if frame == 12 {
            println!("The first 0.4 s:");
            table.hits.iter().for_each(report);
            println!("\nWhere the balls are then, in metres:");
            for (ball, at) in table.positions()?.into_iter().enumerate() {
                println!("  {:7} ({:.6}, {:.6})", name(ball), at.x, at.y);
            }
            let path = picture::draw(&table.tracks()?, &table.hits)?;
            println!("\nPicture: {}", path.display());
        }
    }

    println!("\nAfter a minute and {} hits:", table.hits.len());
    let energy_now = table.energy()?;
    println!("  kinetic energy  {energy:.12} J before, {energy_now:.12} J now");
    let balance = table.momentum()? - table.impulse;
    println!("  momentum        {momentum:.12} N s before");
    println!("  less cushions'  {balance:.12} N s now");
    println!(
        "  deepest overlap {:.1e} m as any frame ends",
        deepest.max(0.0)
    );
    println!("  every ball is on the table: {}", table.all_on_table()?);
    let lost = (energy_now - energy).abs() / energy;
    let owed = (balance - momentum).length() / (MASS * cue_velocity.length());
    if lost > 1e-9 || owed > 1e-9 || deepest > 1e-9 {
        let what = "of the energy lost, of the momentum owed, m of overlap";
        return Err(format!("{what}: {lost:e}, {owed:e}, {deepest:e}").into());
    }

    step_discretely(cue_velocity)
}

/// The same shot, looked at only as frames end: the cue ball passes through
/// the whole rack and through the cushion behind it.
fn step_discretely(velocity: DVec3) -> Result<(), Box<dyn Error>> {
    let [cue, rest @ ..] = table::rack();
    let ball = Sphere::new(RADIUS)?.into();
    let mut seen = 0;
    for frame in 0..=6 {
        let at = Pose::at(cue + f64::from(frame) * FRAME * velocity);
        for other in rest {
            seen += usize::from(overlap(&ball, &at, &ball, &Pose::at(other)).is_some());
        }
        for (half_extents, centre) in table::cushions() {
            let cushion = Cuboid::new(half_extents)?.into();
            seen += usize::from(overlap(&ball, &at, &cushion, &Pose::at(centre)).is_some());
        }
    }
    let end = cue.x + 6.0 * FRAME * velocity.x;
    println!("\nThe same shot without continuous detection, looked at every 1/30 s:");
    println!("  {seen} overlaps seen, cue ball at x = {end:.2} m of {LENGTH} m");
    Ok(())
}

fn report(hit: &Hit) {
    let target = match hit.target {
        Target::Ball(other) => name(other),
        Target::Cushion(side) => ["left", "right", "near", "far"][side % 4].to_owned() + " cushion",
    };
    let Hit { time, speed, .. } = hit;
    println!(
        "  {time:.9} s  {:7} meets {target:14} at {speed:9.6} m/s",
        name(hit.ball)
    );
}

fn name(ball: usize) -> String {
    match ball {
        0 => "cue".to_owned(),
        number => format!("ball {number}"),
    }
}
