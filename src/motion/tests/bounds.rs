//! Bounds, one-sidedly: dense samples never exceed them.

use super::Random;
use crate::motion::{FrameMotion, Motion};
use glam::DVec3;

const SAMPLES: u32 = 200;

fn frame(random: &mut Random, motion: &Motion) -> (FrameMotion, [f64; 2]) {
    let duration = random.decades(-2.0, 0.3);
    let frame = FrameMotion::new(motion, random.within(0.0, 2.0), duration);
    let from = random.unit();
    let to = match random.below(3) {
        0 => 1.0,
        _ => from + (1.0 - from) * random.decades(-3.0, 0.0),
    };
    (frame, [from, to])
}

#[test]
fn nobody_advances_farther_or_faster_than_bounded() {
    let mut random = Random::seeded(3);
    let mut tight = 0;
    for case in 0..4_000 {
        let size = random.decades(-3.0, 3.0);
        let motion = random.motion(size);
        let (frame, [from, to]) = frame(&mut random, &motion);
        let direction = random.direction();
        let bound = frame.advance_along(&motion, direction, from, to);
        let speed = frame.speed_along(&motion, direction, from, to);
        let start = frame.position_at(&motion, from);
        let rounding = 8.0 * f64::EPSILON * start.abs().max_element();
        let mut most = 0.0_f64;
        for step in 0..=SAMPLES {
            let fraction = from + f64::from(step) / f64::from(SAMPLES) * (to - from);
            let way = (frame.position_at(&motion, fraction) - start).dot(direction);
            most = most.max(way);
            assert!(
                way <= bound + rounding,
                "case {case}: {way:e} beyond {bound:e}, {motion:?}"
            );
            let time = (fraction - from) * frame.duration;
            assert!(
                way <= speed * time + rounding + 1e-13 * (way.abs() + size),
                "case {case}: {way:e} in {time:e} s at {speed:e}"
            );
        }
        tight += u32::from(most >= 0.5 * bound);
    }
    assert!(
        tight > 2_000,
        "bounds are loose: {tight} of 4000 within half"
    );
}

#[test]
fn nobody_turns_farther_than_bounded() {
    let mut random = Random::seeded(4);
    let (mut finite, mut tight) = (0, 0);
    for case in 0..4_000 {
        let size = random.decades(-3.0, 3.0);
        let motion = random.motion(size);
        let orientation = random.turn();
        let (frame, [from, to]) = frame(&mut random, &motion);
        let bound = frame.angle_between(&motion, from, to);
        let pose = |fraction| frame.pose_at(&motion, orientation, fraction).orientation;
        // The length of the way the orientation takes, not the angle between its ends.
        let (mut last, mut turned) = (pose(from), 0.0);
        for step in 1..=SAMPLES {
            let fraction = from + f64::from(step) / f64::from(SAMPLES) * (to - from);
            let next = pose(fraction);
            let chord = (next - last).length().min((next + last).length());
            turned += 4.0 * (0.5 * chord).min(1.0).asin();
            last = next;
        }
        assert!(
            turned <= bound * (1.0 + 1e-9) + 1e-9,
            "case {case}: {turned:e} beyond {bound:e}, {motion:?}"
        );
        if motion.turns() && bound.is_finite() {
            finite += 1;
            tight += u32::from(turned >= 0.3 * bound && bound < 3.0);
        }
    }
    assert!(finite > 1_000, "only {finite} of 4000 are bounded");
    assert!(tight > 500, "bounds are loose: {tight} of {finite}");
}

#[test]
fn envelopes_hold_the_carried_point() {
    let mut random = Random::seeded(5);
    for case in 0..2_000 {
        let size = random.decades(-3.0, 3.0);
        let motion = random.motion(size);
        let (frame, _) = frame(&mut random, &motion);
        let rounding = 16.0 * f64::EPSILON * (frame.start.length() + size);
        for step in 0..=SAMPLES {
            let fraction = f64::from(step) / f64::from(SAMPLES);
            let even = frame.start + fraction * frame.displacement;
            let off = frame.position_at(&motion, fraction).distance(even);
            assert!(
                off <= frame.deviation + rounding,
                "case {case}, {fraction}: {off:e} beyond {:e}, {motion:?}",
                frame.deviation
            );
        }
    }
}

/// The eight metre curve: its bound on speed is that of its tangents.
#[test]
fn a_bend_is_bounded_by_its_control_points() {
    let path = crate::motion::Path::bezier([
        [-2.0, 2.0, 0.0],
        [-2.0, -2.0, 0.0],
        [2.0, -2.0, 0.0],
        [2.0, 2.0, 0.0],
    ])
    .unwrap();
    let motion = Motion::along(path, 8.0).unwrap();
    let frame = FrameMotion::new(&motion, 0.0, 1.0);
    let down = frame.advance_along(&motion, DVec3::NEG_Y, 0.0, 1.0);
    assert!((down - 4.0).abs() < 1e-12, "{down}");
    // In the last quarter it only climbs.
    assert!(frame.speed_along(&motion, DVec3::NEG_Y, 0.75, 1.0) < -4.0);
    assert!(frame.advance_along(&motion, DVec3::NEG_Y, 0.75, 1.0) < 1e-12);
}
