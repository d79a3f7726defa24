//! Drawn casts against the oracle.

use crate::check::{Checked, check, size};
use crate::draw::{Cast, Draw, KINDS};
use feeler::narrow_phase::exact::{crossing, touch};
use feeler::{Pose, Shape, Sphere};
use glam::{DQuat, DVec3};

/// `casts`, or so many times as many as the environment's `CASTS` says: a hunt.
fn effort(casts: usize) -> usize {
    casts * std::env::var("CASTS").map_or(1, |times| times.parse::<usize>().unwrap())
}

/// Seeds moved on by the environment's `SEED`, for fresh casts.
fn seed(seed: u64) -> u64 {
    seed + 1000 * std::env::var("SEED").map_or(0, |shift| shift.parse::<u64>().unwrap())
}

/// Checks `count` casts; how many hit, and how many of those had one feature to tell.
fn run(name: &str, count: usize, mut make: impl FnMut(usize) -> Cast) -> (usize, usize) {
    let (mut hits, mut unique, mut gap, mut turn) = (0, 0, 0.0_f64, 0.0_f64);
    for index in 0..count {
        let Checked {
            hit,
            gap: left,
            turn: turned,
            unique: one,
        } = check(&make(index));
        hits += usize::from(hit);
        unique += usize::from(one);
        (gap, turn) = (gap.max(left), turn.max(turned));
    }
    println!("{name}: {hits} hits, {unique} features of {count}; gap {gap:.1e}, normal {turn:.1e}");
    assert!(
        (count * 3 / 10..count).contains(&hits),
        "{name}: inputs are lopsided: {hits} hits of {count}"
    );
    (hits, unique)
}

fn casts(share: usize) {
    for (kind, name) in KINDS.into_iter().enumerate() {
        let mut draw = Draw::new(seed(kind as u64));
        let count = share / if kind < 6 { 1 } else { 2 };
        let mut shape = (draw.shape(kind, 1.0), 1.0);
        let (hits, unique) = run(name, count, |index| {
            if index % 16 == 0 {
                let scale = draw.log(1e-3, 1e3);
                shape = (draw.shape(kind, scale), scale);
            }
            let distance = shape.1 * 10.0 * (draw.unit() - 0.2);
            draw.cast(shape.0.clone(), shape.1, distance)
        });
        assert!(
            10 * unique >= 7 * hits,
            "{name}: {unique} features of {hits} hits"
        );
    }
}

#[test]
fn drawn_casts_agree_with_the_oracle() {
    casts(effort(2_000));
}

fn hulls(casts: usize) {
    for count in [4, 12, 100, 1000] {
        let mut draw = Draw::new(seed(count as u64));
        let casts = (casts / count).max(30);
        let mut shape: Option<Shape> = None;
        run(&format!("hull of {count}"), casts, |index| {
            if index % 32 == 0 {
                shape = None;
            }
            let shape = shape.get_or_insert_with(|| {
                let stretch = DVec3::splat(0.2) + draw.cube().abs();
                draw.hull(count, stretch).into()
            });
            draw.cast(shape.clone(), 1.0, 3.0)
        });
    }
}

#[test]
fn hulls_of_all_sizes_agree_with_the_oracle() {
    hulls(effort(10_000));
}

/// Ten kilometres away the coordinates are coarser; nothing worse may come of it.
#[test]
fn casts_from_afar_agree_with_the_oracle() {
    for (kind, name) in KINDS.into_iter().enumerate() {
        let mut draw = Draw::new(seed(100 + kind as u64));
        run(name, effort(300), |_| {
            let shape = draw.shape(kind, 1.0);
            let mut cast = draw.cast(shape, 1.0, 0.0);
            cast.motion = 2e4 * cast.motion.normalize();
            cast.position -= 0.5 * cast.motion;
            cast
        });
    }
}

/// Lines aimed to touch and no more, a little nearer and a little further off.
fn grazes(count: usize) {
    for (kind, name) in KINDS.into_iter().enumerate() {
        let mut draw = Draw::new(seed(200 + kind as u64));
        run(name, count, |index| {
            let shape = draw.shape(kind, 1.0);
            let mut cast = draw.cast(shape.clone(), 1.0, 0.0);
            let mut aside = cast.motion.cross(draw.direction()).normalize_or(DVec3::X);
            if index % 3 == 0 {
                // Past an edge or a face that lies along an axis.
                aside = cast.orientation * DVec3::AXES[draw.below(3)];
                cast.motion = aside.cross(cast.motion);
            }
            let off = [
                0.0, 1e-15, -1e-15, 1e-12, -1e-12, 1e-9, -1e-9, 3e-9, -1e-6, -0.01,
            ];
            let reach = cast.ball.radius() + off[index % 10] * size(&cast);
            let summit = Draw::summit(&shape, cast.orientation.conjugate() * aside);
            let middle = cast.orientation * summit + reach * aside;
            cast.position = middle - 3.0 * draw.unit() * cast.motion;
            cast
        });
    }
}

