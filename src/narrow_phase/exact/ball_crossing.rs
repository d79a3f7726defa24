//! A ball cast at any shape and out again.

use super::Crossing;
use super::ball_line::Line;
use super::ball_touch::{first, rotation};
use crate::geometry::{Shape, Sphere};
use glam::{DQuat, DVec3};

/// When a ball that moves straight and a shape that stands touch and part.
///
/// `position` is the ball's centre as it sets out, relative to the shape's position and
/// along the world's axes; `orientation` is the shape's, of unit length; metres. None if
/// they never touch, if there is no motion, or if a number is not finite. The ball is the first
/// body, so the normal points to it. A graze is a touch that ends as it begins.
///
/// One ray against the rounded shape: its faces pushed out by the radius, its edges as
/// cylinders, its vertices as spheres. A touch where two features meet may be told of either.
///
/// The gap at the touch is some ulp of the coordinates given and of the shape's size. O(1), for a
/// polytope usually too: it is searched from neighbour to neighbour. Where only the touch is
/// asked for, [`ball_touch`](super::ball_touch) takes half the time.
///
/// ```
/// use feeler::narrow_phase::exact::ball_crossing;
/// use feeler::{Cuboid, Feature, ShapeError, Sphere};
/// use glam::{DQuat, DVec3};
///
/// let (ball, slab) = (Sphere::new(0.5)?, Cuboid::new([5.0, 5.0, 0.5])?.into());
/// let above = DVec3::new(1.0, 2.0, 3.0);
/// let cast = |motion| ball_crossing(&ball, above, &slab, DQuat::IDENTITY, motion);
///
/// let crossing = cast(-4.0 * DVec3::Z);
/// assert_eq!(crossing.map(|c| (c.enter.fraction, c.leave)), Some((0.5, 1.0)));
/// assert_eq!(crossing.map(|c| c.enter.point), Some(DVec3::new(1.0, 2.0, 0.5)));
/// assert_eq!(crossing.map(|c| c.enter.features), Some([Feature::Surface, Feature::Face(5)]));
/// assert!(cast(DVec3::X).is_none());
/// # Ok::<(), ShapeError>(())
/// ```
#[must_use]
pub fn ball_crossing(
    sphere: &Sphere,
    position: DVec3,
    shape: &Shape,
    orientation: DQuat,
    motion: DVec3,
) -> Option<Crossing> {
    let radius = sphere.radius();
    let world = Line::new(position, motion)?;
    let rotation = rotation(shape, orientation);
    let line = world.turned(&rotation);
    let enter = first(&line, shape, radius)?;
    let last = first(&line.reversed(), shape, radius);
    let mut crossing = world.crossing(enter, last)?;
    crossing.enter.point = rotation * crossing.enter.point;
    crossing.enter.normal = rotation * crossing.enter.normal;
    Some(crossing)
}
