//! The break as an SVG picture, seen from above.

use crate::table::{CUSHION, Hit, LENGTH, RADIUS, Target, WIDTH, rack};
use glam::DVec3;
use std::fmt::Write as _;
use std::path::PathBuf;

const COLOURS: [&str; 10] = [
    "#5c6b73", "#d9a400", "#1f5fbf", "#cf2e2e", "#6f3fa0", "#e8731a", "#1c8a4b", "#8c2f39",
    "#22262b", "#3aa6b9",
];

/// Draws where the balls went and returns the path of the file.
pub(crate) fn draw(tracks: &[Vec<DVec3>], hits: &[Hit]) -> Result<PathBuf, std::io::Error> {
    let svg = picture(tracks, hits).map_err(std::io::Error::other)?;
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or("target".into(), PathBuf::from);
    let folder = target.join("billiards");
    std::fs::create_dir_all(&folder)?;
    let path = folder.join("break.svg");
    std::fs::write(&path, svg)?;
    Ok(path)
}

/// Millimetres; the picture's y points down, the table's up.
fn at(point: DVec3) -> (f64, f64) {
    (1e3 * point.x, 1e3 * (WIDTH - point.y))
}

fn picture(tracks: &[Vec<DVec3>], hits: &[Hit]) -> Result<String, std::fmt::Error> {
    let (length, width, radius) = (1e3 * LENGTH, 1e3 * WIDTH, 1e3 * RADIUS);
    let (rim, margin) = (1e3 * CUSHION, 1e3 * CUSHION + 60.0);
    let mut svg = String::new();
    writeln!(
        svg,
        r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="{:.0} {:.0} {:.0} {:.0}" width="1400" font-family="Helvetica, Arial, sans-serif">
<rect x="{:.0}" y="{:.0}" width="{:.0}" height="{:.0}" fill="#fbfaf7"/>
<rect x="-{rim}" y="-{rim}" width="{}" height="{}" rx="14" fill="#7a5a3c"/>
<rect width="{length}" height="{width}" fill="#e6f0e9"/>"##,
        -margin,
        -margin,
        length + 2.0 * margin,
        width + 2.0 * margin + 70.0,
        -margin,
        -margin,
        length + 2.0 * margin,
        width + 2.0 * margin + 70.0,
        length + 2.0 * rim,
        width + 2.0 * rim,
    )?;
    for start in rack() {
        let (x, y) = at(start);
        writeln!(
            svg,
            r##"<circle cx="{x:.2}" cy="{y:.2}" r="{radius}" fill="#ffffff" stroke="#b9c7be" stroke-width="2"/>"##
        )?;
    }
    for (track, colour) in tracks.iter().zip(COLOURS) {
        write!(
            svg,
            r#"<polyline fill="none" stroke="{colour}" stroke-width="5" stroke-opacity="0.8" stroke-linejoin="round" points=""#
        )?;
        for &point in track {
            let (x, y) = at(point);
            write!(svg, "{x:.2},{y:.2} ")?;
        }
        writeln!(svg, r#""/>"#)?;
    }
    for hit in hits {
        let (x, y) = at(hit.point);
        let fill = match hit.target {
            Target::Ball(_) => "#ffffff",
            Target::Cushion(_) => "#ffd54a",
        };
        writeln!(
            svg,
            r##"<circle cx="{x:.2}" cy="{y:.2}" r="8" fill="{fill}" stroke="#22262b" stroke-width="2.5"/>"##
        )?;
    }
    for (ball, (track, colour)) in tracks.iter().zip(COLOURS).enumerate() {
        let Some(&end) = track.last() else { continue };
        let (x, y) = at(end);
        let label = if ball == 0 {
            "c".to_owned()
        } else {
            ball.to_string()
        };
        writeln!(
            svg,
            r##"<circle cx="{x:.2}" cy="{y:.2}" r="{radius}" fill="{colour}" stroke="#22262b" stroke-width="2.5"/>
<text x="{x:.2}" y="{:.2}" font-size="30" font-weight="bold" fill="#ffffff" text-anchor="middle">{label}</text>"##,
            y + 10.5
        )?;
    }
    let foot = width + rim + 62.0;
    writeln!(
        svg,
        r##"<g font-size="34" fill="#333a40"><text x="0" y="{foot}">The break at 12 m/s, the first 0.4 s.</text>
<circle cx="1012" cy="{dot}" r="9" fill="#ffffff" stroke="#22262b" stroke-width="2.5"/><text x="1034" y="{foot}">ball meets ball</text>
<circle cx="1352" cy="{dot}" r="9" fill="#ffd54a" stroke="#22262b" stroke-width="2.5"/><text x="1374" y="{foot}">ball meets cushion</text>
<circle cx="1775" cy="{dot}" r="20" fill="#ffffff" stroke="#b9c7be" stroke-width="3"/><text x="1808" y="{foot}">where the balls lay</text></g>
</svg>"##,
        dot = foot - 12.0
    )?;
    Ok(svg)
}
