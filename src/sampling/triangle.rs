//! Random points on a triangle.

use crate::sampling::seed::{ThesisStream, UnitStream};
use glam::DVec3;

/// `count` points drawn as the thesis draws them, after its `srand(seed)`:
/// `P1 + x·(P2 − P1) + y·(1 − x)·(P3 − P1)` with x and y random in `[0, 1]`.
///
/// That crowds points towards `P2`: half of them lie in the quarter of the
/// triangle next to it. [`triangle_even`] does not.
///
/// The random numbers are those of the C runtime that the thesis was compiled
/// with, so that the points it prints come out again (seed 10 for its table
/// 4.3, seed 16 for its table 4.5). They have 15 bits, and of the seed 32 count.
///
/// Source: the thesis, §3.8.
///
/// ```
/// use feeler::sampling::triangle_thesis;
/// use glam::DVec3;
///
/// // The base of the thesis's pyramid; its ray hits at (0.481052, −3.123795, −0.029230).
/// let (a, b, c) = ([1.0, -1.0, 1.0], [-1.0, -1.0, 1.0], [0.0, -1.0, -1.0]);
/// let point = triangle_thesis([a.into(), b.into(), c.into()], 1, 10)[0];
/// assert!((point - DVec3::new(0.481052, -1.0, -0.029230)).abs().max_element() < 1e-6);
/// ```
#[must_use]
pub fn triangle_thesis(triangle: [DVec3; 3], count: u32, seed: u64) -> Vec<DVec3> {
    let mut stream = ThesisStream::new(seed);
    draw(triangle, count, || {
        let (x, y) = (stream.next(), stream.next());
        (x, y * (1.0 - x))
    })
}

/// `count` points drawn uniformly over the triangle's area.
///
/// Source: Turk, *Generating Random Points in Triangles*, Graphics Gems (1990).
///
/// ```
/// use feeler::sampling::triangle_even;
/// use glam::DVec3;
///
/// let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
/// assert_eq!(triangle_even(corners, 10, 1), triangle_even(corners, 10, 1));
/// ```
#[must_use]
pub fn triangle_even(triangle: [DVec3; 3], count: u32, seed: u64) -> Vec<DVec3> {
    let mut stream = UnitStream::new(seed);
    draw(triangle, count, || {
        let (root, y) = (stream.next().sqrt(), stream.next());
        (root * (1.0 - y), root * y)
    })
}

/// `count` points with the shares that `draw` gives of the two edges from the first corner.
fn draw([a, b, c]: [DVec3; 3], count: u32, mut shares: impl FnMut() -> (f64, f64)) -> Vec<DVec3> {
    (0..count)
        .map(|_| {
            let (x, y) = shares();
            a + x * (b - a) + y * (c - a)
        })
        .collect()
}
