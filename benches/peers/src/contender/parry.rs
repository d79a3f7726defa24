//! Parry, in both precisions: `cast_shapes` as its guide has it, with the default
//! options (stop at penetration, no target distance), and `cast_ray_and_get_normal`.

macro_rules! parry {
    ($module:ident, $parry:ident) => {
        pub mod $module {
            use crate::casts::{CastSet, Kind, Placed, Solid};
            use crate::contender::{Answer, Casts, Ready};
            use glam::DVec3;
            use $parry::math::{Pose, Real, Rotation, Vector};
            use $parry::query::{Ray, ShapeCastOptions, cast_shapes};
            use $parry::shape::SharedShape;

            fn vector(vector: DVec3) -> Vector {
                Vector::new(vector.x as Real, vector.y as Real, vector.z as Real)
            }

            fn double(vector: Vector) -> DVec3 {
                DVec3::new(vector.x.into(), vector.y.into(), vector.z.into())
            }

            fn pose(placed: &Placed) -> Pose {
                let turn = placed.unit_orientation();
                let turn = [turn.x, turn.y, turn.z, turn.w].map(|part| part as Real);
                Pose::from_parts(vector(placed.position), Rotation::from_array(turn))
            }

            fn shape(solid: &Solid) -> Option<SharedShape> {
                Some(match solid {
                    // A ray has no shape: this one is never cast.
                    Solid::Point => SharedShape::ball(1.0),
                    Solid::Ball(radius) => SharedShape::ball(*radius as Real),
                    Solid::Cuboid(half) => {
                        let half = vector(*half);
                        SharedShape::cuboid(half.x, half.y, half.z)
                    }
                    Solid::Triangle([a, b, c]) => {
                        SharedShape::triangle(vector(*a), vector(*b), vector(*c))
                    }
                    Solid::Hull(points) => {
                        let points: Vec<_> = points.iter().copied().map(vector).collect();
                        SharedShape::convex_hull(&points)?
                    }
                })
            }

            pub fn prepare(set: &CastSet) -> Option<Box<dyn Ready>> {
                let shapes: Option<Vec<_>> = set.solids.iter().map(shape).collect();
                let shapes = shapes?;
                if set.kinds[0] == Kind::Point {
                    let inputs = set.casts.iter().map(|cast| {
                        let ray = Ray::new(vector(cast.a.position), vector(cast.motion));
                        (shapes[cast.b.solid].clone(), pose(&cast.b), ray)
                    });
                    return Some(Box::new(Casts {
                        inputs: inputs.collect(),
                        cast: |(shape, pose, ray): &(SharedShape, Pose, Ray)| {
                            shape.cast_ray_and_get_normal(pose, ray, 1.0, true)
                        },
                        read: |_: &_, hit: Option<$parry::query::RayIntersection>| {
                            let hit = hit?;
                            Some(Answer {
                                fraction: hit.time_of_impact.into(),
                                normal: double(hit.normal),
                            })
                        },
                    }));
                }
                type Input = ([Pose; 2], [SharedShape; 2], Vector);
                let inputs = set.casts.iter().map(|cast| {
                    let placed = [&cast.a, &cast.b];
                    let shapes = placed.map(|placed| shapes[placed.solid].clone());
                    (placed.map(pose), shapes, vector(cast.motion))
                });
                let options = ShapeCastOptions::with_max_time_of_impact(1.0);
                Some(Box::new(Casts {
                    inputs: inputs.collect(),
                    cast: move |([pose_a, pose_b], [a, b], motion): &Input| {
                        cast_shapes(pose_a, *motion, &*a.0, pose_b, Vector::ZERO, &*b.0, options)
                    },
                    read: |([_, pose_b], _, _): &Input, hit: Result<_, _>| {
                        let hit: Option<$parry::query::ShapeCastHit> =
                            hit.unwrap_or_else(|_: $parry::query::Unsupported| {
                                unreachable!("parry casts all of these shapes")
                            });
                        let hit = hit?;
                        Some(Answer {
                            fraction: hit.time_of_impact.into(),
                            normal: double(pose_b.rotation * hit.normal2),
                        })
                    },
                }))
            }
        }
    };
}

parry!(single, parry3d);
parry!(double, parry3d_f64);
