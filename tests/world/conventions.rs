//! What a contact says, whatever touches.

use crate::support::{Random, ball, cuboid, flying, free};
use feeler::{Body, CollisionWorld, ContactKind, Method, Motion, Path, Shape, first_contact};
use glam::{DQuat, DVec3};

#[test]
fn contacts_are_sorted_and_the_moving_body_comes_first() {
    let mut random = Random::seeded(3);
    let mut world = CollisionWorld::default();
    for index in 0..60 {
        let place = 6.0 * random.vector();
        let body = if index % 3 == 0 {
            Body::fixed(cuboid(0.4, 0.5, 0.6), place)
        } else {
            flying(&ball(0.4), place, 3.0 * random.vector())
        };
        world.insert(body).unwrap();
    }
    let mut seen = 0;
    for _ in 0..20 {
        let start = world.time();
        let contacts = world.step(0.1).unwrap().to_vec();
        let end = world.time();
        seen += contacts.len();
        for pair in contacts.windows(2) {
            let key = |c: &feeler::Contact| (c.a, c.b);
            assert!(
                pair[0].time < pair[1].time
                    || pair[0].time.to_bits() == pair[1].time.to_bits()
                        && key(&pair[0]) < key(&pair[1])
            );
        }
        for c in &contacts {
            assert!((start..=end).contains(&c.time) && (0.0..=1.0).contains(&c.fraction));
            assert!((c.normal.length() - 1.0).abs() < 1e-12);
            let is_moving = |id| world.velocity(id).unwrap() != DVec3::ZERO;
            assert!(is_moving(c.a) && (!is_moving(c.b) || c.a < c.b), "{c:?}");
            assert!(world.contacts_of(c.a).any(|other| other == c));
            assert!(world.contacts_of(c.b).any(|other| other == c));
        }
        let doubled: usize = world.bodies().map(|id| world.contacts_of(id).count()).sum();
        assert_eq!(doubled, 2 * contacts.len());
    }
    assert!((50..2000).contains(&seen), "{seen}");
}

/// Whether two bodies in touch make a contact when the first moves thus.
fn touch_tells(a: &Body, b: &Body) -> bool {
    let found = first_contact(a, b, 1.0, &Method::default()).unwrap();
    if let Some(found) = found {
        assert_eq!(found.kind, ContactKind::Touch);
        assert!(found.fraction < 1e-11, "{found:?} {a:?} {b:?}");
    }
    found.is_some()
}

#[test]
fn from_touch_going_in_is_contact_and_parting_or_sliding_is_none() {
    let shapes = [ball(1.0), cuboid(1.0, 1.0, 1.0)];
    let mut random = Random::seeded(4);
    for a in &shapes {
        for b in &shapes {
            for case in 0..200 {
                let along = random.within(-1.0, 1.0);
                // Face to face boxes may be offset, or flush; balls may not.
                let both_boxes = matches!((a, b), (Shape::Cuboid(_), Shape::Cuboid(_)));
                let aside = if both_boxes && case % 2 == 0 {
                    0.3
                } else {
                    0.0
                };
                let place = DVec3::new(-2.0, aside * along, 0.7 * aside);
                let turn = if case % 4 < 2 {
                    DQuat::IDENTITY
                } else {
                    random.turn()
                };
                let other = Body::fixed(b.clone(), [0.0; 3]).oriented(turn);
                let slide = DVec3::new(0.0, along, random.within(-1.0, 1.0));
                for (ahead, want) in [(0.5, true), (1e-3, true), (0.0, false), (-1e-3, false)] {
                    let velocity = slide + ahead * DVec3::X;
                    let body = flying(a, turn * place, turn * velocity).oriented(turn);
                    assert_eq!(
                        touch_tells(&body, &other),
                        want,
                        "{a:?} {b:?} {turn} {velocity}"
                    );
                }
            }
        }
    }
}

