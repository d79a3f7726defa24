//! Shapes: corners, faces and edges.

use glam::DVec3;

/// The hull of some corners, grown by a radius.
pub(crate) struct Solid {
    pub(crate) corners: Vec<DVec3>,
    pub(crate) radius: f64,
    /// Corners of triangles that together are the surface.
    pub(crate) triangles: Vec<[usize; 3]>,
    /// Ends of edges.
    pub(crate) edges: Vec<[usize; 2]>,
    /// Different directions of faces' normals, in the solid's own frame.
    pub(crate) normals: Vec<DVec3>,
    /// Different directions of edges.
    pub(crate) directions: Vec<DVec3>,
}

impl Solid {
    pub(crate) fn ball(radius: f64) -> Self {
        Self {
            corners: vec![DVec3::ZERO],
            radius,
            triangles: Vec::new(),
            edges: Vec::new(),
            normals: Vec::new(),
            directions: Vec::new(),
        }
    }

    /// A hull of points none of which is inside, no four in one plane of its surface; a
    /// triangle if there are three.
    pub(crate) fn hull(corners: Vec<DVec3>) -> Self {
        let mut triangles = Vec::new();
        let count = corners.len();
        for i in 0..count {
            for j in i + 1..count {
                for k in j + 1..count {
                    let normal = (corners[j] - corners[i]).cross(corners[k] - corners[i]);
                    let mut others = (0..count).filter(|other| ![i, j, k].contains(other));
                    let height = |other: usize| normal.dot(corners[other] - corners[i]);
                    if others.clone().all(|other| height(other) <= 0.0) {
                        triangles.push([i, j, k]);
                    } else if others.all(|other| height(other) >= 0.0) {
                        triangles.push([i, k, j]);
                    }
                }
            }
        }
        let mut edges = Vec::new();
        for [i, j, k] in &triangles {
            for [from, to] in [[i, j], [j, k], [k, i]] {
                let edge = [*from.min(to), *from.max(to)];
                if !edges.contains(&edge) {
                    edges.push(edge);
                }
            }
        }
        let normal = |&[i, j, k]: &[usize; 3]| {
            let [a, b, c] = [i, j, k].map(|index: usize| corners[index]);
            (b - a).cross(c - a).normalize()
        };
        let mut normals: Vec<DVec3> = triangles.iter().map(normal).collect();
        let directions: Vec<DVec3> = (edges.iter())
            .map(|&[from, to]: &[usize; 2]| (corners[to] - corners[from]).normalize())
            .collect();
        if let ([normal], [..]) = (&normals[..], &directions[..]) {
            // Seen edge on, a triangle has an outline.
            let aside: Vec<DVec3> = directions
                .iter()
                .map(|along| along.cross(*normal))
                .collect();
            normals.extend(aside);
        }
        Self {
            corners,
            radius: 0.0,
            triangles,
            edges,
            normals,
            directions,
        }
    }

    pub(crate) fn cuboid(half: DVec3) -> Self {
        let sign = |corner: usize, axis: u32| if corner >> axis & 1 == 0 { -1.0 } else { 1.0 };
        let corner = |index| half * DVec3::new(sign(index, 0), sign(index, 1), sign(index, 2));
        let (mut triangles, mut edges) = (Vec::new(), Vec::new());
        for [x, y, z] in [[1, 2, 4], [2, 4, 1], [4, 1, 2]] {
            triangles.extend([[0, y, x], [y, y + x, x]]);
            triangles.extend([[z, z + x, z + y], [z + y, z + x, z + y + x]]);
            edges.extend([[0, x], [y, y + x], [z, z + x], [y + z, y + z + x]]);
        }
        Self {
            corners: (0..8).map(corner).collect(),
            radius: 0.0,
            triangles,
            edges,
            normals: DVec3::AXES.to_vec(),
            directions: DVec3::AXES.to_vec(),
        }
    }

    /// No point is farther from `local`.
    pub(crate) fn reach(&self, local: DVec3) -> f64 {
        let far = self.corners.iter().map(|corner| corner.distance(local));
        self.radius + far.fold(0.0, f64::max)
    }

    pub(crate) fn is_ball(&self) -> bool {
        self.triangles.is_empty()
    }

    pub(crate) fn is_flat(&self) -> bool {
        self.triangles.len() == 1
    }
}
