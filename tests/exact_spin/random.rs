//! Random bodies on curves and in rotation against the oracle.

use crate::draw::{Draw, Random};
use crate::oracle::{Look, apart, witness};
use feeler::{FirstContactError, Method, first_contact};

/// Cases per seed; more by the environment variable `CASTS`.
fn casts() -> u64 {
    std::env::var("CASTS")
        .ok()
        .and_then(|count| count.parse().ok())
        .unwrap_or(120)
}

#[test]
fn random_pairs_meet_when_the_oracle_says() {
    let (mut hits, mut misses, mut undecided, mut grazes) = (0, 0, 0, 0);
    let first: u64 = std::env::var("SEED")
        .ok()
        .and_then(|s| s.parse().ok())
        .unwrap_or(0);
    let count = casts();
    let mut wrong = Vec::new();
    for seed in first..first + count {
        let mut random = Random::seeded(seed);
        let Draw {
            a,
            b,
            horizon,
            size,
            speed,
        } = Draw::new(&mut random);
        let start = apart(&a, &b, 0.0);
        if start < 1e-6 * size {
            continue;
        }
        let look = Look::at(&a, &b, horizon, 4096, speed);
        let slack = 1e-9 * size + 1e-11 * a.pose_after(0.0).position.length();
        match first_contact(&a, &b, horizon, &Method::Exact) {
            Ok(Some(found)) => {
                hits += 1;
                let time = found.fraction * horizon;
                let now = apart(&a, &b, time);
                if now > slack {
                    wrong.push(format!(
                        "{seed}: ghost {now:e} of {size:e} at {}",
                        found.fraction
                    ));
                }
                match look.meets {
                    Some(meets) if (meets - time).abs() <= 1e-8 * horizon => {
                        let (gap, off) = witness(&a, &b, time, found.normal, found.point);
                        if gap.abs() > 10.0 * slack || off.iter().any(|o| o.abs() > 100.0 * slack) {
                            wrong.push(format!(
                                "{seed}: gap {gap:e} off {off:?} of {size:e} {found:?}"
                            ));
                        }
                    }
                    Some(meets) => {
                        grazes += 1;
                        let until = look.least_until(time - 1e-8 * horizon);
                        if meets < time && until < -slack {
                            wrong.push(format!("{seed}: late {time} for {meets}, {until:e}"));
                        }
                        if meets > time && (meets - time) * speed > 1e-2 * size {
                            let rate = now / (meets - time) / speed;
                            wrong.push(format!("{seed}: early {time} for {meets} ({rate:e})"));
                        }
                    }
                    None => grazes += 1,
                }
            }
            Ok(None) => {
                misses += 1;
                let least = look.least_until(horizon);
                if least < -slack {
                    wrong.push(format!(
                        "{seed}: missed at {:?} {least:e} of {size:e}",
                        look.meets
                    ));
                }
            }
            Err(FirstContactError::Undecided { clear_until }) => {
                undecided += 1;
                let least = look.least_until(clear_until * horizon);
                if least < -slack {
                    wrong.push(format!(
                        "{seed}: undecided, but {least:e} before {clear_until}"
                    ));
                } else if std::env::var("SHOW").is_ok() {
                    let now = apart(&a, &b, clear_until * horizon);
                    eprintln!("{seed}: undecided from {clear_until}, {now:e} of {size:e}");
                }
            }
            Err(other) => wrong.push(format!("{seed}: {other}")),
        }
    }
    let told = format!("{hits} hits, {misses} misses, {grazes} grazes, {undecided} undecided");
    eprintln!("{told}");
    assert!(wrong.is_empty(), "{told}\n{}", wrong.join("\n"));
    assert!(hits > count / 10 && misses > count / 10, "lopsided: {told}");
    assert!(undecided * 100 <= count, "{told}");
}
