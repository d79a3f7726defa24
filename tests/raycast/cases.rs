//! Shapes and rays drawn from a seed.

use crate::oracle::{self, Span};
use feeler::{Aabb, Cuboid, Obb, Ray, RayCast, Sphere, Triangle};
use glam::{DMat3, DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

pub(crate) struct Draw(ChaCha8Rng);

impl Draw {
    pub(crate) fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    /// In `[0, 1)`.
    pub(crate) fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    pub(crate) fn log(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }

    pub(crate) fn ball(&mut self) -> DVec3 {
        loop {
            let point = DVec3::from_array(std::array::from_fn(|_| self.between(-1.0, 1.0)));
            if point.length_squared() <= 1.0 {
                return point;
            }
        }
    }

    pub(crate) fn direction(&mut self) -> DVec3 {
        loop {
            let direction = self.ball();
            if direction.length() > 0.01 {
                return direction.normalize();
            }
        }
    }

    pub(crate) fn turn(&mut self) -> DQuat {
        DQuat::from_axis_angle(self.direction(), self.between(0.0, 6.0))
    }

    /// From `distance` away, through `target`, with a direction of any length.
    pub(crate) fn ray_through(&mut self, target: DVec3, distance: f64) -> Ray {
        let direction = self.direction();
        let length = self.log(1e-6, 1e6);
        Ray::new(target - distance * direction, length * direction)
    }
}

/// A shape with what the tests need to know about it.
pub(crate) struct Case {
    pub(crate) name: &'static str,
    pub(crate) shape: Box<dyn RayCast>,
    pub(crate) oracle: Box<dyn Fn(&Ray) -> Span>,
    /// A point inside, or in a triangle's plane.
    pub(crate) middle: DVec3,
    /// Largest coordinate on the surface.
    pub(crate) size: f64,
}

impl Case {
    pub(crate) fn sphere(draw: &mut Draw, scale: f64) -> Self {
        let radius = scale * draw.between(0.5, 1.0);
        Self {
            name: "sphere",
            shape: Box::new(Sphere::new(radius).unwrap()),
            oracle: Box::new(move |ray| oracle::sphere(ray, radius)),
            middle: DVec3::ZERO,
            size: radius,
        }
    }

    pub(crate) fn cuboid(draw: &mut Draw, scale: f64) -> Self {
        let half = scale * DVec3::from_array(std::array::from_fn(|_| draw.log(0.1, 1.0)));
        Self {
            name: "cuboid",
            shape: Box::new(Cuboid::new(half).unwrap()),
            oracle: Box::new(move |ray| oracle::triangles(ray, oracle::box_triangles(-half, half))),
            middle: DVec3::ZERO,
            size: half.max_element(),
        }
    }

    pub(crate) fn aabb(draw: &mut Draw, scale: f64) -> Self {
        let aabb = Aabb::new(scale * draw.ball(), scale * draw.ball());
        Self {
            name: "aabb",
            shape: Box::new(aabb),
            oracle: Box::new(move |ray| {
                oracle::triangles(ray, oracle::box_triangles(aabb.min, aabb.max))
            }),
            middle: aabb.centre(),
            size: aabb.min.abs().max(aabb.max.abs()).max_element(),
        }
    }

    pub(crate) fn obb(draw: &mut Draw, scale: f64) -> Self {
        let axes = DMat3::from_quat(draw.turn());
        let half = scale * DVec3::from_array(std::array::from_fn(|_| draw.log(0.1, 1.0)));
        let centre = scale * draw.ball();
        let obb = Obb {
            centre,
            axes: [axes.x_axis, axes.y_axis, axes.z_axis],
            half_extents: half,
        };
        Self {
            name: "obb",
            shape: Box::new(obb),
            oracle: Box::new(move |ray| {
                let box_triangles = oracle::box_triangles(-half, half);
                let world = |corner: DVec3| centre + axes * corner;
                oracle::triangles(ray, box_triangles.into_iter().map(|t| t.map(world)))
            }),
            middle: centre,
            size: centre.abs().max_element() + half.length(),
        }
    }

    pub(crate) fn triangle(draw: &mut Draw, scale: f64) -> Self {
        let (corners, triangle) = loop {
            let corners: [DVec3; 3] = std::array::from_fn(|_| scale * draw.ball());
            let [a, b, c] = corners;
            if (b - a).cross(c - a).length() > 0.1 * scale * scale {
                break (corners, Triangle::new(a, b, c).unwrap());
            }
        };
        Self {
            name: "triangle",
            shape: Box::new(triangle),
            oracle: Box::new(move |ray| oracle::triangles(ray, [corners])),
            middle: corners.into_iter().sum::<DVec3>() / 3.0,
            size: scale,
        }
    }

    pub(crate) const MAKERS: [fn(&mut Draw, f64) -> Self; 5] = [
        Self::sphere,
        Self::cuboid,
        Self::aabb,
        Self::obb,
        Self::triangle,
    ];
}
