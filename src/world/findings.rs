//! What the narrow phase finds in a frame, and its order.

use crate::math::radix::sort_by_slots;
use crate::world::pair::PairEffort;
#[cfg(feature = "parallel")]
use crate::world::shared::{Ends, PORTIONS, Shared};
use crate::world::{Contact, ContactKind};

/// A pair of slots, the lower one first, as one number to sort by.
pub(super) type PairKey = u64;

/// The key of a pair, in whatever order.
#[inline]
pub(super) fn key(a: u32, b: u32) -> PairKey {
    u64::from(a.min(b)) << 32 | u64::from(a.max(b))
}

/// All that the narrow phase finds.
#[derive(Debug, Default)]
pub(super) struct Findings {
    /// Contacts as they were found.
    pub(super) contacts: Vec<Contact>,
    /// For each contact its pair, and where it is.
    keys: Vec<Found>,
    /// Pairs that were reported as touching and touch still.
    pub(super) resting: Vec<PairKey>,
    pub(super) effort: PairEffort,
    /// Room to sort in.
    spare: Vec<Found>,
    late: Vec<Late>,
    /// What other threads have found; nothing has been found here then.
    #[cfg(feature = "parallel")]
    pub(super) shared: Shared,
    /// Of a part of those, where the portions of its keys end, if it is divided.
    #[cfg(feature = "parallel")]
    ends: Option<Ends>,
    /// So many keys of each portion are of the moment at which the frame begins; of a part that is
    /// not divided, so many of all.
    #[cfg(feature = "parallel")]
    at_start: Ends,
    /// Of such a part, of how many slots its bodies are.
    #[cfg(feature = "parallel")]
    slots: usize,
}

/// Which contact is whose.
#[derive(Debug, Clone, Copy)]
pub(super) struct Found {
    /// The slots as the contact names them, as one number to sort by.
    order: u64,
    /// Where in its list.
    index: u32,
    /// In which list, and three marks.
    rest: u32,
}

impl Found {
    /// It is one of the moment at which the frame begins.
    pub(super) const AT_START: u32 = 1;
    /// The pair may have met unseen: it overlaps, it was looked at in the frame before, and neither
    /// body was put where it is.
    const DRIFTED: u32 = 2;
    /// It is told as a touch.
    const TOUCH: u32 = 4;

    #[inline]
    pub(super) fn is(&self, mark: u32) -> bool {
        self.rest & mark != 0
    }

    #[inline]
    pub(super) fn order(&self) -> u64 {
        self.order
    }

    /// The pair, if it is told as touching.
    #[inline]
    pub(super) fn touch(&self) -> Option<PairKey> {
        self.is(Self::TOUCH)
            .then(|| key((self.order >> 32) as u32, self.order as u32))
    }

    /// Puts the contact into `place`, as it is told.
    #[inline]
    pub(super) fn tell(&self, contact: &Contact, place: &mut Contact) {
        *place = *contact;
        if self.is(Self::DRIFTED) && self.is(Self::TOUCH) {
            place.kind = ContactKind::Touch;
        }
    }
}

#[cfg(feature = "parallel")]
impl Found {
    /// The same in the list of a part.
    #[inline]
    pub(super) fn of_part(&self, part: usize) -> Self {
        Self {
            rest: (part as u32) << 3 | self.rest,
            ..*self
        }
    }

    #[inline]
    pub(super) fn part(&self) -> usize {
        (self.rest >> 3) as usize
    }

    #[inline]
    pub(super) fn index(&self) -> usize {
        self.index as usize
    }
}

/// A contact within the frame, by what it is sorted by.
#[derive(Debug, Clone, Copy)]
pub(super) struct Late {
    pub(super) time: f64,
    pub(super) found: Found,
}

/// By time, then by slots.
pub(super) fn sort_late(late: &mut [Late]) {
    late.sort_unstable_by(|a, b| {
        let by_time = a.time.total_cmp(&b.time);
        by_time.then(a.found.order.cmp(&b.found.order))
    });
}

