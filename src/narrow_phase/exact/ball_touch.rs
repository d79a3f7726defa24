//! A ball cast at any shape.

use super::Touching;
use super::ball_ball::of_ball;
use super::ball_cuboid::{of_cuboid, of_near_cuboid, passes_by};
use super::ball_line::{Line, Touch};
use super::ball_polytope::of_polytope;
use super::ball_triangle::of_triangle;
use crate::geometry::{Cuboid, Shape, Sphere};
use glam::{DMat3, DQuat, DVec3};

/// How a ball that moves straight comes to touch a shape that stands.
///
/// What [`ball_crossing`](super::ball_crossing) says of the way in, to the bit, without the way out: arguments,
/// conventions and accuracy are the same. The fraction may lie behind the start, where the two
/// overlap already or have parted before, or beyond the motion's end.
///
/// ```
/// use feeler::narrow_phase::exact::ball_touch;
/// use feeler::{Cuboid, Feature, ShapeError, Sphere};
/// use glam::{DQuat, DVec3};
///
/// let (ball, slab) = (Sphere::new(0.5)?, Cuboid::new([5.0, 5.0, 0.5])?.into());
/// let above = DVec3::new(1.0, 2.0, 3.0);
/// let cast = |motion| ball_touch(&ball, above, &slab, DQuat::IDENTITY, motion);
///
/// let touch = cast(-4.0 * DVec3::Z);
/// assert_eq!(touch.map(|t| (t.fraction, t.normal)), Some((0.5, DVec3::Z)));
/// assert_eq!(touch.map(|t| t.features), Some([Feature::Surface, Feature::Face(5)]));
/// assert!(cast(DVec3::X).is_none());
/// # Ok::<(), ShapeError>(())
/// ```
#[must_use]
#[inline]
pub fn ball_touch(
    sphere: &Sphere,
    position: DVec3,
    shape: &Shape,
    orientation: DQuat,
    motion: DVec3,
) -> Option<Touching> {
    let radius = sphere.radius();
    match shape {
        Shape::Sphere(other) => {
            let line = Line::new(position, motion)?;
            line.touching(of_ball(&line, [radius, other.radius()])?)
        }
        Shape::Cuboid(cuboid) => at_cuboid(radius, position, cuboid, orientation, motion),
        _ => at_vertices(radius, position, shape, orientation, motion),
    }
}

/// All in one for boxes, the quickest of these: calls would send lines and touches through memory.
#[inline(never)]
fn at_cuboid(
    radius: f64,
    position: DVec3,
    cuboid: &Cuboid,
    orientation: DQuat,
    motion: DVec3,
) -> Option<Touching> {
    let world = Line::new(position, motion)?;
    // In most misses it need not even be known how the box is turned.
    if passes_by(&world, cuboid, radius) {
        return None;
    }
    turned(&world, orientation, |line| {
        of_near_cuboid(line, cuboid, radius)
    })
}

/// Apart from boxes, which the code of these would make slower.
#[inline(never)]
fn at_vertices(
    radius: f64,
    position: DVec3,
    shape: &Shape,
    orientation: DQuat,
    motion: DVec3,
) -> Option<Touching> {
    let world = Line::new(position, motion)?;
    if let Shape::Polytope(polytope) = shape
        && world.passes_by_all(polytope.reach() + radius)
    {
        return None;
    }
    turned(&world, orientation, |line| first(line, shape, radius))
}

/// The touch of a shape that is turned.
#[inline(always)]
fn turned(
    world: &Line,
    orientation: DQuat,
    first: impl Fn(&Line) -> Option<Touch>,
) -> Option<Touching> {
    let rotation = DMat3::from_quat(orientation);
    let touch = first(&world.turned(&rotation))?;
    let touching = world.touching(touch)?;
    Some(Touching {
        point: rotation * touching.point,
        normal: rotation * touching.normal,
        ..touching
    })
}

/// From the shape's frame to the world's axes. A ball has no orientation: nothing is rounded by
/// turning.
#[inline]
pub(super) fn rotation(shape: &Shape, orientation: DQuat) -> DMat3 {
    match shape {
        Shape::Sphere(_) => DMat3::IDENTITY,
        _ => DMat3::from_quat(orientation),
    }
}

/// What a line in the shape's frame first touches.
#[inline]
pub(super) fn first(line: &Line, shape: &Shape, radius: f64) -> Option<Touch> {
    match shape {
        Shape::Sphere(other) => of_ball(line, [radius, other.radius()]),
        Shape::Cuboid(cuboid) => of_cuboid(line, cuboid, radius),
        Shape::Triangle(triangle) => of_triangle(line, triangle, radius),
        Shape::Polytope(polytope) => of_polytope(line, polytope, radius),
    }
}
