//! A bar that turns, and the ball it hits: `cargo run --release --example spinning_bar`.
//!
//! Casts that look for a root of the distance let fast bars through. Here it is found at any rate;
//! the last one is drawn.

#![allow(clippy::print_stdout, reason = "that is what the example does")]

use feeler::{Body, Cuboid, Method, Motion, Sphere, first_contact};
use glam::{DQuat, DVec3};
use std::error::Error;
use std::path::PathBuf;

const HALF: DVec3 = DVec3::new(2.0, 0.05, 0.05);
const RADIUS: f64 = 0.1;

fn main() -> Result<(), Box<dyn Error>> {
    let place = DVec3::new(0.5_f64.sqrt(), 0.5_f64.sqrt(), 0.0) * 1.5;
    let ball = Body::fixed(Sphere::new(RADIUS)?, place);
    let mut svg = String::new();
    println!("rad/s      found (s)          closed form (s)");
    for rate in [1000.0, 31.4, 6.0, 3.0] {
        let motion = Motion::fixed([0.0; 3])?.spin([0.0, 0.0, 1.0], rate)?;
        let bar = Body::moving(Cuboid::new(HALF)?, motion);
        let contact = first_contact(&bar, &ball, 1.0, &Method::Exact)?.ok_or("missed")?;
        let angle = std::f64::consts::FRAC_PI_4 - ((RADIUS + HALF.y) / 1.5).asin();
        println!("{rate:<8} {:.15}  {:.15}", contact.fraction, angle / rate);
        svg = picture(angle, place, contact.point, contact.normal);
    }
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or("target".into(), PathBuf::from);
    let folder = target.join("spinning_bar");
    std::fs::create_dir_all(&folder)?;
    let file = folder.join("bar.svg");
    std::fs::write(&file, svg)?;
    println!("drawn in {}", file.display());
    Ok(())
}

/// The bar as it begins and at the touch, seen against its axis; the picture's y points down.
fn picture(angle: f64, ball: DVec3, point: DVec3, normal: DVec3) -> String {
    let bar = |angle: f64, colour: &str| {
        let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)].map(|(x, y)| {
            let corner = DQuat::from_rotation_z(angle) * DVec3::new(x * HALF.x, y * HALF.y, 0.0);
            format!("{:.4},{:.4}", corner.x, -corner.y)
        });
        format!(
            r#"<polygon points="{}" fill="{colour}"/>"#,
            corners.join(" ")
        )
    };
    let tip = point + 0.4 * normal;
    format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-2.2 -2.2 4.4 4.4" width="800">
<rect x="-2.2" y="-2.2" width="4.4" height="4.4" fill="#f3f7fa"/>
<circle r="2" fill="none" stroke="#b8c4cc" stroke-width="0.01"/>
{}{}
<circle cx="{:.4}" cy="{:.4}" r="{RADIUS}" fill="#d9822b"/>
<line x1="{:.4}" y1="{:.4}" x2="{:.4}" y2="{:.4}" stroke="#b3202c" stroke-width="0.02"/>
<circle cx="{:.4}" cy="{:.4}" r="0.025" fill="#b3202c"/>
</svg>
"##,
        bar(0.0, "#c9d6df"),
        bar(angle, "#3a6ea5"),
        ball.x,
        -ball.y,
        point.x,
        -point.y,
        tip.x,
        -tip.y,
        point.x,
        -point.y,
    )
}
