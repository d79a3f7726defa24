//! Frames against dense samples of whole motions.

mod bounds;
mod frames;

use crate::curve::Spline;
use crate::motion::{Facing, Motion, Path};
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

    fn decades(&mut self, min: f64, max: f64) -> f64 {
        10_f64.powf(self.within(min, max))
    }

    fn below(&mut self, count: u64) -> u64 {
        self.0.next_u64() % count
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(
            self.within(-1.0, 1.0),
            self.within(-1.0, 1.0),
            self.within(-1.0, 1.0),
        )
    }

    fn direction(&mut self) -> DVec3 {
        self.vector().normalize_or(DVec3::X)
    }

    fn turn(&mut self) -> DQuat {
        DQuat::from_axis_angle(self.direction(), self.within(0.0, 6.0))
    }

    /// A path of size about `size`: straight, bent, closed, with corners or cusps.
    fn path(&mut self, size: f64, place: DVec3) -> Path {
        let count = 2 + self.below(5) as usize;
        let mut points: Vec<DVec3> = (0..count).map(|_| place + size * self.vector()).collect();
        match self.below(5) {
            0 => Path::line(points[0], points[1]).unwrap(),
            1 => {
                points.extend([place - size * self.vector(), points[0]]);
                Path::catmull_rom(points, crate::curve::Knots::Centripetal).unwrap()
            }
            2 => {
                let tangents: Vec<_> = points.iter().map(|_| size * self.vector()).collect();
                Path::spline_with_tangents(points, tangents).unwrap()
            }
            3 => {
                // Standstills in some points, and sharp corners there.
                let tangents: Vec<_> = (0..points.len())
                    .map(|index| if index % 2 == 0 { 0.0 } else { size } * self.vector())
                    .collect();
                Path::spline_with_tangents(points, tangents).unwrap()
            }
            _ => {
                points.extend((0..2 * count).map(|_| place + size * self.vector()));
                points.truncate(3 * count - 2);
                while points.len() < 4 {
                    points.push(place + size * self.vector());
                }
                Spline::bezier(points).unwrap().into()
            }
        }
    }

    /// Any motion of size about `size` and period about a second.
    fn motion(&mut self, size: f64) -> Motion {
        let place = self.decades(-3.0, 3.0) * size * self.vector();
        let motion = match self.below(8) {
            0 => Motion::fixed(place),
            1 => Motion::free(place, size * self.vector()),
            _ => {
                let path = self.path(size, place);
                let speed = path.length() * self.decades(-1.0, 1.0);
                Motion::along(path, speed)
            }
        };
        let mut motion = motion.unwrap();
        if motion.path().is_some() {
            if self.below(3) == 0 {
                motion = motion.back_and_forth().unwrap();
            } else if let Ok(looping) = motion.clone().looping() {
                motion = looping;
            }
            if self.below(2) == 0 {
                motion = motion.starting_after(self.within(0.0, 1.5)).unwrap();
            }
            if self.below(2) == 0 {
                motion = motion.starting_at(self.within(0.0, 2.0) * size).unwrap();
            }
        }
        match self.below(3) {
            0 => motion,
            1 if motion.path().is_some() => {
                let facing = Facing {
                    forward: self.direction(),
                    up: self.direction(),
                    world_up: self.direction(),
                };
                motion.facing(facing).unwrap()
            }
            _ => {
                let point = size * self.vector();
                let rate = self.decades(-1.0, 2.0) * if self.below(2) == 0 { 1.0 } else { -1.0 };
                motion.spin_about(point, self.direction(), rate).unwrap()
            }
        }
    }
}
