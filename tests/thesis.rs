//! The thesis's scenes: what it found, what its method finds here, and what the
//! default rays find.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

#[allow(dead_code, reason = "the example reads the rest")]
#[path = "../examples/thesis/accuracy.rs"]
mod accuracy;
#[path = "../examples/thesis/agreement.rs"]
mod agreement;
#[allow(dead_code, reason = "the example reads the rest")]
#[path = "../examples/thesis/scene_file.rs"]
mod scene_file;

use accuracy::{SEEDS, Settings, first_touch, median, run, runs};
use agreement::agreement;
use glam::DVec3;
use scene_file::{Acceleration, SceneFile, SceneFileError};
use std::path::Path;

fn scene(id: &str) -> SceneFile {
    let path = format!("{}/examples/scenes/{id}.toml", env!("CARGO_MANIFEST_DIR"));
    SceneFile::read(Path::new(&path)).unwrap_or_else(|error| panic!("{error}"))
}

/// The median agreement of the point over all seeds.
fn median_agreement(file: &SceneFile, settings: Settings, rays: u32) -> f64 {
    let runs = runs(file, settings, rays).expect("the scene runs");
    median(&runs)
        .and_then(|run| run.point)
        .expect("a point is expected")
}

/// All scenes with less agreement than they should have, for one message.
#[track_caller]
fn assert_none(short: &[String]) {
    assert!(short.is_empty(), "\n{}", short.join("\n"));
}

#[test]
fn every_scene_file_makes_a_world() {
    let files = SceneFile::read_all().expect("all files can be read");
    let ids: Vec<&str> = files.iter().map(|file| file.id.as_str()).collect();
    let expected = [
        "scene-1", "scene-2", "scene-3", "scene-4", "scene-5", "scene-6", "scene-7", "scene-8",
        "scene-9", "scene-10", "scene-11", "rifle",
    ];
    assert_eq!(ids, expected);
    for file in &files {
        let (world, bodies) = file.scene.world().expect("a world");
        assert_eq!(world.len(), bodies.len());
        for table in &file.thesis.timing {
            assert_eq!(table.rays.len(), table.ms.len(), "{}", file.id);
            assert!(table.bodies <= bodies.len(), "{}", file.id);
        }
    }
    let plain = |table: &&scene_file::Timing| table.broad_phase == Acceleration::Plain;
    assert_eq!(
        scene("scene-11").thesis.timing.iter().filter(plain).count(),
        1
    );
}

/// What was copied from the thesis fits together: points and agreements.
#[test]
fn the_thesis_figures_follow_from_its_points() {
    // Rows of the thesis that contradict themselves.
    let scenes: [(&str, &[u32]); 5] = [
        ("scene-2", &[2, 4, 20]),
        ("scene-4", &[]),
        ("scene-6", &[]),
        ("scene-7", &[]),
        ("scene-9", &[100]),
    ];
    for (id, misfits) in scenes {
        let file = scene(id);
        let expected = file.thesis.point.expect("a point is expected");
        for row in &file.thesis.table {
            let Some(found) = row.found else { continue };
            let follows = (agreement(found, expected) - row.point).abs() < 0.1;
            assert_eq!(
                follows,
                !misfits.contains(&row.rays),
                "{id}, {} rays",
                row.rays
            );
        }
    }
}

#[test]
fn agreement_is_the_thesis_formula() {
    let expected = [0.8660254, 0.0, 0.5];
    assert!((agreement([0.857209, -0.086824, 0.507596], expected) - 96.5).abs() < 0.01);
    assert!((agreement(expected, expected) - 100.0).abs() < 1e-12);
    assert!((agreement([0.0; 3], [0.0; 3]) - 100.0).abs() < 1e-12);
    // A mirrored component agrees not at all.
    assert!((agreement([-0.8660254, 0.0, 0.5], expected) - 200.0 / 3.0).abs() < 1e-12);
}

