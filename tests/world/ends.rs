//! Paths: where they end, and where they bend.

use crate::support::{Random, ball, cuboid, flying};
use feeler::{Body, CollisionWorld, Contact, Motion, Path, Spline};
use glam::DVec3;

fn along(path: &Path, speed: f64) -> Motion {
    Motion::along(path.clone(), speed).unwrap()
}

fn run(bodies: &[Body], frames: usize, dt: f64) -> Vec<Contact> {
    let mut world = CollisionWorld::default();
    for body in bodies {
        world.insert(body.clone()).unwrap();
    }
    let mut touches = Vec::new();
    for _ in 0..frames {
        let contacts = world.step(dt).unwrap();
        touches.extend(contacts.iter().copied().filter(Contact::is_touch));
    }
    touches
}

#[test]
fn who_rests_at_the_end_of_a_path_is_hit_there_whatever_the_frames() {
    // It rests at 0.37 s, 1 m short of the other, which comes at 1 m/s.
    let line = Path::line([-3.0, 0.0, 0.0], [-2.26, 0.0, 0.0]).unwrap();
    let bend = Path::spline(
        [[-3.0, 0.0, 0.0], [-2.26, 0.0, 0.0]],
        [0.0, 1.0, 0.0],
        [1.0, 0.0, 0.0],
    )
    .unwrap();
    for path in [line, bend] {
        let a = Body::moving(ball(0.5), along(&path, path.length() / 0.37));
        let b = flying(&cuboid(0.5, 0.5, 0.5), [0.0; 3], [-1.0, 0.0, 0.0]);
        for (frames, dt) in [(1, 5.0), (5, 1.0), (120, 1.0 / 24.0), (500, 0.01)] {
            let touches = run(&[a.clone(), b.clone()], frames, dt);
            assert_eq!(touches.len(), 1);
            assert!((touches[0].time - 1.26).abs() < 1e-9, "{touches:?}");
            assert!(touches[0].point.distance([-1.76, 0.0, 0.0].into()) < 1e-9);
        }
    }
}

#[test]
fn both_may_come_to_rest_in_one_frame() {
    let path = |from: f64, to: f64| Path::line([from, 0.0, 0.0], [to, 0.0, 0.0]).unwrap();
    // They rest at 1 s and 2 s, in touch exactly, or a little into each other.
    for (end, touches) in [(1.01, 0), (1.0, 1), (0.9, 1)] {
        let a = Body::moving(ball(0.5), along(&path(-3.0, 0.0), 3.0));
        let b = Body::moving(ball(0.5), along(&path(end + 4.0, end), 2.0));
        for (frames, dt) in [(1, 4.0), (40, 0.1)] {
            let found = run(&[a.clone(), b.clone()], frames, dt);
            assert_eq!(found.len(), touches, "{end} {found:?}");
            for contact in found {
                assert!((contact.time - (2.0 - 0.5 * (1.0 - end))).abs() < 1e-9);
            }
        }
    }
}

/// The first time a ball on a path is as near to a standing ball as their radii, by
/// dense samples and bisection.
fn sampled(path: &Path, speed: f64, target: DVec3, reach: f64) -> (Option<f64>, f64) {
    let gap = |time: f64| path.position_at(speed * time).distance(target) - reach;
    let end = path.length() / speed;
    let samples = 4000;
    let (mut before, mut least) = (0.0, f64::INFINITY);
    for sample in 1..=samples {
        let time = end * f64::from(sample) / f64::from(samples);
        let here = gap(time);
        least = least.min(here);
        if here <= 0.0 {
            let (mut low, mut high) = (before, time);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if gap(middle) > 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            return (Some(high), least);
        }
        before = time;
    }
    (None, least)
}

#[test]
fn balls_on_splines_meet_when_samples_say_so_in_long_frames_and_short() {
    let mut random = Random::seeded(11);
    let (mut hits, mut worst) = (0, 0.0_f64);
    let casts = 150;
    for case in 0..casts {
        let mut points: Vec<_> = (0..3 + random.below(4))
            .map(|_| 4.0 * random.vector())
            .collect();
        if case % 5 == 0 {
            points.push(points[0]);
        }
        let tangents: Vec<_> = points
            .iter()
            .map(|_| 8.0 * random.vector() * random.within(0.0, 1.0))
            .collect();
        let path = Path::from(Spline::with_tangents(points, tangents).unwrap());
        let (ra, rb) = (random.decades(-2.0, 0.0), random.decades(-0.7, 0.2));
        let target = 1.5 * random.vector();
        if path.start().distance(target) < 1.01 * (ra + rb) {
            continue;
        }
        let speed = path.length() / 10.0;
        let (want, least) = sampled(&path, speed, target, ra + rb);
        let bodies = [
            Body::moving(ball(ra), along(&path, speed)),
            Body::fixed(ball(rb), target),
        ];
        for (frames, dt) in [(1, 10.0), (240, 1.0 / 24.0), (1000, 0.01)] {
            let got = run(&bodies, frames, dt);
            // Within the chords' tolerance either is right.
            let doubt = 4e-6 * (ra + rb);
            let Some(want) = want else {
                assert!(got.is_empty() || least < doubt, "{case}: a ghost");
                continue;
            };
            hits += 1;
            // Chords cut corners by a millionth: ghosts may come, deep hits not go.
            assert!(!got.is_empty(), "{case}: missed, {dt}");
            let place = path.position_at(speed * got[0].time);
            let gap = (place.distance(target) - ra - rb).abs();
            worst = worst.max(gap / (ra + rb));
            assert!(gap < doubt, "{case}, {dt}: {gap:e}");
            assert!(got[0].time <= want + 0.02, "{case}: {} {want}", got[0].time);
        }
    }
    println!("{hits} hits, off by {worst:e} of the size at worst");
    assert!((60..=3 * casts - 60).contains(&hits), "lopsided: {hits}");
}

