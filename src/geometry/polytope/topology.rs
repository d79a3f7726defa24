//! Who lies next to whom.

/// The triangle across the edge from corner `i` to corner `i + 1`, for each
/// triangle of a closed surface.
pub(super) fn neighbours(triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut edges = Vec::with_capacity(3 * triangles.len());
    for (triangle, corners) in triangles.iter().enumerate() {
        for slot in 0..3 {
            let (from, to) = (corners[slot], corners[(slot + 1) % 3]);
            edges.push((from.min(to), from.max(to), triangle, slot));
        }
    }
    edges.sort_unstable();
    let mut neighbours = vec![[0; 3]; triangles.len()];
    for pair in edges.chunks_exact(2) {
        if let [(_, _, a, slot_a), (_, _, b, slot_b)] = *pair {
            neighbours[a][slot_a] = b as u32;
            neighbours[b][slot_b] = a as u32;
        }
    }
    neighbours
}

/// A list of lists, one after the other.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Lists {
    items: Vec<u32>,
    /// Where each list begins, and at last where the last one ends.
    starts: Vec<u32>,
}

impl Lists {
    pub(super) fn new() -> Self {
        Self {
            items: Vec::new(),
            starts: vec![0],
        }
    }

    pub(super) fn push(&mut self, list: impl IntoIterator<Item = u32>) {
        self.items.extend(list);
        self.starts.push(self.items.len() as u32);
    }

    #[inline]
    pub(super) fn get(&self, list: usize) -> &[u32] {
        &self.items[self.starts[list] as usize..self.starts[list + 1] as usize]
    }

    pub(super) fn items_mut(&mut self) -> &mut [u32] {
        &mut self.items
    }

    pub(super) fn len(&self) -> usize {
        self.starts.len() - 1
    }
}

/// For each of `count` vertices the vertices it shares a triangle's edge with.
pub(super) fn vertex_neighbours(count: usize, triangles: &[[u32; 3]]) -> Lists {
    let mut starts = vec![0_u32; count + 1];
    for &corner in triangles.iter().flatten() {
        starts[corner as usize + 1] += 1;
    }
    for vertex in 0..count {
        starts[vertex + 1] += starts[vertex];
    }
    let mut next = starts.clone();
    let mut items = vec![0; 3 * triangles.len()];
    // On a closed surface every edge is run through once each way.
    for corners in triangles {
        for slot in 0..3 {
            let place = &mut next[corners[slot] as usize];
            items[*place as usize] = corners[(slot + 1) % 3];
            *place += 1;
        }
    }
    Lists { items, starts }
}
