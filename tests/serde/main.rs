//! What is written can be read again, the very same; what is read is checked.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod groups;
mod random;

use feeler::{
    Body, CollisionWorld, Cuboid, Method, Motion, NamedBody, Path, Polytope, RayConfig, Scene,
    SceneError, Shape, Sphere, Spline, Triangle, WorldConfig,
};
use glam::DQuat;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use random::{body, config, hull, unit};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt::Debug;

/// TOML wants a table outside.
#[derive(serde::Serialize, serde::Deserialize)]
struct In<T> {
    value: T,
}

fn to_toml<T: Serialize>(value: T) -> String {
    toml::to_string(&In { value }).expect("TOML can hold it")
}

fn from_toml<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    match toml::from_str::<In<T>>(text) {
        Ok(In { value }) => Ok(value),
        Err(error) => Err(error.message().to_owned()),
    }
}

fn assert_round_trips<T>(value: &T)
where
    T: Clone + PartialEq + Debug + Serialize + DeserializeOwned,
{
    let toml = to_toml(value.clone());
    assert_eq!(from_toml::<T>(&toml).as_ref(), Ok(value), "{toml}");
    let pretty = toml::to_string_pretty(&In { value }).expect("TOML can hold it");
    assert_eq!(from_toml::<T>(&pretty).as_ref(), Ok(value), "{pretty}");
    let json = serde_json::to_string(value).expect("JSON can hold it");
    let read: T = serde_json::from_str(&json).expect("what was written can be read");
    assert_eq!(&read, value, "{json}");
}

#[track_caller]
fn assert_refused<T: DeserializeOwned + Debug>(written: &str, message: &str) {
    let read = from_toml::<T>(&format!("value = {written}"));
    let error = read.expect_err("it is refused");
    assert!(error.contains(message), "got: {error}");
}

#[track_caller]
fn assert_reads<T: DeserializeOwned + Debug + PartialEq>(written: &str, value: &T) {
    let read = from_toml::<T>(&format!("value = {written}"));
    assert_eq!(read.as_ref(), Ok(value));
}

#[test]
fn random_bodies_round_trip() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for _ in 0..100 {
        assert_round_trips(&body(&mut rng));
    }
}

#[test]
fn random_scenes_round_trip() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    for number in 0..20 {
        let bodies = (0..rng.next_u64() % 6)
            .map(|index| NamedBody {
                name: format!("body {index}"),
                body: body(&mut rng),
            })
            .collect();
        let scene = Scene {
            name: format!("scene {number}"),
            about: "\"quoted\"\nand äöü".to_owned(),
            config: config(&mut rng),
            frame_rate: 1.0 + 100.0 * unit(&mut rng),
            duration: (number % 2 == 0).then_some(unit(&mut rng) + 0.1),
            bodies,
        };
        assert_round_trips(&scene);
        assert!(scene.world().is_ok());
    }
}

#[test]
fn shapes_paths_and_splines_round_trip_by_themselves() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    assert_round_trips(&Sphere::new(0.1).expect("a sphere"));
    assert_round_trips(&Cuboid::new([0.1, 0.2, 0.3]).expect("a box"));
    let triangle = Triangle::new([0.1, 0.0, 0.0], [0.0, 0.7, 0.0], [0.0, 0.0, 1.0 / 3.0]);
    assert_round_trips(&triangle.expect("a triangle"));
    assert_round_trips(&hull(&mut rng, 1.0));
    assert_round_trips(&Path::line([0.1; 3], [0.3; 3]).expect("a line"));
    let points = [[0.0; 3], [1.0, 1.0 / 3.0, 0.0], [2.0, 0.1, 0.7]];
    assert_round_trips(&Path::spline(points, [0.1; 3], [0.3; 3]).expect("a spline"));
    assert_round_trips(&Spline::with_tangents(points, points).expect("a spline"));
}

/// A polytope whose points tell everything is written by them, else with triangles.
#[test]
fn polytopes_are_written_as_short_as_possible() {
    let tetrahedron = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
    ];
    let hull = Polytope::from_points(tetrahedron).expect("a hull");
    assert!(
        to_toml(&hull).starts_with("[value.hull]\npoints = [["),
        "{}",
        to_toml(&hull)
    );
    let backwards = hull.triangles().iter().rev().copied();
    let mesh = Polytope::from_triangles(tetrahedron, backwards).expect("a mesh");
    assert!(
        to_toml(&mesh).starts_with("[value.mesh]\nvertices = [["),
        "{}",
        to_toml(&mesh)
    );
}

