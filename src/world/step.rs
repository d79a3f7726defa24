//! One frame, phase by phase.
//!
//! This is the one file that names every phase. Bodies' motions in the frame
//! come first, because they are all that can still fail; what follows changes
//! the world.

use crate::broad_phase::BroadPhase;
use crate::error::StepError;
use crate::math::domain;
use crate::motion::FrameMotion;
use crate::tolerance::{MAX_COORDINATE, MAX_TIME_STEP, MIN_TIME_STEP};
use crate::world::envelope::Envelope;
use crate::world::pair::{self, Mover, PairEffort};
use crate::world::slots::Resident;
use crate::world::stats::Laps;
use crate::world::{CollisionWorld, Contact, ContactKind, StepStats, volume};

/// How far [`CollisionWorld::step_to_contact`] came.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Advance<'a> {
    /// The contacts at the moment the world has advanced to: all that touch
    /// just then, and those that overlapped as the call was made. Touches are
    /// missing if there was none within the time given.
    pub contacts: &'a [Contact],
    /// How much time has passed, in seconds.
    pub elapsed: f64,
    /// How much of the time given is left, in seconds; 0 if nothing touched, or
    /// if less is left than [`MIN_TIME_STEP`], which no step can use.
    pub time_left: f64,
}

impl CollisionWorld {
    /// Advances the world by `dt` seconds and returns the contacts of that frame.
    ///
    /// # Errors
    /// If `dt` is not finite or not within
    /// [`MIN_TIME_STEP`]`..=`[`MAX_TIME_STEP`], or if a body in free flight
    /// would leave the domain of coordinates. The world is then as it was.
    ///
    /// ```
    /// use feeler::{CollisionWorld, StepError};
    ///
    /// let mut world = CollisionWorld::default();
    /// assert!(world.step(1.0 / 60.0)?.is_empty());
    /// assert!(matches!(world.step(-1.0), Err(StepError::Value(_))));
    /// assert_eq!(world.time(), 1.0 / 60.0);
    /// # Ok::<(), StepError>(())
    /// ```
    pub fn step(&mut self, dt: f64) -> Result<&[Contact], StepError> {
        self.detect(dt)?;
        self.advance(dt);
        Ok(&self.contacts)
    }

