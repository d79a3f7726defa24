//! What people read: tables on standard output.

use crate::accuracy::{Run, median};
use crate::scene_file::{Acceleration, SceneFile};
use crate::timing::FrameTimes;
use feeler::Contact;
use glam::DVec3;

/// The heading of a scene.
pub fn heading(file: &SceneFile) {
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

fn found(contact: Option<&Contact>, part: impl Fn(&Contact) -> DVec3) -> String {
    contact.map_or_else(
        || "-".to_owned(),
        |contact| vector(part(contact).to_array()),
    )
}

/// A scene's agreements; `by_rays` holds for every number of rays the runs of
/// either settings, the least agreement first.
pub fn agreements(file: &SceneFile, by_rays: &[(u32, [Vec<Run>; 2])]) {
    println!(
        "{:>5} | {:<33} {:>6} | {:<33} {:>6} {:>13} | {:<33} {:>7} {:>7} {:>9}",
        "rays",
        "thesis's point",
        "%",
        "its method here",
        "%",
        "least..best",
        "default rays",
        "%",
        "normal",
        "time/s"
    );
    for (rays, [thesis, default]) in by_rays {
        let row = file.row(*rays);
        let printed = row.map_or_else(String::new, |row| {
            row.found.map_or_else(|| "-".to_owned(), vector)
        });
        let printed_agreement = row.map_or_else(String::new, |row| format!("{:.2}", row.point));
        let (Some(middle), Some(ours)) = (median(thesis), median(default)) else {
            continue;
        };
        let ends = [thesis.first(), thesis.last()].map(|run| run.and_then(|run| run.point));
        println!(
            "{rays:>5} | {printed:<33} {printed_agreement:>6} | {:<33} {:>6.2} {:>13} | {:<33} \
             {:>7.3} {:>7.3} {:>9}",
            found(middle.contact.as_ref(), |contact| contact.point),
            middle.point.unwrap_or(f64::NAN),
            format!(
                "{:.1}..{:.1}",
                ends[0].unwrap_or(f64::NAN),
                ends[1].unwrap_or(f64::NAN)
            ),
            found(ours.contact.as_ref(), |contact| contact.point),
            ours.point.unwrap_or(f64::NAN),
            ours.normal.unwrap_or(f64::NAN),
            ours.contact
                .map_or_else(|| "-".to_owned(), |contact| format!("{:.6}", contact.time)),
        );
    }
}

/// Runs of a scene that was varied, each with what was varied.
pub fn variants(what: &str, variants: &[(String, Run)]) {
    println!(
        "{what:>9} | {:>8} {:>5} | {:<33} {:>9}",
        "settings", "rays", "point", "time/s"
    );
    for (value, run) in variants {
        println!(
            "{value:>9} | {:>8} {:>5} | {:<33} {:>9}",
            run.settings.name(),
            run.rays,
            found(run.contact.as_ref(), |contact| contact.point),
            run.contact
                .map_or_else(|| "-".to_owned(), |contact| format!("{:.6}", contact.time)),
        );
    }
}

/// Frame times.
pub fn times(times: &[FrameTimes]) {
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
pub fn broad_phase(acceleration: Acceleration) -> &'static str {
    match acceleration {
        Acceleration::Plain => "plain",
        Acceleration::Accelerated => "accelerated",
    }
}

/// All contacts of a scene, as they come.
pub fn contacts(file: &SceneFile, contacts: &[(Contact, [String; 2])]) {
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