/// Marks those of some keys, which are sorted, that are told as touches since the pair was apart a
/// frame ago, and moved into each other since: that they met was overlooked by rounding, or by too
/// few rays. `met` as for [`Findings::sort_into`].
pub(super) fn mark_met(keys: &mut [Found], met: &[PairKey]) {
    let Some(first) = keys.first().map(Found::order) else {
        return;
    };
    // Both lists are sorted: one pass tells which pairs are in both.
    let begin = met.partition_point(|&pair| pair < first);
    let mut before = met.iter().skip(begin).peekable();
    for found in keys.iter_mut().filter(|found| found.is(Found::DRIFTED)) {
        while before.next_if(|&&pair| pair < found.order).is_some() {}
        let is_new = before.peek().is_none_or(|&&pair| pair != found.order);
        // A pair changes its order if one of its bodies stops or sets out.
        let turned = found.order.rotate_left(32);
        if is_new && met.binary_search(&turned).is_err() {
            found.rest |= Found::TOUCH;
        }
    }
}

/// Room for so many contacts, all of which are to be overwritten; `any` is one of them.
pub(super) fn make_room(contacts: &mut Vec<Contact>, count: usize, any: Option<&Contact>) {
    contacts.truncate(count);
    if let Some(any) = any {
        contacts.resize(count, *any);
    }
}

impl Findings {
    pub(super) fn clear(&mut self) {
        self.contacts.clear();
        self.keys.clear();
        self.resting.clear();
        self.effort = PairEffort::default();
        #[cfg(feature = "parallel")]
        self.shared.clear();
    }

    /// Adds a contact; `is_placed` tells whether one of its bodies was put where it is, or else nobody
    /// looked at them in the frame before.
    pub(super) fn push(&mut self, contact: Contact, is_placed: bool) {
        let overlaps = matches!(contact.kind, ContactKind::Overlap { .. });
        let mark = |is: bool, mark: u32| if is { mark } else { 0 };
        self.keys.push(Found {
            order: u64::from(contact.a.slot) << 32 | u64::from(contact.b.slot),
            index: self.contacts.len() as u32,
            rest: mark(contact.fraction <= 0.0, Found::AT_START)
                | mark(overlaps && !is_placed, Found::DRIFTED)
                | mark(!overlaps, Found::TOUCH),
        });
        self.contacts.push(contact);
    }

    /// Makes it one of several parts, which are of bodies of so many slots: keys that are not in
    /// order are divided.
    #[cfg(feature = "parallel")]
    pub(super) fn close(&mut self, slots: usize) {
        self.slots = slots.max(1);
        self.ends = None;
        if self.keys.is_sorted_by_key(Found::order) {
            let at_start = self.keys.iter().filter(|found| found.is(Found::AT_START));
            self.at_start[0] = at_start.count() as u32;
        } else {
            self.divide();
        }
    }

    /// Divides the keys among portions, by the first of their slots, unless that is done.
    #[cfg(feature = "parallel")]
    pub(super) fn divide(&mut self) {
        if self.ends.is_some() {
            return;
        }
        let slots = self.slots;
        let portion = |found: &Found| {
            let first = (found.order >> 32) as usize;
            (first * PORTIONS / slots).min(PORTIONS - 1)
        };
        let mut places: Ends = [0; PORTIONS];
        self.at_start = [0; PORTIONS];
        for found in &self.keys {
            places[portion(found)] += 1;
            self.at_start[portion(found)] += u32::from(found.is(Found::AT_START));
        }
        let mut before = 0;
        for place in &mut places {
            before += std::mem::replace(place, before);
        }
        self.spare.clear();
        self.spare.extend_from_slice(&self.keys);
        for found in &self.spare {
            let place = &mut places[portion(found)];
            if let Some(there) = self.keys.get_mut(*place as usize) {
                *there = *found;
            }
            *place += 1;
        }
        self.ends = Some(places);
    }

    /// The keys of a portion.
    #[cfg(feature = "parallel")]
    pub(super) fn portion(&self, number: usize) -> &[Found] {
        let end = |number: usize| {
            let end = self.ends.as_ref().and_then(|ends| ends.get(number));
            end.map_or(0, |&end| end as usize)
        };
        let begin = number.checked_sub(1).map_or(0, end);
        self.keys.get(begin..end(number)).unwrap_or_default()
    }

    /// The keys, if they are in order and not divided.
    #[cfg(feature = "parallel")]
    pub(super) fn in_order(&self) -> Option<&[Found]> {
        self.ends.is_none().then_some(&self.keys)
    }

