//! Any shape against any other.

use super::{Crossing, Touching, ball_crossing, flat_crossing};
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
            Some(mirrored(found, between, motion))
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

/// The crossing of a pair as its second body sees it.
fn mirrored(found: Crossing, between: DVec3, motion: DVec3) -> Crossing {
    let Touching {
        fraction,
        point,
        normal,
        features: [first, second],
    } = found.enter;
    let enter = Touching {
        fraction,
        point: point + (between + fraction * motion),
        normal: -normal,
        features: [second, first],
    };
    Crossing { enter, ..found }
}
