//! Bad input: an error that says what is wrong.

use feeler::{AtEnd, Facing, Motion, MotionError, Path, ValueError};
use glam::DVec3;

fn flight() -> Motion {
    Motion::along(Path::line([0.0; 3], [1.0, 0.0, 0.0]).unwrap(), 1.0).unwrap()
}

#[track_caller]
fn names(result: Result<Motion, MotionError>, wanted: &str) {
    match result {
        Err(MotionError::Value(
            ValueError::NotFinite { field, .. }
            | ValueError::TooSmall { field, .. }
            | ValueError::TooLarge { field, .. },
        )) => assert_eq!(field, wanted),
        other => panic!("{other:?}"),
    }
}

#[test]
fn spins_are_checked() {
    let fixed = || Motion::fixed([0.0; 3]).unwrap();
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e30] {
        names(fixed().spin([0.0, bad, 1.0], 1.0), "spin.axis");
        names(fixed().spin([0.0, 0.0, 1.0], bad), "spin.rate");
        names(fixed().spin([0.0, 0.0, 1.0], -bad), "spin.rate");
        names(
            fixed().spin_about([bad, 0.0, 0.0], [0.0, 0.0, 1.0], 1.0),
            "spin.point",
        );
    }
    for short in [0.0, -0.0, 1e-10, 1e-300] {
        names(fixed().spin([short; 3], 1.0), "spin.axis");
    }
    for motion in [fixed(), flight(), Motion::free([0.0; 3], [1.0; 3]).unwrap()] {
        for rate in [0.0, -1e6, 1e6, 1e-300] {
            assert!(motion.clone().spin([0.0, 0.0, 1e-9], rate).is_ok());
        }
    }
    assert!(fixed().is_fixed());
    assert!(fixed().spin([1.0; 3], 0.0).unwrap().is_fixed());
    assert!(!fixed().spin([1.0; 3], 1e-9).unwrap().is_fixed());
}

#[test]
fn journeys_are_checked() {
    for bad in [f64::NAN, f64::INFINITY, -1.0, -1e-300, 1e300] {
        names(flight().starting_at(bad), "start_distance");
        names(flight().starting_after(bad), "start_time");
    }
    for motion in [Motion::fixed([0.0; 3]), Motion::free([0.0; 3], [1.0; 3])] {
        let motion = motion.unwrap();
        for result in [
            motion.clone().starting_at(0.0),
            motion.clone().starting_after(0.0),
            motion.clone().at_end(AtEnd::Rest),
            motion.clone().looping(),
            motion.clone().back_and_forth(),
            motion.clone().facing(Facing {
                forward: DVec3::X,
                up: DVec3::Z,
                world_up: DVec3::Z,
            }),
        ] {
            assert!(
                matches!(result, Err(MotionError::NoPath { .. })),
                "{result:?}"
            );
        }
    }
    assert_eq!(flight().looping(), Err(MotionError::OpenLoop { gap: 1.0 }));
    // A gap of one part in 1e14 is one; the sine of a whole turn is none.
    let almost = |gap: f64| {
        Path::spline(
            [[5.0, 0.0, 0.0], [0.0, 5.0, 0.0], [5.0, gap, 0.0]],
            [0.0, 5.0, 0.0],
            [0.0, 5.0, 0.0],
        )
        .unwrap()
    };
    let open = Motion::along(almost(5e-14), 1.0).and_then(Motion::looping);
    assert_eq!(open, Err(MotionError::OpenLoop { gap: 5e-14 }));
    assert!(
        Motion::along(almost(1e-15), 1.0)
            .and_then(Motion::looping)
            .is_ok()
    );
}

#[test]
fn facings_are_checked() {
    let good = Facing {
        forward: DVec3::X,
        up: DVec3::Z,
        world_up: DVec3::Z,
    };
    for bad in [
        DVec3::ZERO,
        DVec3::NAN,
        DVec3::INFINITY,
        DVec3::splat(1e-10),
    ] {
        names(
            flight().facing(Facing {
                forward: bad,
                ..good
            }),
            "facing.forward",
        );
        names(flight().facing(Facing { up: bad, ..good }), "facing.up");
        names(
            flight().facing(Facing {
                world_up: bad,
                ..good
            }),
            "facing.world_up",
        );
    }
    for up in [DVec3::X, -3.0 * DVec3::X, DVec3::new(1.0, 1e-7, 0.0)] {
        let error = flight().facing(Facing { up, ..good });
        assert!(
            matches!(error, Err(MotionError::Parallel { .. })),
            "{error:?}"
        );
    }
}
