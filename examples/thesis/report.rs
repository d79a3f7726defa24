//! What people read: tables on standard output.

use crate::accuracy::{Run, Settings, Touch, representative};
use crate::scene_file::{Acceleration, SceneFile};
use crate::timing::FrameTimes;
use feeler::Contact;

/// The heading of a scene.
pub(crate) fn heading(file: &SceneFile) {
    println!("\n{}: {}", file.scene.name, file.scene.about);
    if let (Some(point), Some(normal)) = (file.thesis.point, file.thesis.normal) {
        println!(
            "expected: point {}, normal {}",
            vector(point),
            vector(normal)
        );
    }
}

/// A vector as the thesis prints it.
fn vector(vector: [f64; 3]) -> String {
    // Adding zero turns -0 into 0.
    let [x, y, z] = vector.map(|value| (value * 1e6).round() / 1e6 + 0.0);
    format!("({x:.6}, {y:.6}, {z:.6})")
}

fn found(touch: Option<&Touch>) -> String {
    touch.map_or_else(|| "-".to_owned(), |touch| vector(touch.point.to_array()))
}

/// A scene's agreements, in %: of the thesis's method with its own seed, of the
/// aimed rays the median over all seeds, last of the exact method; `by_rays` holds for
/// every number of rays the runs of either settings, the least agreement first.
pub(crate) fn agreements(file: &SceneFile, by_rays: &[(u32, [Vec<Run>; 2])], exact: &Run) {
    println!(
        "{:>5} | {:<33} {:>6} {:>6} | {:<33} {:>6} {:>6} {:>11} | {:<33} {:>6} {:>6} {:>9}",
        "rays",
        "the thesis",
        "point",
        "normal",
        "its method here",
        "point",
        "normal",
        "points",
        "aimed rays",
        "point",
        "normal",
        "time/s"
    );
    for (rays, [thesis, default]) in by_rays {
        let theirs = representative(file, thesis);
        let (Some(theirs), Some(ours)) = (theirs, representative(file, default)) else {
            continue;
        };
        let row = file.row(*rays);
        let printed = row.map(|row| row.found.map_or_else(|| "-".to_owned(), vector));
        let ends =
            [thesis.first(), thesis.last()].map(|run| percent(run.and_then(|run| run.point)));
        println!(
            "{rays:>5} | {:<33} {:>6} {:>6} | {:<33} {:>6} {:>6} {:>11} | {:<33} {:>6} {:>6} {:>9}",
            printed.unwrap_or_default(),
            percent(row.map(|row| row.point)),
            percent(row.map(|row| row.normal)),
            found(theirs.touch.as_ref()),
            percent(theirs.point),
            percent(theirs.normal),
            // From the worst seed to the best.
            if ends[0] == ends[1] {
                String::new()
            } else {
                ends.join("-")
            },
            found(ours.touch.as_ref()),
            percent(ours.point),
            percent(ours.normal),
            seconds(ours.touch.as_ref()),
        );
    }
    println!(
        "exact | {:47} | {:59} | {:<33} {:>6} {:>6} {:>9}",
        "",
        "",
        found(exact.touch.as_ref()),
        percent(exact.point),
        percent(exact.normal),
        seconds(exact.touch.as_ref()),
    );
}

/// An agreement in %, rounded down so that only what is perfect reads 100.
fn percent(agreement: Option<f64>) -> String {
    agreement.map_or_else(String::new, |agreement| {
        let hundredths = (agreement * 100.0 + 1e-6).floor();
        format!("{:.2}", hundredths / 100.0)
    })
}

fn seconds(touch: Option<&Touch>) -> String {
    touch.map_or_else(|| "-".to_owned(), |touch| format!("{:.6}", touch.time))
}

/// Runs of a scene that was varied, each with what was varied.
pub(crate) fn variants(what: &str, variants: &[(String, Run)]) {
    println!(
        "{what:>9} | {:>8} {:>5} | {:<33} {:>9}",
        "settings", "rays", "point", "time/s"
    );
    for (value, run) in variants {
        println!(
            "{value:>9} | {:>8} {:>5} | {:<33} {:>9}",
            run.settings.name(),
            match run.settings {
                Settings::Exact => String::new(),
                Settings::Thesis | Settings::Rays => run.rays.to_string(),
            },
            found(run.touch.as_ref()),
            seconds(run.touch.as_ref()),
        );
    }
}

/// Frame times.
pub(crate) fn times(times: &[FrameTimes]) {
    println!("ms a frame over the whole flight, each frame the best of several flights");
    println!(
        "{:>6} {:>5} {:>12} | {:>9} {:>9} | {:>9}",
        "bodies", "rays", "broad phase", "median", "worst", "thesis"
    );
    for time in times {
        println!(
            "{:>6} {:>5} {:>12} | {:>9.4} {:>9.4} | {:>9}",
            time.bodies,
            time.rays,
            broad_phase(time.broad_phase),
            time.median_ms,
            time.worst_ms,
            time.thesis_ms.map_or_else(String::new, |ms| ms.to_string()),
        );
    }
}

/// A broad phase's name in tables.
pub(crate) fn broad_phase(acceleration: Acceleration) -> &'static str {
    match acceleration {
        Acceleration::Plain => "plain",
        Acceleration::Accelerated => "accelerated",
    }
}

/// All contacts of a scene, as they come.
pub(crate) fn contacts(file: &SceneFile, contacts: &[(Contact, [String; 2])]) {
    println!(
        "{:>10}  {:<20} {:<33} {:<33} kind",
        "time/s", "bodies", "point", "normal"
    );
    for (contact, [a, b]) in contacts {
        println!(
            "{:>10.6}  {:<20} {:<33} {:<33} {:?}",
            contact.time,
            format!("{a}, {b}"),
            vector(contact.point.to_array()),
            vector(contact.normal.to_array()),
            contact.kind,
        );
    }
    if contacts.is_empty() {
        println!("no contacts in {}", file.scene.name);
    }
}