#[test]
fn overlaps_are_told_with_their_depth_until_parted() {
    let mut random = Random::seeded(5);
    for _ in 0..300 {
        let reach = random.decades(-3.0, 3.0);
        let (ra, rb) = (
            reach * random.within(0.1, 1.0),
            reach * random.within(0.1, 1.0),
        );
        let direction = random.direction();
        let apart = random.within(0.05, 0.95) * (ra + rb);
        let speed = random.within(0.1, 1.0) * (ra + rb);
        let mut world = CollisionWorld::default();
        world
            .insert(flying(&ball(ra), apart * direction, speed * direction))
            .unwrap();
        world.insert(Body::fixed(ball(rb), [0.0; 3])).unwrap();
        loop {
            let distance = apart + speed * world.time();
            let depth = ra + rb - distance;
            let contacts = world.step(0.1).unwrap();
            if depth <= 0.0 {
                assert!(contacts.is_empty());
                break;
            }
            let ContactKind::Overlap { depth: told } = contacts[0].kind else {
                panic!("{contacts:?}");
            };
            assert!((told - depth).abs() < 1e-12 * (ra + rb), "{told} {depth}");
            assert!(contacts[0].normal.distance(direction) < 1e-9);
        }
    }
    // Boxes along their axes: the least of three widths.
    for _ in 0..300 {
        let (a, b) = (random.vector().abs() + 0.1, random.vector().abs() + 0.1);
        let between = 0.9 * random.vector() * (a + b);
        let widths = a + b - between.abs();
        let mut world = CollisionWorld::default();
        world
            .insert(flying(&cuboid(a.x, a.y, a.z), between, [0.0; 3]))
            .unwrap();
        world
            .insert(Body::fixed(cuboid(b.x, b.y, b.z), [0.0; 3]))
            .unwrap();
        let ContactKind::Overlap { depth } = world.step(0.1).unwrap()[0].kind else {
            panic!("{:?}", world.contacts());
        };
        assert!((depth - widths.min_element()).abs() < 1e-12);
    }
}

/// A ball flies at a wall so that it touches just as a frame ends, at many frame
/// rates, far out and late too: it is told once, as a touch.
#[test]
fn a_touch_between_two_frames_is_told_once_and_as_a_touch() {
    let mut random = Random::seeded(6);
    for case in 0..2000 {
        let rate = [1.0, 24.0, 30.0, 59.94, 60.0, 144.0, 1000.0][case % 7];
        let frames = 1 + random.below(40);
        let speed = random.decades(-2.0, 3.0);
        let late = if case % 3 == 0 {
            random.decades(0.0, 6.0)
        } else {
            0.0
        };
        let out = if case % 2 == 0 {
            0.0
        } else {
            1e4 * random.within(-1.0, 1.0)
        };
        let mut world = CollisionWorld::default();
        if late > 0.0 {
            world.step(late).unwrap();
        }
        let way = frames as f64 / rate * speed;
        let direction = random.direction();
        let wall = if case % 5 < 3 {
            ball(1.0)
        } else {
            cuboid(1.0, 1.0, 1.0)
        };
        let turn = DQuat::from_rotation_arc(DVec3::X, direction);
        let start = DVec3::splat(out) - (2.0 + way) * direction;
        world
            .insert(flying(&ball(1.0), start, speed * direction))
            .unwrap();
        world
            .insert(Body::fixed(wall, DVec3::splat(out)).oriented(turn))
            .unwrap();
        let mut touches = Vec::new();
        for frame in 0..frames + 3 {
            for contact in world.step(1.0 / rate).unwrap() {
                match contact.kind {
                    ContactKind::Touch => touches.push(contact.time - late),
                    _ => assert!(!touches.is_empty(), "frame {frame}: told as an overlap"),
                }
            }
        }
        assert_eq!(touches.len(), 1, "case {case}: {touches:?}");
        let rounding = 1e-9 * (1.0 + late * 1e-6) + 1e-11 * out.abs() / speed;
        let want = frames as f64 / rate;
        assert!(
            (touches[0] - want).abs() < rounding,
            "{} {want}",
            touches[0]
        );
    }
}

