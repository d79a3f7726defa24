//! Random scenes, and short names for what every test writes.

use feeler::{
    Body, BroadPhase, CollisionWorld, Cuboid, Method, Motion, Polytope, RayConfig, Shape, Sphere,
    Triangle, WorldConfig,
};
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

    /// Evenly over the decades between two powers of ten.
    pub(crate) fn decades(&mut self, min: f64, max: f64) -> f64 {
        10_f64.powf(self.within(min, max))
    }

    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.0.next_u64() % count as u64) as usize
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

    pub(crate) fn shape(&mut self, kind: Kind, size: f64) -> Shape {
        let half = |x: f64, y: f64, z: f64| Cuboid::new(size * DVec3::new(x, y, z)).unwrap();
        match kind {
            Kind::Ball => Sphere::new(size).unwrap().into(),
            Kind::Box => half(
                self.within(0.3, 1.0),
                self.within(0.3, 1.0),
                self.within(0.3, 1.0),
            )
            .into(),
            Kind::Needle => half(0.02, 0.02, 1.0).into(),
            Kind::Slab => half(1.0, 1.0, 0.02).into(),
            Kind::Hull => {
                let points: Vec<_> = (0..12).map(|_| size * self.direction()).collect();
                Polytope::from_points(points).unwrap().into()
            }
            Kind::Triangle => {
                let corner = |random: &mut Self| size * random.direction();
                loop {
                    let corners = [corner(self), corner(self), corner(self)];
                    let area = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
                    if area.length() > 0.05 * size * size {
                        return Triangle::new(corners[0], corners[1], corners[2])
                            .unwrap()
                            .into();
                    }
                }
            }
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Ball,
    Box,
    Needle,
    Slab,
    Hull,
    Triangle,
}

impl Kind {
    pub(crate) const ALL: [Self; 6] = [
        Self::Ball,
        Self::Box,
        Self::Needle,
        Self::Slab,
        Self::Hull,
        Self::Triangle,
    ];
}

pub(crate) fn ball(radius: f64) -> Shape {
    Sphere::new(radius).unwrap().into()
}

pub(crate) fn cuboid(x: f64, y: f64, z: f64) -> Shape {
    Cuboid::new([x, y, z]).unwrap().into()
}

pub(crate) fn free(position: impl Into<DVec3>, velocity: impl Into<DVec3>) -> Motion {
    Motion::free(position, velocity).unwrap()
}

pub(crate) fn flying(
    shape: &Shape,
    position: impl Into<DVec3>,
    velocity: impl Into<DVec3>,
) -> Body {
    Body::moving(shape.clone(), free(position, velocity))
}

pub(crate) fn world_with(rays: RayConfig, broad_phase: BroadPhase) -> CollisionWorld {
    CollisionWorld::new(WorldConfig {
        method: Method::Rays(rays),
        broad_phase,
    })
    .unwrap()
}
