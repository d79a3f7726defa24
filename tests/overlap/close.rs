//! Balls whose centres lie next to a vertex or an edge, or on it: what rounding leaves of the
//! way there leads anywhere.

use feeler::{Overlap, Polytope, Pose, Shape, Sphere, Triangle, overlap};
use glam::{DQuat, DVec3};

const RADIUS: f64 = 0.5;

/// A body with a slanting edge, and a triangle.
fn bodies() -> [(Shape, Vec<DVec3>); 2] {
    let corners = [
        [-1.0, 1.0, -0.5],
        [0.0, -1.0, -0.5],
        [0.5, -0.5, -0.5],
        [0.5, 1.0, 1.0],
        [-1.0, 1.0, 1.0],
        [0.0, -0.5, 0.0],
    ]
    .map(DVec3::from);
    let [a, b, c, ..] = corners;
    [
        (
            Polytope::from_points(corners).unwrap().into(),
            corners.to_vec(),
        ),
        (Triangle::new(a, b, c).unwrap().into(), vec![a, b, c]),
    ]
}

/// How far the ball must go along the direction to come out, whatever the depth.
fn width(found: &Overlap, corners: &[DVec3], turn: DQuat, centre: DVec3) -> f64 {
    let reach = corners
        .iter()
        .map(|&corner| found.direction.dot(turn * corner))
        .fold(f64::NEG_INFINITY, f64::max);
    reach - found.direction.dot(centre) + RADIUS
}

#[test]
fn a_ball_centred_next_to_a_vertex_or_an_edge_comes_out_by_its_depth() {
    let ball = Shape::from(Sphere::new(RADIUS).unwrap());
    let turns = (0..40).map(|i| {
        DQuat::from_rotation_x(f64::from(i)).mul_quat(DQuat::from_rotation_z(0.7 * f64::from(i)))
    });
    let mut tried = 0;
    for (shape, corners) in bodies() {
        for turn in turns.clone() {
            for place in [corners[0], corners[1], 0.5 * (corners[0] + corners[1])] {
                for exponent in 3..=18 {
                    let away = 10_f64.powi(-exponent) * (turn * DVec3::new(-2.0, -1.0, -1.0));
                    let centre = turn * place + away;
                    let found = overlap(
                        &ball,
                        &Pose::at(centre),
                        &shape,
                        &Pose::new(DVec3::ZERO, turn),
                    )
                    .unwrap();
                    assert!(
                        (width(&found, &corners, turn, centre) - found.depth).abs() < 1e-13,
                        "{found:?} out of {shape:?} from {centre}"
                    );
                    assert!((found.direction.length() - 1.0).abs() < 1e-15);
                    assert!((found.depth - RADIUS).abs() < 3.0 * away.length() + 1e-14);
                    tried += 1;
                }
            }
        }
    }
    assert_eq!(tried, 2 * 40 * 3 * 16);
}

#[test]
fn a_ball_centred_on_a_slanting_edge_is_as_deep_as_its_radius() {
    let [(shape, _), _] = bodies();
    let turn = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2);
    let ball = Shape::from(Sphere::new(RADIUS).unwrap());
    let centre = Pose::at([0.0, -0.5, -0.5]);
    let found = overlap(&ball, &centre, &shape, &Pose::new(DVec3::ZERO, turn)).unwrap();
    assert!((found.depth - RADIUS).abs() < 1e-15, "{found:?}");
}
