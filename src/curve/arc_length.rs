//! From distance flown to place on a sequence of curves, and back.

use crate::curve::CubicBezier;
use crate::curve::builder::Builder;
use crate::curve::fit::Fit;
use crate::curve::hodograph::Hodograph;
use crate::curve::span::{self, Span};
use glam::DVec3;

/// Arc length over a sequence of curves: exact, both ways.
///
/// Every curve is cut into spans on which one quadrature rule is exact to
/// rounding, and these into spans on which a polynomial is the inverse, wherever that may be. A distance finds its span
/// through a grid of equal cells, two per span, that tell the span at their start and where
/// the next one begins.
///
/// So a look-up reads a cell, which is small and stays near at hand, and then two cache lines side by
/// side: among ten thousand curves it waits for memory once.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ArcLength {
    /// By ascending distance.
    fits: Vec<Fit>,
    /// For each fit: the fourth derivative by arc length is no more than the inverse of this one's fourth power; 0 beside a
    /// cusp.
    smooth: Vec<f32>,
    /// Those of the fits that have no polynomial, by their numbers: some may begin at the same distance, as far as numbers
    /// go.
    halts: Vec<(u32, Span)>,
    /// Number of each curve's first fit; one entry more than curves.
    firsts: Vec<u32>,
    /// Distance from the path's start to each curve's; one entry more than curves.
    joints: Vec<f64>,
    cells: Vec<Cell>,
    cells_per_metre: f64,
    length: f64,
}

/// An equal part of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Cell {
    /// The span at the start.
    first: u32,
    /// Share of the cell at which the next begins, or more than 1.
    edge: f32,
}

/// Where a look-up has ended: the number of a span, as good as any of which nothing is known.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Near(u32);

/// Cells of the grid for each span. More leave fewer spans to a cell, at 8 bytes each.
const CELLS: usize = 2;

impl ArcLength {
    /// Measures `pieces`. If one is shorter than `min_piece`: its index and length.
    pub(crate) fn measure(pieces: &[CubicBezier], min_piece: f64) -> Result<Self, (usize, f64)> {
        let count = pieces.len();
        let polygon = |curve: &CubicBezier| {
            let sides = curve.velocity().map(DVec3::length);
            sides.iter().sum::<f64>() / 3.0
        };
        // Of the polygons around the curves: longer than the path, as a rule by little.
        let whole: f64 = pieces.iter().map(polygon).sum();
        let mut builder = Builder::new(0.0625 * f64::EPSILON * whole);
        let mut firsts = Vec::with_capacity(count + 1);
        let mut joints = Vec::with_capacity(count + 1);
        for (piece, curve) in pieces.iter().enumerate() {
            joints.push(builder.sum.value());
            firsts.push(builder.fits.len() as u32);
            let velocity = curve.velocity();
            // No longer than its speed is great; of what underflows no halving would be good.
            let fastest = velocity.iter().map(|v| v.length()).fold(0.0, f64::max);
            if fastest < min_piece {
                return Err((piece, fastest));
            }
            let mut length = 0.0;
            span::sections(&velocity, 0.0..1.0, |section| {
                length += builder.add((piece as u32, curve), &velocity, section);
            });
            debug_assert!(length.is_finite(), "piece {piece} has length {length}");
            if length < min_piece {
                return Err((piece, length));
            }
        }
        let length = builder.sum.value();
        joints.push(length);
        firsts.push(builder.fits.len() as u32);
        let mut arc_length = Self {
            cells: Vec::new(),
            cells_per_metre: (CELLS * builder.fits.len()) as f64 / length,
            fits: builder.fits,
            smooth: builder.smooth,
            halts: builder.halts,
            firsts,
            joints,
            length,
        };
        arc_length.fill_cells();
        Ok(arc_length)
    }

    fn fill_cells(&mut self) {
        let count = CELLS * self.fits.len();
        let mut cells: Vec<Cell> = Vec::with_capacity(count);
        for (number, fit) in self.fits.iter().enumerate().skip(1) {
            let (index, edge) = self.cell(fit.start);
            // Of several in a cell the first.
            if cells.len() <= index {
                let first = number as u32 - 1;
                cells.resize(index, Cell { first, edge: 2.0 });
                cells.push(Cell { first, edge });
            }
        }
        let first = self.fits.len().saturating_sub(1) as u32;
        cells.resize(count, Cell { first, edge: 2.0 });
        self.cells = cells;
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
        if let Some(fit) = self.fits.get(near.0 as usize) {
            let piece = fit.piece as usize;
            if let Some(u) = fit.sure_u_at(distance) {
                return ((piece, u), near);
            }
            if self.is_on(piece, distance) {
                let (u, near) = self.seek(pieces, piece, distance, near);
                return ((piece, u), near);
            }
        }
        self.find(pieces, distance)
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
            _ => {
                let number = self.number_at(distance);
                (self.fits[number].piece as usize, Near(number as u32))
            }
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
        while number < last && self.fits[number as usize + 1].start <= distance {
            number += 1;
        }
        while number > first && self.fits[number as usize].start > distance {
            number -= 1;
        }
        (self.u_on(pieces, number as usize, distance), Near(number))
    }

