//! Whatever comes through a door: an error that says what is wrong, and a world as it was.

use crate::support::{ball, cuboid, flying, free};
use feeler::{
    Body, BodyError, BodyId, BroadPhase, Chords, CollisionWorld, ConfigError, Contact,
    FirstContactError, Method, Motion, MotionError, ObbTest, Path, PathError, Pose, RayConfig,
    StepError, ValueError, WorldConfig, first_contact,
};
use glam::{DQuat, DVec3};

const BAD: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

/// All that can be seen of a world.
type Sight = (f64, Vec<(BodyId, Pose, DVec3)>, Vec<Contact>);

fn sight(world: &CollisionWorld) -> Sight {
    let bodies = world
        .bodies()
        .map(|id| (id, world.pose(id).unwrap(), world.velocity(id).unwrap()))
        .collect();
    (world.time(), bodies, world.contacts().to_vec())
}

fn scene() -> (CollisionWorld, Vec<BodyId>) {
    let mut world = CollisionWorld::default();
    let path = Path::spline(
        [[-3.0, 0.0, 0.5], [0.0, 0.2, 0.0], [3.0, 0.0, 0.0]],
        [1.0; 3],
        [1.0, 0.0, 0.0],
    )
    .unwrap();
    let bodies = [
        flying(&ball(0.5), [2.0, 0.0, 0.0], [-1.0, 0.1, 0.0]),
        Body::fixed(cuboid(0.5, 0.5, 0.5), [0.0, 0.0, 0.0]),
        Body::moving(cuboid(0.2, 0.3, 0.4), Motion::along(path, 1.0).unwrap()),
        flying(&ball(0.3), [0.2, 0.0, 0.0], [0.0, 0.1, 0.0]),
    ];
    let ids = bodies.map(|body| world.insert(body).unwrap()).to_vec();
    world.step(0.25).unwrap();
    (world, ids)
}

/// Does something that must fail to one of two equal worlds, and compares them
/// then and through the frames that follow.
fn leaves_as_it_was(what: &str, call: impl FnOnce(&mut CollisionWorld, &[BodyId])) {
    let ((mut world, ids), (mut twin, _)) = (scene(), scene());
    let stats = *world.stats();
    call(&mut world, &ids);
    assert_eq!(*world.stats(), stats, "{what}");
    for _ in 0..8 {
        assert_eq!(sight(&world), sight(&twin), "{what}");
        world.step(0.25).unwrap();
        twin.step(0.25).unwrap();
    }
}

/// That `error` names a field, the value and, unless it is not finite, the limit.
fn names(error: ValueError, wanted: &str, given: f64) {
    let (field, value, finite) = match error {
        ValueError::NotFinite { field, value } => (field, value, false),
        ValueError::TooSmall { field, value, min } => {
            assert!(value < min, "{error}");
            (field, value, true)
        }
        ValueError::TooLarge { field, value, max } => {
            assert!(value.abs() > max, "{error}");
            (field, value, true)
        }
        _ => panic!("{error}"),
    };
    assert_eq!(field, wanted);
    assert_eq!(value.to_bits(), given.to_bits(), "{error}");
    assert_eq!(finite, given.is_finite(), "{error}");
}

#[test]
fn a_bad_time_step_changes_nothing() {
    let steps = [0.0, -0.0, -1.0, 1e-13, 1e-30, 1.1e9, 1e30, f64::MAX];
    for dt in steps.into_iter().chain(BAD) {
        leaves_as_it_was("step", |world, _| match world.step(dt) {
            Err(StepError::Value(error)) => names(error, "dt", dt),
            other => panic!("{dt}: {other:?}"),
        });
        leaves_as_it_was("step_to_contact", |world, _| {
            match world.step_to_contact(dt) {
                Err(StepError::Value(error)) => names(error, "dt", dt),
                other => panic!("{dt}: {other:?}"),
            }
        });
        let body = Body::fixed(ball(1.0), [0.0; 3]);
        match first_contact(&body, &body, dt, &Method::default()) {
            Err(FirstContactError::Step(StepError::Value(error))) => names(error, "horizon", dt),
            other => panic!("{dt}: {other:?}"),
        }
    }
}

