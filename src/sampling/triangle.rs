//! Random points on a triangle.

use crate::sampling::UnitStream;
use glam::DVec3;

/// `count` points drawn as the thesis draws them:
/// `P1 + x·(P2 − P1) + y·(1 − x)·(P3 − P1)` with x and y uniform in `[0, 1)`.
///
/// That crowds points towards `P2`: half of them lie in the quarter of the
/// triangle next to it. [`triangle_even`] does not.
///
/// Source: the thesis, §3.8.
///
/// ```
/// use feeler::sampling::triangle_thesis;
/// use glam::DVec3;
///
/// let points = triangle_thesis([DVec3::ZERO, DVec3::X, DVec3::Y], 10, 16);
/// assert!(points.iter().all(|p| p.x >= 0.0 && p.y >= 0.0 && p.x + p.y <= 1.0));
/// ```
#[must_use]
pub fn triangle_thesis(triangle: [DVec3; 3], count: u32, seed: u64) -> Vec<DVec3> {
    draw(triangle, count, seed, |x, y| (x, y * (1.0 - x)))
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
    draw(triangle, count, seed, |x, y| {
        let root = x.sqrt();
        (root * (1.0 - y), root * y)
    })
}

fn draw(
    [a, b, c]: [DVec3; 3],
    count: u32,
    seed: u64,
    weights: impl Fn(f64, f64) -> (f64, f64),
) -> Vec<DVec3> {
    let mut stream = UnitStream::new(seed);
    (0..count)
        .map(|_| {
            let (x, y) = (stream.next(), stream.next());
            let (x, y) = weights(x, y);
            a + x * (b - a) + y * (c - a)
        })
        .collect()
}
