//! The world as its users see it.

use crate::broad_phase::{BroadPhase, Bvh, FramePairs, PairList, Volume};
use crate::error::{BodyError, ConfigError};
use crate::geometry::{Pose, Shape};
use crate::motion::{FrameMotion, Motion};
use crate::tolerance::touch_tolerance;
use crate::world::findings::{Findings, PairKey};
use crate::world::gate::Passed;
use crate::world::horizon::Horizon;
use crate::world::looks::Looks;
use crate::world::slots::{Resident, Slots};
use crate::world::solver::Solver;
use crate::world::stirred::Stirred;
use crate::world::tracks::{self, Course, Span, Track};
use crate::world::{Body, BodyId, Contact, StepStats, WorldConfig};
use glam::DVec3;

/// Bodies that move, and when, where and how they meet.
///
/// Bodies go in, the world is stepped frame by frame, and every step answers
/// with the contacts of that frame: for every pair of which at least one body is not
/// [fixed](Motion::is_fixed) the first touch, or that it overlapped already. A body without
/// response flies on through what it hit.
///
/// Contacts come sorted by time, then by ids. The same calls give the same
/// bits. Any call that returns an error leaves the world as it was.
///
/// ```
/// use feeler::{Body, CollisionWorld, Motion, Path, Sphere};
///
/// let mut world = CollisionWorld::default();
/// let target = world.insert(Body::fixed(Sphere::new(1.0)?, [0.0, 0.0, 0.0]))?;
/// let path = Path::line([3.0, 0.0, 1.0], [0.0, 0.0, 1.0])?;
/// let ball = world.insert(Body::moving(Sphere::new(1.0)?, Motion::along(path, 1.0)?))?;
///
/// let contacts = world.step(2.0)?;
/// assert_eq!(contacts.len(), 1);
/// assert_eq!((contacts[0].a, contacts[0].b), (ball, target));
/// assert!((contacts[0].time - (3.0 - 3.0_f64.sqrt())).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct CollisionWorld {
    pub(super) config: WorldConfig,
    pub(super) slots: Slots,
    pub(super) time: f64,
    pub(super) solver: Solver,
    pub(super) pairs: PairList,
    /// The pairs with bodies in free flight, of the frame at hand.
    pub(super) frame_pairs: FramePairs,
    /// Where each slot's body can be, over its whole motion.
    pub(super) volumes: Vec<Option<Volume>>,
    /// Slots whose pairs are to be listed anew.
    pub(super) changed: Vec<u32>,
    /// The bodies' boxes: for pairs, if [`BroadPhase::Bvh`] is set, and for queries.
    pub(super) bvh: Bvh<Track>,
    /// Slots with bodies on paths, and perhaps others.
    pub(super) on_paths: Vec<u32>,
    /// Until then, by the world's clock, no body flies out of the domain of coordinates.
    pub(super) safe_until: f64,
    /// Bodies inserted or given a motion since the last step.
    pub(super) stirred: Stirred,
    pub(super) contacts: Vec<Contact>,
    /// Pairs that were reported as touching and have not parted since, sorted.
    pub(super) touching: Vec<PairKey>,
    /// Pairs with a contact in the last step, as contacts name them, and those that a caller held
    /// back, sorted.
    pub(super) met: Vec<PairKey>,
    /// What the narrow phase found in the frame at hand.
    pub(super) findings: Findings,
    /// Pairs that passed the early-outs of the frame at hand.
    pub(super) passed: Passed,
    /// For how long boxes hold.
    pub(super) horizon: Horizon,
    pub(super) looks: Looks,
    pub(super) stats: StepStats,
}

impl Default for CollisionWorld {
    /// An empty world with default settings.
    fn default() -> Self {
        Self::with_checked(WorldConfig::default())
    }
}

impl CollisionWorld {
    /// An empty world.
    ///
    /// # Errors
    /// If a setting is outside its documented domain.
    pub fn new(config: WorldConfig) -> Result<Self, ConfigError> {
        Ok(Self::with_checked(config.checked()?))
    }

    fn with_checked(config: WorldConfig) -> Self {
        Self {
            config,
            slots: Slots::default(),
            time: 0.0,
            solver: Solver::new(config.method),
            pairs: PairList::new(config.broad_phase),
            frame_pairs: FramePairs::default(),
            volumes: Vec::new(),
            changed: Vec::new(),
            bvh: Bvh::default(),
            on_paths: Vec::new(),
            safe_until: f64::INFINITY,
            stirred: Stirred::default(),
            contacts: Vec::new(),
            touching: Vec::new(),
            met: Vec::new(),
            findings: Findings::default(),
            passed: Passed::default(),
            horizon: Horizon::default(),
            looks: Looks::default(),
            stats: StepStats::default(),
        }
    }