#[test]
fn a_file_that_is_no_scene_says_where() {
    let folder = std::env::temp_dir();
    let missing = SceneFile::read(&folder.join("no-such-scene.toml"));
    assert!(matches!(missing, Err(SceneFileError::Read { .. })));
    let path = folder.join(format!("feeler-bad-scene-{}.toml", std::process::id()));
    std::fs::write(&path, "name = \"s\"\nframe_rate = -1\n").expect("a file is written");
    let bad = SceneFile::read(&path)
        .expect_err("it is refused")
        .to_string();
    std::fs::write(&path, "name = \"s\"\n[thesis]\nwidth = 1\n").expect("a file is written");
    let unknown = SceneFile::read(&path)
        .expect_err("it is refused")
        .to_string();
    std::fs::remove_file(&path).expect("the file is removed");
    assert!(
        bad.contains("frame_rate is -1e0, below the minimum of 1e-9"),
        "{bad}"
    );
    assert!(unknown.contains("unknown field `width`"), "{unknown}");
    assert!(unknown.contains("line 3"), "{unknown}");
}

#[test]
fn a_scene_varies_only_bodies_it_has() {
    let file = scene("rifle");
    assert!(file.sped("A", 2.0).is_ok());
    assert!(matches!(
        file.sped("B", 2.0),
        Err(SceneFileError::NoSuchBody { .. })
    ));
    assert!(matches!(
        file.placed("C", [0.0; 3]),
        Err(SceneFileError::NoSuchBody { .. })
    ));
}

/// Where one ray is the answer, any number of rays finds it.
#[test]
fn head_on_scenes_agree_from_one_ray() {
    let mut short = Vec::new();
    for id in ["scene-1", "scene-3", "scene-5", "rifle"] {
        let file = scene(id);
        for rays in file.ray_counts() {
            for settings in Settings::BOTH {
                for run in runs(&file, settings, rays).expect("the scene runs") {
                    let [point, normal] = [run.point, run.normal].map(|it| it.unwrap_or(0.0));
                    // In scene 5 every direction within a cone is a normal.
                    let normal_counts = id != "scene-5" || settings == Settings::Thesis;
                    if point < 100.0 - 1e-6 || (normal_counts && normal < 100.0 - 1e-6) {
                        let seed = run.seed;
                        short.push(format!(
                            "{id} {settings:?} {rays} rays seed {seed}: {point} {normal}"
                        ));
                    }
                }
            }
        }
    }
    assert_none(&short);
}

#[test]
fn the_bullet_hits_at_every_speed() {
    let file = scene("rifle");
    let speeds = file.thesis.speeds.as_ref().expect("there are speeds");
    for &speed in &speeds.speeds {
        let scene = file.sped(&speeds.body, speed).expect("the body moves");
        for settings in Settings::BOTH {
            let run = run(&file, &scene, settings, 1, 10).expect("the scene runs");
            let agreement = run.point.unwrap_or(0.0);
            assert!(
                agreement > 100.0 - 1e-6,
                "{settings:?} at {speed} m/s: {agreement}"
            );
        }
    }
}

#[test]
fn the_ball_on_a_curve_agrees_from_one_ray() {
    let file = scene("scene-7");
    let mut short = Vec::new();
    for rays in file.ray_counts() {
        let bar = if rays >= 64 { 99.9 } else { 99.7 };
        let agreement = median_agreement(&file, Settings::Rays, rays);
        if agreement < bar {
            short.push(format!("{rays} rays: {agreement}, below {bar}"));
        }
    }
    assert_none(&short);
}

