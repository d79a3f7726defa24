//! Shapes cast into a world, and set down in it.

use super::{BodyHit, QueryFilter, checked_pose, nearer};
use crate::error::QueryError;
use crate::geometry::{Aabb, Feature, Pose, Ray, Shape};
use crate::math::domain;
use crate::narrow_phase::exact::crossing;
use crate::narrow_phase::overlap::overlap;
use crate::narrow_phase::rays::{Standing, part};
use crate::tolerance::{MAX_COORDINATE, MIN_LENGTH, TOUCH, touch_tolerance};
use crate::world::pair::SLIDE;
use crate::world::{BodyId, CollisionWorld};
use glam::DVec3;

impl CollisionWorld {
    /// The body that a shape meets first which moves straight from `pose` by `motion`, in metres.
    ///
    /// A body that it overlaps as it starts is met at once, with the direction of
    /// least separation as its normal; of several the one with the lowest id. A
    /// touch counts, a touch that it starts with and leaves does not. The cast is the one
    /// of [`exact`](crate::narrow_phase::exact). Bodies are where they are now.
    ///
    /// # Errors
    /// If the pose or the motion is not finite or outside the domain of coordinates,
    /// the orientation not of unit length, or the motion shorter than [`MIN_LENGTH`]:
    /// for no motion there is [`overlaps`](Self::overlaps).
    ///
    /// ```
    /// use feeler::{Body, CollisionWorld, Pose, QueryFilter, Sphere};
    ///
    /// let mut world = CollisionWorld::default();
    /// let ball = world.insert(Body::fixed(Sphere::new(1.0)?, [5.0, 0.0, 0.0]))?;
    /// let shape = Sphere::new(0.5)?.into();
    /// let all = QueryFilter::default();
    /// let hit = world.cast(&shape, &Pose::IDENTITY, [10.0, 0.0, 0.0], &all)?;
    /// assert_eq!(hit.map(|hit| (hit.body, hit.distance)), Some((ball, 3.5)));
    /// assert!(world.cast(&shape, &Pose::IDENTITY, [0.0, 0.0, 0.0], &all).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn cast(
        &self,
        shape: &Shape,
        pose: &Pose,
        motion: impl Into<DVec3>,
        filter: &QueryFilter<'_>,
    ) -> Result<Option<BodyHit>, QueryError> {
        let pose = checked_pose(pose)?;
        let motion = domain::vector("motion", motion.into(), MAX_COORDINATE)?;
        let length = domain::within("motion.length", motion.length(), MIN_LENGTH, f64::MAX)?;
        let around = grown(&shape.aabb(&pose));
        let ray = Ray::new(around.centre(), motion);
        // Its middle is rounded; so the half extents are to both sides.
        let half = (around.max - ray.origin).max(ray.origin - around.min);
        let mut first: Option<BodyHit> = None;
        self.view(1).along((&ray, half), 1.0, |leaf| {
            if let Some((id, body, other)) = self.present(leaf.slot, filter)
                && let Some(found) = meet((shape, &pose), (&body.shape, &other), motion)
            {
                let hit = found.at(id, length);
                first = Some(nearer(first, hit));
            }
            first.map_or(1.0, |first| first.distance / length)
        });
        Ok(first)
    }

    /// All bodies that a shape standing at `pose` overlaps, by id.
    ///
    /// `distance` is the depth of each overlap, negative, `normal` the direction of
    /// least separation; see [`overlap`](crate::overlap()). Bodies in mere touch do not overlap.
    ///
    /// # Errors
    /// If the pose is not finite or outside the domain of coordinates, or its
    /// orientation not of unit length.
    ///
    /// ```
    /// use feeler::{Body, CollisionWorld, Cuboid, Pose, QueryFilter, Sphere};
    ///
    /// let mut world = CollisionWorld::default();
    /// let ball = world.insert(Body::fixed(Sphere::new(1.0)?, [5.0, 0.0, 0.0]))?;
    /// let region = Cuboid::new([1.0, 1.0, 1.0])?.into();
    /// let found = world.overlaps(&region, &Pose::at([3.5, 0.0, 0.0]), &QueryFilter::default())?;
    /// assert_eq!(found.len(), 1);
    /// assert_eq!((found[0].body, found[0].distance), (ball, -0.5));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn overlaps(
        &self,
        shape: &Shape,
        pose: &Pose,
        filter: &QueryFilter<'_>,
    ) -> Result<Vec<BodyHit>, QueryError> {
        let pose = checked_pose(pose)?;
        let mut hits = Vec::new();
        self.view(1)
            .overlapping(&grown(&shape.aabb(&pose)), |leaf| {
                if let Some((id, body, other)) = self.present(leaf.slot, filter)
                    && let Some(found) = overlap(shape, &pose, &body.shape, &other)
                {
                    hits.push(BodyHit {
                        body: id,
                        distance: -found.depth,
                        point: found.point,
                        normal: Some(found.direction),
                        feature: Some(found.feature_b),
                    });
                }
            });
        hits.sort_unstable_by_key(|hit| hit.body);
        Ok(hits)
    }
}

/// A box grown by what may count as a touch.
pub(super) fn grown(aabb: &Aabb) -> Aabb {
    let size = aabb.min.abs().max(aabb.max.abs()).max_element();
    aabb.grown(4.0 * TOUCH * size)
}

/// How a shape that moves meets a body that stands.
struct Meeting {
    fraction: f64,
    point: DVec3,
    normal: DVec3,
    feature: Feature,
}

impl Meeting {
    fn at(self, body: BodyId, length: f64) -> BodyHit {
        BodyHit {
            body,
            distance: self.fraction * length,
            point: self.point,
            normal: Some(self.normal),
            feature: Some(self.feature),
        }
    }
}

fn meet(
    (shape, pose): (&Shape, &Pose),
    (other, other_pose): (&Shape, &Pose),
    motion: DVec3,
) -> Option<Meeting> {
    let found = crossing(shape, pose, other, other_pose, motion)?;
    let (enter, leave, length) = (found.enter, found.leave, motion.length());
    let coordinate = (pose.position.abs()).max(other_pose.position.abs());
    let size = shape.max_dist() + other.max_dist();
    let touch = touch_tolerance(size, coordinate.max_element());
    if (enter.fraction - 1.0) * length > touch || leave * length < -touch {
        return None;
    }
    if enter.fraction < 0.0
        && let Some(found) = overlap(shape, pose, other, other_pose)
    {
        return Some(Meeting {
            fraction: 0.0,
            point: found.point,
            normal: found.direction,
            feature: found.feature_b,
        });
    }
    let closing = -motion.dot(enter.normal);
    // Deeper in since they met than a touch is deep, and yet without overlap: they part just now.
    if -enter.fraction * closing > touch {
        return None;
    }
    // In touch, and about to leave or to slide along, as in a frame.
    let in_touch = enter.fraction * length <= touch
        || enter.fraction * length <= SLIDE * size && enter.fraction * closing <= touch;
    if in_touch {
        let centres = other_pose.direction(other.centre()) - pose.direction(shape.centre());
        let between = (other_pose.position - pose.position) + centres;
        let standing = |shape, pose| Standing {
            shape,
            pose,
            points: &[],
        };
        let pair = (standing(shape, pose), standing(other, other_pose));
        if closing <= SLIDE * length || part(pair, between, motion, touch) {
            return None;
        }
    }
    Some(Meeting {
        fraction: enter.fraction.clamp(0.0, 1.0),
        point: other_pose.position + enter.point,
        normal: enter.normal,
        feature: enter.features[1],
    })
}
