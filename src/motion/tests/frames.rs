//! A frame is a part of a motion, and its stretches make it up.

use super::Random;
use crate::motion::stretch::Course;
use crate::motion::{FrameMotion, Path};

#[test]
fn a_frame_is_where_its_motion_is() {
    let mut random = Random::seeded(1);
    for case in 0..2_000 {
        let size = random.decades(-3.0, 3.0);
        let motion = random.motion(size);
        let orientation = random.turn();
        let elapsed = random.within(0.0, 3.0);
        let duration = random.decades(-3.0, 0.5);
        let frame = FrameMotion::new(&motion, elapsed, duration);
        let place = motion.position_after(elapsed).length();
        let path = motion.path().map_or(size, Path::length);
        for step in 0..=20 {
            let fraction = f64::from(step) / 20.0;
            let got = frame.pose_at(&motion, orientation, fraction);
            let want = motion.pose_after(elapsed + fraction * duration, orientation);
            let off = got.position.distance(want.position);
            assert!(
                off <= 1e-12 * (place + 40.0 * path + 40.0 * size),
                "case {case}, {fraction}: {off:e} of {size:e}, {motion:?}"
            );
            if motion.spinning().is_some() {
                let turn = got.orientation.dot(want.orientation).abs();
                assert!(turn > 1.0 - 1e-15, "case {case}, {fraction}: {turn}");
            }
            assert!(got.orientation.is_normalized());
        }
    }
}

/// Tracks are stretches of which less is looked up.
#[test]
fn tracks_lie_where_stretches_do_and_tell_where_the_body_is() {
    let mut random = Random::seeded(3);
    let (mut curves, mut bent) = (0, 0);
    for case in 0..1_000 {
        let size = random.decades(-2.0, 2.0);
        let motion = random.motion(size);
        let elapsed = random.within(0.0, 3.0);
        let frame = FrameMotion::new(&motion, elapsed, random.decades(-2.0, 0.5));
        let place = motion.position_after(elapsed).length();
        let path = motion.path().map_or(size, Path::length);
        let allowed = 1e-12 * (place + 40.0 * path + 40.0 * size);
        let speed = frame.highest_speed(&motion);
        let (mut from, mut count) = (0.0, 0);
        while from < 1.0 && count < 200 {
            let stretch = frame.stretch_at(&motion, from);
            let (track, mut near) = frame.track_at(&motion, from);
            assert!(
                track.to.to_bits() == stretch.to.to_bits() && track.from <= from,
                "case {case}: {track:?} {stretch:?}"
            );
            let width = track.to - from;
            for share in [0.3, 0.9, 1.0, 0.0, 0.5] {
                let fraction = from + share * width;
                let there = track.at(fraction, &near);
                near = there.milestone;
                let want = frame.position_at(&motion, fraction);
                let off = there.position.distance(want);
                assert!(
                    off <= allowed,
                    "case {case}, {fraction} of {track:?}: {off:e}"
                );
                let step = 1e-4 * width;
                if matches!(stretch.course, Course::Curve(_)) && share > 0.4 && share < 0.6 {
                    curves += 1;
                    let later = track.at(fraction + step, &near);
                    let way = (later.position - there.position) / step;
                    let mean = 0.5 * (later.velocity + there.velocity);
                    let rounding = 8.0 * allowed / step;
                    let acceleration = track.acceleration(&near);
                    // Beside a cusp a step is too long.
                    if acceleration.length() * step < 1e-3 * speed {
                        bent += 1;
                        let off = (way - mean).length();
                        assert!(off < 1e-3 * speed + rounding, "case {case}: {way} {mean}");
                        let change = (later.velocity - there.velocity) / step;
                        let off = (change - acceleration).length();
                        let most = 0.1 * acceleration.length() + 1e-2 * speed / width;
                        assert!(off < most + rounding / step, "case {case}: {off} {change}");
                    }
                }
            }
            from = track.to;
            count += 1;
        }
    }
    assert!(
        curves > 500 && bent > 400,
        "only {curves} on curves, {bent} followed"
    );
}

#[test]
fn stretches_follow_one_another_and_tell_where_the_body_is() {
    let mut random = Random::seeded(2);
    let mut curves = 0;
    for case in 0..1_000 {
        let size = random.decades(-2.0, 2.0);
        let motion = random.motion(size);
        let elapsed = random.within(0.0, 3.0);
        let frame = FrameMotion::new(&motion, elapsed, random.decades(-2.0, 0.5));
        let place = motion.position_after(elapsed).length();
        let path = motion.path().map_or(size, Path::length);
        let allowed = 1e-12 * (place + 40.0 * path + 40.0 * size);
        let (mut from, mut count) = (0.0, 0);
        while from < 1.0 {
            let stretch = frame.stretch_at(&motion, from);
            assert!(
                stretch.from <= from && stretch.to > from && stretch.to <= 1.0,
                "case {case}: {stretch:?}"
            );
            let start = frame.position_at(&motion, stretch.from);
            for share in [0.0, 0.3, 0.9, 1.0] {
                let fraction = from + share * (stretch.to - from);
                let want = frame.position_at(&motion, fraction);
                let got = match stretch.course {
                    Course::Rest => start,
                    Course::Straight(velocity) => {
                        start + (fraction - from) * frame.duration * velocity
                    }
                    Course::Curve(curve) => {
                        curves += 1;
                        let u = curve.u_at(share);
                        curve.piece.point(u)
                    }
                };
                assert!(
                    got.distance(want) <= allowed,
                    "case {case}, {fraction} of {stretch:?}: {:e} of {size:e}",
                    got.distance(want)
                );
            }
            from = stretch.to;
            count += 1;
            assert!(count < 2_000, "case {case}: {motion:?}");
        }
    }
    assert!(curves > 2_000, "only {curves} on curves");
}