    /// Advances the world to the first touch within `dt` seconds, or by `dt` if
    /// there is none.
    ///
    /// That is what callers need who let bodies bounce: they change the motions
    /// of those that touch and call again with the time that is left. Bodies
    /// that overlap do not stop the world. A touch that is not answered by
    /// [`set_motion`](Self::set_motion) does not stop it again.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    ///
    /// ```
    /// use feeler::{Body, CollisionWorld, Motion, Sphere};
    ///
    /// let mut world = CollisionWorld::default();
    /// let ball = Motion::free([3.0, 0.0, 0.0], [-1.0, 0.0, 0.0])?;
    /// let ball = world.insert(Body::moving(Sphere::new(1.0)?, ball))?;
    /// world.insert(Body::fixed(Sphere::new(1.0)?, [0.0, 0.0, 0.0]))?;
    ///
    /// let advance = world.step_to_contact(4.0)?;
    /// assert_eq!((advance.elapsed, advance.time_left), (1.0, 3.0));
    /// let normal = advance.contacts[0].normal;
    /// world.set_velocity(ball, normal)?;
    /// assert_eq!(world.step_to_contact(3.0)?.time_left, 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn step_to_contact(&mut self, dt: f64) -> Result<Advance<'_>, StepError> {
        self.detect(dt)?;
        let first = self.contacts.iter().find(|contact| contact.is_touch());
        let elapsed = first.map_or(dt, |first| first.fraction * dt);
        if let Some(&Contact { fraction, .. }) = first {
            self.contacts.retain(|contact| contact.fraction <= fraction);
            self.stats.contacts = self.contacts.len();
        }
        self.advance(elapsed);
        let time_left = dt - elapsed;
        Ok(Advance {
            contacts: &self.contacts,
            elapsed,
            time_left: if time_left < MIN_TIME_STEP {
                0.0
            } else {
                time_left
            },
        })
    }

    /// Finds the contacts of the next `dt` seconds; bodies stay where they are.
    fn detect(&mut self, dt: f64) -> Result<(), StepError> {
        let mut laps = Laps::start();
        domain::within("dt", dt, MIN_TIME_STEP, MAX_TIME_STEP)?;
        self.check_coordinates(dt)?;
        let mut stats = StepStats {
            bodies: self.slots.len(),
            ..StepStats::default()
        };

        self.move_bodies(dt);
        stats.times.motions = laps.lap();
        self.list_pairs();
        stats.pairs =
            self.pairs.dynamic().len() + self.pairs.fixed().len() + self.frame_pairs.pairs().len();
        stats.times.broad_phase = laps.lap();
        self.reject_early(&mut stats);
        stats.times.early_outs = laps.lap();
        self.examine_pairs(dt, &mut stats);
        stats.times.narrow_phase = laps.lap();
        self.contacts.sort_by(|a, b| {
            a.time
                .total_cmp(&b.time)
                .then_with(|| (a.a, a.b).cmp(&(b.a, b.b)))
        });
        stats.contacts = self.contacts.len();
        stats.times.advance = laps.lap();
        self.stats = stats;
        Ok(())
    }

    /// Whether all bodies stay within the domain of coordinates.
    fn check_coordinates(&self, dt: f64) -> Result<(), StepError> {
        // Paths do not leave it: their points were checked.
        let flying = self
            .slots
            .iter()
            .filter(|(_, resident)| resident.body.motion().is_free());
        for (slot, resident) in flying {
            let end = resident
                .body
                .motion()
                .position_after(self.time + dt - resident.since);
            domain::vector("position", end, MAX_COORDINATE).map_err(|source| {
                StepError::LeftWorld {
                    id: self.slots.id(slot),
                    source,
                }
            })?;
        }
        Ok(())
    }

    /// What every body does in the frame.
    fn move_bodies(&mut self, dt: f64) {
        self.envelopes.clear();
        self.envelopes
            .resize(self.slots.capacity(), Envelope::default());
        for (slot, resident) in self.slots.iter_mut() {
            let elapsed = self.time - resident.since;
            // By the clock, which moves on by `dt` to rounding only: the next
            // frame shall begin where this one ends.
            let duration = (self.time + dt - resident.since) - elapsed;
            resident.frame = FrameMotion::new(resident.body.motion(), elapsed, duration);
            if let Some(envelope) = self.envelopes.get_mut(slot as usize) {
                *envelope = Envelope::of(resident);
            }
        }
    }

    /// The broad phase: which pairs can meet at all.
    fn list_pairs(&mut self) {
        let broad_phase = self.config.broad_phase;
        if !self.changed.is_empty() {
            self.volumes.resize(self.slots.capacity(), None);
            for &slot in &self.changed {
                if let Some(volume) = self.volumes.get_mut(slot as usize) {
                    let resident = self.slots.at(slot);
                    *volume = resident.and_then(|body| volume::of(&body.body, broad_phase));
                }
            }
            self.pairs.update(&self.changed, &self.volumes);
            self.changed.clear();
        }
        let is_free = |(_, body): (u32, &Resident)| body.body.motion().is_free();
        let anyone_free = broad_phase != BroadPhase::AllPairs && self.slots.iter().any(is_free);
        let boxes = anyone_free.then(|| self.slots.iter()).into_iter().flatten();
        self.frame_pairs
            .update(boxes.map(|(slot, body)| volume::in_frame(slot, body)));
    }

    /// The early-outs: which of them cannot meet in this frame.
    fn reject_early(&mut self, stats: &mut StepStats) {
        self.survivors.clear();
        let listed = self.pairs.dynamic().iter().chain(self.pairs.fixed());
        for &(first, second) in listed.chain(self.frame_pairs.pairs()) {
            let envelopes = &self.envelopes;
            let (Some(a), Some(b)) = (
                envelopes.get(first as usize),
                envelopes.get(second as usize),
            ) else {
                debug_assert!(false, "a pair of a body that is gone");
                continue;
            };
            match a.reject(b) {
                Some(rejection) => stats.rejected.count(rejection),
                None => self.survivors.push((first, second)),
            }
        }
        stats.examined = self.survivors.len();
    }

    /// The narrow phase: whether, when, where and how they meet.
    fn examine_pairs(&mut self, dt: f64, stats: &mut StepStats) {
        self.contacts.clear();
        self.resting.clear();
        let mut effort = PairEffort::default();
        for &(first, second) in &self.survivors {
            let (Some(a), Some(b)) = (self.slots.at(first), self.slots.at(second)) else {
                continue;
            };
            let placed = a.placed || b.placed;
            let (a, b) = (Mover::new(a), Mover::new(b));
            let found = pair::examine(&mut self.solver, &a, &b, &mut effort);
            let found = found.unwrap_or_else(|undecided| {
                stats.undecided += 1;
                pair::overlap_at_end(&a, &b, undecided)
            });
            let Some(finding) = found else {
                continue;
            };
            if finding.resting && self.touching.binary_search(&(first, second)).is_ok() {
                // Reported when they met.
                self.resting.push((first, second));
                continue;
            }
            let mut found = finding.contact;
            // Apart a frame ago, and moved into each other since: that they met
            // was overlooked by rounding, or by too few rays, and is told now.
            let ordered = (first.min(second), first.max(second));
            if !placed && self.met.binary_search(&ordered).is_err() {
                found.kind = ContactKind::Touch;
            }
            self.contacts.push(Contact {
                a: self.slots.id(first),
                b: self.slots.id(second),
                time: self.time + found.fraction * dt,
                fraction: found.fraction,
                point: found.point,
                normal: found.normal,
                feature_a: found.features[0],
                feature_b: found.features[1],
                kind: found.kind,
            });
        }
        (stats.stretches, stats.rays) = (effort.stretches, effort.rays);
    }

    /// Lets time pass, and remembers which pairs touch from now on.
    fn advance(&mut self, elapsed: f64) {
        self.time += elapsed;
        for (_, resident) in self.slots.iter_mut() {
            resident.placed = false;
        }
        let contacts = self.contacts.iter().map(|c| (c.a.slot, c.b.slot));
        self.met.clear();
        self.met.extend(
            contacts
                .chain(self.resting.iter().copied())
                .map(|(a, b)| (a.min(b), a.max(b))),
        );
        self.met.sort_unstable();
        self.touching.clear();
        self.touching.append(&mut self.resting);
        let touches = self.contacts.iter().filter(|contact| contact.is_touch());
        self.touching
            .extend(touches.map(|contact| (contact.a.slot, contact.b.slot)));
        self.touching.sort_unstable();
    }
}