    #[inline]
    fn find(&self, pieces: &[CubicBezier], distance: f64) -> ((usize, f64), Near) {
        let number = self.guess(distance);
        // Far beyond the end there may be none.
        if let Some(fit) = self.fits.get(number)
            && let Some(u) = fit.sure_u_at(distance)
        {
            return ((fit.piece as usize, u), Near(number as u32));
        }
        self.search(pieces, distance)
    }

    /// The same, wherever it is.
    fn search(&self, pieces: &[CubicBezier], distance: f64) -> ((usize, f64), Near) {
        // NaN counts as 0.
        let distance = distance.max(0.0);
        let number = self.number_at(distance);
        let u = if distance < self.length {
            self.u_on(pieces, number, distance)
        } else {
            1.0
        };
        ((self.fits[number].piece as usize, u), Near(number as u32))
    }

    /// The parameter at `distance` on a span.
    #[inline]
    fn u_on(&self, pieces: &[CubicBezier], number: usize, distance: f64) -> f64 {
        let fit = &self.fits[number];
        match fit.u_at(distance) {
            Some(u) => u,
            None => self.u_beside_halt(pieces, number, distance),
        }
    }

    #[cold]
    fn u_beside_halt(&self, pieces: &[CubicBezier], number: usize, distance: f64) -> f64 {
        let after = (self.halts).partition_point(|(halt, _)| *halt as usize <= number);
        let (_, span) = &self.halts[after.saturating_sub(1)];
        let piece = self.fits[number].piece as usize;
        span.u_at(&pieces[piece].velocity(), distance)
    }

    /// Most likely the span at `distance`.
    #[inline]
    fn guess(&self, distance: f64) -> usize {
        let (index, share) = self.cell(distance);
        let Cell { first, edge } = self.cells[index];
        first as usize + usize::from(share >= edge)
    }

    /// The cell at a distance, and the share of it before that.
    #[inline]
    fn cell(&self, distance: f64) -> (usize, f32) {
        let place = distance * self.cells_per_metre;
        // `as` saturates and takes NaN to 0.
        let index = (place as usize).min(CELLS * self.fits.len() - 1);
        (index, (place - index as f64) as f32)
    }

    /// The last span that begins at `distance` or before, or the first.
    fn number_at(&self, distance: f64) -> usize {
        let is_after = |number: usize| {
            let fit = self.fits.get(number);
            fit.is_none_or(|fit| fit.start > distance)
        };
        let guess = self.guess(distance).min(self.fits.len() - 1);
        // By rounding one too many.
        let number = guess - usize::from(guess > 0 && is_after(guess));
        if let Some(few) = (0..2).find(|more| is_after(number + more + 1)) {
            return number + few;
        }
        // Neither the multiple nor `as` falls as the distance rises: a span that begins in a later cell begins later.
        let next = self.cells.get(self.cell(distance).0 + 1);
        let last = next.map_or(self.fits.len() - 1, |next| next.first as usize);
        let many = &self.fits[number..=last.max(number)];
        number + many.partition_point(|fit| fit.start <= distance).max(1) - 1
    }

