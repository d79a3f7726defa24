//! Who takes part.

use crate::draw::{Cast, Flyer, Form};
use feeler::{Body, Cuboid, Method, Motion, Polytope, Shape, Sphere, first_contact};
use glam::DVec3;
use std::hint::black_box;

/// What a contender says of a cast that hits.
pub struct Answer {
    /// Seconds.
    pub time: f64,
    /// Out of the second body, along the world's axes.
    pub normal: DVec3,
}

pub struct Contender<'a> {
    pub name: &'static str,
    /// Share of size and coordinates below which it cannot tell a hit from a miss.
    pub precision: f64,
    pub count: usize,
    /// Casts and drops the answer: the part that is timed.
    pub run: Box<dyn Fn(usize) + 'a>,
    pub answer: Box<dyn Fn(usize) -> Option<Answer> + 'a>,
}

pub fn all(casts: &[Cast]) -> Vec<Contender<'_>> {
    vec![
        feeler(casts),
        double::contender(casts),
        single::contender(casts),
    ]
}

fn body(flyer: &Flyer) -> Body {
    let shape: Shape = match &flyer.form {
        Form::Ball(radius) => Sphere::new(*radius).expect("in range").into(),
        Form::Cuboid(half) => Cuboid::new(*half).expect("in range").into(),
        Form::Hull(points) => Polytope::from_points(points.clone())
            .expect("in general position")
            .into(),
    };
    let motion = Motion::free(flyer.position, flyer.velocity)
        .and_then(|motion| motion.spin(flyer.spin, flyer.spin.length()));
    Body::moving(shape, motion.expect("in range")).oriented(flyer.orientation.normalize())
}

fn feeler(casts: &[Cast]) -> Contender<'_> {
    let pairs: Vec<[Body; 2]> = casts
        .iter()
        .map(|cast| cast.flyers.each_ref().map(body))
        .collect();
    let copies = pairs.clone();
    let cast = |[a, b]: &[Body; 2]| first_contact(a, b, 1.0, &Method::Exact);
    Contender {
        name: "feeler",
        precision: 1e-9,
        count: casts.len(),
        run: Box::new(move |index| {
            let _ = black_box(cast(black_box(&pairs[index])));
        }),
        answer: Box::new(move |index| {
            // One that is given up counts as a miss if it is one.
            let found = cast(&copies[index]).ok().flatten()?;
            Some(Answer {
                time: found.fraction,
                normal: found.normal,
            })
        }),
    }
}

macro_rules! parry {
    ($module:ident, $parry:ident, $name:literal, $precision:literal) => {
        pub mod $module {
            use super::{Answer, Contender};
            use crate::draw::{Cast, Flyer, Form};
            use glam::DVec3;
            use std::hint::black_box;
            use $parry::math::{Pose, Real, Rotation, Vector};
            use $parry::query::{NonlinearRigidMotion, cast_shapes_nonlinear};
            use $parry::shape::SharedShape;

            fn vector(vector: DVec3) -> Vector {
                Vector::new(vector.x as Real, vector.y as Real, vector.z as Real)
            }

            fn shape(form: &Form) -> SharedShape {
                match form {
                    Form::Ball(radius) => SharedShape::ball(*radius as Real),
                    Form::Cuboid(half) => {
                        let half = vector(*half);
                        SharedShape::cuboid(half.x, half.y, half.z)
                    }
                    Form::Hull(points) => {
                        let points: Vec<_> = points.iter().copied().map(vector).collect();
                        SharedShape::convex_hull(&points).expect("in general position")
                    }
                }
            }

            pub fn motion(flyer: &Flyer) -> NonlinearRigidMotion {
                let turn = flyer.orientation.normalize();
                let turn = [turn.x, turn.y, turn.z, turn.w].map(|part| part as Real);
                let start = Pose::from_parts(vector(flyer.position), Rotation::from_array(turn));
                NonlinearRigidMotion::new(
                    start,
                    Vector::ZERO,
                    vector(flyer.velocity),
                    vector(flyer.spin),
                )
            }

            type Input = ([NonlinearRigidMotion; 2], [SharedShape; 2]);

            pub fn ready(cast: &Cast) -> Input {
                let shapes = cast.flyers.each_ref().map(|flyer| shape(&flyer.form));
                (cast.flyers.each_ref().map(motion), shapes)
            }

            /// Seconds and normal.
            pub fn cast(([a, b], [shape_a, shape_b]): &Input) -> Option<(f64, DVec3)> {
                let hit = cast_shapes_nonlinear(a, &*shape_a.0, b, &*shape_b.0, 0.0, 1.0, true)
                    .expect("parry casts all of these shapes")?;
                let turned = b.position_at_time(hit.time_of_impact).rotation;
                let normal: Vector = turned * hit.normal2;
                let normal = DVec3::new(normal.x.into(), normal.y.into(), normal.z.into());
                Some((hit.time_of_impact.into(), normal))
            }

            pub fn contender(casts: &[Cast]) -> Contender<'_> {
                let inputs: Vec<Input> = casts.iter().map(ready).collect();
                let copies = inputs.clone();
                Contender {
                    name: $name,
                    precision: $precision,
                    count: casts.len(),
                    run: Box::new(move |index| {
                        black_box(cast(black_box(&inputs[index])));
                    }),
                    answer: Box::new(move |index| {
                        cast(&copies[index]).map(|(time, normal)| Answer { time, normal })
                    }),
                }
            }
        }
    };
}

parry!(double, parry3d_f64, "parry f64", 1e-9);
parry!(single, parry3d, "parry f32", 1e-6);