/// A spline is written with its end tangents if Catmull's are between.
#[test]
fn splines_are_written_as_short_as_possible() {
    let points = [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [2.0, 0.0, 0.0]];
    let catmull = Spline::through(points, [0.0, 2.0, 0.0], [0.0, -2.0, 0.0]).expect("a spline");
    assert!(
        to_toml(&catmull).contains("start_tangent"),
        "{}",
        to_toml(&catmull)
    );
    assert!(
        !to_toml(&catmull).contains("tangents"),
        "{}",
        to_toml(&catmull)
    );
    let other = Spline::with_tangents(points, [[0.0, 1.0, 0.0]; 3]).expect("a spline");
    assert!(to_toml(&other).contains("tangents"), "{}", to_toml(&other));
}

#[test]
fn integers_are_numbers() {
    assert_reads(
        "{ sphere = { radius = 2 } }",
        &Shape::from(Sphere::new(2.0).expect("a sphere")),
    );
    assert_reads(
        "{ cuboid = { half_extents = [1, 2, 3] } }",
        &Shape::from(Cuboid::new([1.0, 2.0, 3.0]).expect("a box")),
    );
    assert_reads(
        "{ fixed = [1, 0.5, -3] }",
        &Motion::fixed([1.0, 0.5, -3.0]).expect("a place"),
    );
    let path = Path::line([0.0; 3], [4.0, 0.0, 0.0]).expect("a line");
    assert_reads(
        "{ line = { from = [0, 0, 0], to = [4, 0, 0], speed = 2 } }",
        &Motion::along(path, 2.0).expect("a motion"),
    );
}

#[test]
fn orientations_are_quaternions_or_axis_and_angle() {
    let written = |orientation: &str| {
        format!(
            "{{ shape = {{ sphere = {{ radius = 1 }} }}, orientation = {orientation}, \
             motion = {{ fixed = [0, 0, 0] }} }}"
        )
    };
    let read = |orientation: &str| {
        from_toml::<Body>(&format!("value = {}", written(orientation)))
            .map(|body| body.orientation())
    };
    assert_eq!(
        read("[0, 0, 1, 0]"),
        Ok(DQuat::from_xyzw(0.0, 0.0, 1.0, 0.0))
    );
    let turned = read("{ axis = [0, 0, 7], degrees = 90 }").expect("an orientation");
    let expected = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2);
    assert!(turned.abs_diff_eq(expected, 1e-15), "{turned}");

    let refused = |orientation: &str, message: &str| {
        assert_refused::<Body>(&written(orientation), message);
    };
    refused("[0, 0, 1]", "3 numbers given, 4 are expected");
    refused("[0, 0, 1, 0, 0]", "5 numbers given, 4 are expected");
    refused(
        "[0, 0, 2, 0]",
        "orientation.length is 2e0, above the maximum of 1.001e0",
    );
    refused("[0, 0, nan, 0]", "orientation.length is not finite: NaN");
    refused(
        "{ axis = [0, 0, 0], degrees = 90 }",
        "orientation.axis.length is 0e0, below",
    );
    refused(
        "{ axis = [0, 0, 1], degrees = inf }",
        "orientation.degrees is not finite: inf",
    );
    refused(
        "{ axis = [0, 0, 1], radians = 1 }",
        "unknown field `radians`",
    );
    refused(
        "90",
        "expected a quaternion [x, y, z, w] or { axis = [x, y, z], degrees = angle }",
    );
}

#[test]
fn bad_shapes_are_refused_as_by_their_constructors() {
    let refused = assert_refused::<Shape>;
    refused(
        "{ sphere = { radius = 0 } }",
        "radius is 0e0, below the minimum of 1e-9",
    );
    refused("{ sphere = { radius = nan } }", "radius is not finite: NaN");
    refused(
        "{ sphere = { radius = 1e10 } }",
        "radius is 1e10, above the maximum of 1e9",
    );
    refused(
        "{ sphere = { radius = \"wide\" } }",
        "invalid type: string \"wide\"",
    );
    refused(
        "{ sphere = { radius = 1, colour = 2 } }",
        "unknown field `colour`",
    );
    refused("{ sphere = {} }", "missing field `radius`");
    refused("{ cone = { radius = 1 } }", "unknown variant `cone`");
    refused(
        "{ cuboid = { half_extents = [1, -2, 3] } }",
        "half_extents.y is -2e0, below",
    );
    refused(
        "{ cuboid = { half_extents = [1, 2] } }",
        "2 numbers given, 3 are expected",
    );
    refused(
        "{ cuboid = { half_extents = [1, 2, 3, 4] } }",
        "4 numbers given, 3 are expected",
    );
    let line = "{ triangle = { vertices = [[0, 0, 0], [1, 0, 0], [2, 0, 0]] } }";
    refused(line, "triangle 0 is degenerate");
    let flat = "{ hull = { points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]] } }";
    refused(flat, "the points span 2 dimensions");
    refused(
        "{ hull = { points = [[0, 0, 0]] } }",
        "1 points given, at least 4 are needed",
    );
    refused(
        "{ hull = { points = [], triangles = [] } }",
        "unknown field `triangles`",
    );
    let open = "{ mesh = { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], \
                triangles = [[0, 2, 1], [0, 1, 3], [0, 3, 2]] } }";
    refused(open, "the surface is not closed");
    assert_refused::<Polytope>(open, "the surface is not closed");
    assert_refused::<Sphere>("{ radius = -1 }", "radius is -1e0, below");
}

