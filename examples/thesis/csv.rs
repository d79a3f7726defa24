//! Files for other programs: comma-separated values.

use crate::accuracy::{Run, Settings};
use crate::report::broad_phase;
use crate::timing::FrameTimes;
use std::fmt::Write;

/// `accuracy.csv`, line by line.
pub(crate) struct Accuracy(pub String);

impl Accuracy {
    pub(crate) fn new() -> Self {
        Self(
            "scene,method,rays,seed,px,py,pz,nx,ny,nz,time,agreement_point,agreement_normal,\
             thesis_agreement\n"
                .to_owned(),
        )
    }

    /// One run; fields without a figure stay empty.
    pub(crate) fn push(&mut self, scene: &str, run: &Run, thesis: Option<f64>) {
        // The exact method knows neither rays nor seeds.
        let if_sampled = |number: u64| match run.settings {
            Settings::Exact => String::new(),
            Settings::Thesis | Settings::Rays => number.to_string(),
        };
        let mut fields = vec![
            scene.to_owned(),
            run.settings.name().to_owned(),
            if_sampled(run.rays.into()),
            if_sampled(run.seed),
        ];
        match &run.touch {
            Some(touch) => {
                let numbers = [touch.point.to_array(), touch.normal.to_array()].concat();
                fields.extend(numbers.iter().map(f64::to_string));
                fields.push(touch.time.to_string());
            }
            None => fields.extend(std::iter::repeat_n(String::new(), 7)),
        }
        fields.extend([run.point, run.normal, thesis].map(optional));
        self.0.push_str(&fields.join(","));
        self.0.push('\n');
    }
}

/// `timing.csv`.
pub(crate) fn timing(times: &[FrameTimes]) -> String {
    let mut csv = "scene,bodies,rays,broad_phase,ms_median,ms_worst,thesis_ms\n".to_owned();
    for time in times {
        // Writing to a string cannot fail.
        let _ = writeln!(
            csv,
            "{},{},{},{},{:.6},{:.6},{}",
            time.scene,
            time.bodies,
            time.rays,
            broad_phase(time.broad_phase),
            time.median_ms,
            time.worst_ms,
            optional(time.thesis_ms),
        );
    }
    csv
}

fn optional(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}
