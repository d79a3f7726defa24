//! Feeler: exact casts of shapes; `first_contact` for bodies, which checks its arguments and
//! with rays sets up a caster in each call; `first_hit_at` for rays.

use super::{Answer, Casts, Ready};
use crate::casts::{CastSet, Kind, Placed, Solid};
use feeler::narrow_phase::exact::{Touching, touch};
use feeler::{
    Body, Cuboid, Method, Motion, Polytope, Pose, Ray, RayCast, RayConfig, Shape, ShapeError,
    Sphere, Triangle, first_contact,
};
use glam::DVec3;

fn shape(solid: &Solid) -> Result<Shape, ShapeError> {
    Ok(match solid {
        // A ray has no shape: this one is never cast.
        Solid::Point => Sphere::new(1.0)?.into(),
        Solid::Ball(radius) => Sphere::new(*radius)?.into(),
        Solid::Cuboid(half) => Cuboid::new(*half)?.into(),
        Solid::Triangle([a, b, c]) => Triangle::new(*a, *b, *c)?.into(),
        Solid::Hull(points) => Polytope::from_points(points.iter().copied())?.into(),
    })
}

fn shapes(set: &CastSet) -> Option<Vec<Shape>> {
    let shapes: Result<Vec<_>, _> = set.solids.iter().map(shape).collect();
    shapes.ok()
}

/// A ray against a shape.
pub fn ray(set: &CastSet) -> Option<Box<dyn Ready>> {
    if set.kinds[0] != Kind::Point {
        return None;
    }
    let shapes = shapes(set)?;
    let inputs = set.casts.iter().map(|cast| {
        let pose = Pose::new(cast.b.position, cast.b.unit_orientation());
        let ray = Ray::new(cast.a.position, cast.motion);
        (shapes[cast.b.solid].clone(), pose, ray)
    });
    Some(Box::new(Casts {
        inputs: inputs.collect(),
        cast: |(shape, pose, ray): &(Shape, Pose, Ray)| shape.first_hit_at(pose, ray),
        read: |_: &_, hit: Option<feeler::RayHit>| {
            let point = hit?.surface()?;
            (point.fraction <= 1.0).then_some(Answer {
                fraction: point.fraction,
                normal: point.normal,
            })
        },
    }))
}

/// The exact cast of shapes, as the peers' own casts take them.
pub fn exact(set: &CastSet) -> Option<Box<dyn Ready>> {
    if set.kinds[0] == Kind::Point {
        return None;
    }
    let shapes = shapes(set)?;
    let placed = |placed: &Placed| {
        let pose = Pose::new(placed.position, placed.unit_orientation());
        (shapes[placed.solid].clone(), pose)
    };
    let inputs = (set.casts.iter()).map(|cast| (placed(&cast.a), placed(&cast.b), cast.motion));
    Some(Box::new(Casts {
        inputs: inputs.collect(),
        cast: |((a, pose_a), (b, pose_b), motion): &((Shape, Pose), (Shape, Pose), DVec3)| {
            touch(a, pose_a, b, pose_b, *motion)
        },
        read: |_: &_, found: Option<Touching>| {
            let found = found?;
            (0.0..=1.0).contains(&found.fraction).then_some(Answer {
                fraction: found.fraction,
                normal: found.normal,
            })
        },
    }))
}

/// The same for bodies with motions, arguments checked in each call.
pub fn first(set: &CastSet) -> Option<Box<dyn Ready>> {
    bodies(set, Method::Exact)
}

/// The ray method as it is by default.
pub fn hundred_rays(set: &CastSet) -> Option<Box<dyn Ready>> {
    bodies(set, Method::Rays(RayConfig::default()))
}

/// A body against a body, by whatever method.
fn bodies(set: &CastSet, method: Method) -> Option<Box<dyn Ready>> {
    if set.kinds[0] == Kind::Point {
        return None;
    }
    let shapes = shapes(set)?;
    let body = |placed: &Placed, motion: DVec3| -> Option<Body> {
        let motion = if motion == DVec3::ZERO {
            Motion::fixed(placed.position)
        } else {
            Motion::free(placed.position, motion)
        };
        let body = Body::moving(shapes[placed.solid].clone(), motion.ok()?);
        Some(body.oriented(placed.unit_orientation()))
    };
    let inputs = set.casts.iter().map(|cast| {
        let (a, b) = (body(&cast.a, cast.motion)?, body(&cast.b, DVec3::ZERO)?);
        Some((a, b))
    });
    Some(Box::new(Casts {
        inputs: inputs.collect::<Option<Vec<_>>>()?,
        cast: move |(a, b): &(Body, Body)| first_contact(a, b, 1.0, &method),
        read: |_: &_, found: Result<Option<feeler::PairContact>, _>| {
            let contact = found.unwrap_or_else(|error: feeler::FirstContactError| {
                unreachable!("bodies of moderate size are in order: {error}")
            })?;
            Some(Answer {
                fraction: contact.fraction,
                normal: contact.normal,
            })
        },
    }))
}
