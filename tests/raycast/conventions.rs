//! One set of conventions for every shape.

use feeler::{
    Aabb, Cuboid, Feature, Obb, Polytope, Pose, Ray, RayCast, RayHit, Shape, Sphere, Triangle,
};
use glam::{DQuat, DVec3};

/// Shapes with thickness that reach from −1 to 1 along every axis and contain the origin.
pub(crate) fn solids() -> Vec<(&'static str, Box<dyn RayCast>)> {
    let mut all: Vec<(&'static str, Box<dyn RayCast>)> = vec![
        ("sphere", Box::new(Sphere::new(1.0).unwrap())),
        ("cuboid", Box::new(Cuboid::new([1.0, 1.0, 1.0]).unwrap())),
        ("aabb", Box::new(Aabb::new([-1.0; 3], [1.0; 3]))),
        (
            "obb",
            Box::new(Obb {
                centre: DVec3::ZERO,
                axes: DVec3::AXES,
                half_extents: DVec3::ONE,
            }),
        ),
        ("shape", Box::new(Shape::from(Sphere::new(1.0).unwrap()))),
    ];
    let corners = Cuboid::new([1.0, 1.0, 1.0]).unwrap().vertices();
    if let Ok(hull) = Polytope::from_points(corners) {
        all.push(("polytope", Box::new(hull)));
    }
    let tips = DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]);
    if let Ok(hull) = Polytope::from_points(tips) {
        all.push(("octahedron", Box::new(hull)));
    }
    all
}

fn surface(hit: Option<RayHit>) -> Option<(f64, DVec3)> {
    hit?.surface().map(|point| (point.fraction, point.normal))
}

#[test]
fn from_outside_the_near_side_is_hit() {
    for (name, solid) in solids() {
        if name == "octahedron" {
            continue;
        }
        for axis in DVec3::AXES {
            for side in [-1.0, 1.0] {
                let ray = Ray::new(side * 3.0 * axis, -side * 0.25 * axis);
                assert_eq!(
                    surface(solid.first_hit(&ray)),
                    Some((8.0, side * axis)),
                    "{name}"
                );
                let span = solid.line_span(&ray).unwrap();
                assert_eq!(
                    (span.leave.fraction, span.leave.normal),
                    (16.0, -side * axis)
                );
            }
        }
    }
}

