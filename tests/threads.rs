//! The same world on one thread and on many, alone and among strangers.

#![allow(
    clippy::unwrap_used,
    reason = "planted input that is refused shall fail the test"
)]

#[path = "crowds/worlds.rs"]
mod worlds;

use feeler::{Body, CollisionWorld, Contact, QueryFilter, Ray};
use glam::DVec3;
use worlds::{Crowd, Random};

/// All that can be told of a run.
#[derive(Debug, PartialEq)]
struct Run {
    contacts: Vec<Vec<Contact>>,
    pairs: Vec<usize>,
    rejected: Vec<u64>,
    hits: Vec<Option<feeler::BodyHit>>,
}

fn run(bodies: &[Body]) -> Run {
    let mut world = CollisionWorld::default();
    let ids: Vec<_> = bodies
        .iter()
        .map(|body| world.insert(body.clone()).unwrap())
        .collect();
    let mut run = Run {
        contacts: Vec::new(),
        pairs: Vec::new(),
        rejected: Vec::new(),
        hits: Vec::new(),
    };
    let mut random = Random::seeded(9);
    for _ in 0..8 {
        run.contacts.push(world.step(1.0 / 60.0).unwrap().to_vec());
        run.pairs.push(world.stats().pairs);
        run.rejected.push(world.stats().rejected.total());
        for _ in 0..20 {
            let id = ids[random.below(ids.len())];
            world.set_velocity(id, 8.0 * random.vector()).unwrap();
        }
        let rays: Vec<Ray> = (0..300)
            .map(|_| Ray::new(20.0 * random.vector(), random.vector()))
            .collect();
        let all = QueryFilter::default();
        let hits = world.cast_rays(&rays, f64::INFINITY, &all).unwrap();
        run.hits.extend(hits);
    }
    run
}

fn on_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    pool.build().unwrap().install(work)
}

#[test]
fn any_number_of_threads_gives_the_same_bits_in_the_same_order() {
    for crowd in Crowd::ALL {
        let bodies = crowd.bodies(1_200, &mut Random::seeded(1));
        let alone = on_threads(1, || run(&bodies));
        let told: usize = alone.contacts.iter().map(Vec::len).sum();
        assert!(told > 50, "lopsided, {crowd:?}: {told}");
        let hits = alone.hits.iter().flatten().count();
        assert!(hits > 50 || crowd == Crowd::Far, "{crowd:?}: {hits}");
        for threads in [2, 3, 8] {
            let many = on_threads(threads, || run(&bodies));
            assert!(alone == many, "{crowd:?} on {threads} threads");
        }
    }
}

/// Bodies that have nothing to do with a crowd, inserted between its own in any
/// order, change nothing about its contacts but their ids.
#[test]
fn strangers_in_any_order_change_nothing() {
    let mut random = Random::seeded(2);
    let bodies = Crowd::Mixed.bodies(600, &mut random);
    let strangers: Vec<Body> = Crowd::Balls
        .bodies(900, &mut random)
        .into_iter()
        .map(|body| {
            let place = body.motion().position_after(0.0) + DVec3::new(1e4, 0.0, 0.0);
            Body::fixed(body.shape().clone(), place)
        })
        .collect();
    let told = |order: &[usize]| {
        let mut world = CollisionWorld::default();
        let mut names = Vec::new();
        let mut others = order.iter().map(|&index| &strangers[index]);
        for body in &bodies {
            names.push(world.insert(body.clone()).unwrap());
            for other in others.by_ref().take(names.len() % 3) {
                world.insert(other.clone()).unwrap();
            }
        }
        let mut told = Vec::new();
        for _ in 0..5 {
            for contact in world.step(1.0 / 60.0).unwrap() {
                let index = |id| names.binary_search(&id).unwrap();
                let (a, b) = (index(contact.a), index(contact.b));
                told.push((a, b, contact.time, contact.point, contact.normal));
            }
        }
        told
    };
    let alone = on_threads(1, || told(&[]));
    assert!(alone.len() > 100, "{}", alone.len());
    for threads in [1, 2, 8] {
        let mut order: Vec<usize> = (0..strangers.len()).collect();
        for index in (1..order.len()).rev() {
            order.swap(index, random.below(index + 1));
        }
        assert!(on_threads(threads, || told(&order)) == alone, "{threads}");
    }
}
