//! Rays into a world.

use super::{BodyHit, QueryFilter, nearer, order};
use crate::broad_phase::{Leaf, View};
use crate::error::QueryError;
use crate::geometry::{Ray, Sphere};
use crate::math::domain;
use crate::raycast::{RayCast, RayHit};
use crate::tolerance::{MAX_COORDINATE, MAX_LENGTH, MIN_LENGTH};
use crate::world::tracks::{Span, Track};
use crate::world::{BodyId, CollisionWorld};
use glam::DVec3;

/// So many rays are worth handing over to another thread.
#[cfg(feature = "parallel")]
const HANDED: usize = 64;

/// A ray that has been checked, and how far it goes, in directions.
struct Cast {
    ray: Ray,
    /// Of the direction, in metres.
    length: f64,
    until: f64,
}

impl Cast {
    fn new(ray: &Ray, reach: f64) -> Result<Self, QueryError> {
        let origin = domain::vector("ray.origin", ray.origin, MAX_COORDINATE)?;
        let direction = domain::vector("ray.direction", ray.direction, MAX_LENGTH)?;
        let length = domain::within(
            "ray.direction.length",
            direction.length(),
            MIN_LENGTH,
            f64::MAX,
        )?;
        // Across all that a world can hold: as good as without end.
        let reach = if reach == f64::INFINITY {
            8.0 * MAX_COORDINATE
        } else {
            domain::within("reach", reach, 0.0, f64::MAX)?
        };
        Ok(Self {
            ray: Ray { origin, direction },
            length,
            until: reach / length,
        })
    }

    /// What is told of a hit, if it is not too far away.
    fn told(&self, body: BodyId, hit: RayHit) -> Option<BodyHit> {
        let fraction = hit.fraction();
        if fraction > self.until {
            return None;
        }
        let surface = match hit {
            RayHit::Surface(point) => Some(point),
            RayHit::Inside => None,
        };
        Some(BodyHit {
            body,
            distance: fraction * self.length,
            point: self.ray.at(fraction),
            normal: surface.map(|point| point.normal),
            feature: surface.map(|point| point.feature),
        })
    }
}

