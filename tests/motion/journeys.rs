//! Loops, ways back, late starts and head starts, against laps counted by hand.

use crate::{ring, within};
use feeler::{AtEnd, Motion, Path};
use glam::DVec3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// Where a body is that has flown so far, lap by lap.
fn walked(path: &Path, at_end: AtEnd, mut flown: f64) -> DVec3 {
    let length = path.length();
    let mut back = false;
    while flown > length {
        match at_end {
            AtEnd::Rest => return path.end(),
            AtEnd::Loop => {}
            AtEnd::Return => back = !back,
        }
        flown -= length;
    }
    path.position_at(if back { length - flown } else { flown })
}

#[test]
fn journeys_are_walked_lap_by_lap() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for _ in 0..200 {
        let path = ring(&mut rng);
        let speed = within(&mut rng, 0.1, 20.0);
        let wait = within(&mut rng, 0.0, 2.0);
        let ahead = within(&mut rng, 0.0, 1.0) * path.length();
        for at_end in [AtEnd::Rest, AtEnd::Loop, AtEnd::Return] {
            let motion = Motion::along(path.clone(), speed)
                .and_then(|motion| motion.at_end(at_end))
                .and_then(|motion| motion.starting_at(ahead))
                .and_then(|motion| motion.starting_after(wait))
                .unwrap();
            for step in 0..50 {
                let elapsed = 0.1 * f64::from(step);
                let flown = ahead + speed * (elapsed - wait).max(0.0);
                let want = walked(&path, at_end, flown);
                let got = motion.position_after(elapsed);
                assert!(
                    got.distance(want) < 1e-12 * (1.0 + flown),
                    "{at_end:?} {elapsed}"
                );
            }
            assert_eq!(motion.position_after(0.0), path.position_at(ahead));
            assert_eq!(motion.velocity_after(0.5 * wait), DVec3::ZERO);
            let after = motion.velocity_after(wait + 1e-6);
            assert!((after.length() - speed).abs() < 1e-12 * speed);
        }
    }
}

#[test]
fn velocity_is_what_position_does() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let step = 1e-6;
    for _ in 0..300 {
        let path = ring(&mut rng);
        let motion = Motion::along(path, 2.0).unwrap();
        for motion in [motion.clone().looping(), motion.back_and_forth()] {
            let motion = motion.unwrap();
            let elapsed = within(&mut rng, 0.0, 40.0);
            let (before, after) = (
                motion.position_after(elapsed),
                motion.position_after(elapsed + step),
            );
            let off = (after - before) / step - motion.velocity_after(elapsed);
            // A millionth of a second sees a turn of some 1e-5, or a turning point.
            assert!(off.length() < 1e-2 || off.length() > 1.0, "{off}");
        }
    }
}

#[test]
fn hours_of_laps_cost_no_digits() {
    // A hundred million laps of 8 m; where a lap ends is exact in f64.
    let shuttle = Path::line([0.0; 3], [8.0, 0.0, 0.0]).unwrap();
    let shuttle = Motion::along(shuttle, 1024.0)
        .and_then(Motion::back_and_forth)
        .unwrap();
    for lap in [1_u32, 7, 1_000_001, 100_000_000] {
        let elapsed = 16.0 / 1024.0 * f64::from(lap);
        assert_eq!(shuttle.position_after(elapsed), DVec3::ZERO);
        let further = shuttle.position_after(elapsed + 0.25 / 1024.0);
        assert_eq!(further, DVec3::new(0.25, 0.0, 0.0));
    }
}

#[test]
fn a_loop_goes_on_where_it_began() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    for _ in 0..200 {
        let path = ring(&mut rng);
        let motion = Motion::along(path.clone(), 1.0)
            .and_then(Motion::looping)
            .unwrap();
        for lap in 1..4 {
            let end = f64::from(lap) * path.length();
            let around = [end.next_down(), end, end.next_up()].map(|t| motion.position_after(t));
            for point in around {
                assert!(point.distance(path.start()) < 1e-13);
            }
        }
    }
}
