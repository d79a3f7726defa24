//! The casts.

use crate::course::{Course, Turning, Way, axes};
use crate::look::Actor;
use crate::random::{Random, single, single_vector};
use crate::solid::Solid;
use glam::{DMat3, DQuat, DVec3};

#[derive(Clone, Copy)]
pub enum Kind {
    Ball,
    Box,
    /// Twenty times as long as wide.
    Bar,
    /// A hundred times as wide as thick.
    Slab,
    /// Of 12 points.
    Hull,
}

pub enum Form {
    Ball(f64),
    Cuboid(DVec3),
    Hull(Vec<DVec3>),
}

impl Form {
    fn new(random: &mut Random, kind: Kind) -> Self {
        match kind {
            Kind::Ball => Self::Ball(single(random.between(0.1, 0.5))),
            Kind::Box => Self::Cuboid(single_vector(random.vector(0.2, 0.6))),
            Kind::Bar => Self::Cuboid(single_vector(
                random.between(0.8, 1.2) * DVec3::new(1.0, 0.05, 0.05),
            )),
            Kind::Slab => Self::Cuboid(single_vector(
                random.between(0.5, 1.0) * DVec3::new(1.0, 0.7, 0.01),
            )),
            Kind::Hull => {
                let axes = random.vector(0.3, 0.8);
                let point = |_| single_vector(axes * random.direction());
                Self::Hull((0..12).map(point).collect())
            }
        }
    }

    fn solid(&self) -> Solid {
        match self {
            Self::Ball(radius) => Solid::ball(*radius),
            Self::Cuboid(half) => Solid::cuboid(*half),
            Self::Hull(points) => Solid::hull(points.clone()),
        }
    }
}

/// A body that flies and spins for a second.
pub struct Flyer {
    pub form: Form,
    pub position: DVec3,
    pub orientation: DQuat,
    pub velocity: DVec3,
    /// Axis times radians per second.
    pub spin: DVec3,
}

impl Flyer {
    pub fn actor(&self) -> Actor {
        let (rate, axis) = (self.spin.length(), self.spin.normalize_or(DVec3::X));
        let (turn_axis, angle) = self.orientation.normalize().to_axis_angle();
        let way = Way::Free {
            from: self.position,
            velocity: self.velocity,
        };
        let turning = Turning::Spin {
            point: DVec3::ZERO,
            axis,
            rate,
        };
        let turned: DMat3 = axes(turn_axis, angle);
        Actor {
            solid: self.form.solid(),
            course: Course {
                way,
                turning,
                turned,
            },
        }
    }
}

pub struct Cast {
    pub flyers: [Flyer; 2],
    pub size: f64,
}

impl Cast {
    /// Both fly past each other or into one another.
    pub fn new(random: &mut Random, kinds: [Kind; 2], rate: f64) -> Self {
        let forms = kinds.map(|kind| Form::new(random, kind));
        let reaches = forms.each_ref().map(|form| form.solid().reach(DVec3::ZERO));
        let size: f64 = reaches.iter().sum();
        let towards = random.direction();
        // So that a third to two thirds of the casts hit.
        let thin = kinds
            .iter()
            .any(|kind| matches!(kind, Kind::Bar | Kind::Slab));
        let spread = if thin { 0.7 } else { 1.1 };
        let aside =
            spread * size * random.unit().sqrt() * towards.cross(random.direction()).normalize();
        let distance = size * random.between(1.1, 2.5);
        let middle = random.vector(-2.0, 2.0);
        let meeting = random.between(0.3, 1.2);
        let drift = random.vector(-1.0, 1.0);
        let mut sides = [0.5, -0.5].into_iter();
        let flyers = forms.map(|form| {
            let side = sides.next().unwrap_or_default();
            let spin = rate * random.between(0.2, 1.0) * random.direction();
            Flyer {
                form,
                position: single_vector(middle + side * (distance * towards + aside)),
                orientation: random.orientation().as_quat().as_dquat(),
                velocity: single_vector(drift - side * distance / meeting * towards),
                spin: single_vector(spin),
            }
        });
        Self { flyers, size }
    }

    pub fn actors(&self) -> [Actor; 2] {
        self.flyers.each_ref().map(Flyer::actor)
    }
}
