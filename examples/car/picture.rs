//! The drive as an SVG picture, seen from the right.

use crate::Moment;
use crate::terrain::{CELL, LENGTH, Terrain};
use glam::DVec3;
use std::fmt::Write as _;
use std::path::PathBuf;

const WHEEL: f64 = 0.42;
/// The car's outline, in metres from its middle on the ground.
const BODY: [[f64; 2]; 11] = [
    [-2.15, 0.45],
    [2.15, 0.45],
    [2.2, 0.85],
    [2.1, 1.05],
    [1.15, 1.15],
    [0.55, 1.7],
    [-1.5, 1.75],
    [-2.0, 1.2],
    [-2.15, 1.1],
    [-2.2, 0.8],
    [-2.15, 0.45],
];
const WINDOW: [[f64; 2]; 4] = [[0.9, 1.15], [0.45, 1.58], [-1.35, 1.62], [-1.6, 1.15]];

/// Draws the drive and returns the path of the file.
pub(crate) fn draw(terrain: &Terrain, drive: &[Moment]) -> Result<PathBuf, std::io::Error> {
    let svg = picture(terrain, drive).map_err(std::io::Error::other)?;
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or("target".into(), PathBuf::from);
    let folder = target.join("car");
    std::fs::create_dir_all(&folder)?;
    let path = folder.join("drive.svg");
    std::fs::write(&path, svg)?;
    Ok(path)
}

/// Centimetres; the picture's y points down.
fn points(outline: impl IntoIterator<Item = DVec3>) -> String {
    let pair = |point: DVec3| format!("{:.2},{:.2} ", 1e2 * point.x, -1e2 * point.z);
    outline.into_iter().map(pair).collect()
}

/// The ground along a line of the mesh.
fn profile(terrain: &Terrain, y: f64) -> Vec<DVec3> {
    let steps = (LENGTH / CELL) as u32;
    let above = (0..=steps).map(|step| DVec3::new(f64::from(step) * CELL, y, 0.0));
    let ground = |above| terrain.below(above).map(|g| above - g.distance * DVec3::Z);
    above.filter_map(ground).collect()
}

fn picture(terrain: &Terrain, drive: &[Moment]) -> Result<String, std::fmt::Error> {
    let mut svg = String::new();
    let width = 1e2 * LENGTH;
    writeln!(
        svg,
        r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-60 -520 {} 900" width="1800" font-family="Helvetica, Arial, sans-serif">
<rect x="-60" y="-520" width="{}" height="900" fill="#f3f7fa"/>"##,
        width + 120.0,
        width + 120.0
    )?;
    for (y, fill) in [(CELL, "#c9d3b4"), (-CELL, "#a3b283")] {
        let ground = points(profile(terrain, y));
        writeln!(
            svg,
            r##"<polygon points="0,300 {ground}{width},300" fill="{fill}" stroke="#5d6b3c" stroke-width="3"/>"##
        )?;
    }
    let shown = drive.len().saturating_sub(1) / 5;
    for moment in drive.iter().step_by(shown.max(1)) {
        let body = |outline: &[[f64; 2]]| {
            points(
                outline
                    .iter()
                    .map(|&[x, z]| moment.pose.point(DVec3::new(x, 0.0, z))),
            )
        };
        writeln!(
            svg,
            r##"<polygon points="{}" fill="#d8573f" fill-opacity="0.92" stroke="#5b1f14" stroke-width="4" stroke-linejoin="round"/>
<polygon points="{}" fill="#dcebf3" stroke="#5b1f14" stroke-width="3" stroke-linejoin="round"/>"##,
            body(&BODY),
            body(&WINDOW)
        )?;
        let up = moment.pose.direction(DVec3::Z);
        // The left wheels are seen behind the right ones.
        for (index, fill) in [
            (0, "#6d7278"),
            (2, "#6d7278"),
            (1, "#2a2d31"),
            (3, "#2a2d31"),
        ] {
            let hub = moment.wheels[index] + WHEEL * up;
            let (x, y) = (1e2 * hub.x, -1e2 * hub.z);
            writeln!(
                svg,
                r##"<circle cx="{x:.2}" cy="{y:.2}" r="{}" fill="{fill}"/><circle cx="{x:.2}" cy="{y:.2}" r="17" fill="#c7ccd1"/>"##,
                1e2 * WHEEL
            )?;
        }
    }
    for (index, colour) in [(1, "#0f62a8"), (3, "#f0b429")] {
        for moment in drive.iter().step_by(4) {
            let at = moment.wheels[index];
            writeln!(
                svg,
                r##"<circle cx="{:.2}" cy="{:.2}" r="{}" fill="{colour}"/>"##,
                1e2 * at.x,
                -1e2 * at.z,
                if index == 1 { 7.5 } else { 4.5 }
            )?;
        }
    }
    writeln!(
        svg,
        r##"<g font-size="50" fill="#2b3a42"><text x="0" y="-440">Four rays a frame find the ground; the car's pose follows.</text>
<circle cx="20" cy="343" r="12" fill="#0f62a8"/><text x="45" y="360">right front wheel's contacts</text>
<circle cx="810" cy="343" r="12" fill="#f0b429"/><text x="835" y="360">right rear wheel's</text>
<rect x="1380" y="325" width="40" height="36" fill="#a3b283" stroke="#5d6b3c" stroke-width="3"/><text x="1435" y="360">ground on the right</text>
<rect x="1990" y="325" width="40" height="36" fill="#c9d3b4" stroke="#5d6b3c" stroke-width="3"/><text x="2045" y="360">on the left</text>
<path d="M3000 345h500m-500 -15v30m500 -30v30" stroke="#2b3a42" stroke-width="5" fill="none"/><text x="2880" y="360">5 m</text></g>
</svg>"##
    )?;
    Ok(svg)
}
