//! However a body is said to move, its contacts are the same.

use feeler::{Body, Cuboid, Method, Motion, PairContact, Path, Shape, Sphere, first_contact};
use glam::{DQuat, DVec3};

fn arch() -> Path {
    Path::bezier([
        [-2.0, 2.0, 0.0],
        [-2.0, -2.0, 0.1],
        [2.0, -2.0, 0.0],
        [2.0, 2.0, 0.3],
    ])
    .unwrap()
}

fn contact(a: &Body, b: &Body) -> PairContact {
    let found = first_contact(a, b, 1.0, &Method::Exact).unwrap();
    found.unwrap()
}

fn alike(found: &PairContact, want: &PairContact, place: &str) {
    assert!(
        (found.fraction - want.fraction).abs() < 1e-11,
        "{place}: {found:?} {want:?}"
    );
    assert!(
        found.point.distance(want.point) < 1e-9,
        "{place}: {found:?} {want:?}"
    );
    assert!(
        found.normal.distance(want.normal) < 1e-9,
        "{place}: {found:?} {want:?}"
    );
}

fn shapes() -> [Shape; 2] {
    [
        Cuboid::new([0.5, 0.3, 0.4]).unwrap().into(),
        Sphere::new(0.4).unwrap().into(),
    ]
}

#[test]
fn a_spin_of_rate_zero_is_none() {
    for first in shapes() {
        for second in shapes() {
            let turned = DQuat::from_euler(glam::EulerRot::XYZ, 0.3, 0.5, 0.7);
            let motion = Motion::along(arch(), 8.0).unwrap();
            let still = motion.clone().spin(DVec3::Z, 0.0).unwrap();
            let target = Body::fixed(second.clone(), [0.1, -1.0, 0.1]).oriented(turned);
            let body = |motion: Motion| Body::moving(first.clone(), motion).oriented(turned);
            let place = format!("{first:?} {second:?}");
            let (found, want) = (
                contact(&body(still), &target),
                contact(&body(motion), &target),
            );
            alike(&found, &want, &place);
        }
    }
}

#[test]
fn exchanging_the_bodies_turns_the_normal() {
    for first in shapes() {
        for second in shapes() {
            let on_curve = Body::moving(first.clone(), Motion::along(arch(), 8.0).unwrap());
            let spun = Motion::along(arch(), 8.0).unwrap();
            let spun = Body::moving(first.clone(), spun.spin([1.0, 2.0, 0.5], 1.5).unwrap());
            let way = Motion::free([0.2, -2.0, 0.1], [0.0, 1.5, 0.0]).unwrap();
            let fixed = Body::fixed(second.clone(), [0.1, -1.0, 0.1]);
            let flying = Body::moving(second.clone(), way);
            for a in [&on_curve, &spun] {
                for b in [&fixed, &flying] {
                    let (found, other) = (contact(a, b), contact(b, a));
                    let turned = PairContact {
                        normal: -other.normal,
                        ..other
                    };
                    alike(&found, &turned, &format!("{first:?} {second:?}"));
                }
            }
        }
    }
}
