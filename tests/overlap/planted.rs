//! Pairs of known depth.

use crate::case::*;
use feeler::{Cuboid, Feature, Polytope, Pose, Shape, Sphere, Triangle};
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// A pair that touches when A stands `touch` metres along +x from B; moved in
/// from there along x it overlaps by as much.
struct Planted {
    name: &'static str,
    a: Shape,
    turn_a: DQuat,
    b: Shape,
    turn_b: DQuat,
    touch: f64,
    features: (Feature, Feature),
}

fn planted() -> Vec<Planted> {
    use std::f64::consts::{FRAC_PI_4, SQRT_2};
    let cube = Shape::from(Cuboid::new([1.0, 1.0, 1.0]).unwrap());
    let ball = Shape::from(Sphere::new(1.0).unwrap());
    let corners: Vec<DVec3> = Cuboid::new([1.0, 1.0, 1.0]).unwrap().vertices().to_vec();
    let hull = Shape::from(Polytope::from_points(corners).unwrap());
    let upright = Triangle::new([0.0, 0.0, -1.0], [0.0, 0.0, 1.0], [2.0, 0.0, 0.0]).unwrap();
    let flat = Triangle::new([0.0, 1.0, 0.0], [-2.0, 0.0, 0.0], [0.0, -1.0, 0.0]).unwrap();
    let corner = DQuat::from_rotation_arc(DVec3::ONE.normalize(), DVec3::X);
    let about_y = DQuat::from_rotation_y(FRAC_PI_4);
    let about_z = DQuat::from_rotation_z(FRAC_PI_4);
    let new = |name, a: &Shape, turn_a, b: &Shape, turn_b, touch, features| Planted {
        name,
        a: a.clone(),
        turn_a,
        b: b.clone(),
        turn_b,
        touch,
        features,
    };
    let (i, surface) = (DQuat::IDENTITY, Feature::Surface);
    let (face, edge, vertex) = (Feature::Face, Feature::Edge, Feature::Vertex);
    let (upright, flat) = (Shape::from(upright), Shape::from(flat));
    let any = u32::MAX;
    vec![
        new(
            "sphere on sphere",
            &ball,
            i,
            &ball,
            i,
            2.0,
            (surface, surface),
        ),
        new(
            "sphere on face",
            &ball,
            i,
            &cube,
            i,
            2.0,
            (surface, face(1)),
        ),
        new(
            "sphere on edge",
            &ball,
            i,
            &cube,
            about_z,
            1.0 + SQRT_2,
            (surface, edge(9)),
        ),
        new(
            "sphere on vertex",
            &ball,
            i,
            &cube,
            corner,
            1.0 + 3_f64.sqrt(),
            (surface, vertex(7)),
        ),
        new(
            "sphere on hull's face",
            &ball,
            i,
            &hull,
            i,
            2.0,
            (surface, face(any)),
        ),
        new(
            "sphere on hull's edge",
            &ball,
            i,
            &hull,
            about_z,
            1.0 + SQRT_2,
            (surface, edge(any)),
        ),
        new(
            "sphere on hull's vertex",
            &ball,
            i,
            &hull,
            corner,
            1.0 + 3_f64.sqrt(),
            (surface, vertex(any)),
        ),
        new(
            "sphere on triangle's edge",
            &ball,
            i,
            &flat,
            i,
            1.0,
            (surface, edge(2)),
        ),
        new("face on face", &cube, i, &cube, i, 2.0, (face(0), face(1))),
        new(
            "face on edge",
            &cube,
            i,
            &cube,
            about_z,
            1.0 + SQRT_2,
            (face(0), edge(9)),
        ),
        new(
            "face on vertex",
            &cube,
            i,
            &cube,
            corner,
            1.0 + 3_f64.sqrt(),
            (face(0), vertex(7)),
        ),
        new(
            "edge on edge",
            &cube,
            about_y,
            &cube,
            about_z,
            2.0 * SQRT_2,
            (edge(4), edge(9)),
        ),
        new(
            "hull's face on face",
            &hull,
            i,
            &cube,
            i,
            2.0,
            (face(any), face(1)),
        ),
        new(
            "hull's face on hull's edge",
            &hull,
            i,
            &hull,
            about_z,
            1.0 + SQRT_2,
            (face(any), edge(any)),
        ),
        new(
            "hull's edge on hull's edge",
            &hull,
            about_y,
            &hull,
            about_z,
            2.0 * SQRT_2,
            (edge(any), edge(any)),
        ),
        new(
            "hull's face on hull's vertex",
            &hull,
            i,
            &hull,
            corner,
            1.0 + 3_f64.sqrt(),
            (face(any), vertex(any)),
        ),
        new(
            "triangle's edge on face",
            &upright,
            i,
            &cube,
            i,
            1.0,
            (edge(0), face(1)),
        ),
        new(
            "triangle's edge on edge",
            &upright,
            i,
            &flat,
            i,
            0.0,
            (edge(0), edge(2)),
        ),
        new(
            "triangle's edge on box's edge",
            &upright,
            DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2),
            &cube,
            about_z,
            SQRT_2,
            (edge(0), edge(9)),
        ),
    ]
}

fn same_feature(found: Feature, wanted: Feature) -> bool {
    match wanted {
        Feature::Face(u32::MAX) => matches!(found, Feature::Face(_)),
        Feature::Edge(u32::MAX) => matches!(found, Feature::Edge(_)),
        Feature::Vertex(u32::MAX) => matches!(found, Feature::Vertex(_)),
        _ => found == wanted,
    }
}

#[test]
fn planted_depths_come_out() {
    let mut rng = ChaCha8Rng::seed_from_u64(9);
    for Planted {
        name,
        a,
        turn_a,
        b,
        turn_b,
        touch,
        features,
    } in planted()
    {
        for index in 0..20 {
            // The first as it stands, the others turned together.
            let common = if index == 0 {
                DQuat::IDENTITY
            } else {
                turn(&mut rng)
            };
            for depth in [-0.1, -1e-6, -1e-9, 0.0, 1e-11, 1e-9, 1e-6, 1e-3, 0.02] {
                let at = common * DVec3::new(touch - depth, 0.0, 0.0);
                let case = Case {
                    a: a.clone(),
                    pose_a: Pose::new(at, (common * turn_a).normalize()),
                    b: b.clone(),
                    pose_b: Pose::new(DVec3::ZERO, (common * turn_b).normalize()),
                };
                let found = case.overlap();
                if depth <= 0.0 {
                    assert!(found.is_none(), "{name}, {depth:e} deep: {found:?}");
                    continue;
                }
                let Some(found) = found else {
                    panic!("{name}, {depth:e} deep: missed");
                };
                assert!((found.depth - depth).abs() < 5e-15, "{name}: {found:?}");
                assert!(
                    found.direction.distance(common * DVec3::X) < 1e-14,
                    "{name}, {depth:e} deep: {found:?}"
                );
                assert!(
                    same_feature(found.feature_a, features.0)
                        && same_feature(found.feature_b, features.1),
                    "{name}, {depth:e} deep: {found:?}"
                );
                // The pair is symmetric about the x axis, where it meets.
                let local = common.conjugate() * found.point;
                assert!(local.y.abs() + local.z.abs() < 1e-9, "{name}: {local}");
                assert!(case.check(name));
            }
        }
    }
}
