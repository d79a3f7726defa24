//! The ten combinations of the thesis's table B.2: either body stands, flies, turns, or does both.
//!
//! Each has an answer in closed form, or one that was put there: the gap is known, and falls
//! all the time until then.

use feeler::{Body, CollisionWorld, Cuboid, Method, Motion, Shape, Sphere, first_contact};
use glam::{DQuat, DVec3};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

const SECONDS: f64 = 1.0;

/// Turned to an angle about z, at a place.
#[derive(Clone, Copy)]
struct Stand {
    at: DVec3,
    angle: f64,
}

/// A velocity, and radians per second about z.
#[derive(Clone, Copy)]
struct Going {
    velocity: DVec3,
    rate: f64,
}

/// The whole scene somewhere, turned somehow.
struct Scene {
    turn: DQuat,
    shift: DVec3,
}

impl Scene {
    fn body(&self, shape: impl Into<Shape>, stand: Stand, going: Going) -> Body {
        let place = self.turn * stand.at + self.shift;
        let motion = if going.velocity == DVec3::ZERO {
            Motion::fixed(place)
        } else {
            Motion::free(place, self.turn * going.velocity)
        };
        let motion = match going.rate {
            0.0 => motion,
            rate => motion.and_then(|motion| motion.spin(self.turn * DVec3::Z, rate)),
        };
        let turned = self.turn * DQuat::from_rotation_z(stand.angle);
        Body::moving(shape, motion.unwrap()).oriented(turned.normalize())
    }

    /// A ball that turns about one of its points, its centre `arm` from there.
    fn orbiting(&self, radius: f64, about: DVec3, arm: DVec3, rate: f64) -> Body {
        let place = self.turn * (about + arm) + self.shift;
        let motion = Motion::fixed(place)
            .and_then(|motion| motion.spin_about(-arm, self.turn * DVec3::Z, rate));
        Body::moving(Sphere::new(radius).unwrap(), motion.unwrap()).oriented(self.turn)
    }
}

struct Case {
    name: &'static str,
    pair: [Body; 2],
    /// Seconds, and the normal in the scene's frame where it is unique.
    touch: Option<(f64, Option<DVec3>)>,
}

const STILL: Going = Going {
    velocity: DVec3::ZERO,
    rate: 0.0,
};

fn flying(velocity: DVec3) -> Going {
    Going {
        velocity,
        rate: 0.0,
    }
}

fn turning(rate: f64) -> Going {
    Going {
        velocity: DVec3::ZERO,
        rate,
    }
}

fn at(x: f64, y: f64) -> Stand {
    Stand {
        at: DVec3::new(x, y, 0.0),
        angle: 0.0,
    }
}

