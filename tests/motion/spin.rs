//! Spin, against rotations worked out otherwise.

use crate::{unit, vector, within};
use feeler::Motion;
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use std::f64::consts::TAU;

/// Rodrigues' formula; the thesis, B.1–B.4.
fn turned(vector: DVec3, axis: DVec3, angle: f64) -> DVec3 {
    let along = vector.dot(axis) * axis;
    along + angle.cos() * (vector - along) + angle.sin() * axis.cross(vector)
}

#[test]
fn bodies_turn_about_their_point_and_it_flies_on() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for _ in 0..2_000 {
        let (place, velocity, point) = (vector(&mut rng), vector(&mut rng), vector(&mut rng));
        let axis = vector(&mut rng).normalize();
        let rate = within(&mut rng, -50.0, 50.0);
        let orientation = DQuat::from_axis_angle(vector(&mut rng).normalize(), unit(&mut rng));
        let motion = Motion::free(place, velocity)
            .and_then(|motion| motion.spin_about(point, 3.0 * axis, rate))
            .unwrap();
        let elapsed = within(&mut rng, 0.0, 4.0);
        let pose = motion.pose_after(elapsed, orientation);
        let hub = place + orientation * point + elapsed * velocity;
        for _ in 0..4 {
            let local = vector(&mut rng);
            let arm = turned(orientation * (local - point), axis, rate * elapsed);
            assert!(pose.point(local).distance(hub + arm) < 1e-13);
        }
        assert!(pose.point(point).distance(hub) < 1e-14);
        let start = motion.pose_after(0.0, orientation);
        assert!(start.position.distance(place) < 1e-15);
        assert!(start.orientation.dot(orientation).abs() > 1.0 - 1e-15);
    }
}

/// For an hour and for years: the angle is reduced in integers.
#[test]
fn orientation_does_not_drift() {
    const SCALE: i128 = 10_i128.pow(24);
    /// 8π in units of 1e-24: quarters of a radian are whole, too.
    const FOUR_TURNS: i128 = 25_132_741_228_718_345_907_701_147;
    for (rate, hours) in [
        (1.0, 1),
        (1000.0, 1),
        (1e6, 10),
        (-313.0, 24 * 365),
        (0.75, 100_000),
    ] {
        let motion = Motion::fixed(DVec3::ZERO)
            .and_then(|motion| motion.spin([0.0, 0.0, 1.0], rate))
            .unwrap();
        for second in 0..50_u32 {
            let elapsed = f64::from(second) + 3600.0 * f64::from(hours);
            // Exact: rates are whole or quarters, and seconds are whole.
            let quarters = (4.0 * rate) as i128 * elapsed as i128;
            let angle = (quarters * SCALE % FOUR_TURNS) as f64 / (4.0 * SCALE as f64);
            let got = motion
                .pose_after(elapsed, DQuat::IDENTITY)
                .direction(DVec3::X);
            let want = DVec3::new(angle.cos(), angle.sin(), 0.0);
            assert!(
                got.distance(want) < 1e-13,
                "{rate} rad/s, {elapsed} s: off by {:e}",
                got.distance(want)
            );
        }
    }
}

#[test]
fn a_whole_turn_is_none() {
    let motion = Motion::fixed([1.0, 2.0, 3.0])
        .and_then(|motion| motion.spin_about([5.0, 0.0, 0.0], [0.0, 0.0, 1.0], TAU))
        .unwrap();
    for turn in 0..1000 {
        let pose = motion.pose_after(f64::from(turn), DQuat::IDENTITY);
        // TAU is off by 2.4e-16.
        assert!(
            pose.position.distance(DVec3::new(1.0, 2.0, 3.0)) < 1e-14 + 3e-15 * f64::from(turn)
        );
    }
    // Half a turn later the origin is on the other side of the point.
    let pose = motion.pose_after(0.5, DQuat::IDENTITY);
    assert!(pose.position.distance(DVec3::new(11.0, 2.0, 3.0)) < 1e-14);
}
