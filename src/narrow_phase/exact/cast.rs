//! Any shape against any other.

use super::{Crossing, Touching, ball_crossing, ball_touch, flat_crossing, flat_touch, two_balls};
use crate::geometry::{Pose, Shape};
use glam::DVec3;

/// When two shapes touch and part that move straight relative to each other.
///
/// `motion` is the first's relative to the second's, in metres. None if they
/// never share a point, or if there is no motion to speak of.
///
/// ```
/// use feeler::narrow_phase::exact::crossing;
/// use feeler::{Pose, Shape, ShapeError, Sphere};
/// use glam::DVec3;
///
/// let ball = Shape::from(Sphere::new(1.0)?);
/// let cast = |motion| crossing(&ball, &Pose::at([3.0, 0.0, 0.0]), &ball, &Pose::IDENTITY, motion);
/// let found = cast(DVec3::new(-4.0, 0.0, 0.0)).expect("they meet");
/// assert_eq!((found.enter.fraction, found.leave), (0.25, 1.25));
/// assert_eq!(found.enter.point, DVec3::X);
/// assert!(cast(DVec3::Z).is_none());
/// # Ok::<(), ShapeError>(())
/// ```
#[must_use]
pub fn crossing(
    a: &Shape,
    pose_a: &Pose,
    b: &Shape,
    pose_b: &Pose,
    motion: DVec3,
) -> Option<Crossing> {
    let between = pose_a.position - pose_b.position;
    match (a, b) {
        (Shape::Sphere(ball), _) => ball_crossing(ball, between, b, pose_b.orientation, motion),
        (_, Shape::Sphere(ball)) => {
            let found = ball_crossing(ball, -between, a, pose_a.orientation, -motion)?;
            Some(Crossing {
                enter: mirrored(found.enter, between, motion),
                ..found
            })
        }
        _ => flat_crossing(
            a,
            pose_a.orientation,
            b,
            pose_b.orientation,
            between,
            motion,
        ),
    }
}

/// How two shapes come to touch that move straight relative to each other.
///
/// The entry of [`crossing`], to the last bit, at half the cost: the exit is not looked for. The
/// whole line of the motion is looked at, so that fractions may be negative or beyond 1.
///
/// ```
/// use feeler::narrow_phase::exact::touch;
/// use feeler::{Cuboid, Feature, Pose, Shape, ShapeError, Sphere};
/// use glam::DVec3;
///
/// let ball = Shape::from(Sphere::new(0.5)?);
/// let floor = Shape::from(Cuboid::new([10.0, 10.0, 1.0])?);
/// let above = Pose::at([2.0, 3.0, 5.5]);
/// let cast = |motion| touch(&ball, &above, &floor, &Pose::IDENTITY, motion);
/// let found = cast(DVec3::new(0.0, 0.0, -8.0)).expect("it falls on the floor");
/// assert_eq!(found.fraction, 0.5);
/// assert_eq!(found.normal, DVec3::Z);
/// assert_eq!(found.features, [Feature::Surface, Feature::Face(5)]);
/// assert!(cast(DVec3::X).is_none());
/// # Ok::<(), ShapeError>(())
/// ```
#[must_use]
#[inline]
pub fn touch(
    a: &Shape,
    pose_a: &Pose,
    b: &Shape,
    pose_b: &Pose,
    motion: DVec3,
) -> Option<Touching> {
    let between = pose_a.position - pose_b.position;
    // Balls are by far the quickest: a call would cost as much as they do.
    if let (Shape::Sphere(a), Shape::Sphere(b)) = (a, b) {
        return two_balls(a.radius(), b.radius(), -between, motion);
    }
    touch_of(a, pose_a, b, pose_b, motion.x, motion.y, motion.z)
}

/// [`touch`] of any two shapes. The motion comes in single numbers: as a vector it would go
/// through memory for two balls as well.
fn touch_of(
    a: &Shape,
    pose_a: &Pose,
    b: &Shape,
    pose_b: &Pose,
    x: f64,
    y: f64,
    z: f64,
) -> Option<Touching> {
    let motion = DVec3::new(x, y, z);
    let between = pose_a.position - pose_b.position;
    match (a, b) {
        (Shape::Sphere(ball), _) => ball_touch(ball, between, b, pose_b.orientation, motion),
        (_, Shape::Sphere(ball)) => {
            let found = ball_touch(ball, -between, a, pose_a.orientation, -motion)?;
            Some(mirrored(found, between, motion))
        }
        _ => flat_touch(
            a,
            pose_a.orientation,
            b,
            pose_b.orientation,
            between,
            motion,
        ),
    }
}

/// The touch of a pair as its second body sees it.
#[inline]
fn mirrored(found: Touching, between: DVec3, motion: DVec3) -> Touching {
    let Touching {
        fraction,
        point,
        normal,
        features: [first, second],
    } = found;
    Touching {
        fraction,
        point: point + (between + fraction * motion),
        normal: -normal,
        features: [second, first],
    }
}
