//! A car drives over hills and feels the ground with four rays, one at each
//! wheel: the example the thesis opens with (§1.7, after Akenine-Möller).
//!
//! A ray points down from the lowest point of a wheel. Where it meets the
//! ground at fraction 0, the wheel stands; a positive one says how far it
//! floats, a negative one how deep it has sunk. The car is put where all four
//! are 0, and its pose follows.
//!
//! `cargo run --example car` prints the drive and draws it.
#![allow(clippy::print_stdout, reason = "an example talks to its reader")]

#[path = "car/picture.rs"]
mod picture;
#[path = "car/terrain.rs"]
mod terrain;

use feeler::{Path, Pose};
use glam::{DMat3, DQuat, DVec3};
use std::error::Error;
use terrain::{CELL, LENGTH, Terrain};

/// Wheels from the car's middle, in metres: a whole number of cells apart, so
/// that they can roll along the lines of the mesh.
const WHEELS: [DVec3; 4] = [
    DVec3::new(2.0 * CELL, CELL, 0.0),
    DVec3::new(2.0 * CELL, -CELL, 0.0),
    DVec3::new(-2.0 * CELL, CELL, 0.0),
    DVec3::new(-2.0 * CELL, -CELL, 0.0),
];
const SPEED: f64 = 6.0;
/// Rays are cast this often: every eighth of a cell on a straight course.
const FRAME: f64 = CELL / 8.0 / SPEED;

/// What one frame found.
pub(crate) struct Moment {
    pub(crate) wheels: [DVec3; 4],
    pub(crate) pose: Pose,
}

fn main() -> Result<(), Box<dyn Error>> {
    let terrain = Terrain::new(7)?;
    println!("The ground: {} triangles.", terrain.triangles().len());
    let (start, end) = (3.0 * CELL, LENGTH - 3.0 * CELL);

    println!("\nStraight on, all wheels on lines of the mesh:");
    let straight = drive(&terrain, &Path::line([start, 0.0, 0.0], [end, 0.0, 0.0])?)?;
    println!("\nIn curves:");
    let bend = |share: f64, y: f64| DVec3::new(start + share * (end - start), y, 0.0);
    let points = [
        bend(0.0, 0.0),
        bend(0.25, 0.9),
        bend(0.5, -0.8),
        bend(0.75, 0.7),
        bend(1.0, 0.0),
    ];
    drive(
        &terrain,
        &Path::spline(points, [8.0, 0.0, 0.0], [8.0, 0.0, 0.0])?,
    )?;

    println!(
        "\nPicture: {}",
        picture::draw(&terrain, &straight)?.display()
    );
    Ok(())
}

/// Drives along a course in the plane z = 0 and returns every frame.
fn drive(terrain: &Terrain, course: &Path) -> Result<Vec<Moment>, Box<dyn Error>> {
    let frames = (course.length() / SPEED / FRAME) as usize;
    let mut moments = Vec::with_capacity(frames + 1);
    let (mut edges, mut vertices, mut misses, mut worst) = (0, 0, 0, 0.0_f64);
    let mut heights = [10.0; 4];
    println!(
        "  time/s    x/m    y/m | wheels' heights/m: fl, fr, rl, rr | pitch/°  roll/° | wheels moved by/mm"
    );
    for frame in 0..=frames {
        let time = frame as f64 * FRAME;
        let (at, ahead) = (
            course.position_at(SPEED * time),
            course.tangent_at(SPEED * time),
        );
        let left = DVec3::Z.cross(ahead);
        let mut wheels = [DVec3::ZERO; 4];
        let mut moved = 0.0_f64;
        for ((wheel, height), mount) in wheels.iter_mut().zip(&mut heights).zip(WHEELS) {
            let above = (at + mount.x * ahead + mount.y * left).with_z(*height);
            *wheel = above;
            let Some(ground) = terrain.below(above) else {
                misses += 1;
                continue;
            };
            match ground.triangles {
                1 => {}
                2 => edges += 1,
                _ => vertices += 1,
            }
            // Down is positive: what is below, the wheel floats above.
            *height -= ground.distance;
            *wheel = above.with_z(*height);
            if frame > 0 {
                moved = moved.max(ground.distance.abs());
            }
        }
        worst = worst.max(moved);
        let pose = pose_on(&wheels);
        if frame % 48 == 0 {
            let [fl, fr, rl, rr] = heights;
            let pitch = pose.direction(DVec3::X).z.asin().to_degrees();
            let roll = pose.direction(DVec3::Y).z.asin().to_degrees();
            println!(
                "  {time:6.3} {:6.2} {:6.2} | {fl:7.4} {fr:7.4} {rl:7.4} {rr:7.4}   | {pitch:7.2} {roll:7.2} | {:6.1}",
                at.x,
                at.y,
                1e3 * moved
            );
        }
        moments.push(Moment { wheels, pose });
    }
    println!(
        "  {} rays: {edges} on edges, {vertices} on vertices, {misses} missed",
        4 * moments.len()
    );
    println!(
        "  a wheel moved by {:.1} mm in a frame at most",
        1e3 * worst
    );
    if misses > 0 {
        return Err("rays went through the ground".into());
    }
    Ok(moments)
}

/// The car's pose on four wheels: ahead from the rear ones to the front ones,
/// left from the right ones to the left ones.
fn pose_on(&[fl, fr, rl, rr]: &[DVec3; 4]) -> Pose {
    let ahead = ((fl + fr) - (rl + rr)).normalize();
    let up = ahead.cross((fl + rl) - (fr + rr)).normalize();
    let turned = DMat3::from_cols(ahead, up.cross(ahead), up);
    Pose::new(0.25 * (fl + fr + rl + rr), DQuat::from_mat3(&turned))
}
