//! Seeded random casts.

use feeler::{Cuboid, Polytope, Shape, Sphere, Triangle};
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

pub(crate) struct Draw(ChaCha8Rng);

/// One cast of a ball.
#[derive(Debug, Clone)]
pub(crate) struct Cast {
    pub(crate) ball: Sphere,
    pub(crate) position: DVec3,
    pub(crate) shape: Shape,
    pub(crate) orientation: DQuat,
    pub(crate) motion: DVec3,
}

/// Kinds of shapes, by number.
pub(crate) const KINDS: [&str; 10] = [
    "ball",
    "box",
    "slab",
    "needle",
    "triangle",
    "thin triangle",
    "tetrahedron",
    "hull12",
    "cylinder",
    "flat hull",
];

impl Draw {
    pub(crate) fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    pub(crate) fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.0.next_u64() % count as u64) as usize
    }

    /// Evenly distributed by its logarithm.
    pub(crate) fn log(&mut self, low: f64, high: f64) -> f64 {
        (low.ln() + (high.ln() - low.ln()) * self.unit()).exp()
    }

    /// In the cube from −1 to 1.
    pub(crate) fn cube(&mut self) -> DVec3 {
        DVec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0
    }

    pub(crate) fn direction(&mut self) -> DVec3 {
        loop {
            let vector = self.cube();
            if (0.01..=1.0).contains(&vector.length_squared()) {
                return vector.normalize();
            }
        }
    }

    pub(crate) fn orientation(&mut self) -> DQuat {
        match self.below(6) {
            0 => DQuat::IDENTITY,
            1 => DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2),
            _ => DQuat::from_axis_angle(self.direction(), 6.3 * self.unit()).normalize(),
        }
    }

    pub(crate) fn hull(&mut self, count: usize, stretch: DVec3) -> Polytope {
        let round = self.below(2) == 0;
        Polytope::from_points((0..count).map(|_| {
            let point = if round { self.direction() } else { self.cube() };
            point * stretch
        }))
        .unwrap()
    }

    /// A shape of about `scale`.
    pub(crate) fn shape(&mut self, kind: usize, scale: f64) -> Shape {
        let ratio = self.log(0.002, 0.2);
        let mut half = scale * (DVec3::splat(0.05) + 0.95 * self.cube().abs());
        match kind {
            0 => Sphere::new(half.x).unwrap().into(),
            1 => Cuboid::new(half).unwrap().into(),
            2 | 3 => {
                let axis = self.below(3);
                half[axis] = ratio * scale;
                if kind == 3 {
                    half[(axis + 1) % 3] = ratio * scale * (0.5 + self.unit());
                }
                Cuboid::new(half).unwrap().into()
            }
            4 => {
                let mut corner = || scale * self.cube();
                Triangle::new(corner(), corner(), corner()).unwrap().into()
            }
            5 => {
                let (from, along) = (scale * self.cube(), scale * self.direction());
                let share = 2.0 * self.unit() - 0.5;
                let corner = from + share * along + ratio * scale * self.direction();
                Triangle::new(from, from + along, corner).unwrap().into()
            }
            6 => self.hull(4, DVec3::splat(scale)).into(),
            7 => self.hull(12, DVec3::splat(scale)).into(),
            8 => {
                let count = 3 + self.below(20);
                let turn = self.unit();
                let rim = (0..2 * count).map(|index| {
                    let angle = turn + std::f64::consts::TAU * (index / 2) as f64 / count as f64;
                    let height = if index % 2 == 0 { -ratio } else { ratio };
                    scale * DVec3::new(angle.cos(), angle.sin(), height)
                });
                Polytope::from_points(rim.collect::<Vec<_>>())
                    .unwrap()
                    .into()
            }
            _ => {
                let mut stretch = DVec3::splat(scale);
                stretch[self.below(3)] *= ratio;
                self.hull(20, stretch).into()
            }
        }
    }

    /// A point on or in the surface.
    pub(crate) fn target(&mut self, shape: &Shape) -> DVec3 {
        let corners: Vec<DVec3> = match shape {
            Shape::Sphere(ball) => return ball.radius() * self.cube(),
            Shape::Cuboid(cuboid) => cuboid.vertices().to_vec(),
            Shape::Triangle(triangle) => triangle.vertices().to_vec(),
            Shape::Polytope(polytope) => {
                let triangles = polytope.triangles();
                let corners = triangles[self.below(triangles.len())];
                corners
                    .map(|corner| polytope.vertices()[corner as usize])
                    .to_vec()
            }
        };
        let mut pick = || corners[self.below(corners.len())];
        let (a, b, c) = (pick(), pick(), pick());
        let (u, v) = (self.unit(), self.unit());
        a + u * (b - a) + v * (1.0 - u) * (c - a)
    }

    /// The furthest of the corners along `direction`, or of all a ball's points.
    pub(crate) fn summit(shape: &Shape, direction: DVec3) -> DVec3 {
        let furthest = |corners: &[DVec3]| {
            let height = |corner: &&DVec3| direction.dot(**corner);
            *(corners.iter())
                .max_by(|a, b| height(a).total_cmp(&height(b)))
                .unwrap()
        };
        match shape {
            Shape::Sphere(ball) => ball.radius() * direction.normalize(),
            Shape::Cuboid(cuboid) => furthest(&cuboid.vertices()),
            Shape::Triangle(triangle) => furthest(&triangle.vertices()),
            Shape::Polytope(polytope) => furthest(polytope.vertices()),
        }
    }

    /// A cast of a ball at `shape`, aimed at a point about a radius off its surface.
    pub(crate) fn cast(&mut self, shape: Shape, scale: f64, distance: f64) -> Cast {
        let ball = Sphere::new(scale * self.log(0.01, 3.0)).unwrap();
        let orientation = self.orientation();
        let mut direction = self.direction();
        if self.below(8) == 0 {
            // Along an axis of the shape.
            direction = DVec3::AXES[self.below(3)];
            if self.below(2) == 0 {
                direction = -direction;
            }
        }
        let aside = self.direction().cross(direction).normalize_or_zero();
        let target = self.target(&shape) + 2.5 * self.unit() * ball.radius() * aside;
        let start = target - distance * direction;
        Cast {
            ball,
            position: orientation * start,
            shape,
            orientation,
            motion: orientation * direction * scale * self.log(0.1, 10.0),
        }
    }
}
