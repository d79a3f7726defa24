//! Scene files: a scene, and what the thesis found in it.

use feeler::{Body, BodyError, Motion, MotionError, Scene};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use thiserror::Error;
use toml::de::{DeTable, Deserializer};

/// A scene file that was read.
#[derive(Debug, Clone)]
pub(crate) struct SceneFile {
    /// The file's name without its ending.
    pub id: String,
    pub scene: Scene,
    pub thesis: Thesis,
    /// The section `[as_its_program_flew]`: motions by the names of bodies, where those
    /// of the thesis's program were not those of its text.
    pub flown: BTreeMap<String, Motion>,
}

/// The section `[thesis]`: what is expected and what the thesis found.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Thesis {
    /// The contact's point.
    pub point: Option<[f64; 3]>,
    /// The contact's normal.
    pub normal: Option<[f64; 3]>,
    /// The normal that separates the bodies, where the thesis expects another.
    pub separating_normal: Option<[f64; 3]>,
    /// The seed of the thesis's random points; 10 if none is given.
    pub seed: Option<u64>,
    pub table: Vec<Row>,
    /// Numbers of rays that the thesis does not list.
    pub more_rays: Vec<u32>,
    pub positions: Option<Positions>,
    pub speeds: Option<Speeds>,
    pub timing: Vec<Timing>,
}

/// A row of a table of agreements, in %.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Row {
    pub rays: u32,
    /// The point the thesis found; none if there was no contact.
    pub found: Option<[f64; 3]>,
    pub point: f64,
    pub normal: f64,
}

/// A body to be placed here and there.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Positions {
    pub body: String,
    pub rays: Vec<u32>,
    pub at: Vec<[f64; 3]>,
}

/// A body to be moved at several speeds, in m/s.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Speeds {
    pub body: String,
    pub speeds: Vec<f64>,
}

/// A table of frame times in ms.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Timing {
    /// How many bodies take part, the first ones of the scene.
    pub bodies: usize,
    #[serde(default)]
    pub broad_phase: Acceleration,
    pub rays: Vec<u32>,
    pub ms: Vec<f64>,
}

/// Whether boxes around the paths spare pairs.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Acceleration {
    Plain,
    #[default]
    Accelerated,
}