#[test]
fn bad_motions_are_refused_as_by_their_constructors() {
    let refused = assert_refused::<Motion>;
    refused("{ fixed = [inf, 0, 0] }", "position is not finite: inf");
    refused(
        "{ fixed = [1e13, 0, 0] }",
        "position is 1e13, above the maximum of 1e12",
    );
    refused("{ fixed = [0, 0] }", "2 numbers given, 3 are expected");
    let line = "{ line = { from = [0, 0, 0], to = [1, 0, 0], speed = 0 } }";
    refused(line, "speed is 0e0, below the minimum of 1e-12");
    let point = "{ line = { from = [1, 0, 0], to = [1, 0, 0], speed = 1 } }";
    refused(point, "piece 0 of the path is 0e0 m long");
    refused(
        "{ line = { from = [1, 0, 0], to = [2, 0, 0] } }",
        "missing field `speed`",
    );
    refused(
        "{ free = { position = [0, 0, 0], velocity = [0, nan, 0] } }",
        "velocity is not finite",
    );
    refused(
        "{ free = { position = [0, 0, 0], speed = 1 } }",
        "unknown field `speed`",
    );
    let spline = |rest: &str| {
        format!("{{ spline = {{ points = [[0, 0, 0], [1, 0, 0]], speed = 1{rest} }} }}")
    };
    refused(&spline(""), "needs either `tangents` or both");
    refused(
        &spline(", start_tangent = [1, 0, 0]"),
        "needs either `tangents` or both",
    );
    let both = ", start_tangent = [1, 0, 0], end_tangent = [1, 0, 0], tangents = []";
    refused(&spline(both), "needs either `tangents` or both");
    refused(
        &spline(", tangents = [[1, 0, 0]]"),
        "1 tangents given for 2 points",
    );
    refused(
        &spline(", tangents = [[1, 0, 0]], tension = 1"),
        "unknown field `tension`",
    );
    refused(
        "{}",
        "a motion is one of `fixed`, `line`, `spline` and `free`",
    );
    let fixed = |rest: &str| format!("{{ fixed = [0, 0, 0]{rest} }}");
    refused(
        &fixed(", free = { position = [0, 0, 0], velocity = [0, 0, 0] }"),
        "a motion is one of",
    );
    refused(
        &fixed(", spin = { axis = [0, 0, 0], rate = 1 }"),
        "spin.axis is 0e0",
    );
    refused(
        &fixed(", spin = { axis = [0, 0, 1], rate = inf }"),
        "spin.rate is not finite: inf",
    );
    refused(
        &fixed(", spin = { axis = [0, 0, 1], rate = 1, turns = 3 }"),
        "unknown field `turns`",
    );
    let facing = ", facing = { forward = [1, 0, 0], up = [0, 0, 1], world_up = [0, 0, 1] }";
    refused(&fixed(facing), "needs a path");
    let line = |rest: &str| {
        format!("{{ line = {{ from = [0, 0, 0], to = [1, 0, 0], speed = 1{rest} }} }}")
    };
    refused(
        &line(", at_end = \"loop\""),
        "its end is 1e0 m from its start",
    );
    refused(&line(", at_end = \"stop\""), "unknown variant `stop`");
    refused(&line(", start_time = -1"), "start_time is -1e0, below");
    refused(
        &line(", start_distance = nan"),
        "start_distance is not finite",
    );
    refused(
        "{ spline = { control_points = [[0, 0, 0], [1, 0, 0]], speed = 1 } }",
        "2 control points given",
    );
    refused(
        &spline(", control_points = [[0, 0, 0], [1, 0, 0]]"),
        "`control_points` alone",
    );
    assert_refused::<Path>(
        "{ line = { from = [0, 0, 0], to = [0, 0, 0] } }",
        "piece 0 of the path",
    );
    assert_refused::<Path>("{ circle = { radius = 1 } }", "unknown variant `circle`");
}

