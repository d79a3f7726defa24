//! What a body is and does, told to the crate and to the oracle.

use crate::course::{Course, Pace, Turning, Way, axes};
use crate::look::Actor;
use crate::route::{Route, catmull_rom, hermite, through};
use crate::solid::Solid;
use feeler::{Body, Cuboid, Knots, Motion, Path, Polytope, Shape, Sphere, Triangle};
use glam::{DQuat, DVec3};

#[derive(Clone, Debug)]
pub(crate) enum Form {
    Ball(f64),
    Cuboid(DVec3),
    Triangle([DVec3; 3]),
    Hull(Vec<DVec3>),
}

/// The courses, with their points in the world.
#[derive(Clone, Debug)]
pub(crate) enum Trip {
    Still(DVec3),
    Free(DVec3, DVec3),
    Line([DVec3; 2]),
    Bezier(Vec<DVec3>),
    /// A tangent for each point.
    Tangents(Vec<DVec3>, Vec<DVec3>),
    /// The first and last tangent.
    Ends(Vec<DVec3>, [DVec3; 2]),
    CatmullRom(Vec<DVec3>, Knots),
}

#[derive(Clone, Debug)]
pub(crate) struct Plan {
    pub(crate) form: Form,
    pub(crate) trip: Trip,
    /// Of paths.
    pub(crate) pace: Pace,
    pub(crate) turning: Turning,
    /// Axis and angle.
    pub(crate) oriented: (DVec3, f64),
}

impl Plan {
    pub(crate) fn shape(&self) -> Shape {
        match &self.form {
            Form::Ball(radius) => Sphere::new(*radius).unwrap().into(),
            Form::Cuboid(half) => Cuboid::new(*half).unwrap().into(),
            Form::Triangle([a, b, c]) => Triangle::new(*a, *b, *c).unwrap().into(),
            Form::Hull(points) => Polytope::from_points(points.clone()).unwrap().into(),
        }
    }

    pub(crate) fn path(&self) -> Option<Path> {
        let path = match self.trip.clone() {
            Trip::Still(_) | Trip::Free(..) => return None,
            Trip::Line([from, to]) => Path::line(from, to),
            Trip::Bezier(points) => Path::bezier(points),
            Trip::Tangents(points, tangents) => Path::spline_with_tangents(points, tangents),
            Trip::Ends(points, [start, end]) => Path::spline(points, start, end),
            Trip::CatmullRom(points, knots) => Path::catmull_rom(points, knots),
        };
        Some(path.unwrap())
    }

    /// For the crate.
    pub(crate) fn body(&self) -> Body {
        let motion = match &self.trip {
            Trip::Still(at) => Motion::fixed(*at),
            Trip::Free(from, velocity) => Motion::free(*from, *velocity),
            _ => {
                let Pace {
                    speed,
                    at_end,
                    offset,
                    wait,
                } = self.pace;
                Motion::along(self.path().unwrap(), speed)
                    .and_then(|motion| motion.at_end(at_end))
                    .and_then(|motion| motion.starting_at(offset))
                    .and_then(|motion| motion.starting_after(wait))
            }
        };
        let motion = motion.and_then(|motion| match self.turning {
            Turning::Not => Ok(motion),
            Turning::Spin { point, axis, rate } => motion.spin_about(point, axis, rate),
            Turning::Facing(facing) => motion.facing(facing),
        });
        let (axis, angle) = self.oriented;
        let turned = DQuat::from_axis_angle(axis, angle);
        Body::moving(self.shape(), motion.unwrap()).oriented(turned)
    }

    /// For the oracle, seen from `base`, so that it has not the crate's rounding far from the origin.
    pub(crate) fn actor(&self, base: DVec3) -> Actor {
        let seen = |points: &[DVec3]| -> Vec<DVec3> { points.iter().map(|p| *p - base).collect() };
        let pace = self.pace;
        let along = |cubics| Way::Curve {
            route: Route::new(cubics),
            pace,
        };
        let way = match &self.trip {
            Trip::Still(at) => Way::Free {
                from: *at - base,
                velocity: DVec3::ZERO,
            },
            Trip::Free(from, velocity) => Way::Free {
                from: *from - base,
                velocity: *velocity,
            },
            Trip::Line([from, to]) => Way::Line {
                from: *from - base,
                to: *to - base,
                pace,
            },
            Trip::Bezier(points) => {
                let points = seen(points);
                let cubic = |i: usize| [points[i], points[i + 1], points[i + 2], points[i + 3]];
                along((0..points.len() - 1).step_by(3).map(cubic).collect())
            }
            Trip::Tangents(points, tangents) => along(hermite(&seen(points), tangents)),
            Trip::Ends(points, ends) => along(through(&seen(points), *ends)),
            Trip::CatmullRom(points, knots) => {
                let power = match knots {
                    Knots::Uniform => 0.0,
                    Knots::Centripetal => 0.5,
                };
                along(catmull_rom(&seen(points), power))
            }
        };
        let solid = match &self.form {
            Form::Ball(radius) => Solid::ball(*radius),
            Form::Cuboid(half) => Solid::cuboid(*half),
            Form::Triangle(corners) => Solid::hull(corners.to_vec()),
            Form::Hull(points) => Solid::hull(points.clone()),
        };
        let (axis, angle) = self.oriented;
        let course = Course {
            way,
            turning: self.turning,
            turned: axes(axis, angle),
        };
        Actor { solid, course }
    }

    /// The same elsewhere.
    pub(crate) fn shifted(mut self, by: DVec3) -> Self {
        let all = |points: &mut [DVec3]| points.iter_mut().for_each(|point| *point += by);
        match &mut self.trip {
            Trip::Still(at) | Trip::Free(at, _) => *at += by,
            Trip::Line(points) => all(points),
            Trip::Bezier(points)
            | Trip::Tangents(points, _)
            | Trip::Ends(points, _)
            | Trip::CatmullRom(points, _) => all(points),
        }
        self
    }

    /// Whether it does nothing that a straight cast would not do.
    pub(crate) fn is_plain(&self) -> bool {
        let straight = matches!(self.trip, Trip::Still(_) | Trip::Free(..) | Trip::Line(_));
        straight && matches!(self.turning, Turning::Not)
    }
}
