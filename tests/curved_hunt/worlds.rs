//! The same pairs in worlds, in frames of any length.

use crate::draw::Draw;
use crate::hunt::seeds;
use crate::verdict::Pair;
use feeler::{CollisionWorld, Contact, Method, first_contact};
use std::ops::Range;

/// What a world tells first of its two bodies, in frames of so many to the horizon.
fn stepped(pair: &Pair, frames: u32) -> Result<Option<Contact>, f64> {
    let mut world = CollisionWorld::default();
    for body in &pair.bodies {
        world.insert(body.clone()).unwrap();
    }
    for frame in 0..frames {
        let contact = world
            .step(pair.horizon / f64::from(frames))
            .unwrap()
            .first()
            .copied();
        if world.stats().undecided > 0 {
            return Err(f64::from(frame) / f64::from(frames) * pair.horizon);
        }
        if contact.is_some() {
            return Ok(contact);
        }
    }
    Ok(None)
}

/// Far from the origin, where in a short frame a body's velocity is hidden in the rounding of where it is: the
/// last bit of the way to the touch took 4e-9 of the horizon too short.
#[test]
fn who_faces_its_way_far_from_the_origin_meets_when_it_does_in_longer_frames() {
    let (hits, .., wrong) = compare(14_132..14_133);
    assert!(hits == 1 && wrong.is_empty(), "{wrong:?}");
}

/// A gap that counts as touching is wide there, and at a small angle bodies slide on for long until it is closed:
/// touches were told 5e-8 of the horizon early, and so 2e-8 apart in frames of different length.
#[test]
fn who_slides_into_touch_far_from_the_origin_meets_when_the_gap_is_closed() {
    let (hits, .., wrong) = compare(778_402..778_403);
    assert!(hits == 1 && wrong.is_empty(), "{wrong:?}");
    let pair = Pair::new(Draw::new(778_402 + (1 << 32)));
    let [a, b] = &pair.bodies;
    let found = first_contact(a, b, pair.horizon, &Method::Exact);
    let time = found.unwrap().unwrap().fraction * pair.horizon;
    assert!(pair.above(time).abs() < 1e-9, "{}", pair.above(time));
}

/// A corner comes down on a plank's edge: 2e-8 m before it does, what is nearest tells nothing of how they touch, and
/// normals were 0.02 apart in frames of different length.
#[test]
fn a_corner_that_meets_an_edge_far_from_the_origin_is_told_when_it_does() {
    let (hits, .., wrong) = compare(9_216_317..9_216_318);
    assert!(hits == 1 && wrong.is_empty(), "{wrong:?}");
}

/// The surface of a ball runs by a corner that comes to touch it slowly: it was told 1e-8 of the horizon late.
#[test]
fn how_fast_a_ball_spins_says_nothing_of_when_it_is_touched() {
    let (hits, .., wrong) = compare(9_216_445..9_216_446);
    assert!(hits == 1 && wrong.is_empty(), "{wrong:?}");
}

/// On a corner of its path a body looked the way it came, and nothing told that it was about to turn round: it
/// turned through the other body, and was told 4 m deep in it.
#[test]
fn who_faces_its_way_and_stands_on_a_corner_turns_round_from_there() {
    let (hits, .., wrong) = compare(9_403_617..9_403_618);
    assert!(hits == 1 && wrong.is_empty(), "{wrong:?}");
}

#[test]
fn frames_of_any_length_tell_the_same_first_contact() {
    let seeds = seeds(40);
    let all = seeds.end - seeds.start;
    let (hits, misses, open, wrong) = compare(seeds);
    let told = format!("{hits} hits, {misses} misses, {open} open");
    eprintln!("{told}");
    assert!(wrong.is_empty(), "{told}\n{}", wrong.join("\n"));
    assert!(
        all < 30 || 8 * hits > all && 5 * misses > all,
        "lopsided: {told}"
    );
    assert!(20 * open <= all, "{told}");
}

/// Hits, misses, what cannot be told, and what is wrong.
fn compare(seeds: Range<u64>) -> (u64, u64, u64, Vec<String>) {
    let (mut hits, mut misses, mut open) = (0, 0, 0);
    let mut wrong = Vec::new();
    for seed in seeds {
        // Others than those of the hunt.
        let pair = Pair::new(Draw::new(seed + (1 << 32)));
        let slack = 1e-9 * pair.size + pair.rounding;
        let [a, b] = &pair.bodies;
        if pair.above(0.0) < slack {
            continue;
        }
        let Ok(whole) = first_contact(a, b, pair.horizon, &Method::Exact) else {
            open += 1;
            continue;
        };
        if whole.is_some() {
            hits += 1;
        } else {
            misses += 1;
        }
        for frames in [1, 24, 1000] {
            let Ok(found) = stepped(&pair, frames) else {
                open += 1;
                continue;
            };
            let told = match (whole, found) {
                (None, None) => continue,
                (Some(whole), Some(found)) => {
                    let late = found.time / pair.horizon - whole.fraction;
                    let off = found.point.distance(whole.point) / pair.size;
                    // Two fixed bodies never meet, and a moving one comes first.
                    let sign = if pair.bodies[0].motion().is_fixed() {
                        -1.0
                    } else {
                        1.0
                    };
                    let turned = found.normal.distance(sign * whole.normal);
                    let near = 1e-6 + 10.0 * pair.rounding / pair.size;
                    if found.is_touch() && late.abs() <= 1e-9 && off < near && turned < near {
                        continue;
                    }
                    format!("late {late:e} off {off:e} turned {turned:e}")
                }
                (Some(whole), None) => format!("missed at {}", whole.fraction),
                (None, Some(found)) => format!("ghost at {}", found.time / pair.horizon),
            };
            // Who just grazes may do so or not.
            let time = whole.map_or_else(
                || found.map_or(0.0, |found| found.time),
                |whole| whole.fraction * pair.horizon,
            );
            let low = (-8..=8).map(|step| pair.above(time + f64::from(step) * 1e-5 * pair.horizon));
            if low.fold(f64::MAX, f64::min) < -1e-6 * pair.size {
                wrong.push(format!("{seed} in {frames} frames: {told}"));
            } else {
                open += 1;
            }
        }
    }
    (hits, misses, open, wrong)
}
