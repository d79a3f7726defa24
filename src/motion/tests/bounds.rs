//! Bounds, one-sidedly: dense samples never exceed them.

use super::Random;
use crate::motion::{FrameMotion, Motion, TurningRate};
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

/// By differences of orientations, which share nothing with the formulas.
#[test]
fn angular_velocities_change_no_more_than_bounded() {
    let mut random = Random::seeded(7);
    let (mut swaying, mut tight) = (0, 0);
    for case in 0..4_000 {
        let size = random.decades(-1.0, 1.0);
        let motion = random.motion(size);
        let orientation = random.turn();
        let (frame, [from, to]) = frame(&mut random, &motion);
        let stretch = frame.stretch_at(&motion, from);
        let to = to.min(stretch.to);
        let step = 1e-4 * (to - from);
        let rate = frame.turning_rate(&motion, &stretch, from, to);
        let TurningRate::About { spin, sway } = rate else {
            continue;
        };
        let pose = |fraction| frame.pose_at(&motion, orientation, fraction).orientation;
        let direction = DVec3::new(random.unit(), random.unit(), random.unit());
        for share in 0..20 {
            let gone = f64::from(share) / 20.0 * (to - from);
            let (now, next) = (pose(from + gone), pose(from + gone + step));
            let turn = next * now.conjugate();
            let turn = if turn.w < 0.0 { -turn } else { turn };
            let velocity = 2.0 / step * turn.xyz();
            // It is that of half a step later, and rounded.
            let time = gone + step;
            let speed = spin.length() + time * sway.most();
            let rounding = 1e-11 / step + 1e-6 * speed + (speed * step).powi(2) * speed;
            let change = velocity - spin;
            assert!(
                change.length() <= time * sway.most() + rounding,
                "case {case}: {change} beyond {} of {spin}, {motion:?}",
                time * sway.most()
            );
            assert!(
                direction.cross(change).length()
                    <= time * sway.across(direction) + rounding * direction.length(),
                "case {case}: {change} across {direction}, {motion:?}"
            );
            if sway.most() > 0.0 && share == 19 {
                swaying += 1;
                tight += u32::from(change.length() > 0.1 * time * sway.most());
            }
        }
    }
    assert!(swaying > 200, "only {swaying} change");
    assert!(tight > 20, "bounds are loose: {tight} of {swaying}");
}
