//! Every pair of features in turn: slow and certain.

use super::separator::Separator;
use super::simplex::{Nearest, Simplex};
use crate::geometry::Mesh;
use glam::DVec3;

/// The nearest pair of a vertex of one and a triangle of the other, or of two edges.
///
/// For bodies that do not overlap: their difference's surface is made of such
/// pairs. `offset` leads from B's centre to A's.
pub(super) fn nearest(pair: &Separator, offset: DVec3) -> Option<(Simplex, Nearest)> {
    let mut best: Option<(Simplex, Nearest)> = None;
    let mut show = |corners: [[u32; 2]; 3]| {
        let mut simplex = Simplex::default();
        for vertices in corners {
            simplex.push(pair.probe(offset, vertices));
        }
        if let Some(nearest) = simplex.reduce()
            && (best.as_ref()).is_none_or(|(_, least)| nearest.square < least.square)
        {
            best = Some((simplex, nearest));
        }
    };
    let (mesh_a, mesh_b) = (Mesh::of(pair.a.shape), Mesh::of(pair.b.shape));
    for [i, j, k] in mesh_a
        .iter()
        .flat_map(|mesh| mesh.triangles.iter().copied())
    {
        for b in 0..pair.b.vertex_count() {
            show([[i, b], [j, b], [k, b]]);
        }
    }
    for [i, j, k] in mesh_b
        .iter()
        .flat_map(|mesh| mesh.triangles.iter().copied())
    {
        for a in 0..pair.a.vertex_count() {
            show([[a, i], [a, j], [a, k]]);
        }
    }
    if let (Some(mesh_a), Some(mesh_b)) = (&mesh_a, &mesh_b) {
        for [i, j] in mesh_a.edges.iter().map(|edge| edge.vertices) {
            for [k, l] in mesh_b.edges.iter().map(|edge| edge.vertices) {
                show([[i, k], [j, k], [j, l]]);
                show([[i, k], [i, l], [j, l]]);
            }
        }
    }
    best
}