#[test]
fn a_bad_position_or_velocity_changes_nothing() {
    for bad in BAD.into_iter().chain([1.1e12, -1e30]) {
        for axis in 0..3 {
            let mut vector = DVec3::ONE;
            vector[axis] = bad;
            leaves_as_it_was("insert", |world, _| {
                match world.insert(Body::fixed(ball(1.0), vector)) {
                    Err(BodyError::Motion(MotionError::Value(error))) => {
                        names(error, "position", bad);
                    }
                    other => panic!("{other:?}"),
                }
            });
            leaves_as_it_was("set_velocity", |world, ids| {
                match world.set_velocity(ids[0], vector) {
                    Err(BodyError::Motion(MotionError::Value(error))) => {
                        names(error, "velocity", bad);
                    }
                    other => panic!("{other:?}"),
                }
            });
            leaves_as_it_was("set_motion", |world, ids| {
                let motion = Body::fixed(ball(1.0), vector).motion().clone();
                assert!(world.set_motion(ids[0], motion).is_err());
            });
            assert!(Motion::fixed(vector).is_err());
            assert!(Motion::free(vector, DVec3::ZERO).is_err());
            assert!(Path::line(vector, DVec3::ZERO).is_err());
        }
    }
}

#[test]
fn a_bad_speed_or_path_is_refused() {
    let path = Path::line([0.0; 3], [1.0, 0.0, 0.0]).unwrap();
    for speed in [0.0, -1.0, 1e-30, 1e30].into_iter().chain(BAD) {
        match Motion::along(path.clone(), speed) {
            Err(MotionError::Value(error)) => names(error, "speed", speed),
            other => panic!("{speed}: {other:?}"),
        }
    }
    let none: [[f64; 3]; 0] = [];
    let error = Path::spline(none, [1.0; 3], [1.0; 3]).unwrap_err();
    assert!(matches!(error, PathError::TooFewPoints { count: 0, .. }));
    let twice = Path::spline([[1.0; 3], [1.0; 3]], [0.0; 3], [0.0; 3]).unwrap_err();
    assert!(matches!(twice, PathError::PieceTooShort { piece: 0, .. }));
}

#[test]
fn a_bad_orientation_changes_nothing() {
    let turns = [
        DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0),
        DQuat::from_xyzw(0.0, 0.0, 0.0, 0.9),
        DQuat::from_xyzw(1.0, 1.0, 0.0, 0.0),
        DQuat::from_xyzw(f64::NAN, 0.0, 0.0, 1.0),
        DQuat::from_xyzw(f64::INFINITY, 0.0, 0.0, 1.0),
        DQuat::from_xyzw(1e300, 0.0, 0.0, 1.0),
        DQuat::from_xyzw(1e-30, 0.0, 0.0, 0.0),
    ];
    for turn in turns {
        let body = Body::fixed(cuboid(1.0, 1.0, 1.0), [0.0; 3]).oriented(turn);
        leaves_as_it_was("insert", |world, _| match world.insert(body.clone()) {
            Err(BodyError::Value(error)) => names(error, "orientation.length", turn.length()),
            other => panic!("{other:?}"),
        });
        let other = Body::fixed(ball(1.0), [0.0; 3]);
        assert!(matches!(
            first_contact(&other, &body, 1.0, &Method::default()),
            Err(FirstContactError::Body(BodyError::Value(_)))
        ));
    }
}

