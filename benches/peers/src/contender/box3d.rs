//! Box3D, in its pure Rust port: `shape_cast`, which stops a slop of 5 mm short of
//! contact by design, and `ray_cast_hull`, in `f32` as Box3D is.
//!
//! Its proxies hold 128 points at most and its hulls 128 edges, so that hulls of
//! 1000 points, and rays at hulls of 100, are left out.

use super::{Answer, Casts, Ready};
use crate::casts::{CastSet, Kind, Placed, Solid};
use box3d_rust::distance::{CastOutput, ShapeCastPairInput, ShapeProxy, make_proxy, shape_cast};
use box3d_rust::geometry::RayCastInput;
use box3d_rust::hull::{HullData, create_hull, ray_cast_hull};
use box3d_rust::math_functions::{
    Quat, Transform, Vec3, inv_mul_transforms, inv_rotate_vector, inv_transform_point,
    rotate_vector,
};
use glam::DVec3;
use std::sync::Arc;

fn vector(vector: DVec3) -> Vec3 {
    Vec3 {
        x: vector.x as f32,
        y: vector.y as f32,
        z: vector.z as f32,
    }
}

fn double(vector: Vec3) -> DVec3 {
    DVec3::new(vector.x.into(), vector.y.into(), vector.z.into())
}

fn transform(placed: &Placed) -> Transform {
    let turn = placed.unit_orientation();
    Transform {
        p: vector(placed.position),
        q: Quat {
            v: vector(turn.xyz()),
            s: turn.w as f32,
        },
    }
}

fn points(solid: &Solid) -> Vec<Vec3> {
    solid.corners().into_iter().map(vector).collect()
}

fn proxy(solid: &Solid) -> Option<ShapeProxy> {
    let points = points(solid);
    (points.len() <= 128).then(|| make_proxy(&points, solid.radius() as f32))
}

fn read(turn: Quat, hit: CastOutput) -> Option<Answer> {
    hit.hit.then(|| Answer {
        fraction: hit.fraction.into(),
        normal: double(rotate_vector(turn, hit.normal)),
    })
}

pub fn prepare(set: &CastSet) -> Option<Box<dyn Ready>> {
    if set.kinds[0] == Kind::Point {
        return rays(set);
    }
    let proxies: Option<Vec<_>> = set.solids.iter().map(proxy).collect();
    let proxies = proxies?;
    // In the frame of the standing body, which Box3D calls A. Its users keep proxies
    // and poses; the input holds copies of the proxies, made here and not timed.
    let inputs = set.casts.iter().map(|cast| {
        let (moving, standing) = (transform(&cast.a), transform(&cast.b));
        let input = ShapeCastPairInput {
            proxy_a: proxies[cast.b.solid],
            proxy_b: proxies[cast.a.solid],
            transform: inv_mul_transforms(standing, moving),
            translation_b: inv_rotate_vector(standing.q, vector(cast.motion)),
            max_fraction: 1.0,
            can_encroach: false,
        };
        (input, standing.q)
    });
    Some(Box::new(Casts {
        inputs: inputs.collect(),
        cast: |(input, _): &(ShapeCastPairInput, Quat)| shape_cast(input),
        read: |(_, turn): &(ShapeCastPairInput, Quat), hit| read(*turn, hit),
    }))
}

fn rays(set: &CastSet) -> Option<Box<dyn Ready>> {
    let hulls: Vec<_> = set
        .solids
        .iter()
        .map(|solid| create_hull(&points(solid), 128).map(Arc::new))
        .collect();
    type Input = (Arc<HullData>, Transform, Vec3, Vec3);
    let inputs = set.casts.iter().map(|cast| -> Option<Input> {
        let hull = hulls[cast.b.solid].clone()?;
        let (from, motion) = (vector(cast.a.position), vector(cast.motion));
        Some((hull, transform(&cast.b), from, motion))
    });
    Some(Box::new(Casts {
        inputs: inputs.collect::<Option<Vec<_>>>()?,
        cast: |(hull, standing, from, motion): &Input| {
            let input = RayCastInput {
                origin: inv_transform_point(*standing, *from),
                translation: inv_rotate_vector(standing.q, *motion),
                max_fraction: 1.0,
            };
            ray_cast_hull(hull, &input)
        },
        read: |(_, standing, _, _): &Input, hit| read(standing.q, hit),
    }))
}
