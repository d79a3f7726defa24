//! Which edges lie where.

use super::Edge;
use super::topology::Lists;
use glam::DVec3;

/// An edge with all that a search needs to know of it: one line of cache.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub(crate) struct EdgeLine {
    /// Its first vertex.
    pub(crate) from: DVec3,
    /// From there to its second.
    pub(crate) along: DVec3,
    /// As [`Edge`] has them.
    pub(crate) vertices: [u32; 2],
    pub(crate) faces: [u32; 2],
}

/// The edges around each vertex of a polytope.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct EdgeMap {
    lines: Vec<EdgeLine>,
    /// By both vertices the edge between them, or [`NONE`]; empty if vertices are many.
    pairs: Vec<u8>,
    count: usize,
    of_vertices: Lists,
    /// The other ends of those edges.
    others: Lists,
}

/// No edge.
const NONE: u8 = u8::MAX;

/// Up to this many vertices there is a table of all pairs: 576 bytes at most, and no more than
/// 66 edges.
const FEW: usize = 24;

impl EdgeMap {
    pub(super) fn new(vertices: &[DVec3], edges: &[Edge]) -> Self {
        let line = |&Edge {
                        vertices: ends,
                        faces,
                    }: &Edge| {
            let [from, to] = ends.map(|end| vertices[end as usize]);
            EdgeLine {
                from,
                along: to - from,
                vertices: ends,
                faces,
            }
        };
        let count = vertices.len();
        let mut pairs = Vec::new();
        if count <= FEW && edges.len() < usize::from(NONE) {
            pairs.resize(count * count, NONE);
            for (number, edge) in (0..NONE).zip(edges) {
                let [from, to] = edge.vertices.map(|vertex| vertex as usize);
                pairs[from * count + to] = number;
                pairs[to * count + from] = number;
            }
        }
        let of_vertices = gathered(vertices.len(), edges, |edge| edge.vertices);
        let mut others = Lists::new();
        for vertex in 0..count {
            let other = |&edge: &u32| {
                let [first, second] = edges[edge as usize].vertices;
                if first as usize == vertex {
                    second
                } else {
                    first
                }
            };
            others.push(of_vertices.get(vertex).iter().map(other));
        }
        Self {
            lines: edges.iter().map(line).collect(),
            pairs,
            count,
            of_vertices,
            others,
        }
    }

    #[inline]
    pub(crate) fn line(&self, edge: u32) -> &EdgeLine {
        &self.lines[edge as usize]
    }

    /// The edge between two vertices.
    #[inline]
    pub(crate) fn between(&self, from: u32, to: u32) -> Option<u32> {
        if let Some(&edge) = self.pairs.get(from as usize * self.count + to as usize) {
            return (edge != NONE).then(|| u32::from(edge));
        }
        let (around_from, around_to) = (self.around_vertex(from), self.around_vertex(to));
        // A cone's tip has many.
        let (list, here, there) = if around_from.len() <= around_to.len() {
            (around_from, from, to)
        } else {
            (around_to, to, from)
        };
        let mut others = self.others.get(here as usize).iter();
        list.get(others.position(|&other| other == there)?).copied()
    }

    /// The edges that end at a vertex; none at one amid a face.
    #[inline]
    pub(crate) fn around_vertex(&self, vertex: u32) -> &[u32] {
        self.of_vertices.get(vertex as usize)
    }
}

/// For each of `count` places the edges whose two places it is one of.
fn gathered(count: usize, edges: &[Edge], places: impl Fn(&Edge) -> [u32; 2]) -> Lists {
    let mut pairs: Vec<(u32, u32)> = (0..)
        .zip(edges)
        .flat_map(|(number, edge)| places(edge).map(|place| (place, number)))
        .collect();
    pairs.sort_unstable();
    let mut lists = Lists::new();
    let mut next = 0;
    for place in 0..count as u32 {
        let first = next;
        while pairs.get(next).is_some_and(|&(other, _)| other == place) {
            next += 1;
        }
        lists.push(pairs[first..next].iter().map(|&(_, number)| number));
    }
    lists
}
