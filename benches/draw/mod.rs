//! Casts as a world meets them: many shapes, drawn and placed at random, each body turned,
//! about half of them hits.

use feeler::{Cuboid, Polytope, Pose, Shape, Sphere, Triangle};
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// How many casts there are of each kind: more than a branch predictor learns by heart, few
/// enough that all stay in the cache. A power of two.
pub(crate) const COUNT: usize = 1024;

/// A point or a ball of this radius moves by `motion` from `position`.
pub(crate) struct Cast {
    pub(crate) radius: f64,
    pub(crate) position: DVec3,
    pub(crate) shape: Shape,
    pub(crate) pose: Pose,
    pub(crate) motion: DVec3,
}

pub(crate) struct Draw(ChaCha8Rng);

impl Draw {
    pub(crate) fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        let unit = (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        low + (high - low) * unit
    }

    fn vector(&mut self, low: f64, high: f64) -> DVec3 {
        DVec3::from_array([(); 3].map(|()| self.between(low, high)))
    }

    fn direction(&mut self) -> DVec3 {
        loop {
            let vector = self.vector(-1.0, 1.0);
            if (0.01..1.0).contains(&vector.length_squared()) {
                return vector.normalize();
            }
        }
    }

    fn orientation(&mut self) -> DQuat {
        loop {
            let [x, y, z, w] = [(); 4].map(|()| self.between(-1.0, 1.0));
            let quaternion = DQuat::from_xyzw(x, y, z, w);
            if (0.01..1.0).contains(&quaternion.length_squared()) {
                return quaternion.normalize();
            }
        }
    }

    /// A shape of this name; none if there is no such.
    fn shape(&mut self, name: &str) -> Option<Shape> {
        Some(match name {
            "ball" => Sphere::new(self.between(0.3, 1.0)).ok()?.into(),
            "box" => Cuboid::new(self.vector(0.3, 1.0)).ok()?.into(),
            "triangle" => {
                let corners = [(); 3].map(|()| self.direction());
                Triangle::new(corners[0], corners[1], corners[2])
                    .ok()?
                    .into()
            }
            _ => {
                let count: usize = name.strip_prefix("hull")?.parse().ok()?;
                let axes = self.vector(0.5, 1.0);
                let points: Vec<DVec3> = (0..count).map(|_| axes * self.direction()).collect();
                Polytope::from_points(points).ok()?.into()
            }
        })
    }

    /// Casts of balls, or of points, at shapes of one kind.
    ///
    /// They start well apart and fly past or into the shape; some motions end before they
    /// would touch.
    pub(crate) fn casts(&mut self, name: &str, balls: bool) -> Vec<Cast> {
        let variety = if name.len() > 6 { 16 } else { 256 };
        let shapes: Vec<Shape> = (0..variety).filter_map(|_| self.shape(name)).collect();
        let casts = (0..COUNT).map(|number| {
            let shape = shapes[number % shapes.len()].clone();
            let radius = if balls { self.between(0.3, 1.0) } else { 0.0 };
            let reach = radius + shape.centre().length() + shape.max_dist();
            let towards = self.direction();
            let across = DQuat::from_axis_angle(towards, self.between(0.0, 6.3))
                * towards.any_orthonormal_vector();
            let aside = 1.15 * reach * self.between(0.0, 1.0).sqrt();
            let distance = reach * self.between(1.5, 4.0);
            let pose = Pose::new(self.vector(-5.0, 5.0), self.orientation());
            Cast {
                radius,
                position: pose.position - distance * towards + aside * across,
                shape,
                pose,
                motion: distance * self.between(0.6, 2.5) * towards,
            }
        });
        casts.collect()
    }
}
