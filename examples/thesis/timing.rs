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
            let times = frame_times(&scene)?;
            let ms =
                |duration: Option<&Duration>| duration.map_or(0.0, Duration::as_secs_f64) * 1e3;
            all.push(FrameTimes {
                scene: file.id.clone(),
                bodies: scene.bodies.len(),
                rays,
                broad_phase: table.broad_phase,
                median_ms: ms(times.get(times.len() / 2)),
                worst_ms: ms(times.last()),
                thesis_ms: table.ms.get(index).copied(),
            });
        }
    }
    Ok(all)
}

/// Every frame's time over the whole flight, in ascending order.
///
/// Of several flights each frame's least: whatever else the machine does only adds to it.
fn frame_times(scene: &Scene) -> Result<Vec<Duration>, RunError> {
    let mut least = vec![Duration::MAX; frames(scene) as usize];
    for _ in 0..FLIGHTS {
        let (mut world, _) = scene.world()?;
        for least in &mut least {
            world.step(scene.time_step())?;
            *least = world.stats().times.total().min(*least);
        }
    }
    least.sort_unstable();
    Ok(least)
}
