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
    /// Half the edges of the box around it, from its bounding centre, along the world's axes.
    pub(crate) half: DVec3,
    /// Starting points of rays that do not depend on the motion, in its own frame.
    pub(crate) points: Vec<DVec3>,
    /// What it does in the frame at hand, if it is on a path.
    ///
    /// Apart: it is large, and most bodies have none.
    pub(crate) frame: Option<Box<FrameMotion>>,
}

/// Bodies by slot, with generations that tell a slot's tenants apart.
#[derive(Debug, Clone, Default)]
pub(crate) struct Slots {
    residents: Vec<Option<Resident>>,
    /// Apart, so that ids are made without a look at the bodies.
    generations: Vec<u32>,
    vacant: Vec<u32>,
    occupied: usize,
}

impl Slots {
    /// More bodies than this cannot be numbered.
    pub(crate) const MAX: usize = u32::MAX as usize;

    pub(crate) fn len(&self) -> usize {
        self.occupied
    }

    /// Number of slots, vacant ones included.
    pub(crate) fn capacity(&self) -> usize {
        self.residents.len()
    }

    /// The id that the next insertion will give; none if all are taken.
    pub(crate) fn next_id(&self) -> Option<BodyId> {
        let slot = match self.vacant.last() {
            Some(&slot) => slot,
            None if self.residents.len() < Self::MAX => self.residents.len() as u32,
            None => return None,
        };
        Some(self.id(slot))
    }

    pub(crate) fn insert(&mut self, id: BodyId, resident: Resident) {
        if self.vacant.last() == Some(&id.slot) {
            self.vacant.pop();
        } else {
            self.residents.push(None);
            self.generations.push(0);
        }
        if let Some(place) = self.residents.get_mut(id.slot as usize) {
            debug_assert!(place.is_none(), "the slot is taken");
            *place = Some(resident);
            self.occupied += 1;
        }
    }

    pub(crate) fn remove(&mut self, id: BodyId) -> Option<Resident> {
        self.get(id)?;
        let resident = self.residents.get_mut(id.slot as usize)?.take()?;
        self.occupied -= 1;
        // A slot whose generations are used up stays vacant for good.
        let generation = self.generations.get_mut(id.slot as usize)?;
        if let Some(next) = generation.checked_add(1) {
            *generation = next;
            self.vacant.push(id.slot);
        }
        Some(resident)
    }

    pub(crate) fn get(&self, id: BodyId) -> Option<&Resident> {
        self.at(id.slot).filter(|_| self.id(id.slot) == id)
    }

    pub(crate) fn get_mut(&mut self, id: BodyId) -> Option<&mut Resident> {
        if self.id(id.slot) != id {
            return None;
        }
        self.residents.get_mut(id.slot as usize)?.as_mut()
    }

    /// The tenant of a slot.
    pub(crate) fn at(&self, slot: u32) -> Option<&Resident> {
        self.residents.get(slot as usize)?.as_ref()
    }

    pub(crate) fn at_mut(&mut self, slot: u32) -> Option<&mut Resident> {
        self.residents.get_mut(slot as usize)?.as_mut()
    }

    pub(crate) fn id(&self, slot: u32) -> BodyId {
        let generation = self.generations.get(slot as usize);
        BodyId {
            slot,
            generation: generation.copied().unwrap_or(0),
        }
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = (u32, &Resident)> {
        (0..)
            .zip(&self.residents)
            .filter_map(|(index, resident)| Some((index, resident.as_ref()?)))
    }

    /// Bytes in use.
    pub(crate) fn memory(&self) -> usize {
        let on_paths = self.iter().filter(|(_, body)| body.frame.is_some()).count();
        self.residents.capacity() * size_of::<Option<Resident>>()
            + on_paths * size_of::<FrameMotion>()
            + (self.generations.capacity() + self.vacant.capacity()) * size_of::<u32>()
    }
}
