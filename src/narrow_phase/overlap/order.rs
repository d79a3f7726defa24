//! An order of bodies, so that exchanging two of them changes nothing.

use crate::geometry::{Pose, Shape};
use glam::DVec3;
use std::cmp::Ordering;

/// By kind, position, orientation and size; equal only if nothing tells the two apart.
pub(super) fn compare(a: &Shape, pose_a: &Pose, b: &Shape, pose_b: &Pose) -> Ordering {
    kind(a)
        .cmp(&kind(b))
        .then_with(|| points(&[pose_a.position], &[pose_b.position]))
        .then_with(|| {
            numbers(
                &pose_a.orientation.to_array(),
                &pose_b.orientation.to_array(),
            )
        })
        .then_with(|| shapes(a, b))
}

/// The same of two balls: by centre, then radius.
#[inline]
pub(super) fn balls(a: (DVec3, f64), b: (DVec3, f64)) -> Ordering {
    // Most differ here.
    if let Some(order) = a.0.x.partial_cmp(&b.0.x)
        && order.is_ne()
    {
        return order;
    }
    numbers(&a.0.to_array(), &b.0.to_array()).then_with(|| a.1.total_cmp(&b.1))
}

fn kind(shape: &Shape) -> u8 {
    match shape {
        Shape::Sphere(_) => 0,
        Shape::Cuboid(_) => 1,
        Shape::Triangle(_) => 2,
        Shape::Polytope(_) => 3,
    }
}

fn shapes(a: &Shape, b: &Shape) -> Ordering {
    match (a, b) {
        (Shape::Sphere(a), Shape::Sphere(b)) => a.radius().total_cmp(&b.radius()),
        (Shape::Cuboid(a), Shape::Cuboid(b)) => points(&[a.half_extents()], &[b.half_extents()]),
        (Shape::Triangle(a), Shape::Triangle(b)) => points(&a.vertices(), &b.vertices()),
        (Shape::Polytope(a), Shape::Polytope(b)) => points(a.vertices(), b.vertices()),
        _ => Ordering::Equal,
    }
}

fn points(a: &[DVec3], b: &[DVec3]) -> Ordering {
    a.len().cmp(&b.len()).then_with(|| {
        a.iter()
            .zip(b)
            .map(|(a, b)| numbers(&a.to_array(), &b.to_array()))
            .find(|order| order.is_ne())
            .unwrap_or(Ordering::Equal)
    })
}

fn numbers<const N: usize>(a: &[f64; N], b: &[f64; N]) -> Ordering {
    a.iter()
        .zip(b)
        // Adding zero makes −0 and 0 one.
        .map(|(a, b)| (a + 0.0).total_cmp(&(b + 0.0)))
        .find(|order| order.is_ne())
        .unwrap_or(Ordering::Equal)
}