    /// Puts a body into the world, at the world's present time.
    ///
    /// # Errors
    /// If its position or orientation is outside its domain, or if the world
    /// holds 2³² − 1 bodies.
    pub fn insert(&mut self, body: Body) -> Result<BodyId, BodyError> {
        let body = body.checked()?;
        let id = self
            .slots
            .next_id()
            .ok_or(BodyError::TooManyBodies { max: Slots::MAX })?;
        self.slots
            .insert(id, Resident::new(body, self.time, &self.solver));
        self.stirred.place(id.slot);
        self.track(id.slot, true);
        self.volume_changed(id.slot);
        Ok(id)
    }

    /// Takes a body out of the world. Its motion is the one it was given last, from
    /// the beginning, and its orientation the one it had then.
    ///
    /// # Errors
    /// If there is no such body (any more).
    pub fn remove(&mut self, id: BodyId) -> Result<Body, BodyError> {
        let resident = self.slots.remove(id).ok_or(BodyError::UnknownBody { id })?;
        self.bvh.remove(id.slot);
        self.looks.forget();
        self.volume_changed(id.slot);
        Ok(resident.body)
    }

    /// Gives a body another motion, from the world's present time on.
    ///
    /// It begins with the orientation the body has got till now.
    ///
    /// # Errors
    /// If there is no such body (any more).
    pub fn set_motion(&mut self, id: BodyId, motion: Motion) -> Result<(), BodyError> {
        let motion = motion.checked()?;
        let time = self.time;
        let resident = self
            .slots
            .get_mut(id)
            .ok_or(BodyError::UnknownBody { id })?;
        // In free flight a body's whole path is unknown before and after.
        let keeps_volume = resident.body.motion.is_free() && motion.is_free();
        let was_fixed = resident.body.motion.is_fixed();
        let keeps_kind = was_fixed == motion.is_fixed();
        let from = resident.body.pose_after(time - resident.since);
        resident.body.orientation = from.orientation;
        resident.body.motion = motion;
        let to = resident.body.pose_after(0.0);
        let rounding = touch_tolerance(resident.reach, to.position.abs().max_element());
        // A turn carries the body's points farther than its origin.
        let turn = (to.orientation - from.orientation).length();
        let turn = turn.min((to.orientation + from.orientation).length());
        let shift = from.position.distance(to.position) + 2.0 * turn * resident.reach;
        let placed = shift > rounding;
        resident.since = time;
        (resident.centre_offset, resident.reach) = resident.body.hub();
        resident.half = tracks::half_extents(&resident.body, resident.centre_offset);
        if placed {
            self.stirred.place(id.slot);
        } else if was_fixed {
            self.stirred.release(id.slot);
        } else {
            self.stirred.divert(id.slot);
        }
        self.track(id.slot, placed || !keeps_kind);
        if placed || !keeps_volume {
            self.volume_changed(id.slot);
        }
        Ok(())
    }

    /// Writes the track of a body that has a new motion; `anew` if the hierarchies
    /// do not have the body, or have it where it is not.
    fn track(&mut self, slot: u32, anew: bool) {
        /// So many bodies outside the trees cost a query little.
        const WAITING: usize = 16;
        self.looks.forget();
        let Some(resident) = self.slots.at(slot) else {
            return;
        };
        let track = Track::new(resident);
        match track.course {
            Course::Path => self.on_paths.push(slot),
            Course::Free => self.safe_until = self.safe_until.min(track.safe_until()),
            Course::Fixed => {}
        }
        // A box that is to hold for longer would not hold the new motion.
        let is_beyond = self.horizon.is_beyond(self.time);
        self.horizon.disturb();
        let anew = anew || is_beyond && !(track.course == Course::Free && self.bvh.divert(slot));
        match self.bvh.get_mut(slot) {
            Some(place) if !anew => *place = track,
            _ => self.bvh.insert(slot, track.course != Course::Fixed, track),
        }
        if self.bvh.waiting() >= WAITING {
            let span = Span::at(self.time);
            self.bvh.settle(|track| track.swept(span));
        }
    }

    /// Has the pairs of a body listed anew, if such lists are kept.
    fn volume_changed(&mut self, slot: u32) {
        if self.config.broad_phase != BroadPhase::Bvh {
            self.changed.push(slot);
        }
    }

    /// Lets a body fly on freely from where it is, with another velocity (in
    /// metres per second).
    ///
    /// If it spins it goes on spinning about the same point, and the velocity is
    /// that point's. If it was facing its way it keeps the orientation it has.
    ///
    /// # Errors
    /// If there is no such body (any more), or a component of the velocity is
    /// not finite or beyond [`MAX_SPEED`](crate::tolerance::MAX_SPEED).
    pub fn set_velocity(
        &mut self,
        id: BodyId,
        velocity: impl Into<DVec3>,
    ) -> Result<(), BodyError> {
        let position = self.pose(id)?.position;
        let motion = Motion::free(position, velocity)?;
        let motion = motion.turning_as(self.resident(id)?.body.motion());
        self.set_motion(id, motion)
    }

