//! The early-outs against moving spheres in twice the precision.

use feeler::early_out::{Rejection, RejectionCounts, reject};
use glam::DVec3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// An unevaluated sum `high + low`, some 106 bits (Dekker 1971).
#[derive(Clone, Copy)]
struct Double {
    high: f64,
    low: f64,
}

impl Double {
    fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let b_part = high - a;
        let low = (a - (high - b_part)) + (b - b_part);
        Self { high, low }
    }

    fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        let low = a.mul_add(b, -high);
        Self { high, low }
    }

    fn plus(self, other: Self) -> Self {
        let high = Self::sum(self.high, other.high);
        let low = Self::sum(self.low, other.low);
        let first = Self::sum(high.high, high.low + low.high);
        Self::sum(first.high, first.low + low.low)
    }

    fn minus(self, other: Self) -> Self {
        self.plus(Self {
            high: -other.high,
            low: -other.low,
        })
    }

    fn times(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        let cross = self.high * other.low + self.low * other.high;
        Self::sum(product.high, product.low + cross)
    }

    fn at_most(self, other: Self) -> bool {
        let difference = other.minus(self);
        difference.high > 0.0 || (difference.high == 0.0 && difference.low >= 0.0)
    }
}

fn dot(a: [Double; 3], b: [Double; 3]) -> Double {
    a[0].times(b[0])
        .plus(a[1].times(b[1]))
        .plus(a[2].times(b[2]))
}

fn exact(v: DVec3) -> [Double; 3] {
    v.to_array().map(|high| Double { high, low: 0.0 })
}

/// Square of the least distance, as a quotient, of the moving centres.
fn least_distance_squared(between: DVec3, motion: DVec3) -> (Double, Double) {
    let one = Double {
        high: 1.0,
        low: 0.0,
    };
    let (m, v) = (exact(between), exact(motion));
    let (mm, mv, vv) = (dot(m, m), dot(m, v), dot(v, v));
    if mv.high <= 0.0 {
        (mm, one)
    } else if vv.at_most(mv) {
        let end = [0, 1, 2].map(|i| m[i].minus(v[i]));
        (dot(end, end), one)
    } else {
        (mm.times(vv).minus(mv.times(mv)), vv)
    }
}

fn touches(between: DVec3, motion: DVec3, reach: f64) -> bool {
    let (numerator, denominator) = least_distance_squared(between, motion);
    numerator.at_most(Double::product(reach, reach).times(denominator))
}

struct Random(ChaCha8Rng);

impl Random {
    fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn within(&mut self, min: f64, max: f64) -> f64 {
        min + (max - min) * self.unit()
    }

    fn scale(&mut self, decades: f64) -> f64 {
        10_f64.powf(self.within(-decades, decades))
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(
            self.within(-1.0, 1.0),
            self.within(-1.0, 1.0),
            self.within(-1.0, 1.0),
        )
    }
}

/// Rejects a case, checks it against the oracle, counts.
fn check(counts: &mut RejectionCounts, between: DVec3, motion: DVec3, reach: f64) -> bool {
    let rejection = reject(between, motion, reach);
    let touch = touches(between, motion, reach);
    assert!(
        !(touch && rejection.is_some()),
        "rejected as {rejection:?}, yet it touches: {between:?} {motion:?} {reach:e}"
    );
    if let Some(rejection) = rejection {
        counts.count(rejection);
    }
    touch
}

#[test]
fn the_oracle_finds_planted_touches() {
    let motion = DVec3::new(8.0, 0.0, 0.0);
    assert!(touches(DVec3::new(4.0, 3.0, 0.0), motion, 3.0));
    assert!(!touches(DVec3::new(4.0, 3.0, 0.0), motion, 3.0 - 1e-15));
    assert!(touches(DVec3::new(12.0, 3.0, 0.0), motion, 5.0));
    assert!(!touches(DVec3::new(12.0, 3.0, 0.0), motion, 5.0 - 1e-15));
    assert!(!touches(DVec3::new(-4.0, 3.0, 0.0), motion, 5.0 - 1e-15));
}

#[test]
fn random_pairs_that_touch_are_never_rejected_and_the_others_nearly_always() {
    let mut random = Random(ChaCha8Rng::seed_from_u64(1));
    let (mut touching, mut apart) = (0_u64, 0_u64);
    let mut counts = RejectionCounts::default();
    for _ in 0..60_000 {
        let size = random.scale(9.0);
        let between = size * random.vector();
        let motion = 2.0 * size * random.scale(1.0) * random.vector();
        let reach = size * random.within(0.0, 1.5);
        if check(&mut counts, between, motion, reach) {
            touching += 1;
        } else {
            apart += 1;
        }
    }
    assert!((15_000..45_000).contains(&touching), "lopsided: {touching}");
    assert!(
        counts.too_far > 3_000 && counts.moving_away > 3_000 && counts.passing_by > 3_000,
        "{counts:?}"
    );
    // A pair within a billionth of touching is the only one left.
    assert!(
        apart - counts.total() <= 1,
        "{} of {apart} apart were not rejected",
        apart - counts.total()
    );
}

