//! How a plane between two bodies turns with them.

use super::flight::Instant;
use super::window::Window;
use glam::DVec3;

/// Squared sine of the angle between edges below which they count as parallel.
const PARALLEL: f64 = 1e-6;

/// The different ones of up to three numbers.
struct Distinct {
    numbers: [u32; 3],
    count: usize,
}

impl Distinct {
    fn of(numbers: impl Iterator<Item = u32>) -> Self {
        let mut distinct = Self {
            numbers: [0; 3],
            count: 0,
        };
        for number in numbers.take(3) {
            if !distinct.numbers[..distinct.count].contains(&number) {
                distinct.numbers[distinct.count] = number;
                distinct.count += 1;
            }
        }
        distinct
    }

    fn edge(&self, instant: &Instant<'_>) -> DVec3 {
        instant.vertex(self.numbers[1]) - instant.vertex(self.numbers[0])
    }
}

/// How the plane of the nearest features turns, in radians per frame.
///
/// A face takes it along, and so does an edge; across two edges it turns so that both stay in
/// it. Then the heights of the features' vertices above each other change alike, and the bounds
/// of a [`Window`] are those of the features' distance but for terms of the second order.
pub(super) fn of_features(window: &Window<'_, '_>, nearest: &[[u32; 2]], normal: DVec3) -> DVec3 {
    let a = Distinct::of(nearest.iter().map(|pair| pair[0]));
    let b = Distinct::of(nearest.iter().map(|pair| pair[1]));
    let (spin_a, spin_b) = (window.a.spin, window.b.spin);
    match (a.count, b.count) {
        (2, 2) => {
            let edges = [a.edge(window.a.instant), b.edge(window.b.instant)];
            across_edges(window, edges, normal)
        }
        (count_a, count_b) if count_a > count_b => spin_a.cross(normal),
        (count_a, count_b) if count_a < count_b => spin_b.cross(normal),
        (1, _) => DVec3::ZERO,
        _ => spin_a.cross(normal),
    }
}

/// How the plane along an edge of A and one of B turns with both.
pub(super) fn across_edges(
    window: &Window<'_, '_>,
    [along_a, along_b]: [DVec3; 2],
    normal: DVec3,
) -> DVec3 {
    let (spin_a, spin_b) = (window.a.spin, window.b.spin);
    let volume = normal.dot(along_a.cross(along_b));
    let squares = along_a.length_squared() * along_b.length_squared();
    if volume * volume <= PARALLEL * squares {
        return spin_a.cross(normal);
    }
    let rise_a = -normal.dot(spin_a.cross(along_a));
    let rise_b = -normal.dot(spin_b.cross(along_b));
    (rise_a * along_b.cross(normal) + rise_b * normal.cross(along_a)) / volume
}