/// A scene file cannot be used.
#[derive(Debug, Error)]
pub(crate) enum SceneFileError {
    #[error("cannot read {}: {source}", path.display())]
    Read {
        path: PathBuf,
        source: std::io::Error,
    },
    #[error("{} is no scene: {source}", path.display())]
    Malformed {
        path: PathBuf,
        source: toml::de::Error,
    },
    #[error("scene {scene} has no body \"{body}\" that could be varied")]
    NoSuchBody { scene: String, body: String },
    #[error(transparent)]
    Motion(#[from] MotionError),
    #[error(transparent)]
    Body(#[from] BodyError),
}

impl Thesis {
    /// The seed that the thesis's table was made with.
    pub(crate) fn seed(&self) -> u64 {
        self.seed.unwrap_or(10)
    }
}

impl SceneFile {
    /// Reads one file.
    pub(crate) fn read(path: &Path) -> Result<Self, SceneFileError> {
        let text = std::fs::read_to_string(path).map_err(|source| SceneFileError::Read {
            path: path.to_owned(),
            source,
        })?;
        let (scene, thesis, flown) = parse(&text).map_err(|mut source| {
            // So that the message shows the line.
            source.set_input(Some(&text));
            SceneFileError::Malformed {
                path: path.to_owned(),
                source,
            }
        })?;
        let stem = path.file_stem().unwrap_or_default();
        Ok(Self {
            id: stem.to_string_lossy().into_owned(),
            scene,
            thesis,
            flown,
        })
    }

    /// Reads all files of `examples/scenes`, in the order of their numbers.
    pub(crate) fn read_all() -> Result<Vec<Self>, SceneFileError> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/scenes");
        let failed = |source| SceneFileError::Read {
            path: folder.clone(),
            source,
        };
        let mut files = Vec::new();
        for entry in std::fs::read_dir(&folder).map_err(failed)? {
            let path = entry.map_err(failed)?.path();
            if path.extension().is_some_and(|ending| ending == "toml") {
                files.push(Self::read(&path)?);
            }
        }
        files.sort_by_key(|file| {
            let number: String = file.id.chars().filter(char::is_ascii_digit).collect();
            (number.parse().unwrap_or(u32::MAX), file.id.clone())
        });
        Ok(files)
    }

    /// The scene with its body `name` standing at `position`.
    pub(crate) fn placed(&self, name: &str, position: [f64; 3]) -> Result<Scene, SceneFileError> {
        let motion = Motion::fixed(position)?;
        self.with_motion(name, |_| Some(Ok(motion.clone())))
    }

    /// The scene with its body `name` moving along its path at `speed`.
    pub(crate) fn sped(&self, name: &str, speed: f64) -> Result<Scene, SceneFileError> {
        self.with_motion(name, |body| {
            let path = body.motion().path()?;
            Some(Motion::along(path.clone(), speed))
        })
    }

    /// The scene, or a variant of it, as the thesis's program flew it; none if that is
    /// how it is.
    pub(crate) fn as_its_program_flew(&self, scene: &Scene) -> Option<Scene> {
        let mut scene = scene.clone();
        for named in &mut scene.bodies {
            if let Some(motion) = self.flown.get(&named.name) {
                named.body = moved(&named.body, motion.clone());
            }
        }
        (!self.flown.is_empty()).then_some(scene)
    }

    fn with_motion(
        &self,
        name: &str,
        motion: impl Fn(&Body) -> Option<Result<Motion, MotionError>>,
    ) -> Result<Scene, SceneFileError> {
        let mut scene = self.scene.clone();
        let varied = (scene.bodies.iter_mut())
            .find(|named| named.name == name)
            .and_then(|named| motion(&named.body).map(|motion| (named, motion)));
        let Some((named, motion)) = varied else {
            return Err(SceneFileError::NoSuchBody {
                scene: self.id.clone(),
                body: name.to_owned(),
            });
        };
        named.body = moved(&named.body, motion?);
        Ok(scene)
    }

    /// All numbers of rays to try, in ascending order.
    pub(crate) fn ray_counts(&self) -> Vec<u32> {
        let listed = self.thesis.table.iter().map(|row| row.rays);
        let mut counts: Vec<u32> = listed
            .chain(self.thesis.more_rays.iter().copied())
            .collect();
        counts.sort_unstable();
        counts.dedup();
        counts
    }

    /// The thesis's row for a number of rays.
    pub(crate) fn row(&self, rays: u32) -> Option<&Row> {
        self.thesis.table.iter().find(|row| row.rays == rays)
    }
}

/// The body with another motion.
fn moved(body: &Body, motion: Motion) -> Body {
    Body::moving(body.shape().clone(), motion).oriented(body.orientation())
}

/// What a file holds: the scene, and the sections that are none of its business.
type Parts = (Scene, Thesis, BTreeMap<String, Motion>);

fn parse(text: &str) -> Result<Parts, toml::de::Error> {
    let mut table = DeTable::parse(text)?;
    let thesis = section(&mut table, "thesis")?;
    let flown = section(&mut table, "as_its_program_flew")?;
    let scene = Scene::deserialize(Deserializer::from(table))?;
    Ok((scene, thesis, flown))
}

/// Takes a section out of a file; the default if it has none.
fn section<'a, T: Deserialize<'a> + Default>(
    table: &mut toml::Spanned<DeTable<'a>>,
    name: &str,
) -> Result<T, toml::de::Error> {
    match table.get_mut().remove(name) {
        Some(section) => T::deserialize(toml::de::ValueDeserializer::from(section)),
        None => Ok(T::default()),
    }
}
