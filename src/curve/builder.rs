//! Spans along a path, and their polynomials.

use crate::curve::fit::Fit;
use crate::curve::fitter::{FITTER, NARROWER};
use crate::curve::span::{self, Span};
use crate::curve::{CubicBezier, Section};
use glam::DVec3;
use std::ops::Range;

/// Share of a curve, or of its part between two slow places, below which no span is tried: beside a standstill
/// none has a polynomial.
const LEAST: f64 = 1.0 / 64.0;

/// A span must be longer than this many times what a place may be off, else rounding blurs more of its end than
/// [`Fit`] keeps clear of: some 1e-12 of the path.
const SHORT: f64 = 65_536.0;

/// Spans, one after the other.
pub(super) struct Builder {
    pub(super) fits: Vec<Fit>,
    pub(super) smooth: Vec<f32>,
    pub(super) halts: Vec<(u32, Span)>,
    pub(super) sum: Sum,
    /// How far a place may be off, in metres, if that is more than rounding.
    coarse: f64,
}

impl Builder {
    pub(super) fn new(coarse: f64) -> Self {
        Self {
            fits: Vec::new(),
            smooth: Vec::new(),
            halts: Vec::new(),
            sum: Sum::default(),
            coarse,
        }
    }

    /// Adds a part of a curve, which is slow at its ends only; and tells its length.
    ///
    /// Spans are as wide as they may be, as far as their predecessors let that be foretold.
    pub(super) fn add(
        &mut self,
        (piece, curve): (u32, &CubicBezier),
        velocity: &[DVec3; 3],
        section: Range<f64>,
    ) -> f64 {
        // Wider than what neighbouring numbers are apart.
        let least = (LEAST * (section.end - section.start)).max(4.0 * f64::EPSILON);
        let mut length = 0.0;
        let mut start = section.start;
        let mut width = 0.25 * (section.end - section.start);
        while start < section.end {
            let rest = section.end - start;
            let end = if width >= rest {
                section.end
            } else if 2.0 * width > rest {
                start + 0.5 * rest
            } else {
                start + width
            };
            // Between neighbouring numbers there is none; then `width` is no more than `least`.
            let end = if end > start { end } else { section.end };
            width = end - start;
            match FITTER.fit(velocity, (start, width), self.coarse) {
                Ok((fit, way, wider)) if way > SHORT * self.coarse => {
                    self.push((piece, curve), fit, (width, way));
                    length += way;
                    width *= wider;
                }
                Err(narrower) if width > least => {
                    width = (narrower.min(NARROWER) * width).max(0.99 * least);
                    continue;
                }
                _ => {
                    span::subdivide(velocity, start..end, |cut| {
                        let at = self.sum.value();
                        let number = self.fits.len() as u32;
                        self.halts.push((number, Span::new(velocity, &cut, at)));
                        let none = Fit::none(cut.u_start);
                        self.push((piece, curve), none, (cut.width, cut.length));
                        length += cut.length;
                    });
                    width *= 2.0;
                }
            }
            start = end;
        }
        length
    }

    fn push(&mut self, (piece, curve): (u32, &CubicBezier), fit: Fit, (width, way): (f64, f64)) {
        let start = self.sum.value();
        self.smooth
            .push(smooth(curve, [fit.u_start, fit.u_start + width]));
        self.fits.push(Fit {
            start,
            piece,
            ..fit
        });
        self.sum.add(way);
    }
}

/// The fourth derivative by arc length is no more than the inverse of this one's fourth power; 0 beside a
/// cusp.
fn smooth(curve: &CubicBezier, [from, to]: [f64; 2]) -> f32 {
    let root = Section::of(curve, [from, to.min(1.0)], true)
        .jounce()
        .sqrt()
        .sqrt();
    // Of a straight one, as far as numbers go.
    (root.recip() as f32).min(f32::MAX).next_down().max(0.0)
}

/// A running sum that carries what rounding drops (Kahan, Babuška and Neumaier),
/// for terms that are not negative: ten thousand pieces cost no digits.
#[derive(Default)]
pub(super) struct Sum {
    sum: f64,
    dropped: f64,
}

impl Sum {
    fn add(&mut self, term: f64) {
        let sum = self.sum + term;
        self.dropped += if self.sum >= term {
            (self.sum - sum) + term
        } else {
            (term - sum) + self.sum
        };
        self.sum = sum;
    }

    pub(super) fn value(&self) -> f64 {
        self.sum + self.dropped
    }
}
