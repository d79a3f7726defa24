//! Crowds of every kind.

use feeler::{Body, Cuboid, Motion, Path, Polytope, Shape, Sphere};
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

    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.0.next_u64() % count as u64) as usize
    }

    /// Evenly in the cube from −1 to 1.
    pub(crate) fn vector(&mut self) -> DVec3 {
        DVec3::new(
            self.within(-1.0, 1.0),
            self.within(-1.0, 1.0),
            self.within(-1.0, 1.0),
        )
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Crowd {
    Balls,
    Boxes,
    Hulls,
    /// Radii from 1 to 1000.
    Sizes,
    /// All in one hundredth of the space but a few.
    Cluster,
    /// Most do not move.
    Still,
    /// At 1000 m/s.
    Fast,
    /// On paths, and all shapes.
    Mixed,
    /// A few on paths, and all shapes.
    Strays,
    /// Far from the origin.
    Far,
    /// All shapes, freely and on paths, spinning.
    Spinning,
}

impl Crowd {
    pub(crate) const ALL: [Self; 11] = [
        Self::Balls,
        Self::Boxes,
        Self::Hulls,
        Self::Sizes,
        Self::Cluster,
        Self::Still,
        Self::Fast,
        Self::Mixed,
        Self::Strays,
        Self::Far,
        Self::Spinning,
    ];

    /// Some 5 % of a cube filled, whatever the count.
    pub(crate) fn bodies(self, count: usize, random: &mut Random) -> Vec<Body> {
        let half = 0.5 * (12.0 * count as f64).cbrt();
        (0..count)
            .map(|number| self.body(number, half, random))
            .collect()
    }

    fn body(self, number: usize, half: f64, random: &mut Random) -> Body {
        let size = match self {
            Self::Sizes => 2.0 * 10_f64.powf(random.within(-3.0, 0.0)),
            _ => random.within(0.3, 0.7),
        };
        let cuboid = |random: &mut Random| {
            let half = size * (DVec3::splat(0.6) + 0.3 * random.vector());
            Shape::from(Cuboid::new(half).unwrap())
        };
        let hull = |random: &mut Random| {
            let points: Vec<DVec3> = (0..12)
                .map(|_| size * random.vector().normalize())
                .collect();
            Shape::from(Polytope::from_points(points).unwrap())
        };
        let shape = match (self, number % 3) {
            (Self::Boxes, _) | (Self::Mixed | Self::Strays | Self::Still | Self::Spinning, 1) => {
                cuboid(random)
            }
            (Self::Hulls, _) | (Self::Mixed | Self::Strays | Self::Spinning, 2) => hull(random),
            _ => Sphere::new(size).unwrap().into(),
        };
        let place = match self {
            Self::Cluster if !number.is_multiple_of(10) => 0.5 * half * random.vector() - half,
            Self::Far => half * random.vector() + DVec3::new(3e8, -2e7, 5e5),
            _ => half * random.vector(),
        };
        let speed = if self == Self::Fast { 1000.0 } else { 10.0 };
        let velocity = speed * random.unit() * random.vector().normalize();
        let motion = match (self, number % 4) {
            (Self::Still, _) if !number.is_multiple_of(100) => Motion::fixed(place).unwrap(),
            (Self::Strays, _) if !number.is_multiple_of(20) => {
                Motion::free(place, velocity).unwrap()
            }
            (Self::Mixed, 0) | (Self::Spinning, 3) => {
                let path = Path::line(place, place + velocity).unwrap();
                Motion::along(path, 6.0).unwrap()
            }
            (Self::Mixed, 1) | (Self::Strays, _) => {
                let points = [place, place + random.vector(), place + velocity];
                let path = Path::spline(points, random.vector(), random.vector()).unwrap();
                Motion::along(path, 20.0).unwrap()
            }
            _ => Motion::free(place, velocity).unwrap(),
        };
        let motion = match self {
            Self::Spinning => {
                let rate = random.within(-20.0, 20.0);
                motion.spin(random.vector().normalize(), rate).unwrap()
            }
            _ => motion,
        };
        let axis = random.vector().normalize();
        let turn = DQuat::from_axis_angle(axis, random.within(0.0, 6.0));
        Body::moving(shape, motion).oriented(turn)
    }
}
