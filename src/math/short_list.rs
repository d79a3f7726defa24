//! A list that lies where it is made as long as it is short.

use std::ops::{Deref, DerefMut};

/// Entries in place, or on the heap once there are more than `N` of them.
#[derive(Debug, Clone)]
pub(crate) struct ShortList<T, const N: usize> {
    few: [T; N],
    /// How many of the few count; what there is beyond `N` lies with them in `many`.
    count: usize,
    many: Vec<T>,
}

impl<T: Copy + Default, const N: usize> ShortList<T, N> {
    pub(crate) fn new() -> Self {
        Self {
            few: [T::default(); N],
            count: 0,
            many: Vec::new(),
        }
    }

    pub(crate) fn push(&mut self, entry: T) {
        if self.many.is_empty() {
            if let Some(place) = self.few.get_mut(self.count) {
                *place = entry;
                self.count += 1;
                return;
            }
            self.many.extend(self.few);
        }
        self.many.push(entry);
    }

    pub(crate) fn clear(&mut self) {
        self.count = 0;
        self.many.clear();
    }
}

impl<T, const N: usize> Deref for ShortList<T, N> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        if self.many.is_empty() {
            self.few.get(..self.count).unwrap_or_default()
        } else {
            &self.many
        }
    }
}

impl<T, const N: usize> DerefMut for ShortList<T, N> {
    fn deref_mut(&mut self) -> &mut [T] {
        if self.many.is_empty() {
            self.few.get_mut(..self.count).unwrap_or_default()
        } else {
            &mut self.many
        }
    }
}

impl<T: Copy + Default, const N: usize> FromIterator<T> for ShortList<T, N> {
    fn from_iter<I: IntoIterator<Item = T>>(entries: I) -> Self {
        let mut list = Self::new();
        entries.into_iter().for_each(|entry| list.push(entry));
        list
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_and_long_lists_hold_what_was_pushed() {
        let mut list = ShortList::<u32, 4>::new();
        for round in 0..2 {
            for entry in 0..9 {
                assert_eq!(*list, *(0..entry).collect::<Vec<_>>(), "{round}");
                list.push(entry);
            }
            list.sort_by(|p, q| q.cmp(p));
            assert_eq!(list.first(), Some(&8));
            list.clear();
        }
        assert_eq!(*(0..4).collect::<ShortList<u32, 4>>(), [0, 1, 2, 3]);
    }
}
