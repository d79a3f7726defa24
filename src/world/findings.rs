//! What the narrow phase finds in a frame, and its order.

use crate::world::pair::PairEffort;
use crate::world::radix::sort_by_slots;
use crate::world::{Contact, ContactKind};

/// A pair of slots, the lower one first, as one number to sort by.
pub(super) type PairKey = u64;

/// The key of a pair, in whatever order.
#[inline]
pub(super) fn key(a: u32, b: u32) -> PairKey {
    u64::from(a.min(b)) << 32 | u64::from(a.max(b))
}

/// All that the narrow phase finds.
#[derive(Debug, Clone, Default)]
pub(super) struct Findings {
    /// Contacts as they were found.
    pub(super) contacts: Vec<Contact>,
    /// Those that other threads found: left where they are.
    parts: Vec<Vec<Contact>>,
    /// For each contact its pair, and where it is.
    pub(super) keys: Vec<Found>,
    /// Pairs that were reported as touching and touch still.
    pub(super) resting: Vec<PairKey>,
    pub(super) effort: PairEffort,
    /// Room to sort in.
    spare: Vec<Found>,
    late: Vec<Late>,
}

/// Which contact is whose.
#[derive(Debug, Clone, Copy)]
pub(super) struct Found {
    pair: PairKey,
    /// In which list, and where in it.
    part: u32,
    index: u32,
    /// Whether the contact names the higher slot first.
    turned: bool,
    /// Whether it is one of the moment at which the frame begins.
    at_start: bool,
    /// Whether the pair may have met unseen: it overlaps, and neither body was put where it is.
    drifted: bool,
}

/// A contact within the frame, by what it is sorted by.
#[derive(Debug, Clone, Copy)]
struct Late {
    time: f64,
    found: Found,
}

impl Found {
    /// The slots as the contact names them.
    fn order(&self) -> u64 {
        if self.turned {
            self.pair.rotate_left(32)
        } else {
            self.pair
        }
    }
}

impl Findings {
    pub(super) fn clear(&mut self) {
        self.contacts.clear();
        self.parts.clear();
        self.keys.clear();
        self.resting.clear();
        self.effort = PairEffort::default();
    }

    /// Adds a contact; `is_placed` tells whether one of its bodies was put where it is.
    pub(super) fn push(&mut self, contact: Contact, is_placed: bool) {
        let (a, b) = (contact.a.slot, contact.b.slot);
        let overlaps = matches!(contact.kind, ContactKind::Overlap { .. });
        self.keys.push(Found {
            pair: key(a, b),
            part: 0,
            index: self.contacts.len() as u32,
            turned: a > b,
            at_start: contact.fraction <= 0.0,
            drifted: overlaps && !is_placed,
        });
        self.contacts.push(contact);
    }

    /// Adds what was found of other pairs.
    #[cfg(feature = "parallel")]
    pub(super) fn append(&mut self, other: Self) {
        debug_assert!(other.parts.is_empty(), "parts have no parts");
        self.parts.push(other.contacts);
        let part = self.parts.len() as u32;
        self.keys
            .extend(other.keys.iter().map(|found| Found { part, ..*found }));
        self.resting.extend_from_slice(&other.resting);
        self.effort.stretches += other.effort.stretches;
        self.effort.rays += other.effort.rays;
        self.effort.undecided += other.effort.undecided;
    }

    /// Bytes in use.
    pub(super) fn memory(&self) -> usize {
        let parts = self.parts.iter().map(Vec::capacity).sum::<usize>();
        (self.contacts.capacity() + parts) * size_of::<Contact>()
            + (self.keys.capacity() + self.spare.capacity()) * size_of::<Found>()
            + self.late.capacity() * size_of::<Late>()
            + self.resting.capacity() * size_of::<PairKey>()
    }

    fn list(&self, part: u32) -> &[Contact] {
        match part.checked_sub(1) {
            None => &self.contacts,
            Some(part) => self.parts.get(part as usize).map_or(&[], Vec::as_slice),
        }
    }

    fn contact(&self, found: &Found) -> Option<&Contact> {
        self.list(found.part).get(found.index as usize)
    }

    fn contact_mut(&mut self, found: &Found) -> Option<&mut Contact> {
        let list = match found.part.checked_sub(1) {
            None => &mut self.contacts,
            Some(part) => self.parts.get_mut(part as usize)?,
        };
        list.get_mut(found.index as usize)
    }

    /// Sorts the contacts into `sorted`: by time, then by ids.
    ///
    /// `met` are the pairs with a contact in the frame before, sorted.
    pub(super) fn sort_into(&mut self, sorted: &mut Vec<Contact>, met: &[PairKey]) {
        let mut keys = std::mem::take(&mut self.keys);
        sort_by_slots((&mut keys, &mut self.spare), |found| found.pair);
        // Both lists are sorted: one pass tells which pairs are in both.
        let mut met = met.iter().peekable();
        for found in &keys {
            while met.next_if(|&&pair| pair < found.pair).is_some() {}
            let is_new = met.peek().is_none_or(|&&pair| pair != found.pair);
            // Apart a frame ago, and moved into each other since: that they met
            // was overlooked by rounding, or by too few rays, and is told now.
            if found.drifted
                && is_new
                && let Some(contact) = self.contact_mut(found)
            {
                contact.kind = ContactKind::Touch;
            }
        }
        if keys.iter().any(|found| found.turned) {
            sort_by_slots((&mut keys, &mut self.spare), Found::order);
        }
        // Most contacts of a crowd are overlaps as the frame begins, and in order now.
        let mut late = std::mem::take(&mut self.late);
        late.clear();
        late.extend(
            keys.iter()
                .filter(|found| !found.at_start)
                .filter_map(|&found| {
                    let time = self.contact(&found)?.time;
                    Some(Late { time, found })
                }),
        );
        late.sort_unstable_by(|a, b| {
            let order = |late: &Late| late.found.order();
            a.time
                .total_cmp(&b.time)
                .then_with(|| order(a).cmp(&order(b)))
        });
        self.spare.clear();
        self.spare
            .extend(keys.iter().filter(|found| found.at_start));
        self.spare.extend(late.iter().map(|late| late.found));
        self.gather(sorted);
        (self.keys, self.late) = (keys, late);
    }

    /// The contacts in the order in which their keys lie in the spare room.
    fn gather(&self, sorted: &mut Vec<Contact>) {
        #[cfg(feature = "parallel")]
        if self.spare.len() > 2 * GATHERED && rayon::current_num_threads() > 1 {
            use rayon::prelude::*;
            let found = self.spare.par_iter().with_min_len(GATHERED);
            let contact = |found: &Found| self.list(found.part)[found.index as usize];
            found.map(contact).collect_into_vec(sorted);
            return;
        }
        sorted.clear();
        let found = self.spare.iter();
        sorted.extend(found.filter_map(|found| self.contact(found).copied()));
    }

    /// The pairs with a contact at `until` or before, in fractions of the frame,
    /// and those that rest in touch: into `met`, sorted.
    pub(super) fn met_until(&self, until: f64, met: &mut Vec<PairKey>) {
        met.clear();
        let counts = |found: &&Found| {
            let is_soon = |contact: &Contact| contact.fraction <= until;
            found.at_start || until >= 1.0 || self.contact(found).is_some_and(is_soon)
        };
        met.extend(self.keys.iter().filter(counts).map(|found| found.pair));
        met.extend_from_slice(&self.resting);
        if !met.is_sorted() {
            met.sort_unstable();
        }
    }
}

/// So many contacts are worth handing to another thread.
#[cfg(feature = "parallel")]
const GATHERED: usize = 1024;
