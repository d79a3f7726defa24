//! Shapes cast along paths.

use super::{BodyHit, QueryFilter, checked_orientation, nearer};
use crate::error::QueryError;
use crate::geometry::{Aabb, Shape};
use crate::motion::{FrameMotion, Motion, Path};
use crate::tolerance::TOUCH;
use crate::world::pair::{Mover, PairEffort, Undecided, examine};
use crate::world::solver::Solver;
use crate::world::{Body, BodyId, CollisionWorld};
use glam::{DQuat, DVec3};

/// Windows of a path are this many reaches of the shape long, so that the boxes around them are
/// not much larger than what passes through.
const REACHES: f64 = 8.0;

/// And there are at most so many.
const MOST_WINDOWS: f64 = 256.0;

impl CollisionWorld {
    /// The body that a shape meets first which follows `path` from end to end, always turned by
    /// `orientation`.
    ///
    /// `distance` is the distance flown till then. Bodies are where they are now. A body that the
    /// shape overlaps as it starts is met at once, with the direction of least separation as its
    /// normal; a touch that it starts with and leaves does not count. Touches are on the true
    /// curve, as those of frames are. O(log n) and what lies near the path.
    ///
    /// # Errors
    /// If the orientation is not of unit length. [`QueryError::Undecided`] if the shape comes or
    /// stays so near to a body, without touching, that the search runs out of budget before it
    /// has met any other.
    ///
    /// ```
    /// use feeler::{Body, CollisionWorld, Path, QueryFilter, Sphere};
    /// use glam::DQuat;
    ///
    /// let mut world = CollisionWorld::default();
    /// let ball = world.insert(Body::fixed(Sphere::new(1.0)?, [4.0, 4.0, 0.0]))?;
    /// // Round a corner that a straight cast would cut.
    /// let bend = Path::bezier([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 8.0, 0.0]])?;
    /// let probe = Sphere::new(0.5)?.into();
    /// let all = QueryFilter::default();
    /// let hit = world.cast_along(&probe, DQuat::IDENTITY, &bend, &all)?.expect("it is in the way");
    /// assert_eq!(hit.body, ball);
    /// let centre = bend.position_at(hit.distance);
    /// assert!((centre.distance([4.0, 4.0, 0.0].into()) - 1.5).abs() < 1e-9);
    /// assert!(world.cast_along(&probe, DQuat::IDENTITY * 2.0, &bend, &all).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn cast_along(
        &self,
        shape: &Shape,
        orientation: DQuat,
        path: &Path,
        filter: &QueryFilter<'_>,
    ) -> Result<Option<BodyHit>, QueryError> {
        let orientation = checked_orientation("orientation.length", orientation)?;
        let flyer = Flyer {
            // A metre a second: seconds are metres flown.
            body: Body::moving(shape.clone(), Motion::at_unit_speed(path.clone())),
            orientation,
        };
        let length = path.length();
        let count = (length / (REACHES * shape.max_dist())).clamp(1.0, MOST_WINDOWS) as u32;
        let mut solver = Solver::Exact;
        let view = self.view(count as usize);
        for window in 0..count {
            let at = |window: u32| length * (f64::from(window) / f64::from(count));
            let (from, to) = (at(window), at(window + 1));
            let frame = FrameMotion::new(flyer.body.motion(), from, to - from);
            let mover = flyer.mover(&frame);
            let mut first: Option<BodyHit> = None;
            let mut undecided: Option<(f64, BodyId)> = None;
            view.overlapping(&flyer.swept(&frame), |leaf| {
                let Some((id, body, pose)) = self.present(leaf.slot, filter) else {
                    return;
                };
                let other = Body::fixed(body.shape.clone(), pose.position);
                let still = FrameMotion::new(other.motion(), 0.0, to - from);
                let other = Mover::of(&other, pose.orientation, &still, &[]);
                let flown = |fraction: f64| (from + fraction * (to - from)).min(length);
                match examine(&mut solver, &mover, &other, &mut PairEffort::default()) {
                    Ok(None) => {}
                    Ok(Some(finding)) => {
                        let found = finding.contact;
                        let hit = BodyHit {
                            body: id,
                            distance: flown(found.fraction),
                            point: found.point,
                            normal: Some(found.normal),
                            feature: Some(found.features[1]),
                        };
                        first = Some(nearer(first, hit));
                    }
                    Err(Undecided { clear_until }) => {
                        let here = (flown(clear_until), id);
                        undecided =
                            Some(undecided.map_or(
                                here,
                                |before| {
                                    if here < before { here } else { before }
                                },
                            ));
                    }
                }
            });
            if let Some((clear_until, body)) = undecided
                && first.is_none_or(|first| first.distance > clear_until)
            {
                return Err(QueryError::Undecided { body, clear_until });
            }
            if first.is_some() {
                return Ok(first);
            }
        }
        Ok(None)
    }
}

/// A shape on its way.
struct Flyer {
    body: Body,
    orientation: DQuat,
}

impl Flyer {
    fn mover<'a>(&'a self, frame: &'a FrameMotion) -> Mover<'a> {
        Mover::of(&self.body, self.orientation, frame, &[])
    }

    /// The box around all places where it is in a window.
    fn swept(&self, frame: &FrameMotion) -> Aabb {
        let (offset, reach) = self.body.hub_turned(self.orientation);
        let from = frame.start + offset;
        let to = from + frame.displacement;
        let largest = from.abs().max(to.abs()).max_element() + reach;
        // What comes as near as this counts as touching; far more than rounding.
        let slack = 4.0 * TOUCH * largest;
        let around = DVec3::splat(reach + frame.deviation + slack);
        Aabb {
            min: from.min(to) - around,
            max: from.max(to) + around,
        }
    }
}
