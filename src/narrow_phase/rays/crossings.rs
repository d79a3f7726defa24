//! Rays from an edge of one body to an edge of the other.

use crate::geometry::Shape;
use crate::narrow_phase::rays::aim::Aim;
use crate::narrow_phase::rays::starts::Outline;
use glam::{DVec2, DVec3};

/// Up to this many pairs of edges, every pair is looked at; beyond, only edges of
/// the silhouettes, which is all it takes to miss nothing.
const MANY: usize = 1 << 14;

/// Edges whose shadows meet at a smaller sine are taken for parallel: where they
/// cross would be rounding, and what vertices next to them miss is as narrow.
const PARALLEL: f64 = 1e-6;

/// A ray between two edges, parallel to the motion.
#[derive(Debug, Clone, Copy)]
pub(super) struct Crossing {
    /// Where it ends on the second body, in view coordinates.
    pub(super) end: DVec3,
    pub(super) gap: f64,
    /// The first body's edge and the second's.
    pub(super) edges: [u32; 2],
}

/// An edge over the aim, in view coordinates.
#[derive(Clone, Copy)]
struct Seen {
    edge: u32,
    from: DVec3,
    along: DVec3,
    min: DVec3,
    max: DVec3,
}

/// Finds where the edges of two outlines cross; keeps its buffers.
///
/// Where two shadows overlap, they share a vertex of one, or their outlines
/// cross: with the vertices' own rays, these leave no overlap without a ray.
#[derive(Default)]
pub(super) struct Crossings {
    seen: [Vec<Seen>; 2],
}

impl Crossings {
    /// The shortest ray between edges that is shorter than `limit` and no
    /// shorter than `-touch`, and whose ends `counts`. `directions` are the motion's in each shape's own
    /// frame. Adds the rays cast to `rays`.
    pub(super) fn shortest(
        &mut self,
        outlines: [(&Outline<'_>, &Shape); 2],
        directions: [DVec3; 2],
        aim: &Aim,
        (touch, limit): (f64, f64),
        counts: impl Fn(DVec3, DVec3) -> bool,
        rays: &mut u64,
    ) -> Option<Crossing> {
        for (seen, (outline, _)) in self.seen.iter_mut().zip(outlines) {
            look(seen, outline, aim);
        }
        if self.seen[0].len().saturating_mul(self.seen[1].len()) > MANY {
            for ((seen, (_, shape)), direction) in
                self.seen.iter_mut().zip(outlines).zip(directions)
            {
                keep_silhouette(seen, shape, direction);
            }
        }
        let [ahead, behind] = &self.seen;
        let mut best = None::<Crossing>;
        let mut limit = limit;
        for a in ahead {
            for b in behind {
                let apart = a.min.truncate().cmpgt(b.max.truncate()).any()
                    || b.min.truncate().cmpgt(a.max.truncate()).any();
                if apart || b.min.z - a.max.z >= limit {
                    continue;
                }
                let Some((start, end)) = cross(a, b) else {
                    continue;
                };
                *rays += 1;
                let gap = end.z - start.z;
                if gap >= -touch && gap < limit && counts(start, end) {
                    limit = gap;
                    best = Some(Crossing {
                        end,
                        gap,
                        edges: [a.edge, b.edge],
                    });
                }
            }
        }
        best
    }
}

fn look(seen: &mut Vec<Seen>, outline: &Outline<'_>, aim: &Aim) {
    seen.clear();
    seen.extend((0..outline.edges()).filter_map(|edge| {
        let (from, to) = outline.edge(edge)?;
        aim.clip(from.truncate(), to.truncate())?;
        Some(Seen {
            edge,
            from,
            along: to - from,
            min: from.min(to),
            max: from.max(to),
        })
    }));
}

/// Of a polytope's edges keeps those between a face towards the motion and one against it.
fn keep_silhouette(seen: &mut Vec<Seen>, shape: &Shape, direction: DVec3) {
    if let Shape::Polytope(polytope) = shape {
        let ahead = |face: u32| {
            let normal = polytope.face_normals().get(face as usize);
            normal.is_some_and(|normal| normal.dot(direction) > 0.0)
        };
        seen.retain(|seen| {
            let edge = polytope.edges().get(seen.edge as usize);
            edge.is_some_and(|edge| ahead(edge.faces[0]) != ahead(edge.faces[1]))
        });
    }
}

/// The points of the two edges that lie over each other.
fn cross(a: &Seen, b: &Seen) -> Option<(DVec3, DVec3)> {
    let (u, v): (DVec2, DVec2) = (a.along.truncate(), b.along.truncate());
    let determinant = u.perp_dot(v);
    let sines = determinant * determinant;
    // Written so that a NaN, or an edge along the motion, crosses nothing.
    let crosses = sines > PARALLEL * PARALLEL * u.length_squared() * v.length_squared();
    let w = (b.from - a.from).truncate();
    let (on_a, on_b) = (w.perp_dot(v) / determinant, w.perp_dot(u) / determinant);
    let within = |share: f64| (0.0..=1.0).contains(&share);
    (crosses && within(on_a) && within(on_b))
        .then(|| (a.from + on_a * a.along, b.from + on_b * b.along))
}
