//! The broad phase and the early-outs let through all that touches.

use crate::support::{Kind, Random, flying, free, world_with};
use feeler::{Body, BodyId, BroadPhase, CollisionWorld, Contact, Motion, Path, RayConfig};

fn body(random: &mut Random, extent: f64) -> Body {
    let kind = Kind::ALL[random.below(6)];
    let size = random.decades(-1.0, 0.2);
    let shape = random.shape(kind, size);
    let place = extent * random.vector();
    let body = match random.below(9) {
        0 | 6.. => Body::fixed(shape, place),
        1 => flying(&shape, place, 3.0 * random.vector()),
        2 | 3 => {
            let path = Path::line(place, place + 8.0 * random.vector()).unwrap();
            Body::moving(shape, Motion::along(path, random.within(0.5, 5.0)).unwrap())
        }
        _ => {
            let points: Vec<_> = (0..4).map(|_| place + 3.0 * random.vector()).collect();
            let path = Path::spline(points, 3.0 * random.vector(), 3.0 * random.vector());
            Body::moving(shape, Motion::along(path.unwrap(), 2.0).unwrap())
        }
    };
    body.oriented(random.turn())
}

#[test]
fn swept_boxes_and_all_pairs_give_the_same_contacts_bit_for_bit() {
    let count = std::env::var("BODIES").map_or(250, |count| count.parse().unwrap());
    let mut random = Random::seeded(31);
    // As dense whatever their number.
    let extent = 1.2 * (count as f64).cbrt();
    let rays = RayConfig {
        rays: 16,
        ..RayConfig::default()
    };
    let mut worlds = [BroadPhase::default(), BroadPhase::AllPairs].map(|b| world_with(rays, b));
    let mut ids: Vec<BodyId> = Vec::new();
    let both = |worlds: &mut [CollisionWorld; 2], call: &dyn Fn(&mut CollisionWorld) -> BodyId| {
        let [a, b] = worlds.each_mut().map(call);
        assert_eq!(a, b);
        a
    };
    let mut told = 0;
    for round in 0..12 {
        // Few changes, and very many.
        let changes = [count, 2, count / 3, 0][round % 4].max(usize::from(round == 0));
        for _ in 0..changes {
            let new = body(&mut random, extent);
            if ids.len() < count {
                ids.push(both(&mut worlds, &|world| {
                    world.insert(new.clone()).unwrap()
                }));
                continue;
            }
            let index = random.below(ids.len());
            let id = ids[index];
            match random.below(3) {
                0 => {
                    ids.swap_remove(index);
                    both(&mut worlds, &|world| world.remove(id).map(|_| id).unwrap());
                    ids.push(both(&mut worlds, &|world| {
                        world.insert(new.clone()).unwrap()
                    }));
                }
                1 => {
                    let motion = new.motion().clone();
                    both(&mut worlds, &|world| {
                        world.set_motion(id, motion.clone()).map(|()| id).unwrap()
                    });
                }
                _ if random.below(4) > 0 => {}
                _ => {
                    let motion = free(extent * random.vector(), 3.0 * random.vector());
                    both(&mut worlds, &|world| {
                        world.set_motion(id, motion.clone()).map(|()| id).unwrap()
                    });
                }
            }
        }
        let [few, all] = worlds
            .each_mut()
            .map(|world| -> Vec<Contact> { world.step([0.1, 1.0][round % 2]).unwrap().to_vec() });
        assert_eq!(few, all, "round {round}");
        told += few.len();
    }
    let pairs = worlds.each_ref().map(|world| world.stats().pairs);
    println!("{told} contacts, {pairs:?} pairs");
    assert!(told > count / 2, "{told}");
    assert!(4 * pairs[0] < 3 * pairs[1], "{pairs:?}");
}
