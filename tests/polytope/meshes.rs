//! Meshes of triangles.

use crate::checks::assert_sound;
use crate::points::{Source, cube};
use feeler::{Polytope, ShapeError};
use glam::DVec3;

const CUBE: [[u32; 3]; 12] = [
    [0, 4, 6],
    [0, 6, 2],
    [1, 3, 7],
    [1, 7, 5],
    [0, 1, 5],
    [0, 5, 4],
    [2, 6, 7],
    [2, 7, 3],
    [0, 2, 3],
    [0, 3, 1],
    [4, 5, 7],
    [4, 7, 6],
];

fn build(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Result<Polytope, ShapeError> {
    Polytope::from_triangles(vertices.iter().copied(), triangles.iter().copied())
}

#[test]
fn a_turned_box_keeps_its_numbers_and_has_six_faces() {
    let mut source = Source::new(21);
    for round in 0..200 {
        let turn = source.rotation();
        let shift = source.in_cube() * [0.0, 1.0, 1e6][round % 3];
        let vertices: Vec<DVec3> = cube()
            .into_iter()
            .map(|p| turn * (p * DVec3::new(1.0, 2.0, 0.1)) + shift)
            .collect();
        let polytope = build(&vertices, &CUBE).unwrap();
        assert_sound(&polytope, 1e-14 + 64.0 * f64::EPSILON * shift.length());
        assert_eq!(polytope.vertices(), vertices);
        assert_eq!(polytope.triangles(), CUBE);
        let faces: Vec<u32> = (0..12).map(|t| t / 2).collect();
        assert_eq!(polytope.triangle_faces(), faces);
        assert_eq!(polytope.edges().len(), 12);
    }
}

/// A cube whose sides are grids of `n × n` squares.
fn gridded(n: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut vertices: Vec<DVec3> = Vec::new();
    let mut triangles = Vec::new();
    for axis in 0..3 {
        for side in [0, n] {
            let mut number = |row: u32, column: u32| {
                let mut p = [0.0; 3];
                p[axis] = f64::from(side);
                p[(axis + 1) % 3] = f64::from(row);
                p[(axis + 2) % 3] = f64::from(column);
                let p = DVec3::from_array(p);
                let found = vertices.iter().position(|v| *v == p).unwrap_or_else(|| {
                    vertices.push(p);
                    vertices.len() - 1
                });
                found as u32
            };
            for i in 0..n {
                for j in 0..n {
                    let square = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
                    let mut q = square.map(|(i, j)| number(i, j));
                    if side == 0 {
                        q.reverse();
                    }
                    triangles.extend([[q[0], q[1], q[2]], [q[0], q[2], q[3]]]);
                }
            }
        }
    }
    (vertices, triangles)
}

#[test]
fn vertices_inside_faces_and_edges_of_a_mesh_are_kept() {
    let mut source = Source::new(22);
    for round in 0..20 {
        let (vertices, triangles) = gridded(5);
        let turn = source.rotation();
        let vertices: Vec<DVec3> = (vertices.into_iter())
            .map(|v| if round == 0 { v } else { turn * v })
            .collect();
        let polytope = build(&vertices, &triangles).unwrap();
        assert_sound(&polytope, 64.0 * f64::EPSILON * 10.0);
        assert_eq!(polytope.faces().len(), 6);
        assert_eq!(polytope.triangles(), triangles);
        for _ in 0..100 {
            let direction = source.on_sphere();
            let most = (vertices.iter())
                .map(|v| direction.dot(*v))
                .fold(f64::NEG_INFINITY, f64::max);
            let found = vertices[polytope.support(direction) as usize].dot(direction);
            assert!(most - found < 1e-14);
        }
    }
}

/// What is done to a sound mesh.
type Change<'a> = dyn Fn(&mut Vec<DVec3>, &mut Vec<[u32; 3]>) + 'a;

#[test]
fn each_fault_has_its_name() {
    let cube = cube();
    let fault = |change: &Change<'_>| {
        let (mut vertices, mut triangles) = (cube.clone(), CUBE.to_vec());
        change(&mut vertices, &mut triangles);
        build(&vertices, &triangles).expect_err("a faulty mesh passed")
    };
    use ShapeError as E;
    assert_eq!(
        fault(&|_, t| t[3][1] = 8),
        E::NoSuchVertex {
            triangle: 3,
            vertex: 8,
            count: 8
        }
    );
    assert_eq!(
        fault(&|v, _| v[5] = v[2]),
        E::DuplicateVertex {
            first: 2,
            second: 5
        }
    );
    assert_eq!(
        fault(&|v, _| v.push(DVec3::ZERO)),
        E::UnusedVertex { vertex: 8 }
    );
    assert!(matches!(
        fault(&|_, t| t.push([0, 1, 1])),
        E::DegenerateTriangle { triangle: 12, .. }
    ));
    assert!(matches!(
        fault(&|_, t| t.truncate(11)),
        E::NotClosed { count: 1, .. }
    ));
    assert!(matches!(
        fault(&|_, t| t.push([0, 4, 6])),
        E::NotClosed { count: 3, .. }
    ));
    assert_eq!(
        fault(&|_, t| t[4].swap(0, 1)),
        E::InconsistentWinding {
            triangle: 4,
            neighbour: 3
        }
    );
    assert_eq!(
        fault(&|v, t| {
            v.extend(cube.iter().map(|p| *p + 5.0));
            t.extend(CUBE.map(|t| t.map(|c| c + 8)));
        }),
        E::NotConnected { triangle: 12 }
    );
    assert_eq!(
        fault(&|_, t| t.iter_mut().for_each(|t| t.swap(0, 1))),
        E::InsideOut { triangle: 0 }
    );
    assert!(matches!(fault(&|v, _| v[7] *= 0.9), E::NotConvex { .. }));
    assert!(matches!(
        fault(&|v, _| v[7] *= 1.0 - 1e-9),
        E::NotConvex { .. }
    ));
    assert!(matches!(fault(&|v, _| v[7] *= -0.9), E::NotConvex { .. }));
    assert!(matches!(
        fault(&|v, _| v.iter_mut().for_each(|v| v.z = v.x + v.y)),
        E::DuplicateVertex { .. } | E::Flat { .. } | E::DegenerateTriangle { .. }
    ));
    assert!(matches!(fault(&|v, _| v[0].x = f64::NAN), E::Value(_)));
    assert_eq!(
        fault(&|v, t| {
            v.clear();
            t.clear();
        }),
        E::TooFewPoints { count: 0, min: 4 }
    );
}

