//! Many keys sorted.

/// Fewer than these are sorted by comparing, which is as fast. Up to 512 it takes fewer steps, but more
/// time: no one can predict how keys compare.
const FEW: usize = 128;

/// At most so many bits of a key are looked at in a pass: as many counters as stay in
/// the nearest cache; fewer where there would be more counters than items.
const DIGIT: u32 = 11;

/// So many items of one slot are sorted by insertion.
const RUN: usize = 16;

/// Sorts `items` by the slots that `key` answers with, its two halves; `spare` is room.
///
/// By the first slot digit by digit, from the last: some 2 ns an item and pass, two passes where there
/// are 100 000 slots, no branch that depends on the items. There are few items of one first slot, as a rule:
/// they are put in order one by one.
pub(crate) fn sort_by_slots<T: Copy>(
    (items, spare): (&mut Vec<T>, &mut Vec<T>),
    key: impl Fn(&T) -> u64,
) {
    if items.len() < FEW {
        items.sort_unstable_by_key(key);
        return;
    }
    let used = items.iter().fold(0, |used, item| used | key(item));
    spare.clear();
    spare.extend_from_slice(items);
    let digit = (usize::BITS - items.len().leading_zeros()).min(DIGIT);
    let mut places = [0_u32; 1 << DIGIT];
    let bits = u32::BITS - ((used >> 32) as u32).leading_zeros();
    let passes = bits.div_ceil(digit);
    let width = bits.div_ceil(passes.max(1));
    for pass in 0..passes {
        let shift = 32 + pass * width;
        let digit = |item: &T| (key(item) >> shift) as usize & ((1 << width) - 1);
        let places = &mut places[..1 << width];
        places.fill(0);
        for item in items.iter() {
            places[digit(item)] += 1;
        }
        let mut before = 0;
        for place in places.iter_mut() {
            before += std::mem::replace(place, before);
        }
        for item in items.iter() {
            let place = &mut places[digit(item)];
            if let Some(there) = spare.get_mut(*place as usize) {
                *there = *item;
            }
            *place += 1;
        }
        std::mem::swap(items, spare);
    }
    for run in items.chunk_by_mut(|a, b| key(a) >> 32 == key(b) >> 32) {
        if run.len() > RUN {
            run.sort_unstable_by_key(&key);
            continue;
        }
        for end in 1..run.len() {
            for place in (1..=end).rev() {
                if key(&run[place - 1]) <= key(&run[place]) {
                    break;
                }
                run.swap(place - 1, place);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{FEW, sort_by_slots};

    #[test]
    fn sorts_as_comparing_does() {
        let mut state = 1_u64;
        let mut next = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 11) ^ (state << 53)
        };
        for (low, high) in [
            (10, 10),
            (17, 17),
            (1, 32),
            (32, 22),
            (0, 12),
            (11, 0),
            (12, 23),
            (20, 3),
            (5, 9),
        ] {
            for count in [0, 1, FEW - 1, FEW, 3000] {
                let mask = ((1_u64 << low) - 1) | (((1_u64 << high) - 1) << 32);
                let mut items: Vec<u64> = (0..count).map(|_| next() & mask).collect();
                let mut expected = items.clone();
                expected.sort_unstable();
                sort_by_slots((&mut items, &mut Vec::new()), |&item| item);
                assert_eq!(items, expected, "{low} and {high} bits, {count}");
            }
        }
    }
}