impl CollisionWorld {
    /// The body that a ray meets first within `reach` metres (which may be infinite).
    ///
    /// Conventions are those of [`raycast`](crate::raycast): a ray that starts in a
    /// body hits it at once; of several the one with the lowest id. Bodies are
    /// where they are now, between two steps.
    ///
    /// O(log bodies) boxes and the few bodies along the ray, in a crowd of like size.
    ///
    /// # Errors
    /// If the ray's origin is outside the domain of coordinates, its direction not
    /// finite, longer than [`MAX_LENGTH`] or shorter than [`MIN_LENGTH`], or
    /// `reach` negative or NaN.
    ///
    /// ```
    /// use feeler::{Body, CollisionWorld, QueryError, QueryFilter, Ray, Sphere};
    ///
    /// let mut world = CollisionWorld::default();
    /// let ball = world.insert(Body::fixed(Sphere::new(1.0)?, [5.0, 0.0, 0.0]))?;
    /// let ray = Ray::new([0.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
    /// let hit = world.cast_ray(&ray, 10.0, &QueryFilter::default())?;
    /// assert_eq!(hit.map(|hit| (hit.body, hit.distance)), Some((ball, 4.0)));
    /// assert!(world.cast_ray(&ray, 3.0, &QueryFilter::default())?.is_none());
    ///
    /// let nowhere = Ray::new([0.0, 0.0, 0.0], [0.0, 0.0, 0.0]);
    /// let refused = world.cast_ray(&nowhere, 10.0, &QueryFilter::default());
    /// assert!(matches!(refused, Err(QueryError::Value(_))));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn cast_ray(
        &self,
        ray: &Ray,
        reach: f64,
        filter: &QueryFilter<'_>,
    ) -> Result<Option<BodyHit>, QueryError> {
        let cast = Cast::new(ray, reach)?;
        Ok(self.first_along(self.view(1), &cast, filter))
    }

    /// All bodies that a ray meets within `reach` metres, in the order in which it
    /// enters them; those entered at once by id. Otherwise as [`cast_ray`](Self::cast_ray).
    ///
    /// # Errors
    /// As [`cast_ray`](Self::cast_ray).
    pub fn cast_ray_all(
        &self,
        ray: &Ray,
        reach: f64,
        filter: &QueryFilter<'_>,
    ) -> Result<Vec<BodyHit>, QueryError> {
        let cast = Cast::new(ray, reach)?;
        let mut hits = Vec::new();
        self.view(1)
            .along((&cast.ray, DVec3::ZERO), cast.until, |leaf| {
                hits.extend(self.hit(&leaf, &cast, filter));
                cast.until
            });
        hits.sort_unstable_by(order);
        Ok(hits)
    }

    /// The first hit of each of many rays: [`cast_ray`](Self::cast_ray) for each, with the
    /// feature `parallel` by all threads of the rayon pool it is called in.
    ///
    /// # Errors
    /// As [`cast_ray`](Self::cast_ray), for the first ray that is at fault.
    pub fn cast_rays(
        &self,
        rays: &[Ray],
        reach: f64,
        filter: &QueryFilter<'_>,
    ) -> Result<Vec<Option<BodyHit>>, QueryError> {
        let casts = rays.iter().map(|ray| Cast::new(ray, reach));
        let casts: Vec<Cast> = casts.collect::<Result<_, _>>()?;
        let view = self.view(casts.len());
        #[cfg(feature = "parallel")]
        if rayon::current_num_threads() > 1 {
            use rayon::prelude::*;
            // Few enough that nobody waits long for the last.
            let hits = casts.par_iter().with_min_len(HANDED).with_max_len(HANDED);
            return Ok(hits
                .map(|cast| self.first_along(view, cast, filter))
                .collect());
        }
        let hits = casts
            .iter()
            .map(|cast| self.first_along(view, cast, filter));
        Ok(hits.collect())
    }

    fn first_along(
        &self,
        view: View<'_, Track>,
        cast: &Cast,
        filter: &QueryFilter<'_>,
    ) -> Option<BodyHit> {
        let mut first: Option<BodyHit> = None;
        view.along((&cast.ray, DVec3::ZERO), cast.until, |leaf| {
            if let Some(hit) = self.hit(&leaf, cast, filter) {
                first = Some(nearer(first, hit));
            }
            // A little beyond, for a body that is as near and has a lower id.
            first.map_or(cast.until, |first| first.distance / cast.length)
        });
        first
    }

    /// The hit of one body, if it is one.
    fn hit(
        &self,
        leaf: &Leaf<'_, Track>,
        cast: &Cast,
        filter: &QueryFilter<'_>,
    ) -> Option<BodyHit> {
        if leaf.data.is_ball && leaf.data.is_unturned {
            return self.hit_ball(leaf, cast, filter);
        }
        // Most end here, without a look at the body itself.
        if leaf.data.is_passed_by(&cast.ray, cast.until, self.time) {
            return None;
        }
        let (id, body, pose) = self.present(leaf.slot, filter)?;
        let hit = body.shape.first_hit_at(&pose, &cast.ray)?;
        cast.told(id, hit)
    }

    /// The same to the bit of a ball in straight flight, from its track alone; of one that is
    /// turned the rays would have to be turned as well.
    #[inline]
    fn hit_ball(
        &self,
        leaf: &Leaf<'_, Track>,
        cast: &Cast,
        filter: &QueryFilter<'_>,
    ) -> Option<BodyHit> {
        if !leaf.data.groups.meets(filter.groups) {
            return None;
        }
        let (centre, _) = leaf.data.flight(Span::at(self.time));
        let ball = Sphere::new(leaf.data.reach).ok()?;
        let hit = ball.first_hit(&Ray {
            origin: cast.ray.origin - centre,
            direction: cast.ray.direction,
        })?;
        let id = self.slots.id(leaf.slot);
        if filter.keep.is_some_and(|keep| !keep(id)) {
            return None;
        }
        cast.told(id, hit)
    }
}