#[test]
fn what_lies_behind_is_on_the_line_and_not_on_the_ray() {
    for (name, solid) in solids() {
        let ray = Ray::new([3.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
        let span = solid.line_span(&ray).unwrap();
        assert!((span.enter.fraction + 4.0).abs() < 1e-15, "{name}");
        assert!((span.leave.fraction + 2.0).abs() < 1e-15, "{name}");
        assert_eq!(solid.first_hit(&ray), None, "{name}");
    }
}

#[test]
fn a_start_inside_has_no_normal() {
    for (name, solid) in solids() {
        for origin in [[0.0, 0.0, 0.0], [0.3, -0.2, 0.1], [0.0, 0.0, 0.9]] {
            for direction in [[1.0, 0.0, 0.0], [-0.2, 0.3, 1e-9], [0.0, 0.0, -1e30]] {
                let ray = Ray::new(origin, direction);
                assert_eq!(solid.first_hit(&ray), Some(RayHit::Inside), "{name}");
            }
        }
    }
}

#[test]
fn a_start_on_the_surface_is_inside_and_its_neighbours_are_told_apart() {
    for (name, solid) in solids() {
        if name == "octahedron" {
            // Its faces' normals are rounded.
            continue;
        }
        for (axis, other) in [
            (DVec3::X, DVec3::Y),
            (DVec3::Y, DVec3::Z),
            (DVec3::Z, DVec3::X),
        ] {
            for side in [-1.0, 1.0] {
                let outward = side * axis;
                for direction in [outward, -outward, other, other - outward, other + outward] {
                    let from = |distance: f64| Ray::new(distance * outward, 0.7 * direction);
                    let hit = solid.first_hit(&from(1.0));
                    assert_eq!(
                        hit,
                        Some(RayHit::Inside),
                        "{name} on {outward} to {direction}"
                    );
                    let hit = solid.first_hit(&from(1.0_f64.next_down()));
                    assert_eq!(
                        hit,
                        Some(RayHit::Inside),
                        "{name} below {outward} to {direction}"
                    );
                    let hit = solid.first_hit(&from(1.0_f64.next_up()));
                    if direction.dot(outward) < 0.0 {
                        let (fraction, normal) = surface(hit).expect("going in");
                        assert!((0.0..1e-15).contains(&fraction), "{name} {fraction:e}");
                        assert!((normal - outward).length() < 1e-15, "{name} {normal}");
                    } else if direction.dot(outward) > 0.0 {
                        assert_eq!(hit, None, "{name} above {outward} to {direction}");
                    } else {
                        assert_ne!(hit, Some(RayHit::Inside), "{name} along {direction}");
                    }
                }
            }
        }
    }
}

#[test]
fn without_direction_a_ray_is_a_point() {
    for (name, solid) in solids() {
        for (origin, inside) in [
            ([0.0, 0.0, 0.0], true),
            ([0.0, 1.0, 0.0], true),
            ([0.0, 1.0_f64.next_up(), 0.0], false),
            ([2.0, 2.0, 2.0], false),
            ([f64::NAN, 0.0, 0.0], false),
        ] {
            let ray = Ray::new(origin, DVec3::ZERO);
            assert_eq!(solid.line_span(&ray), None, "{name}");
            let want = inside.then_some(RayHit::Inside);
            assert_eq!(solid.first_hit(&ray), want, "{name} at {origin:?}");
        }
    }
}

#[test]
fn nothing_but_numbers_comes_out() {
    let odd = [
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::MAX,
        f64::MIN_POSITIVE,
        5e-324,
        -0.0,
        0.0,
        1.0,
        -1e-300,
        1e300,
    ];
    let mut all = solids();
    let corners = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]];
    all.push((
        "triangle",
        Box::new(Triangle::new(corners[0], corners[1], corners[2]).unwrap()),
    ));
    for (name, solid) in all {
        for a in odd {
            for b in odd {
                for c in odd {
                    for base in [DVec3::ZERO, DVec3::new(0.5, 0.1, 0.3)] {
                        for ray in [
                            Ray::new(base, [a, b, c]),
                            Ray::new([c, a, b], [1.0, b, 0.0]),
                            Ray::new([a, 0.2, b], [c, a, 1.0]),
                        ] {
                            let bad = !(ray.origin.is_finite() && ray.direction.is_finite());
                            let (span, hit) = (solid.line_span(&ray), solid.first_hit(&ray));
                            assert!(!(bad && span.is_some()), "{name} {ray:?}");
                            assert!(!(bad && hit.is_some()), "{name} {ray:?}");
                            for point in span.into_iter().flat_map(|s| [s.enter, s.leave]) {
                                assert!(point.fraction.is_finite(), "{name} {ray:?}");
                                assert!((point.normal.length() - 1.0).abs() < 1e-14);
                            }
                            if let Some(hit) = hit {
                                assert!(hit.fraction() >= 0.0, "{name} {ray:?}");
                            }
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn directions_of_any_length_give_the_same_point() {
    for (name, solid) in solids() {
        for power in [-1070, -1000, -300, -100, 0, 100, 300, 1000, 1020] {
            let length = 2.0_f64.powi(power / 2) * 2.0_f64.powi(power - power / 2);
            let ray = Ray::new([3.0, 0.25, 0.0], [-length, 0.0, 0.0]);
            let plain = solid.first_hit(&Ray::new([3.0, 0.25, 0.0], [-1.0, 0.0, 0.0]));
            let (want, normal) = surface(plain).expect("a hit");
            let got = surface(solid.first_hit(&ray));
            if power < -1022 {
                assert_eq!(got, None, "{name}: beyond the largest f64");
            } else {
                assert_eq!(got, Some((want / length, normal)), "{name} 2^{power}");
            }
        }
    }
}

#[test]
fn faces_edges_and_corners_can_be_grazed() {
    for (name, solid) in solids() {
        // Through the tip on +x, at a right angle to that axis.
        for direction in [[0.0, 1.0, 0.0], [0.0, 0.0, -2.0]] {
            let ray = Ray::new(DVec3::X - 3.0 * DVec3::from(direction), direction);
            let hit = solid
                .first_hit(&ray)
                .unwrap_or_else(|| panic!("{name} lets {ray:?} by"));
            assert!(
                (2.0 - 1e-14..=3.0 + 1e-14).contains(&hit.fraction()),
                "{name} {hit:?}"
            );
            let beside = Ray::new(ray.origin + DVec3::new(1e-13, 0.0, 0.0), direction);
            assert_eq!(solid.first_hit(&beside), None, "{name}");
        }
    }
    for (name, solid) in solids() {
        if !["cuboid", "aabb", "obb", "polytope"].contains(&name) {
            continue;
        }
        // Along an edge; through an edge and a corner from beside.
        for (origin, direction) in [
            ([1.0, 1.0, -3.0], [0.0, 0.0, 1.0]),
            ([2.0, 0.0, 0.5], [-1.0, 1.0, 0.0]),
            ([2.0, 0.0, 1.0], [-1.0, 1.0, 0.0]),
            ([2.0, 0.0, 0.0], [-1.0, 1.0, 1.0]),
        ] {
            let hit = solid.first_hit(&Ray::new(origin, direction));
            assert!(hit.is_some(), "{name} {origin:?}");
        }
    }
}

#[test]
fn an_edge_or_corner_counts_to_the_lowest_face() {
    let unit = Cuboid::new([1.0, 1.0, 1.0]).unwrap();
    for (origin, direction, face) in [
        ([-2.0, -2.0, -2.0], [1.0, 1.0, 1.0], 0),
        ([2.0, 2.0, 2.0], [-1.0, -1.0, -1.0], 1),
        ([0.0, -2.0, 2.0], [0.0, 1.0, -1.0], 2),
        ([0.5, 2.0, 2.0], [0.0, -1.0, -1.0], 3),
    ] {
        let hit = unit
            .first_hit(&Ray::new(origin, direction))
            .and_then(|hit| hit.surface());
        assert_eq!(
            hit.map(|point| point.feature),
            Some(Feature::Face(face)),
            "{origin:?}"
        );
    }
}

#[test]
fn triangles_have_two_sides() {
    let triangle = Triangle::new([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]).unwrap();
    for (z, face) in [(2.0, 0), (-2.0, 1)] {
        let ray = Ray::new([0.25, 0.25, z], [0.0, 0.0, -0.5 * z]);
        let span = triangle.line_span(&ray).unwrap();
        assert_eq!((span.enter.fraction, span.leave.fraction), (2.0, 2.0));
        assert_eq!(span.enter.feature, Feature::Face(face));
        assert_eq!(span.enter.normal, DVec3::Z * z.signum());
        assert_eq!(span.leave.feature, Feature::Face(1 - face));
        assert_eq!(span.leave.normal, -DVec3::Z * z.signum());
    }
    // Corners and edges belong to it.
    for (x, y) in [
        (0.0, 0.0),
        (1.0, 0.0),
        (0.0, 1.0),
        (0.5, 0.5),
        (0.0, 0.3),
        (0.3, 0.0),
    ] {
        for direction in [[0.0, 0.0, -1.0], [0.3, -0.2, -1.0]] {
            let origin = DVec3::new(x, y, 0.0) - 2.0 * DVec3::from(direction);
            let hit = triangle
                .first_hit(&Ray::new(origin, direction))
                .expect("a hit");
            assert!((hit.fraction() - 2.0).abs() < 1e-15);
        }
    }
}

#[test]
fn in_a_triangles_plane_the_line_runs_from_edge_to_edge() {
    let triangle = Triangle::new([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]).unwrap();
    let span = triangle
        .line_span(&Ray::new([-1.0, 0.25, 0.0], [1.0, 0.0, 0.0]))
        .unwrap();
    assert!((span.enter.fraction - 1.0).abs() < 1e-15);
    assert!((span.leave.fraction - 1.75).abs() < 1e-15);
    assert_eq!(span.enter.feature, Feature::Edge(2));
    assert_eq!(span.enter.normal, DVec3::NEG_X);
    assert_eq!(span.leave.feature, Feature::Edge(1));
    assert!(span.leave.normal.dot(DVec3::new(1.0, 1.0, 0.0)) > 1.4);
    // Beside it, along an edge, parallel above.
    let miss = Ray::new([-1.0, 1.5, 0.0], [1.0, 0.0, 0.0]);
    assert_eq!(triangle.line_span(&miss), None);
    let along = triangle
        .line_span(&Ray::new([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]))
        .unwrap();
    assert_eq!((along.enter.fraction, along.leave.fraction), (1.0, 2.0));
    let above = Ray::new([-1.0, 0.25, 1e-14], [1.0, 0.0, 0.0]);
    assert_eq!(triangle.line_span(&above), None);
    let inside = Ray::new([0.25, 0.25, 0.0], [1.0, 0.0, 0.0]);
    assert_eq!(triangle.first_hit(&inside), Some(RayHit::Inside));
}

#[test]
fn a_start_on_a_triangle_is_inside_and_its_neighbours_are_told_apart() {
    let corners = [[0.1, 0.2, 0.3], [1.1, 0.3, 0.7], [0.2, 1.7, 0.4]].map(DVec3::from);
    let triangle = Triangle::new(corners[0], corners[1], corners[2]).unwrap();
    let normal = triangle.normal();
    for corner in corners {
        for direction in [normal, -normal, normal + 0.3 * DVec3::X] {
            let hit = triangle.first_hit(&Ray::new(corner, direction));
            assert_eq!(hit, Some(RayHit::Inside));
        }
        assert!(triangle.contains_point(corner));
        let above = corner.with_z(corner.z.next_up());
        let below = corner.with_z(corner.z.next_down());
        assert!(!triangle.contains_point(above) && !triangle.contains_point(below));
        let side = normal.z.signum();
        for (origin, is_above) in [(above, side > 0.0), (below, side < 0.0)] {
            // Slightly inwards, or else the ray passes by the corner.
            let inwards = 0.1 * (corners.iter().sum::<DVec3>() / 3.0 - corner);
            let down = triangle.first_hit(&Ray::new(origin, inwards - normal));
            let up = triangle.first_hit(&Ray::new(origin, inwards + normal));
            assert_eq!(
                down.and_then(|hit| hit.surface()).is_some(),
                is_above,
                "{down:?}"
            );
            assert_eq!(
                up.and_then(|hit| hit.surface()).is_some(),
                !is_above,
                "{up:?}"
            );
        }
    }
}

#[test]
fn a_pose_turns_the_ray_in_and_the_normal_out() {
    let pose = Pose::new([5.0, 1.0, 0.0], DQuat::from_rotation_z(0.5));
    let ray = Ray::new([0.0, 1.0, 0.0], [1.0, 0.0, 0.0]);
    for (name, solid) in solids() {
        let hit = solid
            .first_hit_at(&pose, &ray)
            .and_then(|hit| hit.surface())
            .unwrap();
        let local = Ray::new(
            pose.local_point(ray.origin),
            pose.local_direction(ray.direction),
        );
        let want = solid
            .first_hit(&local)
            .and_then(|hit| hit.surface())
            .unwrap();
        assert_eq!(hit.fraction, want.fraction, "{name}");
        assert_eq!(hit.feature, want.feature, "{name}");
        assert!(
            hit.normal.dot(pose.direction(want.normal)) > 1.0 - 1e-15,
            "{name}"
        );
        let span = solid.line_span_at(&pose, &ray).unwrap();
        assert_eq!(span.enter, hit);
        assert!(span.leave.fraction > hit.fraction);
    }
}