#[test]
fn a_dent_deeper_than_rounding_is_refused_whatever_the_scale() {
    for scale in [1e-6, 1.0, 1e6] {
        for (depth, convex) in [(0.0, true), (1e-13, true), (1e-10, false), (0.1, false)] {
            let (mut vertices, triangles) = gridded(2);
            let middle = (vertices.iter())
                .position(|v| *v == DVec3::new(1.0, 1.0, 2.0))
                .unwrap();
            vertices[middle].z -= depth;
            let vertices: Vec<DVec3> = vertices.iter().map(|v| *v * scale).collect();
            let built = build(&vertices, &triangles);
            match built {
                Ok(polytope) => {
                    assert!(convex, "{depth:e} at {scale:e}");
                    assert_sound(&polytope, 1e-12 * scale);
                }
                Err(ShapeError::NotConvex { distance, .. }) => {
                    assert!(!convex, "{depth:e} at {scale:e}");
                    assert!(distance >= 0.5 * depth * scale && distance <= 4.0 * depth * scale);
                }
                other => panic!("{other:?}"),
            }
        }
    }
}

/// Two skins on one tetrahedron, cut open along two opposite edges and sewn
/// together crosswise: closed, connected, every triangle on the hull, and
/// twice around.
#[test]
fn a_surface_that_goes_round_twice_is_refused() {
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let faces: [[usize; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let mut vertices = corners.to_vec();
    let mut triangles = Vec::new();
    for skin in [0.4, 0.6] {
        for (number, face) in faces.into_iter().enumerate() {
            let middle = [0, 1, 2].map(|slot| {
                let (i, j) = (face[slot], face[(slot + 1) % 3]);
                let (i, j) = (i.min(j), i.max(j));
                // Of the two faces on a cut edge, one takes the other skin's points.
                let crossed = (i, j, number) == (0, 1, 1) || (i, j, number) == (2, 3, 3);
                let fraction = if crossed { 1.0 - skin } else { skin };
                let point = corners[i].lerp(corners[j], fraction);
                let found = vertices.iter().position(|v| v.distance(point) < 1e-9);
                found.unwrap_or_else(|| {
                    vertices.push(point);
                    vertices.len() - 1
                }) as u32
            });
            for slot in 0..3 {
                let before = middle[(slot + 2) % 3];
                triangles.push([face[slot] as u32, middle[slot], before]);
            }
            triangles.push(middle);
        }
    }
    assert_eq!((vertices.len(), triangles.len()), (16, 32));
    let built = build(&vertices, &triangles);
    assert_eq!(built, Err(ShapeError::Overlapping { layers: 2 }));
}