#[test]
fn bad_settings_are_refused() {
    let refused = assert_refused::<WorldConfig>;
    refused(
        "{ method = { rays = { rays = 0 } } }",
        "rays is 0e0, below the minimum of 1e0",
    );
    refused(
        "{ method = { rays = { rays = -1 } } }",
        "invalid value: integer `-1`",
    );
    refused(
        "{ method = { rays = { curve_angle = 0 } } }",
        "curve_angle is 0e0, below",
    );
    refused(
        "{ method = { rays = { chords = { within = 2 } } } }",
        "chords is 2e0, above",
    );
    refused(
        "{ method = { rays = { tint = 2 } } }",
        "unknown field `tint`",
    );
    refused("{ gravity = 9.81 }", "unknown field `gravity`");
    assert_reads("{}", &WorldConfig::default());
}

#[test]
fn bad_scenes_are_refused() {
    let ball =
        "{ name = \"a\", shape = { sphere = { radius = 1 } }, motion = { fixed = [0, 0, 0] } }";
    let refused = assert_refused::<Scene>;
    refused("{}", "missing field `name`");
    refused(
        "{ name = \"s\", frame_rate = 0 }",
        "frame_rate is 0e0, below the minimum of 1e-9",
    );
    refused(
        "{ name = \"s\", duration = -1 }",
        "duration is -1e0, below the minimum of 1e-12",
    );
    refused("{ name = \"s\", frames = 1 }", "unknown field `frames`");
    refused(
        &format!("{{ name = \"s\", bodies = [{ball}, {ball}] }}"),
        "two bodies are named \"a\"",
    );
    let turned = ball.replace("motion", "orientation = [0, 0, 0, 0], motion");
    refused(
        &format!("{{ name = \"s\", bodies = [{turned}] }}"),
        "body \"a\": orientation.length is 0e0, below the minimum",
    );
    let coloured = ball.replace("motion", "colour = \"red\", motion");
    refused(
        &format!("{{ name = \"s\", bodies = [{coloured}] }}"),
        "unknown field `colour`",
    );
}

/// A scene made in code is checked when its world is made.
#[test]
fn worlds_of_bad_scenes_are_refused() {
    let ball = NamedBody {
        name: "ball".to_owned(),
        body: Body::fixed(Sphere::new(1.0).expect("a sphere"), [0.0; 3]),
    };
    let scene = Scene {
        name: "scene".to_owned(),
        about: String::new(),
        config: WorldConfig::default(),
        frame_rate: Scene::FRAME_RATE,
        duration: None,
        bodies: vec![ball.clone()],
    };
    let (world, bodies) = scene.world().expect("a world");
    assert_eq!((world.len(), bodies.len()), (1, 1));
    let error = |scene: &Scene| scene.world().map(|_| ()).expect_err("it is refused");

    let twice = Scene {
        bodies: vec![ball.clone(), ball.clone()],
        ..scene.clone()
    };
    assert_eq!(
        error(&twice),
        SceneError::DuplicateName {
            name: "ball".to_owned()
        }
    );
    let slow = Scene {
        frame_rate: f64::NAN,
        ..scene.clone()
    };
    assert!(matches!(error(&slow), SceneError::Value(_)));
    let mut none = scene.clone();
    none.config.method = Method::Rays(RayConfig {
        rays: 0,
        ..RayConfig::default()
    });
    assert!(matches!(error(&none), SceneError::Config(_)));
    let mut lost = scene;
    lost.bodies[0].body = Body::fixed(Sphere::new(1.0).expect("a sphere"), [f64::NAN; 3]);
    assert!(matches!(error(&lost), SceneError::Body { name, .. } if name == "ball"));
}

/// A scene that was read behaves as the one that was written.
#[test]
fn contacts_survive_the_round_trip() {
    let points = [[-5.0, 5.0, 0.0], [0.0, 0.1, 0.0], [-5.0, -5.0, 0.0]];
    let path = Path::spline(points, [1.0, 0.3, 0.0], [-1.0, 0.0, 0.7]).expect("a spline");
    let ball = |motion| Body::moving(Sphere::new(1.0).expect("a sphere"), motion);
    let flying = ball(Motion::along(path, 1.0).expect("a motion"));
    let standing = ball(Motion::fixed([0.0, -2.0, 0.0]).expect("a place"));
    let contacts = |bodies: [Body; 2]| {
        let mut world = CollisionWorld::default();
        for body in bodies {
            world.insert(body).expect("a body");
        }
        world.step(20.0).expect("a step").to_vec()
    };
    let written = contacts([flying.clone(), standing.clone()]);
    assert_eq!(written.len(), 1);
    let read = [flying, standing].map(|body| from_toml(&to_toml(body)).expect("a body"));
    assert_eq!(contacts(read), written);
}