#[test]
fn grazes_agree_with_the_oracle() {
    grazes(effort(300));
}

/// Balls of a thousandth of the shape and a thousand times as large.
#[test]
fn balls_of_any_size_agree_with_the_oracle() {
    for (kind, name) in KINDS.into_iter().enumerate() {
        let mut draw = Draw::new(seed(300 + kind as u64));
        run(name, effort(300), |_| {
            let shape = draw.shape(kind, 1.0);
            let mut cast = draw.cast(shape.clone(), 1.0, 0.0);
            let radius = draw.log(1e-3, 1e3);
            cast.ball = Sphere::new(radius).unwrap();
            let aside = cast.motion.cross(draw.direction()).normalize_or(DVec3::X);
            let target = cast.orientation * draw.target(&shape);
            cast.position = target + 1.5 * draw.unit() * radius * aside;
            cast.position -= radius * cast.motion.normalize();
            cast
        });
    }
}

/// Through bodies as thin as a ball, faces are come upon from behind: a search that steps from
/// neighbour to neighbour once stopped there, an edge too far.
#[test]
fn thin_hulls_agree_with_the_oracle() {
    let mut draw = Draw::new(seed(400));
    let mut shape: Option<Shape> = None;
    run("thin hull", effort(3_000), |index| {
        if index % 8 == 0 {
            shape = None;
        }
        let shape = shape.get_or_insert_with(|| {
            let thin = draw.log(1e-3, 1e-1);
            draw.hull(20, DVec3::new(1.0, 1.0, thin)).into()
        });
        let mut cast = draw.cast(shape.clone(), 1.0, 0.0);
        cast.ball = Sphere::new(draw.log(1e-3, 0.3)).unwrap();
        cast.position -= 5.0 * draw.unit() * cast.motion;
        cast
    });
}

/// `touch` has a way of its own for two balls in the usual case, and what it says is the same to the bit.
#[test]
fn two_balls_touch_as_their_crossing_begins() {
    let mut draw = Draw::new(seed(500));
    let (mut hits, mut misses) = (0, 0);
    for index in 0..effort(40_000) {
        let radii = [draw.log(1e-3, 1e3), draw.log(1e-3, 1e3)];
        let reach = radii[0] + radii[1];
        let way = draw.direction();
        let aside = way.cross(draw.direction()).normalize_or(DVec3::X);
        // Anywhere, a graze to some ulp, from touch to some ulp, or from very far.
        let share = match index % 4 {
            1 => 1.0 + 1e-15 * draw.log(1e-1, 1e3) * (draw.unit() - 0.5),
            _ => 1.3 * draw.unit(),
        };
        let back = match index % 4 {
            2 => (1.0 - share * share).max(0.0).sqrt() * (1.0 + 1e-13 * (draw.unit() - 0.5)),
            3 => draw.log(1e0, 1e12),
            _ => draw.log(1e-2, 1e2),
        };
        let sense = if draw.unit() < 0.1 { -1.0 } else { 1.0 };
        let start = reach * (share * aside - back * way);
        let length = reach * sense * draw.log(1e-6, 1e6);
        let extreme = if draw.unit() < 0.05 { 1e-60 } else { 1.0 };
        let motion = length * extreme * way;
        let (at, turn) = (draw.log(1e-3, 1e3) * draw.direction(), draw.direction().x);
        let [a, b] = radii.map(|radius| Shape::from(Sphere::new(radius).unwrap()));
        let (pose_a, pose_b) = (
            Pose::at(at + start),
            Pose::new(at, DQuat::from_rotation_x(turn)),
        );
        let enter = crossing(&a, &pose_a, &b, &pose_b, motion).map(|crossing| crossing.enter);
        assert_eq!(
            touch(&a, &pose_a, &b, &pose_b, motion),
            enter,
            "{radii:?} {start} {motion}"
        );
        if let Some(enter) = enter {
            assert!(
                (enter.normal.length() - 1.0).abs() < 2e-15,
                "{}",
                enter.normal.length() - 1.0
            );
            hits += 1;
        } else {
            misses += 1;
        }
    }
    assert!(hits > 10_000 && misses > 5_000, "{hits} {misses}");
}
