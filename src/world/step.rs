//! One frame, phase by phase.
//!
//! This is the one file that names every phase. Bodies' motions in the frame
//! come first, because they are all that can still fail; what follows changes
//! the world.

use crate::broad_phase::{BroadPhase, Bvh, FramePairs, PairList, Volume};
use crate::error::StepError;
use crate::math::domain;
use crate::motion::FrameMotion;
use crate::tolerance::{MAX_COORDINATE, MAX_TIME_STEP, MIN_TIME_STEP};
use crate::world::finding::Frame;
use crate::world::findings;
use crate::world::gate::{Gate, Keep};
use crate::world::slots::Slots;
use crate::world::stats::Laps;
use crate::world::tracks::{Course, Span, Track};
use crate::world::{BodyId, CollisionWorld, Contact, StepStats, volume};

/// While one body in so many is on a path, at most, theirs are the only pairs that are found anew in
/// each frame. Found by itself, a body costs some five times as much as among all others.
const FEW: usize = 16;

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
        self.detect(dt, None)?;
        self.advance(dt, 1.0);
        Ok(&self.contacts)
    }

    /// As [`step`](Self::step), for those pairs only that `keep` answers true for.
    ///
    /// It is asked about pairs that have passed the broad phase, the bodies' [`Groups`](crate::Groups)
    /// and the early-outs, in no particular order, perhaps from several threads: the
    /// answer must depend on nothing but the pair. A pair that was held back in one step and
    /// overlaps as the next begins is told as overlapping, not as touching.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    ///
    /// ```
    /// use feeler::{Body, CollisionWorld, Motion, Sphere};
    ///
    /// let mut world = CollisionWorld::default();
    /// let ball = Body::moving(Sphere::new(1.0)?, Motion::free([3.0, 0.0, 0.0], [-2.0, 0.0, 0.0])?);
    /// let ball = world.insert(ball)?;
    /// let friend = world.insert(Body::fixed(Sphere::new(1.0)?, [0.0, 0.0, 0.0]))?;
    /// let strangers = |a, b| (a, b) != (ball, friend);
    /// assert!(world.step_where(1.0, strangers)?.is_empty());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn step_where(
        &mut self,
        dt: f64,
        keep: impl Fn(BodyId, BodyId) -> bool + Sync,
    ) -> Result<&[Contact], StepError> {
        self.detect(dt, Some(&keep))?;
        self.advance(dt, 1.0);
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
        self.advance_to_contact(dt, None)
    }

    /// [`step_to_contact`](Self::step_to_contact), but only pairs count that `keep` answers true
    /// for, as in [`step_where`](Self::step_where).
    ///
    /// # Errors
    /// As [`step`](Self::step).
    ///
    /// ```
    /// use feeler::{Body, CollisionWorld, Motion, Sphere};
    ///
    /// let mut world = CollisionWorld::default();
    /// let ball = Motion::free([9.0, 0.0, 0.0], [-1.0, 0.0, 0.0])?;
    /// world.insert(Body::moving(Sphere::new(1.0)?, ball))?;
    /// let ghost = world.insert(Body::fixed(Sphere::new(1.0)?, [5.0, 0.0, 0.0]))?;
    /// world.insert(Body::fixed(Sphere::new(1.0)?, [0.0, 0.0, 0.0]))?;
    /// let advance = world.step_to_contact_where(9.0, |a, b| a != ghost && b != ghost)?;
    /// assert_eq!(advance.elapsed, 7.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn step_to_contact_where(
        &mut self,
        dt: f64,
        keep: impl Fn(BodyId, BodyId) -> bool + Sync,
    ) -> Result<Advance<'_>, StepError> {
        self.advance_to_contact(dt, Some(&keep))
    }

    fn advance_to_contact(&mut self, dt: f64, keep: Keep<'_>) -> Result<Advance<'_>, StepError> {
        self.detect(dt, keep)?;
        let first = self.contacts.iter().find(|contact| contact.is_touch());
        let elapsed = first.map_or(dt, |first| first.fraction * dt);
        let until = first.map_or(1.0, |first| first.fraction);
        self.contacts.retain(|contact| contact.fraction <= until);
        self.stats.contacts = self.contacts.len();
        self.advance(elapsed, until);
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
    fn detect(&mut self, dt: f64, keep: Keep<'_>) -> Result<(), StepError> {
        let mut laps = Laps::start();
        domain::within("dt", dt, MIN_TIME_STEP, MAX_TIME_STEP)?;
        self.check_coordinates(dt)?;
        let span = Span {
            time: self.time,
            dt,
        };
        let mut stats = StepStats {
            bodies: self.slots.len(),
            ..StepStats::default()
        };

        self.move_bodies(span);
        stats.times.motions = laps.lap();
        self.examine_pairs((span, keep), &mut stats, &mut laps);
        self.findings.sort_into(&mut self.contacts, &self.met);
        stats.contacts = self.contacts.len();
        stats.times.advance = laps.lap();
        self.stats = stats;
        Ok(())
    }

    /// Whether all bodies stay within the domain of coordinates.
    fn check_coordinates(&mut self, dt: f64) -> Result<(), StepError> {
        if self.time + dt <= self.safe_until {
            return Ok(());
        }
        // Paths do not leave it: their points were checked.
        let mut safe_until = f64::INFINITY;
        for (slot, resident) in self.slots.iter() {
            let motion = resident.body.motion();
            if !motion.is_free() {
                continue;
            }
            let end = motion.position_after(self.time + dt - resident.since);
            domain::vector("position", end, MAX_COORDINATE).map_err(|source| {
                StepError::LeftWorld {
                    id: self.slots.id(slot),
                    source,
                }
            })?;
            if let Some(track) = self.bvh.get(slot) {
                safe_until = safe_until.min(track.safe_until());
            }
        }
        self.safe_until = safe_until;
        Ok(())
    }

    /// What bodies on paths do in the frame; the others are on their tracks.
    fn move_bodies(&mut self, span: Span) {
        let Self {
            slots,
            bvh,
            on_paths,
            ..
        } = self;
        if !on_paths.is_sorted_by(|a, b| a < b) {
            on_paths.sort_unstable();
            on_paths.dedup();
        }
        on_paths.retain(|&slot| {
            let (Some(resident), Some(track)) = (slots.at_mut(slot), bvh.get_mut(slot)) else {
                return false;
            };
            if track.course != Course::Path {
                return false;
            }
            let (elapsed, duration) = span.of_motion(resident.since);
            let motion = resident.body.motion();
            let before = match &resident.frame {
                Some(frame) => **frame,
                None => FrameMotion::new(motion, 0.0, 1.0),
            };
            let frame = before.renewed(motion, elapsed, duration);
            *track = Track::in_frame(resident, &frame, span);
            match &mut resident.frame {
                Some(place) => **place = frame,
                None => resident.frame = Some(Box::new(frame)),
            }
            true
        });
    }

    /// The broad phase: which pairs can meet at all; the early-outs: which of them
    /// cannot meet in this frame; and the narrow phase: whether, when, where and how
    /// they meet.
    ///
    /// They take turns, so that pairs are examined while they are in the cache.
    fn examine_pairs(
        &mut self,
        (span, keep): (Span, Keep<'_>),
        stats: &mut StepStats,
        laps: &mut Laps,
    ) {
        let by_boxes = self.config.broad_phase == BroadPhase::Bvh;
        // The track of a body on a path holds for this frame only.
        let swept = |track: &Track, ahead: Span| {
            track.swept(if track.course == Course::Path {
                span
            } else {
                ahead
            })
        };
        let ahead = if by_boxes && self.horizon.holds(span) {
            for &slot in &self.on_paths {
                // Or it has come since, and is fitted in any case.
                self.bvh.divert(slot);
            }
            let (ahead, rest) = (self.horizon.ahead(), self.horizon.rest(span));
            self.bvh
                .renew(|track| track.swept(span), |track| swept(track, rest));
            ahead
        } else {
            let may_last = by_boxes && FEW * self.on_paths.len() <= self.slots.len();
            let ahead = self.horizon.begin(span, self.slots.len(), may_last);
            self.bvh.update(|track| swept(track, ahead));
            ahead
        };
        let gate = Gate {
            slots: &self.slots,
            keep,
            span,
            ahead,
        };
        let frame = Frame {
            config: &self.config,
            slots: &self.slots,
            stirred: &self.stirred,
            touching: &self.touching,
            span,
        };
        let (passed, findings) = (&mut self.passed, &mut self.findings);
        passed.clear();
        findings.clear();
        if by_boxes {
            frame.examine_portions(
                (&mut self.bvh, &gate),
                (&mut self.solver, passed, findings),
                (&mut stats.times, laps),
            );
            let kept = passed.seen - passed.dismissed;
            self.horizon.note(self.bvh.tests(), (passed.seen, kept));
        } else {
            Self::list_pairs(
                self.config.broad_phase,
                (&mut self.pairs, &mut self.frame_pairs),
                (&mut self.volumes, &mut self.changed),
                (&self.slots, &self.bvh, span),
            );
            stats.times.broad_phase += laps.lap();
            let listed = self.pairs.dynamic().iter().chain(self.pairs.fixed());
            for &(first, second) in listed.chain(self.frame_pairs.pairs()) {
                let leaf = |slot| self.bvh.at(self.bvh.leaf(slot)?);
                if let (Some(a), Some(b)) = (leaf(first), leaf(second)) {
                    gate.pass(&a, &b, passed);
                }
            }
            stats.times.early_outs += laps.lap();
            frame.examine_all((&passed.pairs, &self.bvh), &mut self.solver, findings);
            stats.times.narrow_phase += laps.lap();
        }
        stats.pairs = passed.seen;
        stats.rejected = passed.rejected;
        stats.examined = passed.count;
        (stats.stretches, stats.rays) = (findings.effort.stretches, findings.effort.rays);
        stats.undecided = findings.effort.undecided;
    }

    /// Brings the lists of pairs by volume up to date.
    fn list_pairs(
        broad_phase: BroadPhase,
        (pairs, frame_pairs): (&mut PairList, &mut FramePairs),
        (volumes, changed): (&mut Vec<Option<Volume>>, &mut Vec<u32>),
        (slots, bvh, span): (&Slots, &Bvh<Track>, Span),
    ) {
        if !changed.is_empty() {
            volumes.resize(slots.capacity(), None);
            for &slot in &*changed {
                if let Some(volume) = volumes.get_mut(slot as usize) {
                    let resident = slots.at(slot);
                    *volume = resident.and_then(|body| volume::of(&body.body, broad_phase));
                }
            }
            pairs.update(changed, volumes);
            changed.clear();
        }
        let anyone_free = broad_phase != BroadPhase::AllPairs
            && bvh.iter().any(|(_, track)| track.course == Course::Free);
        let present = bvh.iter().filter(|_| anyone_free);
        frame_pairs.update(present.map(|(slot, track)| volume::in_frame(slot, track, span)));
    }

    /// Lets time pass, and remembers which pairs touch from now on.
    fn advance(&mut self, elapsed: f64, until: f64) {
        self.time += elapsed;
        self.looks.forget();
        self.stirred.clear();
        self.findings.met_until(until, &mut self.met);
        if !self.passed.held_back.is_empty() {
            // Nobody looked whether they met.
            self.met.append(&mut self.passed.held_back);
            self.met.sort_unstable();
        }
        self.touching.clear();
        self.touching.append(&mut self.findings.resting);
        if until >= 1.0 {
            self.touching.extend(self.findings.touches());
        } else {
            let touches = self.contacts.iter().filter(|contact| contact.is_touch());
            let key = |contact: &Contact| findings::key(contact.a.slot, contact.b.slot);
            self.touching.extend(touches.map(key));
        }
        self.touching.sort_unstable();
    }
}
