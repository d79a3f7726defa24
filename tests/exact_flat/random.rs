//! Random casts against the oracle.

use crate::bodies::{self, Body, direction, index, log, signed, turn, unit};
use crate::oracle::Oracle;
use feeler::narrow_phase::exact::flat_crossing;
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// From where, which way.
fn cast(rng: &mut ChaCha8Rng, a: (&Body, DQuat), b: (&Body, DQuat)) -> (DVec3, DVec3) {
    let point = |rng: &mut ChaCha8Rng, (body, turn): (&Body, DQuat)| {
        let points = &body.hull.points;
        let vertex = |rng: &mut ChaCha8Rng| points[index(rng, points.len())];
        turn * match index(rng, 4) {
            0 => vertex(rng),
            1 => 0.5 * (vertex(rng) + vertex(rng)),
            _ => {
                let share = unit(rng);
                share * vertex(rng) + (1.0 - share) * vertex(rng)
            }
        }
    };
    let size = a.0.shape.max_dist() + b.0.shape.max_dist();
    let along = match index(rng, 4) {
        0 => DVec3::AXES[index(rng, 3)] * signed(rng).signum(),
        1 => (point(rng, a) - point(rng, a))
            .try_normalize()
            .unwrap_or(DVec3::X),
        _ => direction(rng),
    };
    // A point of A runs through a point of B, or past it.
    let through = point(rng, b) - point(rng, a);
    let aside = match index(rng, 6) {
        0..3 => DVec3::ZERO,
        3 => size * log(rng, 1e-16, 1e-6) * direction(rng),
        _ => size * unit(rng) * direction(rng),
    };
    let motion = size * log(rng, 0.1, 10.0) * along;
    (through + aside - size * 4.0 * unit(rng) * along, motion)
}

pub(crate) fn hunt(seed: u64, pairs: usize, casts: usize) {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let (mut hits, mut total, mut wrong) = (0, 0, 0);
    for _ in 0..pairs {
        let scale = log(&mut rng, 1e-3, 1e3);
        let a = bodies::random(&mut rng, scale);
        let b = if index(&mut rng, 4) == 0 {
            a.clone()
        } else {
            bodies::random(&mut rng, scale)
        };
        for _ in 0..casts {
            let turn_a = turn(&mut rng);
            let turn_b = if index(&mut rng, 3) == 0 {
                turn_a
            } else {
                turn(&mut rng)
            };
            let (between, motion) = cast(&mut rng, (&a, turn_a), (&b, turn_b));
            let found = flat_crossing(&a.shape, turn_a, &b.shape, turn_b, between, motion);
            let oracle = Oracle::new((&a.hull, turn_a), (&b.hull, turn_b), between, motion);
            total += 1;
            hits += usize::from(found.is_some());
            if let Some(complaint) = oracle.complaint(found.as_ref()) {
                wrong += 1;
                if wrong <= 5 {
                    println!(
                        "{complaint}\n  {:?}\n  {turn_a:?}\n  {:?}\n  {turn_b:?}\n  between {between:?} motion {motion:?}\n  {found:?}\n oracle {} {} size {}",
                        a.shape_name(),
                        b.shape_name(),
                        oracle.enter,
                        oracle.leave,
                        oracle.size
                    );
                }
            }
            // Exchanged, all is mirrored.
            let back = flat_crossing(&b.shape, turn_b, &a.shape, turn_a, -between, -motion);
            match (found, back) {
                (None, None) => {}
                (Some(one), Some(other)) => {
                    assert_eq!(one.enter.fraction.to_bits(), other.enter.fraction.to_bits());
                    assert_eq!(one.enter.normal, -other.enter.normal);
                    assert_eq!(one.enter.features[0], other.enter.features[1]);
                    assert_eq!(one.enter.features[1], other.enter.features[0]);
                    let at = between + one.enter.fraction * motion;
                    let error = (one.enter.point - at - other.enter.point).length();
                    assert!(
                        error < 1e-13 * (oracle.size + at.length() + between.length()),
                        "{error:e}"
                    );
                }
                _ => panic!("one way only: {found:?} {back:?}"),
            }
        }
    }
    println!("{total} casts, {hits} hits, {wrong} wrong");
    assert!(wrong == 0, "{wrong} of {total} wrong");
    assert!(
        (total * 3 / 10..total * 9 / 10).contains(&hits),
        "lopsided: {hits} hits of {total}"
    );
}

impl Body {
    fn shape_name(&self) -> String {
        format!("{:?}", self.hull.points)
    }
}

/// More, and others: `CASTS=1000000 SEED=7 cargo test --release --test exact_flat -- --nocapture`.
#[test]
fn random_casts_agree_with_the_oracle() {
    let number = |name: &str, default: u64| {
        let text = std::env::var(name).ok();
        text.map_or(default, |text| text.parse().unwrap())
    };
    let casts = number("CASTS", 8000);
    hunt(number("SEED", 1), (casts / 16).max(1) as usize, 16);
}
