//! From distance flown to place on a sequence of curves, and back.

use crate::curve::CubicBezier;
use crate::curve::fit::{FITTER, Fit};
use crate::curve::span::{self, Span};

/// Arc length over a sequence of curves: exact, both ways.
///
/// Every curve is cut into spans on which one quadrature rule is exact to
/// rounding. A distance finds its curve through a grid of equal cells, two per curve,
/// and a bisection among the curves that start in its cell (none or one, if they are of
/// like length), and then its span; there an interpolation guesses the inverse, and one step of
/// an iteration on the integral makes it exact. Splines that are not long have a polynomial besides that
/// is the inverse itself, wherever that was found to be so.
///
/// What tells curve and span is small and stays near at hand; so a look-up among ten thousand
/// curves waits for memory once, for the curve and its spans together.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ArcLength {
    /// By ascending distance.
    spans: Vec<Span>,
    /// One for every span, or none at all.
    fits: Vec<Fit>,
    /// Number of each curve's first span; one entry more than curves.
    firsts: Vec<u32>,
    /// For each curve where its second span starts and so on: infinity where there are no more.
    edges: Vec<[f64; EDGES]>,
    /// Distance from the path's start to each curve's; one entry more than curves.
    joints: Vec<f64>,
    /// How many curves start in an earlier cell; one entry more than cells.
    cells: Vec<u32>,
    cells_per_metre: f64,
    length: f64,
}

/// Where a look-up has ended: the number of a span, as good as any of which nothing is known.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Near(u32);

/// Cells of the grid for each curve. More leave fewer curves to a cell, at 4 bytes each.
const CELLS: usize = 2;

/// Curves up to which spans have a [`Fit`] each: some 1.6 MB.
///
/// A look-up takes two thirds of the time by a fit, as long as that is near at hand. Of ten thousand curves it is not:
/// there most of the time is spent on waiting for memory, and ten times as long a building is not worth it.
const FITTED: usize = 1024;

/// How often a span is halved at most so that it has a good [`Fit`]: beside a standstill none has.
const HALVINGS: u32 = 3;

/// Spans of a curve, but the first, that are told apart without a branch.
///
/// A cache line. Random curves have five or six spans; of one in a hundred thousand that has more than nine
/// the rest are bisected.
const EDGES: usize = 8;

impl ArcLength {
    /// Measures `pieces`. If one is shorter than `min_piece`: its index and length.
    pub(crate) fn measure(pieces: &[CubicBezier], min_piece: f64) -> Result<Self, (usize, f64)> {
        let count = pieces.len();
        let mut firsts = Vec::with_capacity(count + 1);
        let mut joints = Vec::with_capacity(count + 1);
        let mut edges = Vec::with_capacity(count);
        let mut fits = Vec::new();
        let mut spans = Vec::with_capacity(2 * count);
        let mut sum = Sum::default();
        for (piece, curve) in pieces.iter().enumerate() {
            joints.push(sum.value());
            firsts.push(spans.len() as u32);
            let mut length = 0.0;
            let velocity = curve.velocity();
            // No longer than its speed is great; of what underflows no halving would be good.
            let fastest = velocity.iter().map(|v| v.length()).fold(0.0, f64::max);
            if fastest < min_piece {
                return Err((piece, fastest));
            }
            span::subdivide(&velocity, 0.0..1.0, |cut| {
                Span::each(&velocity, &cut, |span, way| {
                    let mut push = |mut span: Span, way: f64| {
                        span.start = sum.value();
                        span.measure(curve);
                        spans.push(span);
                        sum.add(way);
                        length += way;
                        span.start
                    };
                    if count > FITTED {
                        push(span, way);
                        return;
                    }
                    FITTER.each(&velocity, (span, way), HALVINGS, &mut |span, fit, way| {
                        let start = push(span, way);
                        fits.push(Fit {
                            start,
                            piece: piece as u32,
                            ..fit
                        });
                    });
                });
            });
            let mut starts = [f64::INFINITY; EDGES];
            let first = firsts.last().map_or(0, |&first| first as usize);
            for (start, span) in starts.iter_mut().zip(spans.iter().skip(first + 1)) {
                *start = span.start;
            }
            edges.push(starts);
            debug_assert!(length.is_finite(), "piece {piece} has length {length}");
            if length < min_piece {
                return Err((piece, length));
            }
        }
        joints.push(sum.value());
        firsts.push(spans.len() as u32);
        let mut arc_length = Self {
            edges,
            fits,
            spans,
            firsts,
            joints,
            cells: Vec::with_capacity(CELLS * count + 1),
            cells_per_metre: (CELLS * count) as f64 / sum.value(),
            length: sum.value(),
        };
        for (index, &start) in arc_length.joints[..count].iter().enumerate() {
            let cell = arc_length.cell(start);
            while arc_length.cells.len() <= cell {
                arc_length.cells.push(index as u32);
            }
        }
        arc_length.cells.resize(CELLS * count + 1, count as u32);
        Ok(arc_length)
    }

