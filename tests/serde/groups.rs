//! Groups of bodies in scenes.

use crate::{assert_round_trips, from_toml};
use feeler::{Body, Groups, Motion, NamedBody, Scene, Sphere, WorldConfig};

fn ball(name: &str, x: f64, groups: Groups) -> NamedBody {
    let motion = Motion::free([x, 0.0, 0.0], [-x, 0.0, 0.0]).expect("in the domain");
    let shape = Sphere::new(0.5).expect("in the domain");
    NamedBody {
        name: name.to_owned(),
        body: Body::moving(shape, motion).in_groups(groups),
    }
}

#[test]
fn bodies_of_a_scene_keep_their_groups() {
    let scene = Scene {
        name: "Two that ignore each other".to_owned(),
        about: String::new(),
        config: WorldConfig::default(),
        frame_rate: 24.0,
        duration: None,
        bodies: vec![
            ball("left", -3.0, Groups::new(1, 1)),
            ball("right", 3.0, Groups::new(2, 2)),
            ball("ghost", 9.0, Groups::NONE),
            ball("wall", 12.0, Groups::ALL),
        ],
    };
    assert_round_trips(&scene);
    let written = toml::to_string(&scene).expect("TOML can hold it");
    assert_eq!(written.matches("groups").count(), 3, "{written}");
    let read: Scene = toml::from_str(&written).expect("what was written can be read");
    let (mut world, ids) = read.world().expect("it was checked");
    let contacts = world.step(1.0).expect("it can be stepped");
    assert!(
        !contacts
            .iter()
            .any(|found| found.a == ids[0] && found.b == ids[1])
    );
    assert_eq!(contacts.len(), 2, "{contacts:?}");
}

#[test]
fn groups_of_a_scene_are_checked() {
    let read = |groups: &str| {
        from_toml::<NamedBody>(&format!(
            "value = {{ name = \"a\", shape = {{ sphere = {{ radius = 1 }} }}, \
             motion = {{ fixed = [0, 0, 0] }}, groups = {groups} }}"
        ))
    };
    let named = read("{ memberships = 5, mask = 4294967295 }").expect("it is in order");
    assert_eq!(named.body.groups(), Groups::new(5, u32::MAX));
    for bad in ["{ memberships = -1, mask = 1 }", "{ memberships = 1 }", "3"] {
        assert!(read(bad).is_err(), "{bad}");
    }
}