#[test]
fn stepping_to_contact_tells_pairs_an_ulp_apart_and_ends() {
    let mut random = Random::seeded(8);
    for case in 0..300 {
        let mut world = CollisionWorld::default();
        // Pairs far from each other that touch at the same time, or an ulp later.
        let pairs = 2 + random.below(4);
        for index in 0..pairs {
            let y = 10.0 * index as f64;
            let gap = f64::from_bits(1.0_f64.to_bits() + random.below(3) as u64);
            world
                .insert(flying(&ball(0.5), [-1.0 - gap, y, 0.0], [1.0, 0.0, 0.0]))
                .unwrap();
            world.insert(Body::fixed(ball(0.5), [0.0, y, 0.0])).unwrap();
        }
        let (mut left, mut calls, mut touches) = (2.0, 0, 0);
        while left > 0.0 {
            calls += 1;
            assert!(calls < 30, "case {case}");
            let before = world.time();
            let advance = world.step_to_contact(left).unwrap();
            touches += advance.contacts.iter().filter(|c| c.is_touch()).count();
            assert!((advance.elapsed + advance.time_left - left).abs() < 1e-12);
            left = advance.time_left;
            let elapsed = advance.elapsed;
            assert_eq!(world.time().to_bits(), (before + elapsed).to_bits());
        }
        assert_eq!(touches, pairs, "case {case}");
    }
}

/// Bodies that miss their touch at a frame's seam must not pass unnoticed.
#[test]
fn a_bouncing_ball_never_leaves_its_box() {
    let mut random = Random::seeded(9);
    for _ in 0..20 {
        let mut world = CollisionWorld::default();
        for axis in DVec3::AXES {
            for side in [-1.0, 1.0] {
                let half = DVec3::splat(2.0) - 1.9 * axis;
                let wall = cuboid(half.x, half.y, half.z);
                world.insert(Body::fixed(wall, 1.1 * side * axis)).unwrap();
            }
        }
        let velocity = 5.0 * random.direction();
        let id = world
            .insert(flying(&ball(0.1), 0.5 * random.vector(), velocity))
            .unwrap();
        let mut bounces = 0;
        for _ in 0..180 {
            let mut left = 1.0 / 60.0;
            for call in 0.. {
                assert!(call < 100, "stuck");
                let advance = world.step_to_contact(left).unwrap();
                left = advance.time_left;
                let normals: Vec<_> = advance
                    .contacts
                    .iter()
                    .filter(|contact| contact.is_touch())
                    .map(|contact| contact.normal)
                    .collect();
                if normals.is_empty() {
                    break;
                }
                let mut velocity = world.velocity(id).unwrap();
                for normal in normals {
                    bounces += 1;
                    let closing = velocity.dot(normal);
                    velocity -= 2.0 * closing.min(0.0) * normal;
                }
                world.set_velocity(id, velocity).unwrap();
            }
            let position = world.pose(id).unwrap().position;
            assert!(position.abs().max_element() < 0.9 + 1e-9, "{position}");
        }
        assert!(bounces > 3, "{bounces}");
    }
}

#[test]
fn bodies_at_rest_to_each_other_make_no_contact() {
    let mut world = CollisionWorld::default();
    let velocity = [1.0, 2.0, 3.0];
    world
        .insert(flying(&ball(1.0), [0.0; 3], velocity))
        .unwrap();
    world
        .insert(flying(&ball(1.0), [2.0, 0.0, 0.0], velocity))
        .unwrap();
    world
        .insert(flying(&cuboid(1.0, 1.0, 1.0), [0.0, -2.5, 0.0], velocity))
        .unwrap();
    for _ in 0..50 {
        assert!(world.step(0.1).unwrap().is_empty());
    }
}

#[test]
fn a_frame_in_which_bodies_pass_through_each_other_tells_of_it() {
    let (mut whole, mut samples) = (CollisionWorld::default(), 0);
    whole
        .insert(flying(&ball(0.1), [-500.0, 0.0, 0.0], [1000.0, 0.0, 0.0]))
        .unwrap();
    let id = whole
        .insert(Body::fixed(cuboid(0.05, 1.0, 1.0), [0.0; 3]))
        .unwrap();
    let contact = whole.step(1.0).unwrap()[0];
    assert!((contact.time - 0.499_85).abs() < 1e-12 && contact.b == id);
    // A control: looked at frame by frame, at 60 Hz, it goes through unseen.
    for frame in 0..=60 {
        let x: f64 = -500.0 + 1000.0 * f64::from(frame) / 60.0 + 1.0;
        samples += usize::from(x.abs() < 0.15);
    }
    assert_eq!(samples, 0);
}

