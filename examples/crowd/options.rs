//! What the user asks for.

use std::error::Error;

const HELP: &str = "\
--bodies N    so many balls (20000)
--frames N    so many frames (60)
--threads N   so many threads (1); more need the feature `parallel`";

/// Command line options.
pub struct Options {
    pub bodies: usize,
    pub frames: u32,
    pub threads: usize,
}

impl Options {
    /// None if only help was asked for, which has been printed.
    pub fn from_arguments() -> Result<Option<Self>, Box<dyn Error + Send + Sync>> {
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
    pub fn in_threads<T: Send>(
        &self,
        work: impl FnOnce() -> T + Send,
    ) -> Result<T, Box<dyn Error + Send + Sync>> {
        if self.threads != 1 {
            return Err("more threads need the feature `parallel`".into());
        }
        Ok(work())
    }
}
