//! What several threads find, put in order by all of them.

use crate::math::radix::sort_by_slots;
use crate::world::Contact;
use crate::world::findings::{Findings, Found, Late, PairKey, make_room, mark_met, sort_late};
use rayon::prelude::*;
use std::ops::Range;
use std::sync::Mutex;

/// Keys that are not in order are sorted in so many portions, each by one thread: enough that
/// no thread is idle for long, of slots that follow each other.
pub(super) const PORTIONS: usize = 32;

/// Where each portion of some keys ends.
pub(super) type Ends = [u32; PORTIONS];

/// Contacts within the frame are told so many at a time.
const HANDED: usize = 256;

/// All contacts that several threads have found.
#[derive(Debug, Default)]
pub(super) struct Shared {
    parts: Vec<Findings>,
    /// Those in use come first.
    portions: Vec<Portion>,
    used: usize,
    /// The keys of parts that do not follow the others.
    others: Vec<Found>,
    late: Vec<Late>,
    /// The memory of earlier parts.
    pool: Mutex<Vec<Findings>>,
}

/// The keys of some slots.
#[derive(Debug, Default)]
struct Portion {
    /// In order.
    keys: Vec<Found>,
    /// Room to sort in.
    spare: Vec<Found>,
    late: Vec<Late>,
    /// Their pairs, and those that are told as touching.
    met: Vec<PairKey>,
    touches: Vec<PairKey>,
}

impl Portion {
    /// Takes its keys from all parts, in order.
    fn sort(&mut self, number: usize, parts: &[Findings]) {
        self.keys.clear();
        for (index, part) in parts.iter().enumerate() {
            let keys = part.portion(number).iter();
            self.keys.extend(keys.map(|found| found.of_part(index)));
        }
        if !self.keys.is_sorted_by_key(Found::order) {
            sort_by_slots((&mut self.keys, &mut self.spare), Found::order);
        }
    }

    /// Takes the keys of a part, and others, both of which are in order.
    fn merge(&mut self, (index, keys): (usize, &[Found]), others: &[Found]) {
        self.keys.clear();
        let mut rest = keys;
        for other in others {
            let end = rest.partition_point(|found| found.order() < other.order());
            let (before, after) = rest.split_at(end);
            self.keys
                .extend(before.iter().map(|found| found.of_part(index)));
            self.keys.push(*other);
            rest = after;
        }
        self.keys
            .extend(rest.iter().map(|found| found.of_part(index)));
    }

    /// What is to be known of its keys.
    fn fill(&mut self, parts: &[Findings], met: &[PairKey]) {
        mark_met(&mut self.keys, met);
        self.met.clear();
        self.met.extend(self.keys.iter().map(Found::order));
        self.touches.clear();
        self.touches
            .extend(self.keys.iter().filter_map(Found::touch));
        self.late.clear();
        let is_late = |found: &&Found| !found.is(Found::AT_START);
        self.late
            .extend(self.keys.iter().filter(is_late).filter_map(|&found| {
                let time = contact(parts, &found)?.time;
                Some(Late { time, found })
            }));
    }

    /// Puts the contacts of the moment at which the frame begins where they belong.
    fn tell(&self, parts: &[Findings], places: &mut [Contact]) {
        let at_start = self.keys.iter().filter(|found| found.is(Found::AT_START));
        for (place, found) in places.iter_mut().zip(at_start) {
            tell(parts, found, place);
        }
    }
}

/// Where a portion gets its keys from.
enum Source<'a> {
    /// From all parts, of which it is this portion.
    Parts(usize),
    /// From one part, and from others, both in order.
    Part {
        index: usize,
        keys: &'a [Found],
        others: &'a [Found],
    },
}

