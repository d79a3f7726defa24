//! From the facets of a hull to its true corners.

use super::hull::Facet;
use super::orient::side;
use glam::DVec3;

/// The hull's corners, ascending, and triangles that name their places in that list.
///
/// A point in the middle of an edge or inside a face is a vertex of the
/// facets, but no corner: fewer than three edges with an actual angle meet
/// there. Each face (facets in exactly one plane) is a strictly convex polygon
/// of its corners, and cut anew into a fan around its first corner. The
/// triangles are sorted.
pub(super) fn trim(points: &[DVec3], facets: &[Facet]) -> (Vec<u32>, Vec<[u32; 3]>) {
    let bent: Vec<[bool; 3]> = facets.iter().map(|f| bent(points, facets, f)).collect();

    let mut edges_at = vec![0_u32; points.len()];
    for (facet, bent) in facets.iter().zip(&bent) {
        for slot in 0..3 {
            edges_at[facet.corners[slot] as usize] += u32::from(bent[slot]);
        }
    }
    let mut vertices = Vec::new();
    let mut place = vec![u32::MAX; points.len()];
    for (point, &edges) in edges_at.iter().enumerate() {
        if edges >= 3 {
            place[point] = vertices.len() as u32;
            vertices.push(point as u32);
        }
    }

    let mut triangles = Vec::with_capacity(facets.len());
    let mut walked = vec![[false; 3]; facets.len()];
    let mut polygon = Vec::new();
    for start in 0..facets.len() {
        for slot in 0..3 {
            if bent[start][slot] && !walked[start][slot] {
                polygon.clear();
                walk(facets, &bent, &mut walked, (start, slot), |corner| {
                    let place = place[corner as usize];
                    if place != u32::MAX {
                        polygon.push(place);
                    }
                });
                fan(&mut polygon, &mut triangles);
            }
        }
    }
    triangles.sort_unstable();
    (vertices, triangles)
}

/// Which of the facet's edges have an angle.
fn bent(points: &[DVec3], facets: &[Facet], facet: &Facet) -> [bool; 3] {
    let corners = facet.corners.map(|corner| points[corner as usize]);
    std::array::from_fn(|slot| {
        let neighbour = &facets[facet.neighbours[slot] as usize];
        let [a, b, c] = neighbour.corners;
        let from = facet.corners[slot];
        let to = facet.corners[(slot + 1) % 3];
        let opposite = [a, b, c]
            .into_iter()
            .find(|&corner| corner != from && corner != to);
        opposite.is_some_and(|corner| side(corners, points[corner as usize]).abs() > 0.0)
    })
}

/// Walks once around the face on whose rim the edge `start` lies.
fn walk(
    facets: &[Facet],
    bent: &[[bool; 3]],
    walked: &mut [[bool; 3]],
    start: (usize, usize),
    mut visit: impl FnMut(u32),
) {
    let (mut facet, mut slot) = start;
    while !walked[facet][slot] {
        walked[facet][slot] = true;
        visit(facets[facet].corners[slot]);
        slot = (slot + 1) % 3;
        while !bent[facet][slot] {
            let pivot = facets[facet].corners[slot];
            facet = facets[facet].neighbours[slot] as usize;
            // The edge reaches us from the other side: it ends at the pivot here.
            slot = (0..3)
                .find(|&slot| facets[facet].corners[slot] == pivot)
                .unwrap_or(slot);
        }
    }
}

/// Cuts a polygon into triangles around its lowest corner.
fn fan(polygon: &mut [u32], triangles: &mut Vec<[u32; 3]>) {
    let lowest = (0..polygon.len()).min_by_key(|&i| polygon[i]).unwrap_or(0);
    polygon.rotate_left(lowest);
    if let Some((&first, rest)) = polygon.split_first() {
        triangles.extend(rest.windows(2).map(|pair| [first, pair[0], pair[1]]));
    }
}
