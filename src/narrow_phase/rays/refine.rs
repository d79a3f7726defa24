//! Further rays around the shortest.

use glam::DVec2;

/// Least step of the searches, as a share of the region searched. Below it the
/// gaps of neighbouring rays differ by rounding alone.
const LEAST_STEP: f64 = 1e-9;

/// How near to the middle, in radii, the lowest point of the model must be for
/// a round without gain to end the search. A kink's model has it farther out.
const SETTLED: f64 = 0.05;

/// Six directions, evenly around.
const HEXAGON: [DVec2; 6] = [
    DVec2::new(1.0, 0.0),
    DVec2::new(0.5, 0.866_025_403_784_438_6),
    DVec2::new(-0.5, 0.866_025_403_784_438_6),
    DVec2::new(-1.0, 0.0),
    DVec2::new(-0.5, -0.866_025_403_784_438_6),
    DVec2::new(0.5, -0.866_025_403_784_438_6),
];

/// Searches the square `[−1, 1]²` for the least gap, from a point whose gap is known.
///
/// Each round sends six rays around the best so far and, where the surface is
/// smooth, a seventh to where a paraboloid through the seven has its lowest
/// point. A round that finds nothing better halves its radius; where the
/// paraboloid's lowest point is the one already known, the search is over.
/// `turns` are unit vectors that turn the hexagon from round to round, so that
/// no direction of an edge stays unlooked at.
///
/// `cast` gives the gap of a ray, NaN for a miss, and is called at most `budget` times.
pub(super) fn search_area(
    mut best: (DVec2, f64),
    mut radius: f64,
    mut budget: u32,
    turns: &[DVec2],
    mut cast: impl FnMut(DVec2) -> f64,
) -> (DVec2, f64) {
    let square = |point: DVec2| point.clamp(DVec2::NEG_ONE, DVec2::ONE);
    for turn in turns.iter().cycle() {
        if budget < 7 || radius < LEAST_STEP {
            break;
        }
        budget -= 7;
        let (centre, gap) = best;
        let corners = HEXAGON.map(|corner| centre + radius * turn.rotate(corner));
        let points = corners.map(square);
        let gaps = points.map(&mut cast);
        for (point, found) in points.into_iter().zip(gaps) {
            if found < best.1 {
                best = (point, found);
            }
        }
        let moved = best.1 < gap;
        let mut step = if moved { radius } else { 0.5 * radius };
        if points == corners
            && let Some(offset) = lowest_point(gap, &gaps)
        {
            let offset = offset.clamp_length_max(2.0);
            let point = square(centre + radius * turn.rotate(offset));
            let found = cast(point);
            if found < best.1 {
                best = (point, found);
            } else if !moved && offset.length() < SETTLED {
                break;
            }
            // The model was trusted and led somewhere: look closer there.
            if found <= best.1 {
                step = radius * offset.length().clamp(0.125, 1.0);
            }
        }
        radius = step;
    }
    best
}

/// The lowest point of the paraboloid through the middle and the corners of a
/// unit hexagon; none if it opens downwards or a corner is NaN.
///
/// With `f(p) = f₀ + g·p + ½ pᵀHp` the corners' sums against `1`, `cos`, `sin`,
/// `cos 2`, `sin 2` are `3/2 tr H`, `3g` and `3/2 (A, B)` with
/// `A = (Hxx − Hyy)/2` and `B = Hxy`.
fn lowest_point(middle: f64, corners: &[f64; 6]) -> Option<DVec2> {
    let (mut gradient, mut double) = (DVec2::ZERO, DVec2::ZERO);
    let mut trace = 0.0;
    for (corner, direction) in corners.iter().zip(HEXAGON) {
        let rise = corner - middle;
        trace += rise * 2.0 / 3.0;
        gradient += rise * direction / 3.0;
        double += rise * direction.rotate(direction) * 2.0 / 3.0;
    }
    let (xx, yy, xy) = (0.5 * trace + double.x, 0.5 * trace - double.x, double.y);
    let determinant = xx * yy - xy * xy;
    // NaN fails both comparisons.
    if trace > 0.0 && determinant > 1e-6 * trace * trace {
        Some(
            -DVec2::new(
                yy * gradient.x - xy * gradient.y,
                xx * gradient.y - xy * gradient.x,
            ) / determinant,
        )
    } else {
        None
    }
}

/// Searches a segment for the least gap by golden section, from a share whose
/// gap is known and the shares between which to look.
///
/// The gap along an edge is convex, with kinks where the edge passes over the
/// other body's: a search that needs no derivative finds them too.
pub(super) fn search_edge(
    mut best: (f64, f64),
    (mut low, mut high): (f64, f64),
    budget: u32,
    mut cast: impl FnMut(f64) -> f64,
) -> (f64, f64) {
    const GOLDEN: f64 = 0.381_966_011_250_105_1;
    for _ in 0..budget {
        if high - low < LEAST_STEP {
            break;
        }
        let left_is_longer = best.0 - low > high - best.0;
        let end = if left_is_longer { low } else { high };
        let at = best.0 + GOLDEN * (end - best.0);
        let gap = cast(at);
        // A miss, NaN, counts as no better.
        let (inner, outer) = if gap < best.1 {
            (at, best.0)
        } else {
            (best.0, at)
        };
        if gap < best.1 {
            best = (at, gap);
        }
        if outer < inner {
            low = outer;
        } else {
            high = outer;
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_paraboloid_is_found_in_one_round() {
        let f = |p: DVec2| 3.0 + 2.0 * (p.x - 0.2).powi(2) + p.x * p.y + (p.y + 0.1).powi(2);
        let corners = HEXAGON.map(f);
        let lowest = lowest_point(f(DVec2::ZERO), &corners).unwrap();
        for nudge in HEXAGON {
            assert!(f(lowest + 1e-4 * nudge) > f(lowest), "{lowest}");
        }
    }

    #[test]
    fn the_area_search_reaches_a_kink_in_a_corner_of_a_region_with_misses() {
        let f = |p: DVec2| {
            if p.y < -0.7 {
                f64::NAN
            } else {
                (p.x - 0.3).abs() + 2.0 * (p.y + 0.7)
            }
        };
        let turns = [DVec2::X, DVec2::from_angle(0.3), DVec2::from_angle(0.7)];
        let start = (DVec2::new(-0.5, 0.5), f(DVec2::new(-0.5, 0.5)));
        let (point, gap) = search_area(start, 0.5, 400, &turns, f);
        assert!(gap < 1e-3, "{point} {gap}");
    }

    #[test]
    fn the_edge_search_reaches_the_end_of_what_can_be_hit() {
        let f = |at: f64| if at > 0.61 { f64::NAN } else { -at };
        let (at, gap) = search_edge((0.5, -0.5), (0.0, 1.0), 60, f);
        assert!((at - 0.61).abs() < 1e-8, "{at} {gap}");
    }

    #[test]
    fn no_more_rays_are_cast_than_the_budget_allows() {
        for budget in 0..60 {
            let mut cast = 0;
            search_area((DVec2::ZERO, 1.0), 0.5, budget, &[DVec2::X], |p| {
                cast += 1;
                p.x.abs() + (p.y - 0.3).abs()
            });
            assert!(cast <= budget, "{cast} of {budget}");
        }
    }
}
