//! Random bodies.

use feeler::{Body, Cuboid, Facing, Knots, Motion, Path, Polytope, Shape, Sphere, Triangle};
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

pub(crate) struct Random(ChaCha8Rng);

impl Random {
    pub(crate) fn seeded(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    pub(crate) fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn within(&mut self, min: f64, max: f64) -> f64 {
        min + (max - min) * self.unit()
    }

    pub(crate) fn decades(&mut self, min: f64, max: f64) -> f64 {
        10_f64.powf(self.within(min, max))
    }

    pub(crate) fn below(&mut self, count: u64) -> u64 {
        self.0.next_u64() % count
    }

    pub(crate) fn vector(&mut self) -> DVec3 {
        DVec3::new(
            self.within(-1.0, 1.0),
            self.within(-1.0, 1.0),
            self.within(-1.0, 1.0),
        )
    }

    pub(crate) fn direction(&mut self) -> DVec3 {
        loop {
            let vector = self.vector();
            if (0.1..=1.0).contains(&vector.length()) {
                return vector.normalize();
            }
        }
    }

    pub(crate) fn turn(&mut self) -> DQuat {
        DQuat::from_axis_angle(self.direction(), self.within(0.0, 6.0))
    }

    fn shape(&mut self, size: f64) -> Shape {
        match self.below(6) {
            0 => Sphere::new(size).unwrap().into(),
            1 => {
                let half = DVec3::splat(0.2) + 0.8 * self.vector().abs();
                Cuboid::new(size * half).unwrap().into()
            }
            2 => Cuboid::new(size * DVec3::new(1.0, 0.03, 0.03))
                .unwrap()
                .into(),
            3 => Cuboid::new(size * DVec3::new(1.0, 0.7, 0.03))
                .unwrap()
                .into(),
            4 => {
                let points: Vec<_> = (0..10).map(|_| size * self.direction()).collect();
                Polytope::from_points(points).unwrap().into()
            }
            _ => loop {
                let [a, b, c] = [self.direction(), self.direction(), self.direction()];
                if (b - a).cross(c - a).length() > 0.1 {
                    return Triangle::new(size * a, size * b, size * c).unwrap().into();
                }
            },
        }
    }
}

/// Two bodies that may meet.
pub(crate) struct Draw {
    pub(crate) a: Body,
    pub(crate) b: Body,
    pub(crate) horizon: f64,
    pub(crate) size: f64,
    /// Faster than any of their points approach each other.
    pub(crate) speed: f64,
}

impl Draw {
    pub(crate) fn new(random: &mut Random) -> Self {
        let scale = random.decades(-3.0, 3.0);
        let horizon = random.decades(-2.0, 2.0);
        let far = match random.below(4) {
            0 => scale * random.decades(0.0, 4.0) * random.direction(),
            _ => DVec3::ZERO,
        };
        let sizes = [
            scale * random.decades(-0.7, 0.0),
            scale * random.decades(-0.7, 0.0),
        ];
        let mut speed = 0.0;
        let mut body = |random: &mut Random, side: f64, size: f64| {
            let place = |random: &mut Random| {
                far + scale * (2.0 * side * random.vector().abs() + 1.2 * random.vector())
            };
            let from = place(random);
            let mut motion = match random.below(5) {
                0 => Motion::fixed(from).unwrap(),
                1 => {
                    let way = far + 0.8 * scale * random.vector() - from;
                    let rate = random.decades(-0.3, 0.5) / horizon;
                    speed += way.length() * rate;
                    Motion::free(from, rate * way).unwrap()
                }
                kind => {
                    let mut points = vec![from];
                    for _ in 0..random.below(4) + 1 {
                        points.push(far + 1.3 * scale * random.vector());
                    }
                    let path = if kind == 2 {
                        let tangent = |random: &mut Random| 4.0 * scale * random.vector();
                        Path::spline(points, tangent(random), tangent(random)).unwrap()
                    } else {
                        points.push(from);
                        Path::catmull_rom(points, Knots::Centripetal).unwrap()
                    };
                    let pace = path.length() * random.decades(-0.3, 0.3) / horizon;
                    speed += pace;
                    let motion = Motion::along(path, pace).unwrap();
                    match (kind, random.below(3)) {
                        (_, 0) => motion.back_and_forth().unwrap(),
                        (3, _) => motion.looping().unwrap(),
                        _ => motion,
                    }
                }
            };
            let shape = random.shape(size);
            let rate = random.decades(-1.0, 1.5) / horizon;
            match random.below(5) {
                0 | 1 => {
                    speed += rate * size;
                    motion = motion.spin(random.direction(), rate).unwrap();
                }
                2 => {
                    let point = 0.5 * size * random.vector();
                    speed += 2.0 * rate * size;
                    motion = motion.spin_about(point, random.direction(), -rate).unwrap();
                }
                3 if motion.path().is_some_and(|path| !path.is_straight())
                    && random.below(3) == 0 =>
                {
                    speed += 100.0 * scale / horizon;
                    let facing = Facing {
                        forward: DVec3::X,
                        up: DVec3::Z,
                        world_up: DVec3::Z,
                    };
                    motion = motion.facing(facing).unwrap();
                }
                _ => {}
            }
            Body::moving(shape, motion).oriented(random.turn())
        };
        let a = body(random, 1.0, sizes[0]);
        let b = body(random, -1.0, sizes[1]);
        Self {
            a,
            b,
            horizon,
            size: sizes[0] + sizes[1],
            speed: 1.01 * speed + 1e-9 * scale / horizon,
        }
    }
}
