//! Is a polytope what it claims to be? Uses public accessors only, and no code
//! of what it checks.

use feeler::Polytope;
use glam::DVec3;
use std::collections::{HashMap, HashSet};

/// Largest coordinate.
pub(crate) fn size(points: &[DVec3]) -> f64 {
    points
        .iter()
        .map(|p| p.abs().max_element())
        .fold(0.0, f64::max)
}

/// Panics unless the polytope is closed, consistent, outward and, to within
/// `tolerance` metres, convex.
pub(crate) fn assert_sound(polytope: &Polytope, tolerance: f64) {
    let vertices = polytope.vertices();
    let faces: Vec<_> = polytope.faces().collect();
    let triangles = polytope.triangles();
    assert_eq!(faces.len(), polytope.face_normals().len());
    assert_eq!(faces.len(), polytope.face_offsets().len());
    assert_eq!(triangles.len(), polytope.triangle_faces().len());

    // Triangles: every directed edge once, its reverse once.
    let mut directed = HashMap::new();
    for (t, corners) in triangles.iter().enumerate() {
        for slot in 0..3 {
            let edge = (corners[slot], corners[(slot + 1) % 3]);
            assert!(directed.insert(edge, t).is_none(), "edge {edge:?} twice");
        }
    }
    for &(from, to) in directed.keys() {
        assert!(directed.contains_key(&(to, from)), "edge {from} {to} open");
    }
    let used: HashSet<u32> = triangles.iter().flatten().copied().collect();
    assert_eq!(used.len(), vertices.len());
    assert_eq!(2 * vertices.len(), triangles.len() + 4, "no sphere");

    // Faces: their rims are the edges between different faces.
    let mut rims = HashMap::new();
    for (f, face) in faces.iter().enumerate() {
        assert!(face.vertices.len() >= 3);
        for (i, &from) in face.vertices.iter().enumerate() {
            let to = face.vertices[(i + 1) % face.vertices.len()];
            assert!(rims.insert((from, to), f as u32).is_none());
            let triangle = directed[&(from, to)];
            assert_eq!(polytope.triangle_faces()[triangle], f as u32);
        }
    }
    let mut with_edge = HashSet::new();
    for edge in polytope.edges() {
        let [from, to] = edge.vertices;
        let [left, right] = edge.faces;
        assert!(left != right);
        assert_eq!(rims.get(&(from, to)), Some(&left));
        assert_eq!(rims.get(&(to, from)), Some(&right));
        with_edge.extend(edge.vertices);
    }
    assert_eq!(rims.len(), 2 * polytope.edges().len());
    assert_eq!(
        with_edge.len() + faces.len(),
        polytope.edges().len() + 2,
        "Euler: {} vertices, {} faces, {} edges",
        with_edge.len(),
        faces.len(),
        polytope.edges().len()
    );

    // Planes hold the body, and their own vertices.
    for face in &faces {
        assert!((face.normal.length() - 1.0).abs() < 1e-14, "{face:?}");
        let reach = |v: DVec3| face.normal.dot(v);
        let most = vertices
            .iter()
            .map(|&v| reach(v))
            .fold(f64::NEG_INFINITY, f64::max);
        assert!(face.offset >= most, "{:e}", most - face.offset);
        assert!(face.offset - most <= 4.0 * f64::EPSILON * size(vertices));
        for &v in face.vertices {
            let below = face.offset - reach(vertices[v as usize]);
            assert!(below <= tolerance, "vertex {v} {below:e} m below {face:?}");
        }
    }

    // Volume of the mesh positive: outward.
    let origin = vertices[0];
    let volume: f64 = triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|v| vertices[v as usize] - origin);
            a.cross(b).dot(c)
        })
        .sum();
    assert!(volume > 0.0, "volume {volume:e}");

    // The sphere holds all vertices.
    for v in vertices {
        assert!(v.distance(polytope.centre()) <= polytope.max_dist());
    }
}

/// The vertices as a set of bits.
pub(crate) fn vertex_set(vertices: &[DVec3]) -> HashSet<[u64; 3]> {
    vertices
        .iter()
        .map(|v| (*v + 0.0).to_array().map(f64::to_bits))
        .collect()
}
