//! What the answers are worth.

use crate::contender::Answer;
use crate::draw::Cast;
use crate::gap::gap;
use crate::look::{Look, above};
use crate::table;
use glam::DVec3;

/// What happens.
pub struct Truth {
    /// Seconds to the first touch.
    pub touch: Option<f64>,
    /// How deep they overlap at most afterwards, or how near they come.
    margin: f64,
    normal: DVec3,
}

impl Truth {
    pub fn of(cast: &Cast) -> Self {
        let [a, b] = cast.actors();
        let look = Look::at(&a, &b, 1.0, 1e-8 * cast.size);
        let Some(touch) = look.touch else {
            return Self {
                touch: None,
                margin: look.least.0,
                normal: DVec3::X,
            };
        };
        let later = (0..=200).map(|step| touch + (1.0 - touch) * (f64::from(step) / 200.0).powi(3));
        let deepest = later
            .map(|time| above(&a, &b, time))
            .fold(f64::MAX, f64::min);
        let placed = (a.placed(touch), b.placed(touch));
        let normal = crate::gap::apart(&placed.0, &placed.1).1;
        Self {
            touch: Some(touch),
            margin: -deepest,
            normal,
        }
    }
}

#[derive(Default)]
pub struct Score {
    misses: usize,
    ghosts: usize,
    normals: usize,
    /// Seconds.
    errors: Vec<f64>,
    gap: f64,
}

impl Score {
    pub fn add(&mut self, cast: &Cast, truth: &Truth, precision: f64, answer: Option<Answer>) {
        let blur = precision * (cast.size + cast.flyers[0].position.length());
        match (truth.touch, answer) {
            (None, None) => {}
            (Some(_), None) => self.misses += usize::from(truth.margin > blur),
            (None, Some(_)) => self.ghosts += usize::from(truth.margin > blur),
            (Some(_), Some(answer)) if !answer.time.is_finite() => self.misses += 1,
            (Some(touch), Some(answer)) => {
                self.errors.push((answer.time - touch).abs());
                let [a, b] = cast.actors();
                self.gap = self.gap.max(above(&a, &b, answer.time).abs());
                let right = answer.normal.angle_between(truth.normal).to_degrees() <= 1.0;
                let along = answer.normal.normalize_or(DVec3::ZERO);
                if !right && gap(&a.placed(touch), &b.placed(touch), along) < -blur {
                    self.normals += 1;
                }
            }
        }
    }

    /// Of the columns after the time.
    pub fn cells(mut self) -> Vec<String> {
        self.errors.sort_by(f64::total_cmp);
        let last = self.errors.len().saturating_sub(1);
        let quantile = |share: f64| {
            self.errors
                .get((share * last as f64).round() as usize)
                .copied()
        };
        let mut cells = [self.misses, self.ghosts, self.normals]
            .map(|count| count.to_string())
            .to_vec();
        cells.extend([0.5, 0.99, 1.0].map(|share| table::length(quantile(share))));
        cells.push(table::length((!self.errors.is_empty()).then_some(self.gap)));
        cells
    }
}