    /// Length of all curves together.
    pub(crate) fn length(&self) -> f64 {
        self.length
    }

    /// The distance at which a curve begins; beyond the last, at which all end.
    pub(crate) fn joint(&self, piece: usize) -> f64 {
        self.joints.get(piece).copied().unwrap_or(self.length)
    }

    /// The curve and parameter at `distance`, which is clamped; NaN counts as 0.
    pub(crate) fn locate(&self, pieces: &[CubicBezier], distance: f64) -> (usize, f64) {
        self.find(pieces, distance).0
    }

    /// The same, to the bit, for who knows a place near by.
    ///
    /// On the span of that place there is nothing to search, and little memory to wait for.
    #[inline]
    pub(crate) fn locate_near(
        &self,
        pieces: &[CubicBezier],
        distance: f64,
        near: Near,
    ) -> ((usize, f64), Near) {
        // Many begin where their paths do. NaN counts as 0.
        if distance.is_nan() || distance <= 0.0 {
            return ((0, 0.0), Near(0));
        }
        match self.fits.get(near.0 as usize) {
            Some(fit) if fit.holds(distance) => ((fit.piece as usize, fit.u_at(distance)), near),
            Some(fit) if self.is_on(fit.piece as usize, distance) => {
                let piece = fit.piece as usize;
                let (u, near) = self.seek(pieces, piece, distance, near);
                ((piece, u), near)
            }
            _ => self.find(pieces, distance),
        }
    }

    /// Whether a distance lies on a curve, or where it begins.
    #[inline]
    fn is_on(&self, piece: usize, distance: f64) -> bool {
        self.joints[piece] <= distance && distance < self.joints[piece + 1]
    }

    /// The curve at `distance`, and where that is or something else is on the curve.
    #[inline]
    pub(crate) fn piece_near(&self, distance: f64, near: Near) -> (usize, Near) {
        match self.fits.get(near.0 as usize) {
            Some(fit) if self.is_on(fit.piece as usize, distance) => (fit.piece as usize, near),
            _ => self.span_at(distance),
        }
    }

    /// The parameter at a distance that lies on `piece`, from a place near by on that.
    ///
    /// From span to span: who follows a curve passes few.
    #[inline]
    pub(crate) fn seek(
        &self,
        pieces: &[CubicBezier],
        piece: usize,
        distance: f64,
        near: Near,
    ) -> (f64, Near) {
        let (first, last) = (self.firsts[piece], self.firsts[piece + 1] - 1);
        let mut number = near.0.clamp(first, last);
        while number < last && self.spans[number as usize + 1].start <= distance {
            number += 1;
        }
        while number > first && self.spans[number as usize].start > distance {
            number -= 1;
        }
        let number = Near(number);
        (self.u_on(pieces, piece, number, distance), number)
    }

    fn find(&self, pieces: &[CubicBezier], distance: f64) -> ((usize, f64), Near) {
        let (piece, number) = self.span_at(distance);
        if distance >= self.length {
            return ((piece, 1.0), number);
        }
        let u = self.u_on(pieces, piece, number, distance.max(0.0));
        ((piece, u), number)
    }

    /// The parameter at `distance` on a span of `piece`.
    #[inline]
    fn u_on(&self, pieces: &[CubicBezier], piece: usize, span: Near, distance: f64) -> f64 {
        match self.fits.get(span.0 as usize) {
            Some(fit) if fit.good => fit.u_at(distance),
            _ => self.spans[span.0 as usize].u_at(&pieces[piece].velocity(), distance),
        }
    }

    /// The curve at `distance`, and its span.
    #[inline]
    fn span_at(&self, distance: f64) -> (usize, Near) {
        if distance >= self.length {
            let last = self.spans.len().saturating_sub(1);
            return (self.joints.len() - 2, Near(last as u32));
        }
        let distance = distance.max(0.0);
        let cell = self.cell(distance);
        // `cell` never falls as its argument rises, so curves that start in an
        // earlier cell start earlier, and those in a later cell start later.
        let first = self.cells[cell] as usize;
        let count = self.cells[cell + 1] as usize - first;
        let after = if count < 2 {
            // Without a guess at what is less: there is one joint more than curves.
            first + (count & usize::from(self.joints[first] <= distance))
        } else {
            let same_cell = &self.joints[first..first + count];
            first + same_cell.partition_point(|start| *start <= distance)
        };
        let piece = after.saturating_sub(1);
        let edges = &self.edges[piece];
        let mut index = edges
            .map(|start| u32::from(start <= distance))
            .iter()
            .sum::<u32>() as usize;
        if index == EDGES {
            let spans = self.spans_of(piece);
            index = spans.partition_point(|span| span.start <= distance) - 1;
        }
        (piece, Near(self.firsts[piece] + index as u32))
    }