#[test]
fn bodies_may_be_changed_inside_contacts_and_between_steps() {
    let mut world = CollisionWorld::default();
    let wall = world
        .insert(Body::fixed(cuboid(1.0, 1.0, 1.0), [0.0; 3]))
        .unwrap();
    let shot = |x: f64| flying(&ball(0.5), [x, 0.0, 0.0], [1.0, 0.0, 0.0]);
    let first = world.insert(shot(-2.0)).unwrap();
    assert_eq!(world.step(1.0).unwrap().len(), 1);
    // Removed while it is inside; the place is taken by one that is apart.
    world.remove(first).unwrap();
    let second = world.insert(shot(-2.25)).unwrap();
    let contacts = world.step(1.0).unwrap();
    assert_eq!((contacts.len(), contacts[0].a), (1, second));
    assert!(contacts[0].is_touch());
    // Put into the wall anew: an overlap, not a touch.
    world
        .set_motion(second, free([0.0; 3], [0.0, 1.0, 0.0]))
        .unwrap();
    let contacts = world.step(0.1).unwrap();
    assert!(!contacts[0].is_touch());
    // Turned round where it is: still an overlap, of the same two.
    world.set_velocity(second, [0.0, -1.0, 0.0]).unwrap();
    assert!(!world.step(0.1).unwrap()[0].is_touch());
    world.remove(wall).unwrap();
    assert!(world.step(0.1).unwrap().is_empty());
}

#[test]
fn first_contact_and_the_world_agree() {
    let path = Path::line([-3.0, 0.2, 0.0], [3.0, 0.0, 0.3]).unwrap();
    let a = Body::moving(cuboid(0.4, 0.3, 0.2), Motion::along(path, 2.0).unwrap());
    let b = Body::fixed(ball(1.0), [0.0; 3]);
    let alone = first_contact(&a, &b, 3.0, &Method::default())
        .unwrap()
        .unwrap();
    let mut world = CollisionWorld::default();
    world.insert(a).unwrap();
    world.insert(b).unwrap();
    let contact = world.step(3.0).unwrap()[0];
    assert_eq!(
        (alone.fraction, alone.point),
        (contact.fraction, contact.point)
    );
    assert_eq!((alone.normal, alone.kind), (contact.normal, contact.kind));
}

/// A spin that cannot be seen sends a pair the long way round.
#[test]
fn two_flying_balls_are_answered_to_the_bit_as_the_same_balls_turning() {
    let mut random = Random::seeded(77);
    let mut told = [0; 3];
    for case in 0..4000 {
        let size = random.decades(-3.0, 3.0);
        let radii = [random.within(0.1, 1.0), random.within(0.1, 1.0)].map(|share| share * size);
        let far = if case % 3 == 0 {
            random.decades(0.0, 5.0)
        } else {
            0.0
        };
        let place = far * random.vector();
        let aside = match case % 4 {
            0 => radii[0] + radii[1],
            _ => size * random.decades(-3.0, 1.0),
        };
        let out = random.direction();
        let places = [place + aside * out, place];
        let speed = size * random.decades(-9.0, 1.5);
        let aim = if case % 5 == 0 {
            DVec3::ZERO
        } else {
            0.5 * size * random.vector()
        };
        let velocities = [
            speed * (aim - aside * out).normalize_or(DVec3::X),
            0.1 * speed * random.vector(),
        ];
        let balls = [0, 1].map(|index| {
            Motion::free(places[index], velocities[index])
                .map(|motion| (ball(radii[index]), motion))
                .unwrap()
        });
        let [flying, turning] = [0.0, 1.0].map(|rate| {
            let [a, b] = balls.clone().map(|(shape, motion)| match rate {
                0.0 => Body::moving(shape, motion),
                _ => Body::moving(shape, motion.spin([0.0, 1.0, 0.0], rate).unwrap()),
            });
            first_contact(&a, &b, 1.0, &Method::Exact).unwrap()
        });
        assert_eq!(flying, turning, "{balls:?}");
        told[match flying.map(|contact| contact.kind) {
            None => 0,
            Some(ContactKind::Touch) => 1,
            Some(_) => 2,
        }] += 1;
    }
    assert!(told.iter().all(|&count| count > 300), "{told:?}");
}