#[test]
fn a_cusp_and_a_loop_are_followed() {
    // Out and back on itself, with a cusp at x = 2.
    let points = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 0.0]];
    let tangents = [[3.0, 0.0, 0.0], [0.0; 3], [-3.0, 0.0, 0.0]];
    let path = Path::from(Spline::with_tangents(points, tangents).unwrap());
    for beyond in [1.9, 1.999, 1.999_999] {
        let target = Body::fixed(ball(0.5), [beyond + 1.0, 0.0, 0.0]);
        let body = Body::moving(ball(0.5), along(&path, 1.0));
        for (frames, dt) in [(1, 4.0), (100, 0.04)] {
            let found = run(&[body.clone(), target.clone()], frames, dt);
            assert!(!found.is_empty(), "{beyond}");
            assert!((found[0].time - beyond).abs() < 3e-6, "{found:?}");
        }
    }
    // A round trip in one frame: it ends where it began.
    let ring: Vec<_> = (0..=8)
        .map(|i| f64::from(i) * std::f64::consts::FRAC_PI_4)
        .map(|angle| [angle.cos() - 1.0, angle.sin(), 0.0])
        .collect();
    let path = Path::spline(ring, [0.0, 0.8, 0.0], [0.0, 0.8, 0.0]).unwrap();
    let body = Body::moving(ball(0.1), along(&path, 1.0));
    let far_side = Body::fixed(ball(0.1), [-2.1, 0.0, 0.0]);
    assert_eq!(run(&[body, far_side], 1, path.length()).len(), 1);
}

#[test]
fn two_bodies_on_curves_meet_as_samples_say() {
    let mut random = Random::seeded(12);
    let mut hits = 0;
    for case in 0..60 {
        let mut path = || {
            let points: Vec<_> = (0..4).map(|_| 2.0 * random.vector()).collect();
            Path::spline(points, 3.0 * random.vector(), 3.0 * random.vector()).unwrap()
        };
        let paths = [path(), path()];
        let reach = 0.6;
        let at = |time: f64| [0, 1].map(|i: usize| paths[i].position_at(time));
        let gap = |time: f64| at(time)[0].distance(at(time)[1]) - reach;
        if gap(0.0) < 0.01 {
            continue;
        }
        let want = (0..8000)
            .map(|sample| f64::from(sample) * 1e-3)
            .find(|&time| gap(time) < 0.0);
        let bodies = [0, 1].map(|i: usize| Body::moving(ball(0.3), along(&paths[i], 1.0)));
        for (frames, dt) in [(1, 8.0), (80, 0.1)] {
            let got = run(&bodies, frames, dt);
            if let Some(want) = want {
                hits += 1;
                let got = got.first().unwrap_or_else(|| panic!("{case}: missed"));
                assert!(gap(got.time).abs() < 4e-6 && got.time < want + 2e-3);
            } else if let Some(got) = got.first() {
                assert!(gap(got.time).abs() < 4e-6, "{case}: a ghost");
            }
        }
    }
    assert!((20..110).contains(&hits), "lopsided: {hits}");
}

/// Two that follow each other closely for a million kilometres in one frame.
#[test]
fn a_frame_of_a_year_on_a_long_winding_path_ends() {
    let points: Vec<_> = (0..200)
        .map(|i| [1e4 * f64::from(i), 5e3 * f64::from(i % 2), 0.0])
        .collect();
    for beside in [2e-3, 3e-9] {
        let bodies = [0.0, beside].map(|z| {
            let points = points.iter().map(|&[x, y, _]| [x, y, z]);
            let path = Path::spline(points, [1e4, 0.0, 0.0], [1e4, 0.0, 0.0]).unwrap();
            Body::moving(ball(beside / 2.1), along(&path, 1.0))
        });
        let mut world = CollisionWorld::default();
        for body in bodies {
            world.insert(body).unwrap();
        }
        world.step(3e7).unwrap();
        assert!(world.stats().stretches < 200_000, "{:?}", world.stats());
    }
}
