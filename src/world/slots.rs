//! Where bodies are kept.

use crate::motion::FrameMotion;
use crate::world::{Body, BodyId};
use glam::DVec3;

/// A body with what is worked out once when it is inserted.
#[derive(Debug, Clone)]
pub(crate) struct Resident {
    pub(crate) body: Body,
    /// World time from which its motion counts.
    pub(crate) since: f64,
    /// From its motion's position to the centre of a sphere that moves without
    /// turning and holds it.
    pub(crate) centre_offset: DVec3,
    /// Radius of this sphere.
    pub(crate) reach: f64,
    /// Whether it was put where it is since the last step, and did not get there by its motion.
    pub(crate) placed: bool,
    /// Starting points of rays that do not depend on the motion, in its own frame.
    pub(crate) points: Vec<DVec3>,
    /// What it does in the frame at hand.
    pub(crate) frame: FrameMotion,
}

/// Bodies by slot, with generations that tell a slot's tenants apart.
#[derive(Debug, Clone, Default)]
pub(crate) struct Slots {
    slots: Vec<Slot>,
    vacant: Vec<u32>,
    occupied: usize,
}

#[derive(Debug, Clone, Default)]
struct Slot {
    generation: u32,
    resident: Option<Resident>,
}

impl Slots {
    /// More bodies than this cannot be numbered.
    pub(crate) const MAX: usize = u32::MAX as usize;

    pub(crate) fn len(&self) -> usize {
        self.occupied
    }

    /// Number of slots, vacant ones included.
    pub(crate) fn capacity(&self) -> usize {
        self.slots.len()
    }

    /// The id that the next insertion will give; none if all are taken.
    pub(crate) fn next_id(&self) -> Option<BodyId> {
        let slot = match self.vacant.last() {
            Some(&slot) => slot,
            None if self.slots.len() < Self::MAX => self.slots.len() as u32,
            None => return None,
        };
        Some(BodyId {
            slot,
            generation: self.generation(slot),
        })
    }

    pub(crate) fn insert(&mut self, id: BodyId, resident: Resident) {
        if self.vacant.last() == Some(&id.slot) {
            self.vacant.pop();
        } else {
            self.slots.push(Slot::default());
        }
        if let Some(slot) = self.slots.get_mut(id.slot as usize) {
            debug_assert!(slot.resident.is_none(), "the slot is taken");
            slot.resident = Some(resident);
            self.occupied += 1;
        }
    }

    pub(crate) fn remove(&mut self, id: BodyId) -> Option<Resident> {
        self.get(id)?;
        let slot = self.slots.get_mut(id.slot as usize)?;
        let resident = slot.resident.take()?;
        self.occupied -= 1;
        // A slot whose generations are used up stays vacant for good.
        if let Some(next) = slot.generation.checked_add(1) {
            slot.generation = next;
            self.vacant.push(id.slot);
        }
        Some(resident)
    }

    pub(crate) fn get(&self, id: BodyId) -> Option<&Resident> {
        let slot = self.slots.get(id.slot as usize)?;
        slot.resident
            .as_ref()
            .filter(|_| slot.generation == id.generation)
    }

    pub(crate) fn get_mut(&mut self, id: BodyId) -> Option<&mut Resident> {
        let slot = self.slots.get_mut(id.slot as usize)?;
        let generation = slot.generation;
        slot.resident
            .as_mut()
            .filter(|_| generation == id.generation)
    }

    /// The tenant of a slot.
    pub(crate) fn at(&self, slot: u32) -> Option<&Resident> {
        self.slots.get(slot as usize)?.resident.as_ref()
    }

    pub(crate) fn id(&self, slot: u32) -> BodyId {
        BodyId {
            slot,
            generation: self.generation(slot),
        }
    }

    fn generation(&self, slot: u32) -> u32 {
        self.slots
            .get(slot as usize)
            .map_or(0, |slot| slot.generation)
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = (u32, &Resident)> {
        (0..)
            .zip(&self.slots)
            .filter_map(|(index, slot)| Some((index, slot.resident.as_ref()?)))
    }

    pub(crate) fn iter_mut(&mut self) -> impl Iterator<Item = (u32, &mut Resident)> {
        (0..)
            .zip(&mut self.slots)
            .filter_map(|(index, slot)| Some((index, slot.resident.as_mut()?)))
    }
}
