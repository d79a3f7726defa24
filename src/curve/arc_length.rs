//! From distance flown to place on a sequence of curves, and back.

use crate::curve::CubicBezier;
use crate::curve::fit::{Fit, Fitter};
use crate::curve::hodograph::Hodograph;
use crate::curve::span::{self, Span};

/// Arc length over a sequence of curves: exact, both ways.
///
/// Every curve is cut into spans on which one quadrature rule is exact to
/// rounding. A distance finds its span through a grid of equal cells, two per span,
/// and a bisection among the spans that start in its cell (one, if pieces are of
/// like length); there a polynomial is the inverse, which was checked against
/// the integral inverted by iteration. Where it does not do, as beside a cusp,
/// iteration is what answers.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ArcLength {
    /// Distance from the path's start to each span's; ascending.
    starts: Vec<f64>,
    spans: Vec<PieceSpan>,
    /// One for every span.
    fits: Vec<Fit>,
    /// How many spans start in an earlier cell; one entry more than cells.
    cells: Vec<u32>,
    cells_per_metre: f64,
    length: f64,
}

/// Cells of the grid for each span. More leave fewer spans to a cell, at 4 bytes each.
const CELLS: usize = 2;

#[derive(Debug, Clone, Copy, PartialEq)]
struct PieceSpan {
    piece: usize,
    span: Span,
}

impl ArcLength {
    /// Measures `pieces`. If one is shorter than `min_piece`: its index and length.
    pub(crate) fn measure(pieces: &[CubicBezier], min_piece: f64) -> Result<Self, (usize, f64)> {
        let mut starts = Vec::with_capacity(pieces.len());
        let mut spans = Vec::with_capacity(pieces.len());
        let mut fits = Vec::with_capacity(pieces.len());
        let mut sum = Sum::default();
        let fitter = Fitter::new();
        for (piece, curve) in pieces.iter().enumerate() {
            let mut length = 0.0;
            let mut keep = |span: Span, mut fit: Fit| {
                let start = sum.value();
                starts.push(start);
                spans.push(PieceSpan { piece, span });
                fit.start = start;
                fits.push(fit);
                sum.add(span.length);
                length += span.length;
            };
            let velocity = curve.velocity();
            let fit = |span: &Span| {
                let hodograph = Hodograph::over(&velocity, span.u_start, span.width);
                fitter.fit(piece as u32, &hodograph, span)
            };
            span::subdivide(&velocity, 0.0..1.0, |span| {
                let whole = fit(&span);
                // Half as wide, zeros of the speed are twice as far; but beside a
                // standstill that changes nothing.
                if !whole.good {
                    let halves = span.halves(&velocity);
                    let [first, second] = [fit(&halves[0]), fit(&halves[1])];
                    if first.good || second.good {
                        keep(halves[0], first);
                        keep(halves[1], second);
                        return;
                    }
                }
                keep(span, whole);
            });
            debug_assert!(length.is_finite(), "piece {piece} has length {length}");
            if length < min_piece {
                return Err((piece, length));
            }
        }
        let mut arc_length = Self {
            fits,
            cells: Vec::with_capacity(CELLS * spans.len() + 1),
            cells_per_metre: (CELLS * spans.len()) as f64 / sum.value(),
            length: sum.value(),
            starts,
            spans,
        };
        for (index, start) in arc_length.starts.iter().enumerate() {
            let cell = arc_length.cell(*start);
            while arc_length.cells.len() <= cell {
                arc_length.cells.push(index as u32);
            }
        }
        let count = arc_length.spans.len();
        arc_length.cells.resize(CELLS * count + 1, count as u32);
        Ok(arc_length)
    }

    /// Length of all curves together.
    pub(crate) fn length(&self) -> f64 {
        self.length
    }

    /// The curve and parameter at `distance`, which is clamped; NaN counts as 0.
    pub(crate) fn locate(&self, pieces: &[CubicBezier], distance: f64) -> (usize, f64) {
        if distance >= self.length {
            return (pieces.len() - 1, 1.0);
        }
        let distance = distance.max(0.0);
        let cell = self.cell(distance);
        // `cell` never falls as its argument rises, so spans that start in an
        // earlier cell start earlier, and those in a later cell start later.
        let first = self.cells[cell] as usize;
        let same_cell = &self.starts[first..self.cells[cell + 1] as usize];
        let index = first + same_cell.partition_point(|start| *start <= distance);
        let index = index.saturating_sub(1);
        let fit = &self.fits[index];
        if fit.good {
            return (fit.piece as usize, fit.u_at(distance).min(1.0));
        }
        let PieceSpan { piece, span } = self.spans[index];
        let hodograph = pieces[piece].hodograph(span.u_start, span.width);
        let x = span.invert(&hodograph, distance - self.starts[index]);
        (piece, (span.u_start + x * span.width).min(1.0))
    }

    /// The distance at parameter `u` of `piece`; places beyond the ends are clamped.
    pub(crate) fn distance_at(&self, pieces: &[CubicBezier], piece: usize, u: f64) -> f64 {
        if piece >= pieces.len() {
            return self.length;
        }
        let u = u.max(0.0);
        let after = self.spans.partition_point(|candidate| {
            candidate.piece < piece || candidate.piece == piece && candidate.span.u_start <= u
        });
        let index = after.saturating_sub(1);
        let PieceSpan { span, .. } = self.spans[index];
        let end = self.starts.get(index + 1).copied().unwrap_or(self.length);
        let x = (u - span.u_start) / span.width;
        if x >= 1.0 {
            return end;
        }
        let hodograph = pieces[piece].hodograph(span.u_start, span.width);
        (self.starts[index] + hodograph.length_to(x)).min(end)
    }

    fn cell(&self, distance: f64) -> usize {
        let cell = distance * self.cells_per_metre;
        // `as` saturates and takes NaN to 0.
        (cell as usize).min(CELLS * self.spans.len() - 1)
    }
}

/// A running sum that carries what rounding drops (Kahan, Babuška and Neumaier),
/// for terms that are not negative: ten thousand pieces cost no digits.
#[derive(Default)]
struct Sum {
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

    fn value(&self) -> f64 {
        self.sum + self.dropped
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Else look-ups are as slow as iteration, and nobody would see it.
    #[test]
    fn most_spans_have_a_fit_that_is_good() {
        let point = |index: u32| {
            let angle = f64::from(index);
            glam::DVec3::new(
                angle.sin(),
                (1.7 * angle).cos(),
                (0.3 * angle * angle).sin(),
            )
        };
        let pieces: Vec<_> = (0..500)
            .filter_map(|index| CubicBezier::new([0, 1, 2, 3].map(|i| point(3 * index + i))).ok())
            .collect();
        let Ok(arc_length) = ArcLength::measure(&pieces, 1e-9) else {
            panic!("the pieces have lengths");
        };
        let good = arc_length.fits.iter().filter(|fit| fit.good).count();
        let all = arc_length.fits.len();
        assert!(20 * good > 19 * all, "{good} of {all}");
    }
}
