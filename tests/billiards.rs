//! Elastic balls on a table, for seconds, at all speeds: what the world reports
//! is good enough to keep energy, momentum and distance.

#[allow(dead_code, reason = "the example reads the rest")]
#[path = "../examples/billiards/table.rs"]
mod table;

use feeler::{Body, Cuboid, Method, Motion, Pose, Sphere, first_contact, overlap};
use glam::DVec3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use table::{MASS, RADIUS, Table, Target};

const TOLERANCE: f64 = 1e-9;
const BREAKS: u64 = 24;

#[test]
fn breaks_keep_energy_momentum_and_distance() {
    let (mut ball_hits, mut cushion_hits) = (0, 0);
    for seed in 0..BREAKS {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut unit = || (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        let speed = 0.1 * 1000.0_f64.powf(unit());
        // 1.22 m away, the rack's front ball is hit within ±0.046 rad.
        let angle = 0.09 * (unit() - 0.5);
        let velocity = speed * DVec3::new(angle.cos(), angle.sin(), 0.0);
        let case = format!("seed {seed}: {speed} m/s at {angle} rad");

        let mut table = Table::new(velocity).unwrap();
        let energy = table.energy().unwrap();
        // Some thirty table lengths, which at the lowest speeds takes minutes.
        let frame = 0.4 / speed;
        let mut deepest = f64::NEG_INFINITY;
        for index in 1..=100 {
            table.play_until(f64::from(index) * frame).unwrap();
            deepest = deepest.max(table.deepest().unwrap());
            assert!(table.hits.len() < 10_000, "{case}: endless");
        }
        let lost = (table.energy().unwrap() - energy).abs() / energy;
        let owed = table.momentum().unwrap() - MASS * velocity - table.impulse;
        assert!(lost < TOLERANCE, "{case}: energy changed by {lost:e}");
        assert!(
            owed.length() < TOLERANCE * MASS * speed,
            "{case}: momentum off by {owed}"
        );
        assert!(
            table.all_on_table().unwrap(),
            "{case}: a ball left the table"
        );
        assert!(table.tracks().unwrap().iter().all(|track| track.len() >= 2));
        assert!(deepest < TOLERANCE, "{case}: overlap of {deepest:e} m");

        assert!(
            table
                .hits
                .windows(2)
                .all(|pair| pair[0].time <= pair[1].time),
            "{case}: out of order"
        );
        for hit in &table.hits {
            assert!(
                hit.speed > 0.0 && hit.target != Target::Ball(hit.ball),
                "{case}: {hit:?}"
            );
            let [x, y, _] = hit.point.to_array();
            let inside = (-TOLERANCE..=table::LENGTH + TOLERANCE).contains(&x)
                && (-TOLERANCE..=table::WIDTH + TOLERANCE).contains(&y);
            assert!(inside, "{case}: {hit:?}");
        }

        let cushion = |hit: &&table::Hit| matches!(hit.target, Target::Cushion(_));
        let count = table.hits.iter().filter(cushion).count();
        cushion_hits += count;
        ball_hits += table.hits.len() - count;
    }
    assert!(
        ball_hits > 30 * BREAKS as usize,
        "{ball_hits} hits of balls in {BREAKS} breaks"
    );
    assert!(
        cushion_hits > 30 * BREAKS as usize,
        "{cushion_hits} hits of cushions in {BREAKS} breaks"
    );
}

/// A ball that came off the long cushion met the short one at a shallow angle,
/// and the touch was reported 0.2 mm late, with the ball in the cushion by then.
#[test]
fn a_ball_nearly_along_a_cushion_touches_it_in_time() {
    let (half_extents, centre) = table::cushions()[1];
    let cushion = Body::fixed(Cuboid::new(half_extents).unwrap(), centre);
    let start = DVec3::new(2.503_817_441_264_193, 1.240_001_519_030_052, 0.0);
    let velocity = DVec3::new(1.508_863_921_076_759, -9.496_770_295_730_345, 0.0);
    let ball = Motion::free(start, velocity).unwrap();
    let ball = Body::moving(Sphere::new(RADIUS).unwrap(), ball);
    let horizon = 0.01;
    let contact = first_contact(&ball, &cushion, horizon, &Method::default());
    let contact = contact.unwrap().expect("they meet");
    let time = (table::LENGTH - RADIUS - start.x) / velocity.x;
    let error = contact.fraction * horizon - time;
    assert!(error.abs() < 1e-14, "off by {error:e} s");
    let point = start + time * velocity + RADIUS * DVec3::X;
    assert!(contact.point.distance(point) < 1e-12, "{}", contact.point);
}

/// The control: looked at only as frames end, the cue ball passes the rack and
/// leaves the table unseen.
#[test]
fn discrete_steps_tunnel_through_rack_and_cushion() {
    let [cue, rest @ ..] = table::rack();
    let ball = Sphere::new(RADIUS).unwrap().into();
    let step = DVec3::new(0.4, 0.0, 0.0);
    for frame in 0..=6 {
        let at = Pose::at(cue + f64::from(frame) * step);
        for other in rest {
            assert_eq!(overlap(&ball, &at, &ball, &Pose::at(other)), None);
        }
        for (half_extents, centre) in table::cushions() {
            let cushion = Cuboid::new(half_extents).unwrap().into();
            assert_eq!(overlap(&ball, &at, &cushion, &Pose::at(centre)), None);
        }
    }
    assert!((cue + 6.0 * step).x > table::LENGTH + RADIUS);

    let mut table = Table::new(step / 0.1).unwrap();
    table.play_until(0.6).unwrap();
    assert!(table.hits.len() > 10 && table.all_on_table().unwrap());
}
