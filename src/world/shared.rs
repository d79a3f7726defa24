//! What several threads find, put in order by all of them.

use crate::math::radix::sort_by_slots;
use crate::world::Contact;
use crate::world::findings::{Findings, Found, Late, PairKey, mark_met, sort_late};
use rayon::prelude::*;
use std::sync::Mutex;

/// Keys are sorted in so many portions, each by one thread: enough that no thread is
/// idle for long, of slots that follow each other.
pub(super) const PORTIONS: usize = 32;

/// Where each portion of some keys ends.
pub(super) type Ends = [u32; PORTIONS];

/// All contacts that several threads have found.
#[derive(Debug, Default)]
pub(super) struct Shared {
    parts: Vec<Findings>,
    portions: Vec<Portion>,
    late: Vec<Late>,
    /// The memory of earlier parts.
    pool: Mutex<Vec<Findings>>,
}

/// The keys of some slots.
#[derive(Debug, Default)]
struct Portion {
    /// In order.
    keys: Vec<Found>,
    /// Those of the moment at which the frame begins; room to sort in before.
    at_start: Vec<Found>,
    late: Vec<Late>,
    /// Their pairs, and those that are told as touching.
    met: Vec<PairKey>,
    touches: Vec<PairKey>,
}

impl Portion {
    /// Takes its keys from all parts, in order.
    fn fill(&mut self, number: usize, parts: &[Findings], met: &[PairKey]) {
        self.keys.clear();
        for (index, part) in parts.iter().enumerate() {
            let keys = part.portion(number).iter();
            self.keys.extend(keys.map(|found| found.of_part(index)));
        }
        if !self.keys.is_sorted_by_key(Found::order) {
            sort_by_slots((&mut self.keys, &mut self.at_start), Found::order);
        }
        mark_met(&mut self.keys, met);
        self.met.clear();
        self.met.extend(self.keys.iter().map(Found::order));
        self.touches.clear();
        self.touches
            .extend(self.keys.iter().filter_map(Found::touch));
        self.at_start.clear();
        self.late.clear();
        for &found in &self.keys {
            if found.is(Found::AT_START) {
                self.at_start.push(found);
            } else if let Some(contact) = contact(parts, &found) {
                let time = contact.time;
                self.late.push(Late { time, found });
            }
        }
    }
}

impl Shared {
    /// Forgets all parts, but for their memory.
    pub(super) fn clear(&mut self) {
        if let Ok(pool) = self.pool.get_mut() {
            pool.extend(self.parts.drain(..).map(|mut part| {
                part.clear();
                part
            }));
        }
        self.parts.clear();
        for portion in &mut self.portions {
            portion.keys.clear();
            portion.met.clear();
            portion.touches.clear();
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// Empty findings, with the memory of earlier ones.
    pub(super) fn room(&self) -> Findings {
        let room = self.pool.lock().map(|mut pool| pool.pop());
        room.ok().flatten().unwrap_or_default()
    }

    pub(super) fn add(&mut self, part: Findings) {
        self.parts.push(part);
    }

    /// Adds the pairs with a contact at `until` or before, sorted.
    pub(super) fn met_until(&self, until: f64, met: &mut Vec<PairKey>) {
        for portion in &self.portions {
            if until >= 1.0 {
                met.extend_from_slice(&portion.met);
                continue;
            }
            let counts = |found: &&Found| {
                let is_soon = |contact: &Contact| contact.fraction <= until;
                contact(&self.parts, found).is_some_and(is_soon)
            };
            met.extend(portion.keys.iter().filter(counts).map(Found::order));
        }
    }

    /// The pairs that are told as touching.
    pub(super) fn touches(&self) -> impl Iterator<Item = PairKey> {
        let touches = self.portions.iter().map(|portion| &portion.touches);
        touches.flatten().copied()
    }

    /// Sorts the contacts of all parts: see [`Findings::sort_into`].
    pub(super) fn sort_into(&mut self, sorted: &mut Vec<Contact>, met: &[PairKey]) {
        let Self {
            parts,
            portions,
            late,
            ..
        } = self;
        portions.resize_with(PORTIONS, Portion::default);
        let numbered = portions.par_iter_mut().enumerate();
        numbered.for_each(|(number, portion)| portion.fill(number, parts, met));
        late.clear();
        for portion in &*portions {
            late.extend_from_slice(&portion.late);
        }
        sort_late(late);
        let at_start = portions.iter().map(|portion| portion.at_start.len());
        let count = at_start.sum::<usize>() + late.len();
        // What is there is overwritten; there may be more than before.
        sorted.truncate(count);
        if let Some(any) = parts.iter().find_map(|part| part.contacts.first()) {
            sorted.resize(count, *any);
        }
        let mut rest = sorted.as_mut_slice();
        let mut places = Vec::with_capacity(PORTIONS);
        for portion in &*portions {
            let count = portion.at_start.len().min(rest.len());
            let (some, others) = rest.split_at_mut(count);
            places.push((some, portion.at_start.as_slice()));
            rest = others;
        }
        let tell = |place: &mut Contact, found: &Found| {
            if let Some(contact) = contact(parts, found) {
                *place = found.told(contact);
            }
        };
        places.into_par_iter().for_each(|(places, founds)| {
            for (place, found) in places.iter_mut().zip(founds) {
                tell(place, found);
            }
        });
        for (place, late) in rest.iter_mut().zip(late) {
            tell(place, &late.found);
        }
    }

    /// Bytes in use.
    pub(super) fn memory(&self) -> usize {
        let portions = self.portions.iter().map(|portion| {
            (portion.keys.capacity() + portion.at_start.capacity()) * size_of::<Found>()
                + portion.late.capacity() * size_of::<Late>()
                + (portion.met.capacity() + portion.touches.capacity()) * size_of::<PairKey>()
        });
        let pool = self.pool.lock().map_or(0, |pool| {
            pool.iter().map(Findings::memory).sum::<usize>()
                + pool.capacity() * size_of::<Findings>()
        });
        let parts = self.parts.iter().map(Findings::memory).sum::<usize>();
        portions.sum::<usize>()
            + parts
            + pool
            + self.parts.capacity() * size_of::<Findings>()
            + self.late.capacity() * size_of::<Late>()
    }
}

fn contact<'a>(parts: &'a [Findings], found: &Found) -> Option<&'a Contact> {
    parts.get(found.part())?.contacts.get(found.index())
}