#[test]
fn default_rays_agree_better_than_the_thesis() {
    let mut short = Vec::new();
    for id in ["scene-2", "scene-4", "scene-6", "scene-9"] {
        let file = scene(id);
        for rays in file.ray_counts() {
            let thesis = file.row(rays).map_or(0.0, |row| row.point);
            let floor: f64 = match rays {
                400.. => 99.9,
                64.. => 99.0,
                _ => 0.0,
            };
            let bar = if rays >= 10 {
                f64::max(floor, thesis)
            } else {
                floor
            };
            let agreement = median_agreement(&file, Settings::Rays, rays);
            if agreement < bar {
                short.push(format!("{id}, {rays} rays: {agreement}, below {bar}"));
            }
        }
    }
    assert_none(&short);
}

/// The curve grazes the ball at a distance of exactly 2.
#[test]
fn default_rays_tell_a_graze_from_a_miss() {
    let file = scene("scene-8");
    let positions = file.thesis.positions.as_ref().expect("there are positions");
    let mut wrong = Vec::new();
    for (x, rays, touches) in [
        (1.9999, 400, true),
        (2.0001, 100, false),
        (2.0001, 400, false),
    ] {
        let scene = file
            .placed(&positions.body, [x, 0.0, 0.0])
            .expect("the body is there");
        for seed in SEEDS {
            let touch = first_touch(&scene, Settings::Rays.config(rays, seed)).expect("it runs");
            if touch.is_some() != touches {
                wrong.push(format!("x = {x}, {rays} rays, seed {seed}: {touch:?}"));
            }
        }
    }
    assert_none(&wrong);
}

/// Its points to the six digits it prints, which it computed in `f32`: all but
/// those of scene 2 at 64, 100 and 400 rays, and that of scene 4 at 1000.
#[test]
fn the_thesis_points_are_reproduced() {
    let mut wrong = Vec::new();
    let mut rows = 0;
    for (id, others) in [
        ("scene-2", &[1, 2, 4, 64, 100, 400][..]),
        ("scene-4", &[1000]),
        ("scene-6", &[]),
    ] {
        let file = scene(id);
        let table = &file.thesis.table;
        for row in table.iter().filter(|row| !others.contains(&row.rays)) {
            let config = Settings::Thesis.config(row.rays, file.thesis.seed());
            let touch = first_touch(&file.scene, config).expect("it runs");
            let found = touch.expect("there is a contact").point;
            let printed = DVec3::from(row.found.expect("there was a contact"));
            if (found - printed).abs().max_element() > 2e-6 {
                wrong.push(format!(
                    "{id}, {} rays: {found}, printed {printed}",
                    row.rays
                ));
            }
            rows += 1;
        }
    }
    assert_none(&wrong);
    assert_eq!(rows, 9 + 7 + 10);
}

/// Its row of 1000 rays comes out with the first 952 to 979 of them.
#[test]
fn a_few_of_the_thesis_rays_seem_to_be_missing() {
    let file = scene("scene-4");
    let printed = file
        .row(1000)
        .and_then(|row| row.found)
        .expect("there is a row");
    let off = |rays| {
        let config = Settings::Thesis.config(rays, file.thesis.seed());
        let touch = first_touch(&file.scene, config).expect("it runs");
        let found = touch.expect("there is a contact").point;
        (found - DVec3::from(printed)).abs().max_element()
    };
    assert!(off(952) < 2e-6 && off(979) < 2e-6);
    assert!(off(951) > 1e-3 && off(980) > 1e-3);
}

/// Its program lets a frame's chord stand for the sharp bend of scene 7, and where
/// frames begin decides how well that does. Its 99.7 is among what comes out.
#[test]
fn where_frames_begin_decides_the_thesis_figure_on_a_sharp_bend() {
    let mut file = scene("scene-7");
    let mut agreements = Vec::new();
    for step in 0..40 {
        file.scene.frame_rate = 22.0 + 0.1 * f64::from(step);
        let run = run(&file, &file.scene, Settings::Thesis, 2, 10).expect("it runs");
        agreements.push(run.point.expect("a point is expected"));
    }
    agreements.sort_by(f64::total_cmp);
    let (least, best) = (agreements[0], agreements[39]);
    assert!(least < 99.7 && best >= 99.7, "{least}..{best}");
}
