//! What is near a point.

use super::cast::grown;
use super::{BodyHit, QueryFilter, order};
use crate::error::QueryError;
use crate::geometry::Aabb;
use crate::math::domain;
use crate::narrow_phase::overlap::to_point;
use crate::tolerance::MAX_COORDINATE;
use crate::world::CollisionWorld;
use glam::DVec3;

impl CollisionWorld {
    /// The `count` bodies nearest to a point, nearest first, of equally near ones
    /// the lowest id first; fewer if there are no more.
    ///
    /// `distance` is that to the body's surface, negative for a point in the body;
    /// `point` the nearest point of the surface, `normal` leads from there to the point asked
    /// about, for one inside the shortest way out. Bodies are where they are now.
    ///
    /// Distances are exact but for rounding of the coordinates. A polytope's is taken over all
    /// its faces and edges; otherwise O(log bodies) boxes and few bodies more
    /// than asked for, in a crowd of like size.
    ///
    /// # Errors
    /// If the point is not finite or outside the domain of coordinates.
    ///
    /// ```
    /// use feeler::{Body, CollisionWorld, QueryFilter, Sphere};
    /// use glam::DVec3;
    ///
    /// let mut world = CollisionWorld::default();
    /// for x in [5.0, 0.0, 9.0] {
    ///     world.insert(Body::fixed(Sphere::new(1.0)?, [x, 0.0, 0.0]))?;
    /// }
    /// let all = QueryFilter::default();
    /// let found = world.nearest([2.0, 0.0, 0.0], 2, &all)?;
    /// let distances: Vec<f64> = found.iter().map(|hit| hit.distance).collect();
    /// assert_eq!(distances, [1.0, 2.0]);
    /// assert_eq!((found[1].point, found[1].normal), (4.0 * DVec3::X, Some(-DVec3::X)));
    /// assert!(world.nearest([f64::NAN, 0.0, 0.0], 2, &all).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn nearest(
        &self,
        point: impl Into<DVec3>,
        count: usize,
        filter: &QueryFilter<'_>,
    ) -> Result<Vec<BodyHit>, QueryError> {
        let point = domain::vector("point", point.into(), MAX_COORDINATE)?;
        let mut nearest: Vec<BodyHit> = Vec::new();
        if count == 0 {
            return Ok(nearest);
        }
        let place = grown(&Aabb {
            min: point,
            max: point,
        });
        self.view(1).near(&place, |leaf| {
            if let Some((id, body, pose)) = self.present(leaf.slot, filter)
                && let Some(found) = to_point(point, &body.shape, &pose)
            {
                let hit = BodyHit {
                    body: id,
                    distance: found.distance,
                    point: point - found.distance * found.direction,
                    normal: Some(found.direction),
                    feature: Some(found.feature),
                };
                let at = nearest.partition_point(|other| order(other, &hit).is_lt());
                if at < count {
                    nearest.truncate(count - 1);
                    nearest.insert(at, hit);
                }
            }
            // A point in several bodies is in the boxes of all.
            match nearest.last() {
                Some(last) if nearest.len() == count => last.distance.max(0.0),
                _ => f64::INFINITY,
            }
        });
        Ok(nearest)
    }
}