    /// The distance at parameter `u` of `piece`; places beyond the ends are clamped.
    pub(crate) fn distance_at(&self, pieces: &[CubicBezier], piece: usize, u: f64) -> f64 {
        let u = u.max(0.0);
        if piece.saturating_add(1) >= self.joints.len() || u >= 1.0 || u <= 0.0 {
            return self.joint(piece.saturating_add(usize::from(u >= 1.0)));
        }
        let fits = &self.fits[self.firsts[piece] as usize..self.firsts[piece + 1] as usize];
        let index = fits
            .partition_point(|fit| fit.u_start <= u)
            .saturating_sub(1);
        let next = fits.get(index + 1);
        let end = next.map_or_else(|| self.joint(piece + 1), |next| next.start);
        let Fit { start, u_start, .. } = fits[index];
        let stretch = Hodograph::over(&pieces[piece].velocity(), u_start, u - u_start);
        (start + stretch.length_to(1.0)).min(end)
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
            let here = smooth.min(f64::from(self.smooth[span as usize]));
            let longest = root * here;
            if longest <= way {
                return (way, smooth);
            }
            smooth = here;
            let (end, last) = if forward {
                let end = self.fits.get(span as usize + 1);
                (end.map_or(self.length, |next| next.start), span + 1 == next)
            } else {
                (self.fits[span as usize].start, span == first)
            };
            let room = (end - distance).abs();
            if last || longest <= room {
                return (longest, smooth);
            }
            way = room;
            span = if forward { span + 1 } else { span - 1 };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Else look-ups are slow, and nobody would see it.
    #[test]
    fn most_spans_have_a_polynomial_and_are_few() {
        let point = |index: u32| {
            let angle = f64::from(index);
            DVec3::new(
                angle.sin(),
                (1.7 * angle).cos(),
                (0.3 * angle * angle).sin(),
            )
        };
        let pieces: Vec<_> = (0..10_000)
            .filter_map(|index| CubicBezier::new([0, 1, 2, 3].map(|i| point(3 * index + i))).ok())
            .collect();
        let Ok(long) = ArcLength::measure(&pieces, 1e-9) else {
            panic!("the pieces have lengths");
        };
        let few = &pieces[..100];
        let Ok(short) = ArcLength::measure(few, 1e-9) else {
            panic!("the pieces have lengths");
        };
        assert_eq!(size_of::<Fit>(), 128);
        for (arc_length, most) in [(&long, 10), (&short, 15)] {
            let (all, halts) = (arc_length.fits.len(), arc_length.halts.len());
            assert!(20 * halts < all, "{halts} of {all}");
            let pieces = arc_length.joints.len() - 1;
            assert!(all < most * pieces, "{all} of {pieces}");
        }
        // Where the spans of a long path are coarser, they still are exact to its rounding.
        for share in 0..10_000 {
            let distance = short.length() * f64::from(share) / 10_000.0;
            let (piece, u) = short.locate(few, distance);
            let (other, v) = long.locate(&pieces, distance);
            // Where the curve is slow that is more of its parameter.
            let slow = pieces[piece].derivative(u).length().min(1.0);
            assert!(
                piece == other && slow * (u - v).abs() < 2e-12,
                "{piece} {u} {other} {v}"
            );
        }
    }

    /// Whoever asks, and from wherever: the same bits.
    #[test]
    fn every_way_to_a_place_leads_to_the_same() {
        // Pieces of all sizes, so that some cells hold hundreds of spans; and cusps.
        let point = |index: u32| {
            let angle = f64::from(index);
            let size = 10.0_f64.powi(-4 * (index as i32 / 30 % 3));
            size * DVec3::new(angle.sin(), (1.7 * angle).cos(), 0.0)
        };
        let mut pieces = Vec::new();
        let mut from = DVec3::ZERO;
        for index in 0..300 {
            let to = from + point(index);
            let way = if index % 7 == 0 { 0.0 } else { 3.0 };
            pieces.extend(CubicBezier::from_hermite(
                from,
                way * point(index + 1),
                to,
                DVec3::ZERO,
            ));
            from = to;
        }
        let Ok(arc_length) = ArcLength::measure(&pieces, 1e-9) else {
            panic!("the pieces have lengths");
        };
        assert!(!arc_length.halts.is_empty());
        let starts = arc_length.fits.iter().map(|fit| fit.start);
        let beside = starts.flat_map(|start| [start.next_down(), start, start.next_up()]);
        let even = (0..3000).map(|share| arc_length.length() * f64::from(share) / 2999.0);
        for (round, distance) in beside.chain(even).enumerate() {
            let (place, near) = arc_length.find(&pieces, distance);
            assert_eq!(
                arc_length.search(&pieces, distance),
                (place, near),
                "{distance}"
            );
            let after = arc_length
                .fits
                .partition_point(|fit| fit.start <= distance.max(0.0));
            assert_eq!(near.0 as usize + 1, after, "{distance}");
            for far in [
                near.0,
                near.0 + 1,
                near.0.saturating_sub(1),
                0,
                37 * round as u32,
            ] {
                let found = arc_length.locate_near(&pieces, distance, Near(far)).0;
                assert_eq!(found, place, "{distance} from {far}");
                let (piece, u) = place;
                if arc_length.is_on(piece, distance) {
                    let sought = arc_length.seek(&pieces, piece, distance, Near(far)).0;
                    assert_eq!(sought.to_bits(), u.to_bits(), "{distance} from {far}");
                    assert_eq!(arc_length.piece_near(distance, Near(far)).0, piece);
                }
            }
        }
    }
}