    /// The distance at parameter `u` of `piece`; places beyond the ends are clamped.
    pub(crate) fn distance_at(&self, pieces: &[CubicBezier], piece: usize, u: f64) -> f64 {
        let u = u.max(0.0);
        if piece.saturating_add(1) >= self.joints.len() || u >= 1.0 || u <= 0.0 {
            return self.joint(piece.saturating_add(usize::from(u >= 1.0)));
        }
        let spans = self.spans_of(piece);
        let index = spans
            .partition_point(|span| span.u_start <= u)
            .saturating_sub(1);
        let next = spans.get(index + 1);
        let end = next.map_or_else(|| self.joint(piece + 1), |next| next.start);
        let distance = spans[index].distance_to(&pieces[piece].velocity(), u);
        distance.map_or(end, |distance| distance.min(end))
    }

    /// How far a curve may be followed from `distance` on, which lies [there](Near), up to its end or back to its
    /// start, so that its fourth derivative by distance times the way's fourth power is no more than
    /// `root` is to the fourth; and the fourth root of that derivative's inverse.
    pub(crate) fn smooth_way(
        &self,
        piece: usize,
        (near, distance): (Near, f64),
        forward: bool,
        root: f64,
    ) -> (f64, f64) {
        let (first, next) = (self.firsts[piece], self.firsts[piece + 1]);
        let mut way = 0.0;
        let mut smooth = f64::INFINITY;
        // Rounding may have told the neighbour's span.
        let mut span = near.0.clamp(first, next - 1);
        loop {
            let here = smooth.min(f64::from(self.spans[span as usize].smooth));
            let longest = root * here;
            if longest <= way {
                return (way, smooth);
            }
            smooth = here;
            let (end, last) = if forward {
                let end = self.spans.get(span as usize + 1);
                (end.map_or(self.length, |next| next.start), span + 1 == next)
            } else {
                (self.spans[span as usize].start, span == first)
            };
            let room = (end - distance).abs();
            if last || longest <= room {
                return (longest, smooth);
            }
            way = room;
            span = if forward { span + 1 } else { span - 1 };
        }
    }

    /// A curve's spans: at least one.
    #[inline]
    fn spans_of(&self, piece: usize) -> &[Span] {
        &self.spans[self.firsts[piece] as usize..self.firsts[piece + 1] as usize]
    }

    #[inline]
    fn cell(&self, distance: f64) -> usize {
        let cell = distance * self.cells_per_metre;
        // `as` saturates and takes NaN to 0.
        (cell as usize).min(CELLS * (self.joints.len() - 1) - 1)
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

    /// Else look-ups are slow, and nobody would see it.
    #[test]
    fn most_spans_are_smooth_and_few() {
        let point = |index: u32| {
            let angle = f64::from(index);
            glam::DVec3::new(
                angle.sin(),
                (1.7 * angle).cos(),
                (0.3 * angle * angle).sin(),
            )
        };
        let pieces: Vec<_> = (0..2 * FITTED as u32)
            .filter_map(|index| CubicBezier::new([0, 1, 2, 3].map(|i| point(3 * index + i))).ok())
            .collect();
        let Ok(arc_length) = ArcLength::measure(&pieces, 1e-9) else {
            panic!("the pieces have lengths");
        };
        let all = arc_length.spans.len();
        let mut smooth = 0;
        for (index, curve) in pieces.iter().enumerate() {
            let is_smooth = |span: &&Span| span.is_smooth(&curve.velocity());
            smooth += arc_length.spans_of(index).iter().filter(is_smooth).count();
        }
        assert!(20 * smooth > 19 * all, "{smooth} of {all}");
        assert!(all < 8 * pieces.len(), "{all} of {}", pieces.len());
        assert_eq!(size_of::<Span>(), 64);
        let Ok(short) = ArcLength::measure(&pieces[..FITTED], 1e-9) else {
            panic!("the pieces have lengths");
        };
        let good = short.fits.iter().filter(|fit| fit.good).count();
        let all = short.spans.len();
        assert!(50 * good > 49 * all, "{good} of {all}");
        // Some 1.6 MB.
        assert!(all < 10 * FITTED, "{all}");
        for share in 0..10_000 {
            let distance = short.length() * f64::from(share) / 10_000.0;
            let (piece, u) = short.locate(&pieces, distance);
            let (other, v) = arc_length.locate(&pieces, distance);
            // The two add up other spans, and distances are rounded; where the curve is slow that is more of
            // its parameter.
            let slow = pieces[piece].derivative(u).length().min(1.0);
            assert!(
                piece == other && slow * (u - v).abs() < 1e-15 * short.length(),
                "{piece} {u} {other} {v}"
            );
        }
    }
}
