//! Two aircraft on crossing loops: `cargo run --release --example flight`.
//!
//! When and where do they touch, and how near do they come on the way? The one flies its loop a little
//! slower than the other, so that it takes them some rounds to meet.

#![allow(clippy::print_stdout, reason = "that is what the example does")]

use feeler::narrow_phase::distance::closest_points;
use feeler::{Body, Cuboid, Facing, Knots, Method, Motion, Path, first_contact};
use glam::DVec3;
use std::error::Error;
use std::fmt::Write as _;
use std::path::PathBuf;

/// Seconds.
const HORIZON: f64 = 3600.0;

fn aircraft(centre: DVec3, tilt: f64, speed: f64) -> Result<(Body, Path), Box<dyn Error>> {
    let corners = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0].map(|eighth: f64| {
        let (sine, cosine) = (eighth * std::f64::consts::FRAC_PI_4).sin_cos();
        centre + 400.0 * DVec3::new(cosine, sine, tilt * sine)
    });
    let mut corners = corners.to_vec();
    corners[8] = corners[0];
    let path = Path::catmull_rom(corners, Knots::Centripetal)?;
    let facing = Facing {
        forward: DVec3::X,
        up: DVec3::Z,
        world_up: DVec3::Z,
    };
    let motion = Motion::along(path.clone(), speed)?
        .looping()?
        .facing(facing)?;
    Ok((Body::moving(Cuboid::new([9.0, 8.0, 1.5])?, motion), path))
}

fn main() -> Result<(), Box<dyn Error>> {
    let (a, path_a) = aircraft(DVec3::ZERO, 0.1, 70.0)?;
    let (b, path_b) = aircraft(DVec3::new(500.0, 0.0, 0.0), 0.1, 63.7)?;
    let contact = first_contact(&a, &b, HORIZON, &Method::Exact)?;
    let until = contact.map_or(HORIZON, |contact| contact.fraction * HORIZON);
    // How near they came, round by round, a minute before the touch left out.
    let mut nearest = (f64::INFINITY, 0.0);
    let mut time = 0.0;
    while time < until - 60.0 {
        let (pose_a, pose_b) = (a.pose_after(time), b.pose_after(time));
        let apart = closest_points(a.shape(), &pose_a, b.shape(), &pose_b);
        let apart = apart.map_or(0.0, |closest| closest.distance);
        if apart < nearest.0 {
            nearest = (apart, time);
        }
        time += 0.05;
    }
    println!("nearest before: {:.2} m at {:.2} s", nearest.0, nearest.1);
    match contact {
        Some(contact) => {
            println!("they touch at {until:.9} s, at {:.6}", contact.point);
            println!("normal {:.6}, {:?}", contact.normal, contact.features);
        }
        None => println!("they do not touch within {HORIZON} s"),
    }
    let mut svg = String::from(
        r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-450 -450 1400 900" width="1000">
<rect x="-450" y="-450" width="1400" height="900" fill="#f3f7fa"/>
"##,
    );
    for (body, path, colour) in [(&a, &path_a, "#3a6ea5"), (&b, &path_b, "#d9822b")] {
        let points: String = (0..=200)
            .map(|step| path.position_at(path.length() * f64::from(step) / 200.0))
            .map(|point| format!("{:.2},{:.2} ", point.x, -point.y))
            .collect();
        writeln!(
            svg,
            r#"<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="2"/>"#
        )?;
        let pose = body.pose_after(until);
        let corners = [(9.0, 8.0), (-9.0, 8.0), (-9.0, -8.0), (9.0, -8.0)].map(|(x, y)| {
            let corner = pose.point(DVec3::new(x, y, 0.0));
            format!("{:.2},{:.2}", corner.x, -corner.y)
        });
        writeln!(
            svg,
            r#"<polygon points="{}" fill="{colour}"/>"#,
            corners.join(" ")
        )?;
    }
    if let Some(contact) = contact {
        let (point, tip) = (contact.point, contact.point + 40.0 * contact.normal);
        writeln!(
            svg,
            r##"<line x1="{:.2}" y1="{:.2}" x2="{:.2}" y2="{:.2}" stroke="#b3202c" stroke-width="3"/>"##,
            point.x, -point.y, tip.x, -tip.y
        )?;
    }
    svg.push_str("</svg>\n");
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or("target".into(), PathBuf::from);
    let folder = target.join("flight");
    std::fs::create_dir_all(&folder)?;
    let file = folder.join("loops.svg");
    std::fs::write(&file, svg)?;
    println!("drawn in {}", file.display());
    Ok(())
}