    /// So many keys of a portion are of the moment at which the frame begins; see
    /// [`in_order`](Self::in_order) for the only one of a part that is not divided.
    #[cfg(feature = "parallel")]
    pub(super) fn at_start(&self, number: usize) -> usize {
        self.at_start.get(number).map_or(0, |&count| count as usize)
    }

    /// The keys, in whatever order.
    #[cfg(feature = "parallel")]
    pub(super) fn keys(&self) -> &[Found] {
        &self.keys
    }

    /// Adds what was found of other pairs, and has been [closed](Self::close).
    #[cfg(feature = "parallel")]
    pub(super) fn append(&mut self, other: Self) {
        self.resting.extend_from_slice(&other.resting);
        self.effort.stretches += other.effort.stretches;
        self.effort.rays += other.effort.rays;
        self.effort.undecided += other.effort.undecided;
        self.shared.add(other);
    }

    /// Bytes in use.
    pub(super) fn memory(&self) -> usize {
        let own = self.contacts.capacity() * size_of::<Contact>()
            + (self.keys.capacity() + self.spare.capacity()) * size_of::<Found>()
            + self.late.capacity() * size_of::<Late>()
            + self.resting.capacity() * size_of::<PairKey>();
        #[cfg(feature = "parallel")]
        let own = own + self.shared.memory();
        own
    }

    /// Sorts the contacts into `sorted`: by time, then by ids.
    ///
    /// `met` are the pairs with a contact in the frame before, as contacts name them, sorted.
    pub(super) fn sort_into(&mut self, sorted: &mut Vec<Contact>, met: &[PairKey]) {
        #[cfg(feature = "parallel")]
        if !self.shared.is_empty() {
            self.shared.sort_into(sorted, met);
            return;
        }
        self.sort_keys();
        mark_met(&mut self.keys, met);
        let Self {
            contacts,
            keys,
            late,
            ..
        } = self;
        let contact = |found: &Found| contacts.get(found.index as usize);
        // Most contacts of a crowd are overlaps as the frame begins, and in order now.
        late.clear();
        let is_late = |found: &&Found| !found.is(Found::AT_START);
        late.extend(keys.iter().filter(is_late).filter_map(|&found| {
            let time = contact(&found)?.time;
            Some(Late { time, found })
        }));
        sort_late(late);
        make_room(sorted, keys.len(), contacts.first());
        let at_start = keys.iter().filter(|found| found.is(Found::AT_START));
        let in_order = at_start.chain(late.iter().map(|late| &late.found));
        for (place, found) in sorted.iter_mut().zip(in_order) {
            if let Some(contact) = contact(found) {
                found.tell(contact, place);
            }
        }
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
            sort_by_slots((keys, &mut self.spare), Found::order);
            return;
        }
        let (kept, new) = keys.split_at_mut(end);
        new.sort_unstable_by_key(Found::order);
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

    /// The pairs with a contact at `until` or before, in fractions of the frame,
    /// and those that rest in touch: into `met`, sorted.
    pub(super) fn met_until(&self, until: f64, met: &mut Vec<PairKey>) {
        met.clear();
        let counts = |found: &&Found| {
            let is_soon = |contact: &Contact| contact.fraction <= until;
            let contact = || self.contacts.get(found.index as usize);
            found.is(Found::AT_START) || until >= 1.0 || contact().is_some_and(is_soon)
        };
        met.extend(self.keys.iter().filter(counts).map(Found::order));
        #[cfg(feature = "parallel")]
        self.shared.met_until(until, met);
        if self.resting.is_empty() {
            return;
        }
        // Whichever order they are named in.
        let turned = self.resting.iter().map(|pair| pair.rotate_left(32));
        met.extend(self.resting.iter().copied().chain(turned));
        met.sort_unstable();
    }

    /// The pairs that touch in the whole frame, as far as they are told, in no particular order.
    pub(super) fn touches(&self) -> impl Iterator<Item = PairKey> {
        let touches = self.keys.iter().filter_map(Found::touch);
        #[cfg(feature = "parallel")]
        let touches = touches.chain(self.shared.touches());
        touches
    }
}
