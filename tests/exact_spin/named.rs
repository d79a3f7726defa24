//! Cases with answers in closed form.

use feeler::{Body, CollisionWorld, Cuboid, Feature, Method, Motion, Sphere, first_contact};
use glam::{DQuat, DVec3};
use std::f64::consts::{FRAC_PI_4, PI};

fn bar(rate: f64) -> Body {
    let motion = Motion::fixed([0.0; 3]).and_then(|motion| motion.spin([0.0, 0.0, 1.0], rate));
    Body::moving(Cuboid::new([2.0, 0.05, 0.05]).unwrap(), motion.unwrap())
}

fn ball() -> Body {
    let place = 1.5 * DVec3::new(FRAC_PI_4.cos(), FRAC_PI_4.sin(), 0.0);
    Body::fixed(Sphere::new(0.1).unwrap(), place)
}

const RATES: [f64; 7] = [3.0, PI, 6.0, 2.0 * PI, 12.0, 31.4, 1000.0];

/// Where parry's cast lets the bar through.
#[test]
fn a_spinning_bar_hits_a_ball() {
    for rate in RATES {
        let found = first_contact(&bar(rate), &ball(), 1.0, &Method::Exact).unwrap();
        let found = found.unwrap_or_else(|| panic!("{rate}: missed"));
        let want = (FRAC_PI_4 - 0.1_f64.asin()) / rate;
        assert!(
            (found.fraction - want).abs() < 1e-11 / rate,
            "{rate}: {} {want}",
            found.fraction
        );
        // The bar's upper side by then.
        let normal = DQuat::from_rotation_z(rate * want) * DVec3::NEG_Y;
        assert!(found.normal.distance(normal) < 1e-9, "{rate}: {found:?}");
        let foot = ball().pose_after(0.0).position + 0.1 * normal;
        assert!(found.point.distance(foot) < 1e-9);
        assert_eq!(found.features, [Feature::Face(3), Feature::Surface]);
        // From the other body's side.
        let mirrored = first_contact(&ball(), &bar(rate), 1.0, &Method::Exact).unwrap();
        let mirrored = mirrored.unwrap();
        assert!((mirrored.fraction - want).abs() < 1e-11 / rate);
        assert!(mirrored.normal.distance(-normal) < 1e-9);
    }
}

#[test]
fn a_spinning_bar_hits_a_ball_at_any_frame_rate() {
    for rate in RATES {
        let want = (FRAC_PI_4 - 0.1_f64.asin()) / rate;
        for frames in [1.0, 24.0, 1000.0] {
            let mut world = CollisionWorld::default();
            world.insert(bar(rate)).unwrap();
            world.insert(ball()).unwrap();
            let mut seen = None;
            while world.time() < 1.0 && seen.is_none() {
                seen = world.step(1.0 / frames).unwrap().first().copied();
                assert_eq!(world.stats().undecided, 0);
            }
            let seen = seen.unwrap_or_else(|| panic!("{rate} at {frames} Hz: missed"));
            assert!(seen.is_touch());
            assert!((seen.time - want).abs() < 1e-9, "{rate}: {}", seen.time);
        }
    }
}

/// A ball that the bar's end passes by, and one it grazes.
#[test]
fn a_spinning_bar_misses_what_is_out_of_reach() {
    // The farthest corner comes round at this distance.
    let reach = 2.0_f64.hypot(0.05);
    for rate in RATES {
        for (beyond, want) in [(1e-6, false), (1e-9, false), (-1e-9, true), (-1e-6, true)] {
            let place = [0.0, reach + 0.1 + beyond, 0.0];
            let ball = Body::fixed(Sphere::new(0.1).unwrap(), place);
            let found = first_contact(&bar(rate), &ball, 10.0 / rate, &Method::Exact);
            assert_eq!(
                found.map(|found| found.is_some()),
                Ok(want),
                "{rate} {beyond}"
            );
        }
    }
}
