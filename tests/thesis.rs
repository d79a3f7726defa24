//! The thesis's scenes: what it found, what its method finds here, and what aimed
//! rays and the exact method find.

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
#[path = "../examples/thesis/as_printed.rs"]
mod as_printed;
#[allow(dead_code, reason = "the example reads the rest")]
#[path = "../examples/thesis/scene_file.rs"]
mod scene_file;

use accuracy::{SEEDS, Settings, exact, first_touch, frames, median, run, runs};
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
            for settings in Settings::SAMPLED {
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
        for settings in Settings::SAMPLED {
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
fn aimed_rays_agree_better_than_the_thesis() {
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
fn aimed_rays_tell_a_graze_from_a_miss() {
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
            let touch = first_touch(&scene, Settings::Rays.method(rays, seed)).expect("it runs");
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
            let method = Settings::Thesis.method(row.rays, file.thesis.seed());
            let touch = first_touch(&file.scene, method).expect("it runs");
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
        let method = Settings::Thesis.method(rays, file.thesis.seed());
        let touch = first_touch(&file.scene, method).expect("it runs");
        let found = touch.expect("there is a contact").point;
        (found - DVec3::from(printed)).abs().max_element()
    };
    assert!(off(952) < 2e-6 && off(979) < 2e-6);
    assert!(off(951) > 1e-3 && off(980) > 1e-3);
}

/// In every table its method comes out within 3 % of the thesis's figure, and within
/// 1 % on average: the comparison with it is fair.
#[test]
fn the_thesis_figures_are_within_their_scatter() {
    let files = SceneFile::read_all().expect("all files can be read");
    let (mut wrong, mut compared) = (Vec::new(), 0);
    for file in files.iter().filter(|file| !file.thesis.table.is_empty()) {
        let mut off = Vec::new();
        for row in &file.thesis.table {
            // Its only rays that hit graze B's top: rounding decides.
            if file.id == "scene-2" && row.rays <= 4 {
                continue;
            }
            let seed = file.thesis.seed();
            let run =
                run(file, &file.scene, Settings::Thesis, row.rays, seed).expect("the scene runs");
            let here = run.point.expect("a point is expected");
            // A figure that contradicts its point is a misprint.
            let expected = file.thesis.point.expect("a point is expected");
            let printed = row
                .found
                .map_or(row.point, |found| agreement(found, expected));
            off.push((here - printed).abs());
            if (here - printed).abs() > 3.0 {
                let (id, rays) = (&file.id, row.rays);
                wrong.push(format!("{id}, {rays} rays: {here}, printed {printed}"));
            }
        }
        let mean = off.iter().sum::<f64>() / off.len() as f64;
        if mean > 1.0 {
            wrong.push(format!("{}: {mean} on average", file.id));
        }
        compared += off.len();
    }
    assert_none(&wrong);
    assert_eq!(compared, 51);
}

/// On the paths that its program flew. Its points lie mirrored about the paths' plane
/// where two rays are equally long.
#[test]
fn the_thesis_points_on_curves_are_reproduced() {
    let mut wrong = Vec::new();
    for (id, limit) in [("scene-7", 5e-5), ("scene-9", 0.01)] {
        let file = scene(id);
        for row in &file.thesis.table {
            let run = run(&file, &file.scene, Settings::Thesis, row.rays, 10).expect("it runs");
            let upright = |point: DVec3| point.with_z(point.z.abs());
            let near = match (run.touch, row.found) {
                (Some(touch), Some(printed)) => {
                    upright(touch.point).distance(upright(printed.into())) <= limit
                }
                (touch, printed) => touch.is_none() && printed.is_none(),
            };
            if !near {
                let (rays, touch) = (row.rays, run.touch);
                wrong.push(format!(
                    "{id}, {rays} rays: {touch:?}, printed {:?}",
                    row.found
                ));
            }
        }
    }
    assert_none(&wrong);
}

/// On the paths of the thesis's text, which its program did not fly, its method as
/// it describes it agrees differently: worse in scene 7, better in scene 9.
#[test]
fn the_thesis_method_on_the_paths_of_the_text() {
    for (id, least, best) in [("scene-7", 97.0, 99.6), ("scene-9", 87.9, 99.99)] {
        let file = scene(id);
        let expected = file.thesis.point.expect("a point is expected");
        let rays = file.ray_counts().into_iter();
        let agreements = rays
            .filter(|&rays| id == "scene-7" || rays >= 5)
            .map(|rays| {
                let touch = first_touch(&file.scene, Settings::Thesis.method(rays, 10));
                let touch = touch.expect("it runs").expect("there is a contact");
                agreement(touch.point.to_array(), expected)
            });
        let mut agreements: Vec<f64> = agreements.collect();
        agreements.sort_by(f64::total_cmp);
        let ends = [agreements[0], agreements[agreements.len() - 1]];
        assert!(least <= ends[0] && ends[1] <= best, "{id}: {ends:?}");
    }
}

/// Moved towards the path in steps of 0.1 the ball is first found at 1.9, as there.
#[test]
fn the_thesis_finds_a_graze_where_it_says() {
    let file = scene("scene-8");
    let touch = |x: f64| {
        let scene = file.placed("A", [x, 0.0, 0.0]).expect("the body is there");
        let run = run(&file, &scene, Settings::Thesis, 100, 10).expect("it runs");
        run.touch.map(|touch| touch.point)
    };
    assert!(touch(2.0).is_none());
    let found = touch(1.9).expect("there is a contact");
    // One frame nearer along the path, a twenty-fourth of a metre.
    let printed = DVec3::new(0.947749, -0.007954, -0.305212);
    assert!(found.distance(printed) < 1.0 / 24.0, "{found}");
}

/// Where its grid of half turns fails in scene 2, that of half steps on curves
/// comes out, and fails where the other does not.
#[test]
fn half_steps_give_the_other_rows_of_the_thesis() {
    let file = scene("scene-2");
    let near = |rays: u32| {
        let printed = file.row(rays).and_then(|row| row.found);
        let printed = DVec3::from(printed.expect("there was a contact"));
        let touch = as_printed::first_touch(&file.scene, rays, frames(&file.scene));
        let found = touch.expect("there is a contact").point;
        (found.abs() - printed.abs()).abs().max_element() < 2e-6
    };
    assert!([64, 100, 400].into_iter().all(near));
    assert!(![10, 15, 20].into_iter().any(near));
}

/// The exact method agrees in every scene, without a number of rays.
#[test]
fn the_exact_method_agrees_everywhere() {
    let mut short = Vec::new();
    for id in [
        "scene-1", "scene-2", "scene-3", "scene-4", "scene-5", "scene-6", "scene-7", "scene-9",
        "rifle",
    ] {
        let file = scene(id);
        let run = exact(&file, &file.scene).expect("the scene runs");
        let [point, normal] = [run.point, run.normal].map(|it| it.unwrap_or(0.0));
        // Along chords of a curve, within a ten-millionth of the pair's size.
        let curved = ["scene-7", "scene-9"].contains(&id);
        let bar = 100.0 - if curved { 1e-3 } else { 1e-6 };
        if point < bar || normal < bar {
            short.push(format!("{id}: {point}, {normal}"));
        }
    }
    assert_none(&short);
    let file = scene("scene-8");
    let touches = |x: f64| {
        let scene = file.placed("A", [x, 0.0, 0.0]).expect("the body is there");
        exact(&file, &scene).expect("it runs").touch.is_some()
    };
    assert!(touches(1.9999) && !touches(2.0001));
}