fn cases(scene: &Scene, rate: f64) -> Vec<Case> {
    let cube = Cuboid::new([0.5; 3]).unwrap();
    let wall = Cuboid::new([0.5, 4.0, 4.0]).unwrap();
    let bar = Cuboid::new([2.0, 0.05, 0.05]).unwrap();
    let ball = Sphere::new(0.1).unwrap();
    let right = |speed: f64| DVec3::new(speed, 0.0, 0.0);
    // Half-width of a turned box of half-extents `long` and `short`.
    let wide =
        |long: f64, short: f64, angle: f64| long * angle.cos().abs() + short * angle.sin().abs();
    let along = |angle: f64| DVec3::new(angle.cos(), angle.sin(), 0.0);
    let across = |angle: f64| DVec3::new(-angle.sin(), angle.cos(), 0.0);
    let mut cases = Vec::new();
    let mut case = |name, a, b, touch| {
        cases.push(Case {
            name,
            pair: [a, b],
            touch,
        });
    };

    let gap = 0.3;
    case(
        "stands, stands",
        scene.body(cube, at(0.0, 0.0), STILL),
        scene.body(cube, at(1.0 + gap, 0.2), STILL),
        None,
    );
    case(
        "flies, stands",
        scene.body(cube, at(0.0, 0.0), flying(right(0.7))),
        scene.body(cube, at(1.0 + gap, 0.2), STILL),
        Some((gap / 0.7, Some(DVec3::NEG_X))),
    );
    case(
        "flies, flies",
        scene.body(cube, at(0.0, 0.0), flying(right(0.4))),
        scene.body(
            cube,
            at(1.0 + gap, 0.2),
            flying(DVec3::new(-0.3, 0.1, -0.2)),
        ),
        Some((gap / 0.7, Some(DVec3::NEG_X))),
    );

    // Sweeps up to where the ball's edge lies.
    let until = FRAC_PI_4 - 0.1_f64.asin();
    let place = Stand {
        at: 1.5 * along(FRAC_PI_4),
        angle: 0.0,
    };
    case(
        "turns, stands",
        scene.body(bar, at(0.0, 0.0), turning(rate)),
        scene.body(ball, place, STILL),
        Some((until / rate, Some(-across(until)))),
    );

    // The ball comes down upon the bar that comes up.
    let time = 0.7 / rate;
    let touched = 1.2 * along(0.7) + 0.15 * across(0.7);
    let down = rate * DVec3::new(0.3, -0.8, 0.0);
    let drift = rate * DVec3::new(0.1, 0.2, -0.4);
    for (name, drift) in [
        ("turns, flies", DVec3::ZERO),
        ("flies and turns, flies", drift),
    ] {
        let above = Stand {
            at: touched - time * down,
            angle: 0.0,
        };
        case(
            name,
            scene.body(
                bar,
                at(0.0, 0.0),
                Going {
                    velocity: drift,
                    rate,
                },
            ),
            scene.body(ball, above, flying(down + drift)),
            Some((time, Some(-across(0.7)))),
        );
    }

    // A box that keeps turned as the bar is comes down upon it with its whole face.
    let half = Cuboid::new([0.3, 0.2, 0.1]).unwrap();
    let touched = 1.2 * along(0.7) + 0.25 * across(0.7);
    case(
        "turns, flies and turns",
        scene.body(bar, at(0.0, 0.0), turning(rate)),
        scene.body(
            half,
            Stand {
                at: touched - time * down,
                angle: 0.0,
            },
            Going {
                velocity: down,
                rate,
            },
        ),
        Some((time, Some(-across(0.7)))),
    );

    // A cube tumbles against a wall, faster than its corners come and go.
    let speed = 0.8 * rate;
    let time = 1.1 / rate;
    let far = wide(0.5, 0.5, 1.1) + speed * time;
    case(
        "flies and turns, stands",
        scene.body(
            cube,
            at(0.0, 0.0),
            Going {
                velocity: right(speed),
                rate,
            },
        ),
        scene.body(wall, at(far + 0.5, 0.0), STILL),
        Some((time, Some(DVec3::NEG_X))),
    );

    // Mirror images meet in the mirror: two bars whose ends come up to it, and fly there.
    let angle = FRAC_PI_2 - 1.2;
    for (name, speed) in [
        ("turns, turns", 0.0),
        ("flies and turns, flies and turns", 0.2 * rate),
    ] {
        let time = 1.2 / rate;
        let far = wide(2.0, 0.05, angle) + speed * time;
        let standing = |x: f64| Stand {
            at: DVec3::new(x, 0.0, 0.0),
            angle: FRAC_PI_2,
        };
        let bar = |x: f64, velocity: f64, rate: f64| {
            scene.body(
                bar,
                standing(x),
                Going {
                    velocity: right(velocity),
                    rate,
                },
            )
        };
        case(
            name,
            bar(-far, speed, -rate),
            bar(far, -speed, rate),
            Some((time, None)),
        );
    }

    // Balls on two circles.
    let (radius, arm, apart) = (0.2, 1.0_f64, 1.8);
    let angle = ((0.5 * apart - radius) / arm).acos();
    let until = FRAC_PI_2 - angle;
    case(
        "turns, turns about a point",
        scene.orbiting(
            radius,
            DVec3::new(-0.5 * apart, 0.0, 0.0),
            DVec3::new(0.0, arm, 0.0),
            -rate,
        ),
        scene.orbiting(
            radius,
            DVec3::new(0.5 * apart, 0.0, 0.0),
            DVec3::new(0.0, arm, 0.0),
            rate,
        ),
        Some((until / rate, Some(DVec3::NEG_X))),
    );
    cases
}

