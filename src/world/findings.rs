//! What the narrow phase finds in a frame, and its order.

use crate::math::radix::sort_by_slots;
use crate::world::pair::PairEffort;
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
    /// The slots as the contact names them, as one number to sort by.
    order: u64,
    /// Where in its list.
    index: u32,
    /// In which list, and two marks.
    rest: u32,
}

impl Found {
    /// It is one of the moment at which the frame begins.
    const AT_START: u32 = 1;
    /// The pair may have met unseen: it overlaps, and neither body was put where it is.
    const DRIFTED: u32 = 2;

    fn is(&self, mark: u32) -> bool {
        self.rest & mark != 0
    }

    fn part(&self) -> usize {
        (self.rest >> 2) as usize
    }
}

/// A contact within the frame, by what it is sorted by.
#[derive(Debug, Clone, Copy)]
struct Late {
    time: f64,
    found: Found,
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
        let overlaps = matches!(contact.kind, ContactKind::Overlap { .. });
        let mark = |is: bool, mark: u32| if is { mark } else { 0 };
        self.keys.push(Found {
            order: u64::from(contact.a.slot) << 32 | u64::from(contact.b.slot),
            index: self.contacts.len() as u32,
            rest: mark(contact.fraction <= 0.0, Found::AT_START)
                | mark(overlaps && !is_placed, Found::DRIFTED),
        });
        self.contacts.push(contact);
    }

    /// Adds what was found of other pairs.
    #[cfg(feature = "parallel")]
    pub(super) fn append(&mut self, other: Self) {
        debug_assert!(other.parts.is_empty(), "parts have no parts");
        self.parts.push(other.contacts);
        let part = (self.parts.len() as u32) << 2;
        let found = other.keys.iter().map(|found| Found {
            rest: part | found.rest,
            ..*found
        });
        self.keys.extend(found);
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

    fn list(&self, part: usize) -> &[Contact] {
        match part.checked_sub(1) {
            None => &self.contacts,
            Some(part) => self.parts.get(part).map_or(&[], Vec::as_slice),
        }
    }

    fn contact(&self, found: &Found) -> Option<&Contact> {
        self.list(found.part()).get(found.index as usize)
    }

    fn contact_mut(&mut self, found: &Found) -> Option<&mut Contact> {
        let list = match found.part().checked_sub(1) {
            None => &mut self.contacts,
            Some(part) => self.parts.get_mut(part)?,
        };
        list.get_mut(found.index as usize)
    }

    /// Sorts the contacts into `sorted`: by time, then by ids.
    ///
    /// `met` are the pairs with a contact in the frame before, as contacts name them, sorted.
    pub(super) fn sort_into(&mut self, sorted: &mut Vec<Contact>, met: &[PairKey]) {
        self.sort_keys();
        let keys = std::mem::take(&mut self.keys);
        // Both lists are sorted: one pass tells which pairs are in both.
        let mut before = met.iter().peekable();
        for found in keys.iter().filter(|found| found.is(Found::DRIFTED)) {
            while before.next_if(|&&pair| pair < found.order).is_some() {}
            let is_new = before.peek().is_none_or(|&&pair| pair != found.order);
            // A pair changes its order if one of its bodies stops or sets out.
            let turned = found.order.rotate_left(32);
            // Apart a frame ago, and moved into each other since: that they met
            // was overlooked by rounding, or by too few rays, and is told now.
            if is_new
                && met.binary_search(&turned).is_err()
                && let Some(contact) = self.contact_mut(found)
            {
                contact.kind = ContactKind::Touch;
            }
        }
        // Most contacts of a crowd are overlaps as the frame begins, and in order now.
        let mut late = std::mem::take(&mut self.late);
        late.clear();
        let is_late = |found: &&Found| !found.is(Found::AT_START);
        late.extend(keys.iter().filter(is_late).filter_map(|&found| {
            let time = self.contact(&found)?.time;
            Some(Late { time, found })
        }));
        late.sort_unstable_by(|a, b| {
            let by_time = a.time.total_cmp(&b.time);
            by_time.then(a.found.order.cmp(&b.found.order))
        });
        self.spare.clear();
        let at_start = keys.iter().filter(|found| found.is(Found::AT_START));
        self.spare.extend(at_start);
        self.spare.extend(late.iter().map(|late| late.found));
        self.gather(sorted);
        (self.keys, self.late) = (keys, late);
    }

    /// Sorts the keys by slots.
    ///
    /// Pairs that are kept from frame to frame are in order, and come first; those
    /// of bodies that are new follow.
    fn sort_keys(&mut self) {
        let keys = &mut self.keys;
        let in_order = keys.windows(2).position(|pair| match pair {
            [one, next] => next.order < one.order,
            _ => false,
        });
        let Some(end) = in_order.map(|last| last + 1) else {
            return;
        };
        if 4 * (keys.len() - end) > keys.len() {
            sort_by_slots((keys, &mut self.spare), |found| found.order);
            return;
        }
        let (kept, new) = keys.split_at_mut(end);
        new.sort_unstable_by_key(|found| found.order);
        self.spare.clear();
        let mut kept = kept.iter().peekable();
        for found in new {
            while let Some(before) = kept.next_if(|other| other.order < found.order) {
                self.spare.push(*before);
            }
            self.spare.push(*found);
        }
        self.spare.extend(kept);
        std::mem::swap(&mut self.keys, &mut self.spare);
    }

    /// The contacts in the order in which their keys lie in the spare room.
    fn gather(&self, sorted: &mut Vec<Contact>) {
        #[cfg(feature = "parallel")]
        if self.spare.len() > 2 * GATHERED && rayon::current_num_threads() > 1 {
            use rayon::prelude::*;
            let found = self.spare.par_iter().with_min_len(GATHERED);
            let contact = |found: &Found| self.list(found.part())[found.index as usize];
            found.map(contact).collect_into_vec(sorted);
            return;
        }
        sorted.clear();
        sorted.reserve(self.spare.len());
        let found = self.spare.iter();
        sorted.extend(found.filter_map(|found| self.contact(found).copied()));
    }

    /// The pairs with a contact at `until` or before, in fractions of the frame,
    /// and those that rest in touch: into `met`, sorted.
    pub(super) fn met_until(&self, until: f64, met: &mut Vec<PairKey>) {
        met.clear();
        let counts = |found: &&Found| {
            let is_soon = |contact: &Contact| contact.fraction <= until;
            found.is(Found::AT_START) || until >= 1.0 || self.contact(found).is_some_and(is_soon)
        };
        met.extend(self.keys.iter().filter(counts).map(|found| found.order));
        // Whichever order they are named in.
        let turned = self.resting.iter().map(|pair| pair.rotate_left(32));
        met.extend(self.resting.iter().copied().chain(turned));
        if !met.is_sorted() {
            met.sort_unstable();
        }
    }
}

/// So many contacts are worth handing to another thread.
#[cfg(feature = "parallel")]
const GATHERED: usize = 1024;
