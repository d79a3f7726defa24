//! How long frames take.

use crate::accuracy::{RunError, Settings, frames};
use crate::scene_file::{Acceleration, SceneFile};
use feeler::{BroadPhase, Scene};
use std::time::Duration;

/// How often a flight is repeated.
const FLIGHTS: usize = 3;

/// The frames of a scene with one number of bodies and rays.
#[derive(Debug, Clone)]
pub(crate) struct FrameTimes {
    pub scene: String,
    pub bodies: usize,
    pub rays: u32,
    pub broad_phase: Acceleration,
    pub median_ms: f64,
    pub worst_ms: f64,
    pub thesis_ms: Option<f64>,
}

/// Times all that the file's tables list, with aimed rays.
///
/// Flights of all of them take turns, so that a machine whose speed changes is as fast for each.
pub(crate) fn time(file: &SceneFile) -> Result<Vec<FrameTimes>, RunError> {
    let mut all = Vec::new();
    for table in &file.thesis.timing {
        for (index, &rays) in table.rays.iter().enumerate() {
            let mut scene = file.scene.clone();
            scene.bodies.truncate(table.bodies);
            scene.config.method = Settings::Rays.method(rays, 10);
            scene.config.broad_phase = match table.broad_phase {
                Acceleration::Plain => BroadPhase::AllPairs,
                Acceleration::Accelerated => BroadPhase::default(),
            };
            let least = vec![Duration::MAX; frames(&scene) as usize];
            let times = FrameTimes {
                scene: file.id.clone(),
                bodies: scene.bodies.len(),
                rays,
                broad_phase: table.broad_phase,
                median_ms: 0.0,
                worst_ms: 0.0,
                thesis_ms: table.ms.get(index).copied(),
            };
            all.push((scene, least, times));
        }
    }
    for _ in 0..FLIGHTS {
        for (scene, least, _) in &mut all {
            fly(scene, least)?;
        }
    }
    let ms = |duration: Option<&Duration>| duration.map_or(0.0, Duration::as_secs_f64) * 1e3;
    let times = all.into_iter().map(|(_, mut least, times)| {
        least.sort_unstable();
        FrameTimes {
            median_ms: ms(least.get(least.len() / 2)),
            worst_ms: ms(least.last()),
            ..times
        }
    });
    Ok(times.collect())
}

/// Flies once, and lowers each frame's time to what it took.
///
/// Of several flights each frame's least: whatever else the machine does only adds to it.
fn fly(scene: &Scene, least: &mut [Duration]) -> Result<(), RunError> {
    let (mut world, _) = scene.world()?;
    for least in least {
        world.step(scene.time_step())?;
        *least = world.stats().times.total().min(*least);
    }
    Ok(())
}
