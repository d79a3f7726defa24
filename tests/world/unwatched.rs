//! Pairs that nobody looked at for a frame, and bodies that fly side by side.

#![allow(clippy::float_cmp, reason = "what is told here is exact")]

use crate::support::{ball, cuboid, flying};
use feeler::{Body, CollisionWorld, ContactKind, Motion, Path, Shape};
use glam::DVec3;

/// How deep the only two bodies overlap, as the step tells it.
fn depth_of(contacts: &[feeler::Contact]) -> Option<f64> {
    assert_eq!(contacts.len(), 1);
    match contacts[0].kind {
        ContactKind::Overlap { depth } => Some(depth),
        _ => None,
    }
}

#[test]
fn bodies_that_stood_in_each_other_overlap_when_one_is_set_going() {
    for shape in [ball(1.0), cuboid(1.0, 1.0, 1.0)] {
        let mut world = CollisionWorld::default();
        world.insert(Body::fixed(shape.clone(), [0.0; 3])).unwrap();
        let other = world.insert(Body::fixed(shape, [1.5, 0.0, 0.0])).unwrap();
        // Of bodies that stand nobody tells anything.
        assert!(world.step(1.0).unwrap().is_empty());
        world.set_velocity(other, [-0.25, 0.0, 0.0]).unwrap();
        let advance = world.step_to_contact(1.0).unwrap();
        assert_eq!(depth_of(advance.contacts), Some(0.5));
        assert_eq!(advance.elapsed, 1.0);
        assert_eq!(depth_of(world.step(1.0).unwrap()), Some(0.75));
    }
}

#[test]
fn a_body_that_stopped_and_is_set_going_in_one_frame_still_touches() {
    let mut world = CollisionWorld::default();
    world
        .insert(Body::fixed(cuboid(1.0, 1.0, 1.0), [0.0; 3]))
        .unwrap();
    let shot = world
        .insert(flying(&ball(0.5), [3.5, 0.0, 0.0], [-2.0, 0.0, 0.0]))
        .unwrap();
    world.step(0.5).unwrap();
    let here = Motion::fixed(world.pose(shot).unwrap().position).unwrap();
    world.set_motion(shot, here).unwrap();
    world.set_velocity(shot, [-2.0, 0.0, 0.0]).unwrap();
    let contacts = world.step(1.0).unwrap();
    assert!(contacts[0].is_touch());
    assert!((contacts[0].time - 1.0).abs() < 1e-12);
}

#[test]
fn a_pair_that_was_held_back_has_not_just_touched() {
    for shape in [ball(1.0), cuboid(1.0, 1.0, 1.0)] {
        let mut world = CollisionWorld::default();
        world.insert(Body::fixed(shape.clone(), [0.0; 3])).unwrap();
        world
            .insert(flying(&shape, [3.0, 0.0, 0.0], [-1.0, 0.0, 0.0]))
            .unwrap();
        assert!(world.step_where(1.5, |_, _| false).unwrap().is_empty());
        let advance = world.step_to_contact(0.25).unwrap();
        assert_eq!(depth_of(advance.contacts), Some(0.5));
        assert_eq!(advance.elapsed, 0.25);
    }
}

#[test]
fn bodies_that_fly_side_by_side_in_touch_do_not_meet() {
    // The clock rounds what is left of a frame otherwise for each of them.
    let velocity = DVec3::new(1.0, 0.0, 0.0);
    let shapes: [fn() -> Shape; 2] = [|| ball(1.0), || cuboid(1.0, 1.0, 1.0)];
    for shape in shapes {
        for part in 1..40 {
            let mut world = CollisionWorld::default();
            world.insert(flying(&shape(), [0.0; 3], velocity)).unwrap();
            world.step(f64::from(part) / 7.0).unwrap();
            let beside = DVec3::new(world.time() + 2.0, 0.0, 0.0);
            world.insert(flying(&shape(), beside, velocity)).unwrap();
            for frame in 0..20 {
                let contacts = world.step(1.0).unwrap();
                assert!(contacts.is_empty(), "{part}, {frame}: {contacts:?}");
            }
        }
    }
}

#[test]
fn contacts_that_the_clock_does_not_tell_apart_are_sorted_by_their_ids() {
    let mut world = CollisionWorld::default();
    world.step(1000.0).unwrap();
    let gap = 4.0 * f64::EPSILON;
    let near = [2.0 + gap, 0.0, 0.0];
    world.insert(Body::fixed(ball(1.0), [0.0; 3])).unwrap();
    world
        .insert(flying(&ball(1.0), near, [-1.0, 0.0, 0.0]))
        .unwrap();
    for x in [10.0, 11.0] {
        world
            .insert(flying(&ball(1.0), [x, 0.0, 0.0], [0.0; 3]))
            .unwrap();
    }
    let contacts = world.step(0.5).unwrap();
    assert_eq!(contacts.len(), 2);
    assert_eq!(contacts[0].time, contacts[1].time);
    assert!(contacts.is_sorted_by_key(|contact| (contact.a, contact.b)));
}

#[test]
fn frames_too_short_for_the_clock_tell_each_pair_once() {
    let mut world = CollisionWorld::default();
    world.step(1e5).unwrap();
    let path = Path::line([0.0; 3], [1.0, 0.0, 0.0]).unwrap();
    let path = Motion::along(path, 1.0).unwrap();
    world.insert(Body::moving(ball(1.0), path)).unwrap();
    for x in 0..40 {
        let at = [1.5 + 3.0 * f64::from(x), 0.0, 0.0];
        world.insert(flying(&ball(1.0), at, [0.0; 3])).unwrap();
    }
    for frame in 0..40 {
        assert_eq!(world.step(1e-12).unwrap().len(), 1, "frame {frame}");
    }
}