impl Source<'_> {
    /// How many of the keys are of the moment at which the frame begins.
    fn at_start(&self, parts: &[Findings]) -> usize {
        match *self {
            Self::Parts(number) => parts.iter().map(|part| part.at_start(number)).sum(),
            Self::Part { index, others, .. } => {
                let others = others.iter().filter(|found| found.is(Found::AT_START));
                parts.get(index).map_or(0, |part| part.at_start(0)) + others.count()
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
        self.used = 0;
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

    fn portions(&self) -> &[Portion] {
        self.portions.get(..self.used).unwrap_or_default()
    }

    /// Adds the pairs with a contact at `until` or before, sorted.
    pub(super) fn met_until(&self, until: f64, met: &mut Vec<PairKey>) {
        for portion in self.portions() {
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
        let touches = self.portions().iter().map(|portion| &portion.touches);
        touches.flatten().copied()
    }

    /// Sorts the contacts of all parts: see [`Findings::sort_into`].
    pub(super) fn sort_into(&mut self, sorted: &mut Vec<Contact>, met: &[PairKey]) {
        let Self {
            parts,
            portions,
            used,
            others,
            late,
            ..
        } = self;
        let count = parts.iter().map(|part| part.keys().len()).sum::<usize>();
        make_room(
            sorted,
            count,
            parts.iter().find_map(|part| part.contacts.first()),
        );
        // Pairs that are kept from frame to frame may be in order: each part of them is a
        // portion then, to which the few pairs are added that have been found since.
        let kept = longest_ascent(parts);
        others.clear();
        for (index, part) in parts.iter().enumerate() {
            if !kept.contains(&index) {
                others.extend(part.keys().iter().map(|found| found.of_part(index)));
            }
        }
        let sources = if 4 * others.len() > count {
            parts.par_iter_mut().for_each(Findings::divide);
            (0..PORTIONS).map(Source::Parts).collect()
        } else {
            others.sort_unstable_by_key(Found::order);
            shared_out(others, kept, parts)
        };
        *used = sources.len();
        if portions.len() < *used {
            portions.resize_with(*used, Portion::default);
        }
        let mut rest = sorted.as_mut_slice();
        let mut jobs = Vec::with_capacity(*used);
        for (portion, source) in portions.iter_mut().zip(sources) {
            let (places, more) = rest.split_at_mut(source.at_start(parts).min(rest.len()));
            jobs.push((portion, source, places));
            rest = more;
        }
        let jobs = jobs.into_par_iter().with_max_len(1);
        jobs.for_each(|(portion, source, places)| {
            match source {
                Source::Parts(number) => portion.sort(number, parts),
                Source::Part {
                    index,
                    keys,
                    others,
                } => portion.merge((index, keys), others),
            }
            portion.fill(parts, met);
            portion.tell(parts, places);
        });
        late.clear();
        for portion in portions.iter().take(*used) {
            late.extend_from_slice(&portion.late);
        }
        sort_late(late);
        let rest = rest.par_chunks_mut(HANDED).zip(late.par_chunks(HANDED));
        rest.for_each(|(places, late)| {
            for (place, late) in places.iter_mut().zip(late) {
                tell(parts, &late.found, place);
            }
        });
    }

    /// Bytes in use.
    pub(super) fn memory(&self) -> usize {
        let portions = self.portions.iter().map(|portion| {
            (portion.keys.capacity() + portion.spare.capacity()) * size_of::<Found>()
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
            + self.others.capacity() * size_of::<Found>()
            + self.late.capacity() * size_of::<Late>()
    }
}

/// Some keys among the parts that they come between; both are in order.
fn shared_out<'a>(
    others: &'a [Found],
    kept: Range<usize>,
    parts: &'a [Findings],
) -> Vec<Source<'a>> {
    let mut begin = 0;
    let sources = kept.clone().map(|index| {
        let keys = parts.get(index).and_then(Findings::in_order);
        let keys = keys.unwrap_or_default();
        let end = match keys.last() {
            // What comes after all of them comes with the last.
            _ if index + 1 == kept.end => others.len(),
            Some(last) => others.partition_point(|found| found.order() < last.order()),
            None => begin,
        };
        let others = others.get(begin..end).unwrap_or_default();
        begin = end;
        Source::Part {
            index,
            keys,
            others,
        }
    });
    sources.collect()
}

fn contact<'a>(parts: &'a [Findings], found: &Found) -> Option<&'a Contact> {
    parts.get(found.part())?.contacts.get(found.index())
}

fn tell(parts: &[Findings], found: &Found, place: &mut Contact) {
    if let Some(contact) = contact(parts, found) {
        found.tell(contact, place);
    }
}

/// Of all parts that follow each other in order, those in a row with the most keys.
fn longest_ascent(parts: &[Findings]) -> Range<usize> {
    let (mut longest, mut most) = (0..0, 0);
    let (mut begin, mut count, mut last) = (0, 0, None);
    for (index, part) in parts.iter().enumerate() {
        let Some(keys) = part.in_order() else {
            (begin, count, last) = (index + 1, 0, None);
            continue;
        };
        let (Some(first), Some(end)) = (keys.first(), keys.last()) else {
            continue;
        };
        if last.is_some_and(|last| last >= first.order()) {
            (begin, count) = (index, 0);
        }
        count += keys.len();
        last = Some(end.order());
        if count > most {
            (longest, most) = (begin..index + 1, count);
        }
    }
    longest
}
