//! What the hunt has found.

use feeler::{Body, Cuboid, Facing, Method, Motion, Path, Sphere, first_contact};
use glam::DVec3;

const NOSE_FIRST: Facing = Facing {
    forward: DVec3::X,
    up: DVec3::Z,
    world_up: DVec3::Z,
};

/// Beside another body, but not in touch: the search stood still there and was given up.
#[test]
fn who_faces_its_way_and_turns_round_is_not_given_up() {
    let path = Path::bezier([[0.0; 3], [2.0, 0.0, 0.0], [4.0, 1.0, 0.0], [5.0, 3.0, 1.0]]).unwrap();
    let (end, tangent) = (path.end(), path.tangent_at(path.length()));
    // The shuttle is 0.5 m long before its hub.
    let ball = Sphere::new(1.0).unwrap();
    for step in 0..200 {
        let beside = [0.01, 0.1, 0.3][step % 3];
        let ball = Body::fixed(ball, end + (1.5 + beside) * tangent);
        let horizon = 1.1 + 0.01 * step as f64;
        let motion = Motion::along(path.clone(), path.length())
            .and_then(Motion::back_and_forth)
            .and_then(|motion| motion.facing(NOSE_FIRST));
        let shuttle = Body::moving(Cuboid::new([0.5, 0.1, 0.1]).unwrap(), motion.unwrap());
        let found = first_contact(&shuttle, &ball, horizon, &Method::Exact);
        assert_eq!(found, Ok(None), "{beside} in {horizon}");
    }
}

/// On the corners of a path too, and on those of a loop.
#[test]
fn who_faces_its_way_and_turns_at_once_is_not_given_up() {
    let square = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [3.0, 0.0, 0.0],
        [3.0, 1.0, 0.0],
        [3.0, 2.0, 0.0],
        [3.0, 3.0, 0.0],
        [2.0, 3.0, 0.0],
        [1.0, 3.0, 0.0],
        [0.0, 3.0, 0.0],
        [0.0, 2.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 0.0],
    ];
    let motion = Motion::along(Path::bezier(square).unwrap(), 3.0)
        .and_then(Motion::looping)
        .and_then(|motion| motion.facing(NOSE_FIRST));
    let nose = Body::moving(Cuboid::new([0.5, 0.1, 0.1]).unwrap(), motion.unwrap());
    for (x, y) in [(-0.2, -0.2), (3.2, -0.2), (3.2, 3.2), (-0.2, 3.2)] {
        // Its corner comes no nearer than that of the box turned along one of the sides.
        let ball = Body::fixed(Sphere::new(0.05).unwrap(), [x, y, 0.0]);
        let found = first_contact(&nose, &ball, 4.5, &Method::Exact);
        assert!(matches!(found, Ok(None)), "{x} {y}: {found:?}");
    }
}