fn scenes() -> [Scene; 3] {
    let turn = DQuat::from_axis_angle(DVec3::new(1.0, -2.0, 0.5).normalize(), 2.2);
    [
        Scene {
            turn: DQuat::IDENTITY,
            shift: DVec3::ZERO,
        },
        Scene {
            turn,
            shift: DVec3::new(3.0, -7.0, 2.0),
        },
        Scene {
            turn,
            shift: DVec3::new(9e3, 4e3, -2e3),
        },
    ]
}

#[test]
fn all_combinations_meet_when_they_must() {
    for scene in scenes() {
        // Rounding in the coordinates.
        let slack = 1e-11 + 1e-14 * scene.shift.length();
        for rate in [2.0, 6.0, 31.4] {
            for Case {
                name,
                pair: [a, b],
                touch,
            } in cases(&scene, rate)
            {
                let told = format!("{name} at {rate}, {} off", scene.shift.length());
                let found = first_contact(&a, &b, SECONDS, &Method::Exact).unwrap();
                let Some((time, normal)) = touch else {
                    assert_eq!(found, None, "{told}");
                    continue;
                };
                let found = found.unwrap_or_else(|| panic!("{told}: missed"));
                assert!(found.fraction < 1.0, "{told}");
                let late = found.fraction * SECONDS - time;
                assert!(late.abs() < slack, "{told}: {late:e} late");
                if let Some(normal) = normal {
                    let off = found.normal.distance(scene.turn * normal);
                    assert!(off < 1e-8 + 1e3 * slack, "{told}: normal off by {off:e}");
                }
                let back = first_contact(&b, &a, SECONDS, &Method::Exact).unwrap();
                let back = back.unwrap_or_else(|| panic!("{told}: missed from the other side"));
                assert!((back.fraction - found.fraction).abs() < slack, "{told}");
            }
        }
    }
}

#[test]
fn all_combinations_meet_at_any_frame_rate() {
    for scene in scenes() {
        for Case { name, pair, touch } in cases(&scene, 6.0) {
            for frames in [1_u32, 24, 1000] {
                let mut world = CollisionWorld::default();
                for body in &pair {
                    world.insert(body.clone()).unwrap();
                }
                let mut seen = None;
                for _ in 0..frames {
                    let dt = SECONDS / f64::from(frames);
                    seen = seen.or(world.step(dt).unwrap().first().copied());
                    assert_eq!(world.stats().undecided, 0, "{name}");
                }
                let off = seen.zip(touch).map(|(seen, (time, _))| seen.time - time);
                assert_eq!(seen.is_some(), touch.is_some(), "{name} at {frames} Hz");
                assert!(
                    off.is_none_or(|off| off.abs() < 1e-9),
                    "{name} at {frames} Hz: {off:?}"
                );
            }
        }
    }
}

/// Looked at only as each frame ends, most of them go through each other.
#[test]
fn combinations_tunnel_if_looked_at_now_and_then() {
    let scene = &scenes()[0];
    for Case {
        name,
        pair: [a, b],
        touch,
    } in cases(scene, 31.4)
    {
        if touch.is_none() || !name.contains("turns") {
            continue;
        }
        let steps = (1..=5).map(|step| f64::from(step) * 0.2);
        let clear = steps.filter(|&time| {
            let (pose_a, pose_b) = (a.pose_after(time), b.pose_after(time));
            feeler::overlap(a.shape(), &pose_a, b.shape(), &pose_b).is_none()
        });
        assert!(clear.count() > 0, "{name}");
    }
}
