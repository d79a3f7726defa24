//! Bodies that face their way.

use crate::{ring, unit, vector};
use feeler::{CubicBezier, Facing, Motion, Path};
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

const NOSE_FIRST: Facing = Facing {
    forward: DVec3::X,
    up: DVec3::Z,
    world_up: DVec3::Z,
};

#[test]
fn forward_leads_along_the_tangent_and_up_stays_upright() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for _ in 0..500 {
        let path = ring(&mut rng);
        let facing = Facing {
            forward: 5.0 * vector(&mut rng),
            up: 0.1 * vector(&mut rng),
            world_up: vector(&mut rng),
        };
        let motion = Motion::along(path.clone(), 1.0)
            .and_then(Motion::looping)
            .and_then(|motion| motion.facing(facing))
            .unwrap();
        for _ in 0..20 {
            let elapsed = 3.0 * path.length() * unit(&mut rng);
            let turn = DQuat::from_rotation_x(unit(&mut rng));
            let pose = motion.pose_after(elapsed, turn);
            let tangent = motion.velocity_after(elapsed);
            let forward = pose.direction(facing.forward.normalize());
            assert!(forward.distance(tangent) < 1e-14);
            // Up lies in the plane of the tangent and the world's up, on its side.
            let up = pose.direction(facing.up);
            let side = tangent.cross(facing.world_up).normalize();
            assert!(up.dot(side).abs() < 1e-12);
            assert!((up - up.dot(tangent) * tangent).dot(facing.world_up) > 0.0);
        }
    }
}

#[test]
fn cusps_corners_rests_and_the_vertical_are_no_trouble() {
    let straight_up = Path::line([0.0; 3], [0.0, 0.0, 5.0]).unwrap();
    let corner = Path::bezier([
        [0.0; 3],
        [1.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [3.0, 0.0, 0.0],
        [3.0, 1.0, 0.0],
        [3.0, 2.0, 0.0],
        [3.0, 3.0, 0.0],
    ]);
    let cusp = CubicBezier::new([[0.0; 3], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]);
    let cusp = Path::bezier(cusp.unwrap().control_points());
    let over = Path::bezier([[0.0; 3], [4.0, 0.0, 4.0], [-4.0, 0.0, 4.0], [0.0; 3]]);
    let halted = Path::spline_with_tangents([[0.0; 3], [1.0, 0.0, 0.0]], [[0.0; 3]; 2]);
    for path in [
        straight_up,
        corner.unwrap(),
        cusp.unwrap(),
        over.unwrap(),
        halted.unwrap(),
    ] {
        for motion in [
            Motion::along(path.clone(), 1.0),
            Motion::along(path.clone(), 1.0).and_then(Motion::back_and_forth),
            Motion::along(path.clone(), 1.0).and_then(|motion| motion.starting_after(1.0)),
        ] {
            let motion = motion.unwrap().facing(NOSE_FIRST).unwrap();
            for step in 0..=4_000 {
                let elapsed = 3.0 * path.length() * f64::from(step) / 4_000.0;
                let pose = motion.pose_after(elapsed, DQuat::IDENTITY);
                assert!(pose.position.is_finite() && pose.orientation.is_normalized());
                let again = motion.pose_after(elapsed, DQuat::IDENTITY);
                assert_eq!(pose, again);
            }
        }
    }
}

#[test]
fn a_shuttle_flies_back_backwards() {
    let path = Path::line([0.0; 3], [0.0, 4.0, 0.0]).unwrap();
    let motion = Motion::along(path, 1.0)
        .and_then(Motion::back_and_forth)
        .and_then(|motion| motion.facing(NOSE_FIRST))
        .unwrap();
    for elapsed in [1.0, 7.0] {
        let pose = motion.pose_after(elapsed, DQuat::IDENTITY);
        assert!(pose.direction(DVec3::X).distance(DVec3::Y) < 1e-15);
    }
    assert_eq!(motion.velocity_after(7.0), DVec3::NEG_Y);
}
