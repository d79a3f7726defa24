//! What the user asks for.

use std::error::Error;

const HELP: &str = "\
--bodies N    so many balls (20000)
--frames N    so many frames (60)
--threads N   so many threads (1); 0 for as many as there are";

/// Command line options.
pub(crate) struct Options {
    pub(crate) bodies: usize,
    pub(crate) frames: u32,
    pub(crate) threads: usize,
}

impl Options {
    /// None if only help was asked for, which has been printed.
    pub(crate) fn from_arguments() -> Result<Option<Self>, Box<dyn Error + Send + Sync>> {
        let mut options = Self {
            bodies: 20_000,
            frames: 60,
            threads: 1,
        };
        let mut arguments = std::env::args().skip(1);
        while let Some(name) = arguments.next() {
            if name == "--help" {
                println!("{HELP}");
                return Ok(None);
            }
            let value = arguments.next();
            let value = value.ok_or_else(|| format!("{name} needs a number\n{HELP}"))?;
            let wrong = |error| format!("{name} {value}: {error}");
            match name.as_str() {
                "--bodies" => options.bodies = value.parse().map_err(wrong)?,
                "--frames" => options.frames = value.parse().map_err(wrong)?,
                "--threads" => options.threads = value.parse().map_err(wrong)?,
                _ => return Err(format!("no option {name}\n{HELP}").into()),
            }
        }
        Ok(Some(options))
    }

    /// Runs `work` with as many threads as were asked for.
    pub(crate) fn in_threads<T: Send>(
        &self,
        work: impl FnOnce() -> T + Send,
    ) -> Result<T, Box<dyn Error + Send + Sync>> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(self.threads);
        Ok(pool.build()?.install(work))
    }
}