#[test]
fn a_stale_id_is_known_even_when_its_place_is_taken() {
    leaves_as_it_was("every call with a stale id", |world, _| {
        let stale = world
            .insert(Body::fixed(ball(1.0), [1e3, 0.0, 0.0]))
            .unwrap();
        assert!(world.remove(stale).is_ok());
        for reused in [false, true] {
            let tenant = reused.then(|| world.insert(Body::fixed(ball(1.0), [1e3; 3])).unwrap());
            let unknown = BodyError::UnknownBody { id: stale };
            assert!(!world.contains(stale));
            assert_eq!(world.pose(stale), Err(unknown));
            assert_eq!(world.velocity(stale), Err(unknown));
            assert_eq!(world.shape(stale), Err(unknown));
            assert_eq!(world.remove(stale).map(|_| ()), Err(unknown));
            assert_eq!(world.set_velocity(stale, [0.0; 3]), Err(unknown));
            assert_eq!(
                world.set_motion(stale, free([0.0; 3], [0.0; 3])),
                Err(unknown)
            );
            assert_eq!(world.contacts_of(stale).count(), 0);
            if let Some(tenant) = tenant {
                assert_ne!(tenant, stale);
                world.remove(tenant).unwrap();
            }
        }
    });
    let (other, ids) = scene();
    let empty = CollisionWorld::default();
    assert!(other.contains(ids[3]) && !empty.contains(ids[3]));
}

#[test]
fn who_flies_out_of_the_world_stops_it_before_anything_moves() {
    leaves_as_it_was("step", |world, ids| {
        let far = [9e11, 0.0, 0.0];
        let id = world
            .insert(flying(&ball(1.0), far, [1e12, 0.0, 0.0]))
            .unwrap();
        match world.step(0.5) {
            Err(StepError::LeftWorld { id: gone, source }) => {
                assert_eq!(gone, id);
                names(source, "position", 9e11 + 0.5e12);
            }
            other => panic!("{other:?}"),
        }
        assert!(matches!(
            world.step_to_contact(1.0),
            Err(StepError::LeftWorld { .. })
        ));
        assert!(world.remove(id).is_ok());
        assert!(world.contains(ids[0]));
    });
}

#[test]
fn settings_are_checked() {
    let good = RayConfig::default();
    let configs = [
        ("rays", RayConfig { rays: 0, ..good }),
        (
            "rays",
            RayConfig {
                rays: 1_000_001,
                ..good
            },
        ),
        (
            "curve_angle",
            RayConfig {
                curve_angle: f64::NAN,
                ..good
            },
        ),
        (
            "curve_angle",
            RayConfig {
                curve_angle: 0.0,
                ..good
            },
        ),
        (
            "curve_angle",
            RayConfig {
                curve_angle: -1.0,
                ..good
            },
        ),
        (
            "curve_angle",
            RayConfig {
                curve_angle: 3.2,
                ..good
            },
        ),
        (
            "curve_points",
            RayConfig {
                curve_points: 0,
                ..good
            },
        ),
        (
            "curve_points",
            RayConfig {
                curve_points: 1001,
                ..good
            },
        ),
        (
            "chords",
            RayConfig {
                chords: Chords::Within(0.0),
                ..good
            },
        ),
        (
            "chords",
            RayConfig {
                chords: Chords::Within(f64::NAN),
                ..good
            },
        ),
        (
            "chords",
            RayConfig {
                chords: Chords::Within(1.1),
                ..good
            },
        ),
    ];
    for (wanted, rays) in configs {
        let method = Method::Rays(rays);
        let config = WorldConfig {
            method,
            ..WorldConfig::default()
        };
        let field = |error: ConfigError| match error {
            ConfigError::Value(
                ValueError::NotFinite { field, .. }
                | ValueError::TooSmall { field, .. }
                | ValueError::TooLarge { field, .. },
            ) => field,
            _ => panic!("{error}"),
        };
        let error = CollisionWorld::new(config).err().unwrap();
        assert_eq!(field(error), wanted);
        let body = Body::fixed(ball(1.0), [0.0; 3]);
        match first_contact(&body, &body, 1.0, &method) {
            Err(FirstContactError::Config(error)) => assert_eq!(field(error), wanted),
            other => panic!("{other:?}"),
        }
    }
    for rays in [0, 1_000_001] {
        let broad_phase = BroadPhase::SweptObb(ObbTest::Rays { rays, seed: 1 });
        let config = WorldConfig {
            broad_phase,
            ..WorldConfig::default()
        };
        assert!(CollisionWorld::new(config).is_err());
    }
}
