//! What sampling costs: how far off contact points are, against the number of rays.

use crate::accuracy::{RunError, SEEDS, Settings, exact, first_touch};
use crate::plots::{BLUE, GREEN, INK, ORANGE, PURPLE, Plot, Series};
use crate::scene_file::SceneFile;
use feeler::{Method, Placement, RayConfig};
use glam::DVec3;
use std::error::Error;
use std::path::Path;

/// Scenes where the contact is one point, and no ray meets it by being foremost.
const SCENES: [&str; 3] = ["scene-2", "scene-4", "scene-6"];
const RAYS: [u32; 11] = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000];
/// Rounding of a coordinate of 1 m: what is nearer is drawn here.
const FLOOR: f64 = 0.5 * f64::EPSILON;

/// Draws the errors of sampled rays in three scenes, and of the exact method below.
///
/// Of the thesis's method a line for each scene. Refined rays meet some
/// contacts to the last bit by chance, so that only the worst of all is of interest.
pub(crate) fn plot(files: &[SceneFile], path: &Path) -> Result<(), Box<dyn Error>> {
    let (mut series, mut exactly) = (Vec::new(), FLOOR);
    let mut worst = RAYS.map(|rays| (f64::from(rays), FLOOR));
    let scenes = (files.iter()).filter(|file| SCENES.contains(&file.id.as_str()));
    for (file, colour) in scenes.zip([BLUE, ORANGE, PURPLE]) {
        let Some(expected) = file.thesis.point.map(DVec3::from) else {
            continue;
        };
        let mut medians = Vec::new();
        for (&rays, worst) in RAYS.iter().zip(&mut worst) {
            let theirs = errors(file, expected, |seed| Settings::Thesis.method(rays, seed))?;
            if let Some(&median) = theirs.get(theirs.len() / 2) {
                medians.push((f64::from(rays), median.max(FLOOR)));
            }
            let refined = errors(file, expected, |seed| even(rays, seed))?;
            worst.1 = refined.last().copied().unwrap_or(FLOOR).max(worst.1);
        }
        series.push(Series {
            name: format!("its method in {}", file.scene.name.to_lowercase()),
            colour,
            foreign: false,
            points: medians,
        });
        if let Some(touch) = exact(file, &file.scene)?.touch {
            exactly = exactly.max(touch.point.distance(expected));
        }
    }
    series.push(Series {
        name: "even rays, refined, at worst".to_owned(),
        colour: GREEN,
        foreign: false,
        points: worst.into(),
    });
    series.push(Series {
        name: "exact, at worst".to_owned(),
        colour: INK,
        foreign: true,
        points: RAYS.map(|rays| (rays.into(), exactly)).into(),
    });
    let plot = Plot {
        title: "How far from the true contact: the thesis's method (median of 20 seeds), and others",
        unit: "m",
        logarithmic: true,
        series,
    };
    plot.draw(path)
}

/// Rays all over the body, both ways and refined.
fn even(rays: u32, seed: u64) -> Method {
    Method::Rays(RayConfig {
        rays,
        seed,
        placement: Placement::Even,
        ..RayConfig::default()
    })
}

/// How far from `expected` the point is that each seed finds, in ascending order;
/// without the seeds that find none.
fn errors(
    file: &SceneFile,
    expected: DVec3,
    method: impl Fn(u64) -> Method,
) -> Result<Vec<f64>, RunError> {
    let mut errors = Vec::new();
    for seed in SEEDS {
        let touch = first_touch(&file.scene, method(seed))?;
        errors.extend(touch.map(|touch| touch.point.distance(expected)));
    }
    errors.sort_by(f64::total_cmp);
    Ok(errors)
}
