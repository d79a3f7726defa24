//! Which bodies were meddled with since the last step.

/// Marks of the slots whose bodies were inserted or given another motion since
/// the last step. Nothing to be done for all the others.
#[derive(Debug, Clone, Default)]
pub(super) struct Stirred {
    marks: Vec<Mark>,
    /// The slots with a mark.
    slots: Vec<u32>,
    /// Whether one of them was released.
    any_released: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
enum Mark {
    #[default]
    None,
    /// Another motion, from where the body was.
    Diverted,
    /// The same, of a body that was fixed during the last step.
    Released,
    /// Put where it is; it did not get there by its motion.
    Placed,
}

impl Stirred {
    /// The body in `slot` has another motion.
    pub(super) fn divert(&mut self, slot: u32) {
        self.mark(slot, Mark::Diverted);
    }

    /// The body in `slot`, which was fixed till now, has another motion.
    pub(super) fn release(&mut self, slot: u32) {
        // Or it was given a motion to be fixed by only since the last step.
        if self.at(slot) == Mark::None {
            self.mark(slot, Mark::Released);
            self.any_released = true;
        }
    }

    /// The body in `slot` was put where it is.
    pub(super) fn place(&mut self, slot: u32) {
        self.mark(slot, Mark::Placed);
    }

    fn mark(&mut self, slot: u32, mark: Mark) {
        let index = slot as usize;
        if self.marks.len() <= index {
            self.marks.resize(index + 1, Mark::None);
        }
        if self.marks[index] == Mark::None {
            self.slots.push(slot);
        }
        self.marks[index] = self.marks[index].max(mark);
    }

    /// Whether the body in `slot` has another motion, or is another.
    pub(super) fn is_diverted(&self, slot: u32) -> bool {
        self.at(slot) != Mark::None
    }

    /// Whether two bodies were both fixed during the last step, and nobody looked at them;
    /// `is_fixed` tells of a slot whether its body is now.
    pub(super) fn were_fixed(&self, pair: [u32; 2], is_fixed: impl Fn(u32) -> bool) -> bool {
        let was_fixed = |slot: u32| match self.at(slot) {
            Mark::None => is_fixed(slot),
            Mark::Released => true,
            Mark::Diverted | Mark::Placed => false,
        };
        self.any_released && pair.into_iter().all(was_fixed)
    }

    /// Whether the body in `slot` was put where it is.
    pub(super) fn is_placed(&self, slot: u32) -> bool {
        self.at(slot) == Mark::Placed
    }

    fn at(&self, slot: u32) -> Mark {
        self.marks.get(slot as usize).copied().unwrap_or_default()
    }

    /// A step was made.
    pub(super) fn clear(&mut self) {
        self.any_released = false;
        for slot in self.slots.drain(..) {
            if let Some(mark) = self.marks.get_mut(slot as usize) {
                *mark = Mark::None;
            }
        }
    }

    /// Bytes in use.
    pub(super) fn memory(&self) -> usize {
        self.marks.capacity() * size_of::<Mark>() + self.slots.capacity() * size_of::<u32>()
    }
}
