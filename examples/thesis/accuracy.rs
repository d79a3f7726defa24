//! Runs of scenes up to the first touch.

use crate::agreement::agreement;
use crate::as_printed;
use crate::scene_file::SceneFile;
use feeler::{Contact, Method, RayConfig, Scene, SceneError, StepError};
use glam::DVec3;
use thiserror::Error;

/// Seeds that every run is repeated with.
pub(crate) const SEEDS: std::ops::RangeInclusive<u64> = 1..=20;

/// How a scene is examined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Settings {
    /// The method as the thesis publishes it, or as its program went about it where
    /// the file has the paths it flew.
    Thesis,
    /// Aimed rays.
    Rays,
    /// One ray in configuration space, this crate's default; needs no number of rays.
    Exact,
}

impl Settings {
    /// Those with a number of rays.
    pub(crate) const SAMPLED: [Self; 2] = [Self::Thesis, Self::Rays];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Thesis => "thesis",
            Self::Rays => "rays",
            Self::Exact => "exact",
        }
    }

    pub(crate) fn method(self, rays: u32, seed: u64) -> Method {
        match self {
            Self::Thesis => Method::Rays(RayConfig {
                seed,
                ..RayConfig::thesis(rays)
            }),
            Self::Rays => Method::Rays(RayConfig {
                rays,
                seed,
                ..RayConfig::default()
            }),
            Self::Exact => Method::Exact,
        }
    }
}

/// A scene that cannot be run.
#[derive(Debug, Error)]
pub(crate) enum RunError {
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error(transparent)]
    Step(#[from] StepError),
}

/// The first touch in a scene, frame by frame.
pub(crate) fn first_touch(scene: &Scene, method: Method) -> Result<Option<Contact>, RunError> {
    let mut scene = scene.clone();
    scene.config.method = method;
    let (mut world, _) = scene.world()?;
    for _ in 0..frames(&scene) {
        let contacts = world.step(scene.time_step())?;
        if let Some(touch) = contacts.iter().find(|contact| contact.is_touch()) {
            return Ok(Some(*touch));
        }
    }
    Ok(None)
}

/// How many frames a scene lasts.
pub(crate) fn frames(scene: &Scene) -> u64 {
    /// Where neither the scene nor a path says how long, in seconds.
    const OPEN: f64 = 10.0;
    let flights = scene.bodies.iter().map(|named| {
        let motion = named.body.motion();
        match motion.path() {
            Some(path) => path.length() / motion.velocity_after(0.0).length(),
            None if motion.is_fixed() => 0.0,
            None => OPEN,
        }
    });
    let duration = scene
        .duration
        .unwrap_or_else(|| flights.fold(0.0, f64::max));
    (duration * scene.frame_rate).ceil().clamp(1.0, 1e6) as u64
}

/// What is compared of a touch.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Touch {
    /// In seconds.
    pub time: f64,
    pub point: DVec3,
    pub normal: DVec3,
}

impl From<Contact> for Touch {
    fn from(contact: Contact) -> Self {
        Self {
            time: contact.time,
            point: contact.point,
            normal: contact.normal,
        }
    }
}

/// What one run of a scene gave.
#[derive(Debug, Clone)]
pub(crate) struct Run {
    pub settings: Settings,
    pub rays: u32,
    pub seed: u64,
    pub touch: Option<Touch>,
    /// Agreement of the point in %; 0 without contact, none without expectation.
    pub point: Option<f64>,
    /// Agreement of the normal in %, likewise.
    pub normal: Option<f64>,
}

/// One run.
pub(crate) fn run(
    file: &SceneFile,
    scene: &Scene,
    settings: Settings,
    rays: u32,
    seed: u64,
) -> Result<Run, RunError> {
    let flown = match settings {
        Settings::Thesis => file.as_its_program_flew(scene),
        Settings::Rays | Settings::Exact => None,
    };
    let touch = match flown {
        Some(flown) => as_printed::first_touch(&flown, rays, frames(&flown)),
        None => first_touch(scene, settings.method(rays, seed))?.map(Touch::from),
    };
    let compare = |found: Option<[f64; 3]>, expected: Option<[f64; 3]>| {
        let expected = expected?;
        Some(found.map_or(0.0, |found| agreement(found, expected)))
    };
    let thesis = &file.thesis;
    // Where edges cross, the face that a ray hits does not separate the bodies.
    let normal = match settings {
        Settings::Exact => thesis.separating_normal.or(thesis.normal),
        Settings::Thesis | Settings::Rays => thesis.normal,
    };
    Ok(Run {
        settings,
        rays,
        seed,
        touch,
        point: compare(touch.map(|touch| touch.point.to_array()), thesis.point),
        normal: compare(touch.map(|touch| touch.normal.to_array()), normal),
    })
}

/// The one run of the exact method: it knows neither rays nor seeds.
pub(crate) fn exact(file: &SceneFile, scene: &Scene) -> Result<Run, RunError> {
    run(file, scene, Settings::Exact, 0, 0)
}

/// One run for every seed, from the least agreement to the best.
pub(crate) fn runs(file: &SceneFile, settings: Settings, rays: u32) -> Result<Vec<Run>, RunError> {
    let mut runs = SEEDS
        .map(|seed| run(file, &file.scene, settings, rays, seed))
        .collect::<Result<Vec<_>, _>>()?;
    let key = |run: &Run| run.point.unwrap_or(0.0);
    runs.sort_by(|a, b| key(a).total_cmp(&key(b)));
    Ok(runs)
}

/// The run in the middle; of two the one that agrees less.
pub(crate) fn median(runs: &[Run]) -> Option<&Run> {
    runs.get(runs.len().saturating_sub(1) / 2)
}

/// The run that stands for the others: in the thesis's settings the one with its
/// own seed, else the one in the middle.
pub(crate) fn representative<'a>(file: &SceneFile, runs: &'a [Run]) -> Option<&'a Run> {
    let own = |run: &&Run| run.settings == Settings::Thesis && run.seed == file.thesis.seed();
    runs.iter().find(own).or_else(|| median(runs))
}
