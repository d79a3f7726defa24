//! Questions to a world between its steps.

mod cast;
mod cast_along;
mod near;
mod ray;

use crate::broad_phase::View;
use crate::error::QueryError;
use crate::geometry::{Feature, Pose};
use crate::math::domain;
use crate::tolerance::MAX_COORDINATE;
use crate::world::tracks::{Span, Track};
use crate::world::{BodyId, CollisionWorld, Groups};
use glam::{DQuat, DVec3};
use std::fmt;

/// What a query finds of one body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyHit {
    /// The body.
    pub body: BodyId,
    /// How far away, in metres, along the ray or path or from the point; negative for a
    /// shape that stands and overlaps, and for a point inside: how deep.
    pub distance: f64,
    /// Where, in metres.
    pub point: DVec3,
    /// Unit normal out of the body; none for a ray that starts in it.
    pub normal: Option<DVec3>,
    /// The part of the body that is hit; none for a ray that starts in it.
    pub feature: Option<Feature>,
}

/// Which bodies a query sees.
///
/// ```
/// use feeler::{Groups, QueryFilter};
///
/// let walls = QueryFilter::default().meeting(Groups::new(u32::MAX, 0b10));
/// # let _ = walls;
/// ```
#[derive(Clone, Copy, Default)]
pub struct QueryFilter<'a> {
    groups: Groups,
    keep: Option<&'a (dyn Fn(BodyId) -> bool + Sync)>,
}

impl<'a> QueryFilter<'a> {
    /// Only bodies that meet these groups.
    #[must_use]
    pub fn meeting(self, groups: Groups) -> Self {
        Self { groups, ..self }
    }

    /// Only bodies that `keep` answers true for.
    #[must_use]
    pub fn where_body(self, keep: &'a (dyn Fn(BodyId) -> bool + Sync)) -> Self {
        Self {
            keep: Some(keep),
            ..self
        }
    }
}

impl fmt::Debug for QueryFilter<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("QueryFilter")
            .field("groups", &self.groups)
            .field("keep", &self.keep.is_some())
            .finish()
    }
}

impl CollisionWorld {
    /// The boxes that so many queries look at.
    fn view(&self, queries: usize) -> View<'_, Track> {
        let now = Span::at(self.time);
        let moment = self.looks.moment((queries, self.len()), |room| {
            self.bvh.moment(room, |track| track.swept(now))
        });
        self.bvh.view(moment)
    }

    /// The body in a slot and where it is, if the filter lets it through.
    fn present(
        &self,
        slot: u32,
        filter: &QueryFilter<'_>,
    ) -> Option<(BodyId, &crate::world::Body, Pose)> {
        let resident = self.slots.at(slot)?;
        let (id, body) = (self.slots.id(slot), &resident.body);
        if !body.groups.meets(filter.groups) || filter.keep.is_some_and(|keep| !keep(id)) {
            return None;
        }
        Some((id, body, body.pose_after(self.time - resident.since)))
    }
}

/// The nearer hit; of equally near ones that of the lower body.
fn nearer(a: Option<BodyHit>, b: BodyHit) -> BodyHit {
    match a {
        Some(a) if order(&a, &b).is_le() => a,
        _ => b,
    }
}

/// By distance, then by body.
fn order(a: &BodyHit, b: &BodyHit) -> std::cmp::Ordering {
    a.distance.total_cmp(&b.distance).then(a.body.cmp(&b.body))
}

/// `pose` if its position is in the domain and its orientation of unit length.
fn checked_pose(pose: &Pose) -> Result<Pose, QueryError> {
    let position = domain::vector("pose.position", pose.position, MAX_COORDINATE)?;
    let orientation = checked_orientation("pose.orientation.length", pose.orientation)?;
    Ok(Pose::new(position, orientation))
}

/// `orientation` at unit length, if it is near that. `field` names its length.
fn checked_orientation(field: &'static str, orientation: DQuat) -> Result<DQuat, QueryError> {
    /// As for bodies that are inserted.
    const DRIFT: f64 = 1e-3;
    let length = domain::within(field, orientation.length(), 1.0 - DRIFT, 1.0 + DRIFT)?;
    // What is of unit length to rounding is taken as it is.
    let is_unit = (length - 1.0).abs() <= 4.0 * f64::EPSILON;
    Ok(orientation * if is_unit { 1.0 } else { 1.0 / length })
}
