//! Oriented boxes against planted touches and gaps; pair lists against brute force.

#![allow(
    clippy::unwrap_used,
    reason = "planted input that is refused shall fail the test"
)]

use feeler::broad_phase::{
    BroadPhase, Flight, FrameBox, FramePairs, ObbTest, PairList, Volume, obb_overlap_by_axes,
    obb_overlap_by_rays,
};
use feeler::sweep::{along_line, along_spline, around_static};
use feeler::{Aabb, Obb, Path, Pose, Sphere};
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

struct Random(ChaCha8Rng);

impl Random {
    fn seeded(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn within(&mut self, min: f64, max: f64) -> f64 {
        min + (max - min) * self.unit()
    }

    fn below(&mut self, end: usize) -> usize {
        (self.0.next_u64() % end as u64) as usize
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

    fn rotation(&mut self) -> DQuat {
        let axis = self.vector().normalize_or(DVec3::X);
        DQuat::from_axis_angle(axis, self.within(0.0, 6.0))
    }

    /// Turned like `near`: exactly, by a hair, or not at all alike.
    fn rotation_near(&mut self, near: DQuat) -> DQuat {
        let axis = self.vector().normalize_or(DVec3::X);
        match self.below(4) {
            0 => near,
            1 => near * DQuat::from_axis_angle(axis, 10_f64.powf(self.within(-17.0, -5.0))),
            2 => near * DQuat::from_axis_angle(DVec3::Z, self.within(0.0, 6.0)),
            _ => self.rotation(),
        }
    }
}

fn obb(centre: DVec3, rotation: DQuat, half_extents: DVec3) -> Obb {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| rotation * axis);
    Obb {
        centre,
        axes,
        half_extents,
    }
}

/// The corner farthest along `direction`, relative to the box's centre.
fn support(obb: &Obb, direction: DVec3) -> DVec3 {
    (0..3)
        .map(|i| obb.half_extents[i].copysign(obb.axes[i].dot(direction)) * obb.axes[i])
        .sum()
}

/// A direction across which two boxes may touch: a face, two edges, or corners.
fn direction(random: &mut Random, a: &Obb, b: &Obb) -> DVec3 {
    let (i, j) = (random.below(3), random.below(3));
    let normal = match random.below(4) {
        0 => a.axes[i],
        1 => b.axes[j],
        2 => a.axes[i].cross(b.axes[j]),
        _ => random.vector(),
    };
    let normal = normal.try_normalize().unwrap_or(a.axes[i]);
    if random.below(2) == 0 {
        normal
    } else {
        -normal
    }
}

/// Two boxes with `gap` between them along some direction (negative: that deep).
fn pair_with_gap(random: &mut Random, gap: impl Fn(&Obb, &Obb) -> f64) -> (Obb, Obb) {
    let size = random.scale(6.0);
    let mut extents = || size * random.vector().abs() * DVec3::new(1.0, random.scale(3.0), 1.0);
    let (half_a, half_b) = (extents(), extents());
    let turned = random.rotation();
    let mut a = obb(DVec3::ZERO, turned, half_a);
    let mut b = obb(DVec3::ZERO, random.rotation_near(turned), half_b);
    let normal = direction(random, &a, &b);
    // B's deepest corner goes on a point of the face, edge or corner of A that is
    // outermost along `normal`: between the corner and its neighbours, if as far out.
    let mut on_a = support(&a, normal);
    for i in 0..3 {
        if a.axes[i].dot(normal).abs() < 1e-14 {
            on_a += random.within(-1.0, 1.0) * a.half_extents[i] * a.axes[i]
                - on_a.dot(a.axes[i]) * a.axes[i];
        }
    }
    let centre = size * random.vector();
    a.centre = centre;
    b.centre = centre + on_a - support(&b, -normal) + gap(&a, &b) * normal;
    (a, b)
}

fn total(a: &Obb, b: &Obb) -> f64 {
    (a.half_extents + b.half_extents).element_sum()
}

/// The gap that must be seen. Two edges at a small angle `s` give an axis of length
/// `s`, along which the gap shrinks as much; but then faces separate what is `s` apart.
fn resolution(a: &Obb, b: &Obb) -> f64 {
    let sines = (0..9).map(|k| a.axes[k / 3].cross(b.axes[k % 3]).length());
    let seen = sines
        .map(|s| (2e-13 / s).min(8.0 * s))
        .fold(2e-13, f64::max);
    seen * total(a, b)
}

#[test]
fn boxes_that_touch_or_overlap_are_never_called_apart() {
    let mut random = Random::seeded(1);
    for _ in 0..100_000 {
        // Within the rounding of their construction.
        let (a, b) = pair_with_gap(&mut random, |a, b| -2e-16 * total(a, b));
        assert!(obb_overlap_by_axes(&a, &b), "{a:?} {b:?}");
        assert!(obb_overlap_by_axes(&b, &a), "{b:?} {a:?}");
        let depth = random.unit();
        let (a, b) = pair_with_gap(&mut random, |a, b| -depth * total(a, b));
        // Too deep may be out on the other side: only then there may be no overlap.
        let inside = b.contains(a.centre) || a.contains(b.centre);
        assert!(!inside || obb_overlap_by_axes(&a, &b), "{a:?} {b:?}");
    }
}

#[test]
fn boxes_with_a_gap_are_always_called_apart() {
    let mut random = Random::seeded(2);
    for _ in 0..100_000 {
        let (a, b) = pair_with_gap(&mut random, resolution);
        assert!(!obb_overlap_by_axes(&a, &b), "{a:?} {b:?}");
        assert!(!obb_overlap_by_axes(&b, &a), "{b:?} {a:?}");
    }
}

#[test]
fn a_common_point_means_overlap_far_from_the_origin_and_at_any_size() {
    let mut random = Random::seeded(3);
    for _ in 0..100_000 {
        let point = random.scale(9.0) * random.vector();
        let turned = random.rotation();
        let mut around = |rotation: DQuat| {
            let half = random.scale(6.0) * random.vector().abs();
            let local = half * random.vector();
            // Grown as swept boxes are, by the coordinates' rounding.
            let grown = half + 4.0 * f64::EPSILON * point.abs().max_element();
            obb(point - rotation * local, rotation, grown)
        };
        let a = around(turned);
        let b = around(turned.inverse());
        assert!(obb_overlap_by_axes(&a, &b), "{a:?} {b:?}");
    }
}

#[test]
fn degenerate_boxes_have_an_answer() {
    let point = |centre| obb(centre, DQuat::IDENTITY, DVec3::ZERO);
    assert!(obb_overlap_by_axes(&point(DVec3::ONE), &point(DVec3::ONE)));
    assert!(!obb_overlap_by_axes(&point(DVec3::ONE), &point(DVec3::X)));
    let plate = obb(DVec3::ZERO, DQuat::IDENTITY, DVec3::new(1.0, 1.0, 0.0));
    assert!(obb_overlap_by_axes(
        &plate,
        &point(DVec3::new(1.0, 1.0, 0.0))
    ));
    assert!(obb_overlap_by_axes(&plate, &plate));
    let nan = obb(DVec3::NAN, DQuat::IDENTITY, DVec3::ONE);
    assert!(obb_overlap_by_axes(&plate, &nan));
    assert!(!obb_overlap_by_rays(&plate, &nan, 8, 1));
    assert!(!obb_overlap_by_rays(&plate, &point(DVec3::ONE), 8, 1));
}

/// Random boxes of like size, overlapping or not.
fn random_pair(random: &mut Random) -> (Obb, Obb) {
    let mut half = || DVec3::splat(0.2) + random.vector().abs();
    let (half_a, half_b) = (half(), half());
    let a = obb(DVec3::ZERO, random.rotation(), half_a);
    let centre = 2.0 * random.vector();
    (a, obb(centre, random.rotation(), half_b))
}

/// Shares of overlaps missed and of separated boxes called overlapping.
fn ray_errors(rays: u32, cases: u32) -> (f64, f64) {
    let mut random = Random::seeded(4);
    let (mut overlaps, mut missed, mut ghosts) = (0_u32, 0_u32, 0_u32);
    for _ in 0..cases {
        let (a, b) = random_pair(&mut random);
        let found = obb_overlap_by_rays(&a, &b, rays, 10);
        if obb_overlap_by_axes(&a, &b) {
            overlaps += 1;
            missed += u32::from(!found);
        } else {
            ghosts += u32::from(found);
        }
    }
    assert!(
        (cases / 4..cases * 3 / 4).contains(&overlaps),
        "lopsided: {overlaps}"
    );
    let share = |part: u32, whole: u32| f64::from(part) / f64::from(whole);
    (share(missed, overlaps), share(ghosts, cases - overlaps))
}

/// The figures in the documentation of `obb_overlap_by_rays`.
#[test]
fn rays_err_as_often_as_documented() {
    let errors = [1, 4, 16, 64, 256].map(|rays| ray_errors(rays, 4_000));
    let documented = [
        (0.57, 0.01),
        (0.32, 0.02),
        (0.18, 0.04),
        (0.08, 0.06),
        (0.04, 0.07),
    ];
    for (measured, documented) in errors.iter().zip(documented) {
        assert!(
            (measured.0 - documented.0).abs() < 0.01,
            "missed: {errors:?}"
        );
        assert!(
            (measured.1 - documented.1).abs() < 0.01,
            "called overlapping: {errors:?}"
        );
    }
}

#[test]
fn coinciding_boxes_are_caught_without_rays() {
    let a = obb(DVec3::ONE, DQuat::IDENTITY, DVec3::ONE);
    assert!(obb_overlap_by_rays(&a, &a, 0, 1));
}

/// A sphere's path, for brute force.
struct Ball {
    path: Vec<DVec3>,
    radius: f64,
}

fn ball(random: &mut Random, spread: f64) -> (Ball, Volume) {
    let radius = random.within(0.1, 1.0);
    let mut point = || spread * random.vector();
    let (from, to) = (point(), point());
    match random.below(6) {
        0..=2 => {
            let sphere = Sphere::new(radius).unwrap();
            let obb = Some(around_static(&sphere.into(), &Pose::at(from)));
            let path = vec![from];
            let moving = false;
            (Ball { path, radius }, Volume { obb, moving })
        }
        3 => {
            let obb = Some(along_line(from, to, DVec3::ZERO, radius));
            let path = (0..=100).map(|i| from.lerp(to, f64::from(i) / 100.0));
            let path = path.collect();
            (Ball { path, radius }, Volume { obb, moving: true })
        }
        kind => {
            let closed = if kind == 4 { from } else { to };
            let points = [
                from,
                spread * random.vector(),
                spread * random.vector(),
                closed,
            ];
            let tangent = spread * random.vector();
            let path = Path::spline(points, tangent, -tangent).unwrap();
            let spline = path.as_spline().unwrap();
            let obb = Some(along_spline(spline, DVec3::ZERO, radius));
            let path = spline.pieces().iter();
            let path = path.flat_map(|piece| (0..=60).map(|i| piece.point(f64::from(i) / 60.0)));
            let path = path.collect();
            (Ball { path, radius }, Volume { obb, moving: true })
        }
    }
}

fn meet(a: &Ball, b: &Ball) -> bool {
    let reach = (a.radius + b.radius).powi(2);
    let near = |p: &DVec3| b.path.iter().any(|q| p.distance_squared(*q) <= reach);
    a.path.iter().any(near)
}

#[test]
fn every_pair_whose_paths_meet_is_listed() {
    let mut random = Random::seeded(5);
    let (balls, volumes): (Vec<_>, Vec<_>) = (0..160)
        .map(|_| ball(&mut random, 12.0))
        .map(|(ball, volume)| (ball, Some(volume)))
        .unzip();
    let pairs = PairList::build(BroadPhase::SweptObb(ObbTest::Axes), &volumes);
    let everything = PairList::build(BroadPhase::AllPairs, &volumes);
    let moving = |slot: usize| volumes[slot].unwrap().moving;
    let (mut meetings, mut possible) = (0, 0);
    for a in 0..balls.len() {
        for b in a + 1..balls.len() {
            let (list, all, pair) = match (moving(a), moving(b)) {
                (false, false) => continue,
                (true, true) => (pairs.dynamic(), everything.dynamic(), (a, b)),
                (true, false) => (pairs.fixed(), everything.fixed(), (a, b)),
                (false, true) => (pairs.fixed(), everything.fixed(), (b, a)),
            };
            let pair = (pair.0 as u32, pair.1 as u32);
            possible += 1;
            assert!(
                all.binary_search(&pair).is_ok(),
                "{pair:?} is not among all"
            );
            if meet(&balls[a], &balls[b]) {
                meetings += 1;
                assert!(list.binary_search(&pair).is_ok(), "{pair:?} is missing");
            }
        }
    }
    assert_eq!(
        everything.dynamic().len() + everything.fixed().len(),
        possible
    );
    let listed = pairs.dynamic().len() + pairs.fixed().len();
    assert!(
        meetings > possible / 50,
        "lopsided: {meetings} of {possible}"
    );
    assert!(listed < possible * 3 / 4, "no use: {listed} of {possible}");
}

fn volume(random: &mut Random) -> Option<Volume> {
    match random.below(20) {
        0..=2 => None,
        3 => Some(Volume {
            obb: None,
            moving: random.below(2) == 0,
        }),
        _ => Some(ball(random, 12.0).1),
    }
}

#[test]
fn updating_gives_the_same_list_as_building_it_anew() {
    let tests = [
        BroadPhase::default(),
        BroadPhase::SweptObb(ObbTest::Rays { rays: 4, seed: 10 }),
        BroadPhase::AllPairs,
    ];
    for (seed, broad_phase) in (6..).zip(tests) {
        let mut random = Random::seeded(seed);
        let mut volumes = Vec::new();
        let mut pairs = PairList::new(broad_phase);
        for _ in 0..150 {
            let mut changed = Vec::new();
            for _ in 0..random.below(6) {
                match random.below(8) {
                    0..=3 => {
                        changed.push(volumes.len() as u32);
                        volumes.push(volume(&mut random));
                    }
                    4 => {
                        changed.push((volumes.len().max(1) - 1) as u32);
                        volumes.pop();
                    }
                    _ if volumes.is_empty() => {}
                    _ => {
                        let slot = random.below(volumes.len());
                        volumes[slot] = volume(&mut random);
                        changed.push(slot as u32);
                    }
                }
            }
            // Named twice, or naming nobody, does no harm.
            changed.extend_from_within(..changed.len() / 2);
            changed.push(u32::MAX);
            pairs.update(&changed, &volumes);
            assert_eq!(pairs, PairList::build(broad_phase, &volumes));
            assert_eq!(pairs.bodies(), volumes.iter().flatten().count());
            for list in [pairs.dynamic(), pairs.fixed()] {
                assert!(list.is_sorted_by(|a, b| a < b), "{list:?}");
            }
        }
        assert!(pairs.bodies() > 20, "lopsided: {} bodies", pairs.bodies());
    }
}

#[test]
fn an_unbounded_volume_pairs_with_everything_but_not_two_that_rest() {
    let free = |moving| Some(Volume { obb: None, moving });
    let far = obb(DVec3::splat(1e12), DQuat::IDENTITY, DVec3::ONE);
    let fixed = Some(Volume {
        obb: Some(far),
        moving: false,
    });
    let nan = Some(Volume {
        obb: Some(obb(DVec3::NAN, DQuat::IDENTITY, DVec3::ONE)),
        moving: true,
    });
    let volumes = [fixed, free(true), None, free(false), nan];
    let pairs = PairList::build(BroadPhase::SweptObb(ObbTest::Axes), &volumes);
    assert_eq!(pairs.dynamic(), [(1, 4)]);
    assert_eq!(pairs.fixed(), [(1, 0), (1, 3), (4, 0), (4, 3)]);
}

/// Every pair with a free body in it whose boxes overlap, once; whatever the order.
#[test]
fn pairs_of_a_frame_are_those_of_brute_force() {
    let mut random = Random::seeded(11);
    let (mut pairs, mut found) = (FramePairs::default(), 0);
    for round in 0..400 {
        let count = 1 + round % 60;
        // Coarse coordinates, so that many boxes begin or end at the same place.
        let coarse = |value: f64| (8.0 * value).round() / 4.0;
        let boxes: Vec<FrameBox> = (0..count)
            .map(|slot| {
                let corner = random.vector().map(coarse);
                let size = random.vector().abs().map(coarse);
                let flight = match slot % 5 {
                    0 => Flight::Fixed,
                    1 => Flight::Path,
                    _ => Flight::Free,
                };
                FrameBox {
                    slot,
                    aabb: Aabb::new(corner, corner + 0.5 * size),
                    flight,
                }
            })
            .collect();
        let mut expected = Vec::new();
        for (index, a) in boxes.iter().enumerate() {
            for b in &boxes[index + 1..] {
                let one_is_free = a.flight == Flight::Free || b.flight == Flight::Free;
                if one_is_free && a.aabb.overlaps(&b.aabb) {
                    let swap = a.flight == Flight::Fixed;
                    expected.push(if swap {
                        (b.slot, a.slot)
                    } else {
                        (a.slot, b.slot)
                    });
                }
            }
        }
        expected.sort_unstable();
        found += expected.len();
        pairs.update(boxes.iter().rev().copied());
        let mut got = pairs.pairs().to_vec();
        got.sort_unstable();
        assert_eq!(got, expected, "round {round}");
    }
    assert!(found > 2_000, "inputs are lopsided: {found} pairs");
}