#[test]
fn grazes_are_never_rejected() {
    let mut random = Random(ChaCha8Rng::seed_from_u64(2));
    let (mut touching, mut rejected) = (0, RejectionCounts::default());
    for case in 0..120_000 {
        let between = random.scale(12.0) * random.vector();
        let motion = match case % 3 {
            // Nearly along the line of centres, then anywhere.
            0 => {
                between * random.scale(2.0) + between.length() * random.scale(8.0) * random.vector()
            }
            _ => random.scale(12.0) * random.vector(),
        };
        let (numerator, denominator) = least_distance_squared(between, motion);
        let distance = (numerator.high / denominator.high).sqrt();
        let reach = distance * (1.0 + random.within(-4e-15, 4e-15));
        touching += u64::from(check(&mut rejected, between, motion, reach));
        // Well clear of the margins a miss is seen, unless it is hair-thin.
        if distance > 1e-3 * between.length() {
            assert!(
                reject(between, motion, distance * (1.0 - 2e-9)).is_some(),
                "{between:?} {motion:?} {distance:e}"
            );
        }
    }
    assert!((40_000..80_000).contains(&touching), "lopsided: {touching}");
}

#[test]
fn pairs_far_apart_for_their_reach_are_never_rejected_when_they_touch() {
    let mut random = Random(ChaCha8Rng::seed_from_u64(3));
    let mut counts = RejectionCounts::default();
    let mut touching = 0;
    for _ in 0..60_000 {
        let size = random.scale(6.0);
        let between = size * random.vector();
        // The motion passes about one reach beside B, far behind or just before it.
        let reach = size * 10_f64.powf(random.within(-9.0, -1.0));
        let aim = between + reach * random.within(0.2, 1.2) * random.vector().normalize();
        let motion = aim * random.within(0.9, 3.0);
        touching += u64::from(check(&mut counts, between, motion, reach));
    }
    assert!((20_000..55_000).contains(&touching), "lopsided: {touching}");
}

#[test]
fn each_rejection_is_named() {
    let x = DVec3::X;
    let cases = [
        ("short", 5.0 * x, 2.9 * x, 2.0, Some(Rejection::TooFar)),
        ("reaches", 5.0 * x, 3.0 * x, 2.0, None),
        ("away", 5.0 * x, -x, 2.0, Some(Rejection::MovingAway)),
        ("still", 5.0 * x, DVec3::ZERO, 2.0, Some(Rejection::TooFar)),
        (
            "across",
            5.0 * x,
            100.0 * DVec3::Y,
            2.0,
            Some(Rejection::TooFar),
        ),
        (
            "past",
            5.0 * x,
            DVec3::new(9.0, 9.0, 0.0),
            2.0,
            Some(Rejection::PassingBy),
        ),
        (
            "stops beside",
            DVec3::new(5.0, 2.0, 0.0),
            4.9 * x,
            1.9,
            Some(Rejection::TooFar),
        ),
        ("overlapping, parting", x, -9.0 * x, 2.0, None),
        ("touching, parting", 2.0 * x, -9.0 * x, 2.0, None),
        ("concentric", DVec3::ZERO, x, 2.0, None),
        ("points in one place", DVec3::ZERO, DVec3::ZERO, 0.0, None),
        ("points", x, 2.0 * x, 0.0, None),
        ("point on end", x, x, 0.0, None),
    ];
    for (case, between, motion, reach, expected) in cases {
        assert_eq!(reject(between, motion, reach), expected, "{case}");
    }
}

#[test]
fn what_cannot_be_decided_is_not_rejected() {
    let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e200, f64::MAX];
    for value in odd {
        for component in 0..3 {
            let mut between = DVec3::new(5.0, 0.0, 0.0);
            between[component] = value;
            assert_eq!(reject(between, DVec3::Y, 1.0), None, "between {between}");
            let mut motion = DVec3::ONE;
            motion[component] = value;
            assert_eq!(reject(5.0 * DVec3::X, motion, 1.0), None, "motion {motion}");
        }
    }
    assert_eq!(reject(5.0 * DVec3::X, DVec3::Y, f64::NAN), None);
    assert_eq!(reject(5.0 * DVec3::X, DVec3::Y, f64::INFINITY), None);
    for tiny in [f64::MIN_POSITIVE, 1e-300, 1e-160, 5e-324] {
        let x = tiny * DVec3::X;
        assert_eq!(reject(x, x, 0.5 * tiny), None);
        // The motion alone may be tiny: B is a metre away.
        assert_eq!(reject(DVec3::X, x, 0.5), Some(Rejection::TooFar));
        let just = 0.5_f64.next_up();
        assert_eq!(reject(DVec3::X * 0.5, x + DVec3::Y * tiny, just), None);
    }
}