    /// Where a body is now, and how it is turned.
    ///
    /// # Errors
    /// If there is no such body (any more).
    pub fn pose(&self, id: BodyId) -> Result<Pose, BodyError> {
        let resident = self.resident(id)?;
        Ok(resident.body.pose_after(self.time - resident.since))
    }

    /// How fast a body moves now, and whereto, in metres per second; of a body
    /// that spins, the point it spins about.
    ///
    /// # Errors
    /// If there is no such body (any more).
    pub fn velocity(&self, id: BodyId) -> Result<DVec3, BodyError> {
        let resident = self.resident(id)?;
        Ok(resident
            .body
            .motion
            .velocity_after(self.time - resident.since))
    }

    /// A contact's point in the first body's own coordinates and in the second's, in metres.
    ///
    /// From where the bodies' present motions have them at the contact's time.
    ///
    /// # Errors
    /// If one of the bodies is gone.
    pub fn local_points(&self, contact: &Contact) -> Result<[DVec3; 2], BodyError> {
        let local = |id: BodyId| -> Result<DVec3, BodyError> {
            let resident = self.resident(id)?;
            let pose = resident.body.pose_after(contact.time - resident.since);
            Ok(pose.local_point(contact.point))
        };
        Ok([local(contact.a)?, local(contact.b)?])
    }

    /// A body's shape.
    ///
    /// # Errors
    /// If there is no such body (any more).
    pub fn shape(&self, id: BodyId) -> Result<&Shape, BodyError> {
        Ok(self.resident(id)?.body.shape())
    }

    /// A body as the motion began that it has: its shape, motion, groups, and how it was turned
    /// then. Where it is now tells [`pose`](Self::pose).
    ///
    /// # Errors
    /// If there is no such body (any more).
    ///
    /// ```
    /// use feeler::{Body, CollisionWorld, Groups, Sphere};
    ///
    /// let mut world = CollisionWorld::default();
    /// let door = Body::fixed(Sphere::new(1.0)?, [0.0, 0.0, 0.0]).in_groups(Groups::new(1, 2));
    /// let id = world.insert(door)?;
    /// assert_eq!(world.body(id)?.groups(), Groups::new(1, 2));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn body(&self, id: BodyId) -> Result<&Body, BodyError> {
        Ok(&self.resident(id)?.body)
    }

    fn resident(&self, id: BodyId) -> Result<&Resident, BodyError> {
        self.slots.get(id).ok_or(BodyError::UnknownBody { id })
    }

    /// Whether the body is in the world.
    #[must_use]
    pub fn contains(&self, id: BodyId) -> bool {
        self.slots.get(id).is_some()
    }

    /// How many bodies are in the world.
    #[must_use]
    pub fn len(&self) -> usize {
        self.slots.len()
    }

    /// Whether there are no bodies in the world.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The ids of all bodies, in ascending order.
    pub fn bodies(&self) -> impl Iterator<Item = BodyId> + '_ {
        self.slots.iter().map(|(slot, _)| self.slots.id(slot))
    }

    /// The world's clock, in seconds since it was made.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The settings the world was made with.
    #[must_use]
    pub fn config(&self) -> &WorldConfig {
        &self.config
    }

    /// The contacts of the last step, sorted by time, then by ids.
    #[must_use]
    pub fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    /// The contacts of the last step in which a body takes part.
    pub fn contacts_of(&self, id: BodyId) -> impl Iterator<Item = &Contact> {
        self.contacts
            .iter()
            .filter(move |contact| contact.a == id || contact.b == id)
    }

    /// Bytes of memory in use, spare room included, but for what paths and
    /// polytopes, which may be shared, hold themselves.
    #[must_use]
    pub fn memory(&self) -> usize {
        fn of<T>(list: &Vec<T>) -> usize {
            list.capacity() * size_of::<T>()
        }
        size_of::<Self>()
            + self.slots.memory()
            + self.bvh.memory()
            + self.looks.memory()
            + self.stirred.memory()
            + self.findings.memory()
            + (of(&self.on_paths) + of(&self.contacts))
            + (of(&self.touching) + of(&self.met))
            + (of(&self.passed.pairs) + of(&self.passed.held_back))
            + (of(&self.volumes) + of(&self.changed))
    }

    /// What the last step did, and how long it took.
    #[must_use]
    pub fn stats(&self) -> &StepStats {
        &self.stats
    }
}

impl Resident {
    pub(super) fn new(body: Body, since: f64, solver: &Solver) -> Self {
        let (centre_offset, reach) = body.hub();
        Self {
            since,
            centre_offset,
            reach,
            half: tracks::half_extents(&body, centre_offset),
            points: solver.surface_points(&body.shape),
            frame: (body.motion.path().is_some())
                .then(|| Box::new(FrameMotion::new(&body.motion, 0.0, 1.0))),
            body,
        }
    }
}
