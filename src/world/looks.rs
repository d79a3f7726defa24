//! Boxes for queries between two steps.

use crate::broad_phase::Moment;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, OnceLock};

/// As soon as one query has come for so many bodies, the boxes of the moment are fitted.
///
/// Fitting one costs 10 ns to 20 ns, and a ray into 100 000 balls gains some 3 µs by it. So
/// at most twice the time is spent that would be if one knew how many queries come.
const BODIES: usize = 200;

/// The boxes of the present moment, if there are so many queries that they pay.
#[derive(Debug, Default)]
pub(super) struct Looks {
    /// Queries since the world last changed.
    asked: AtomicUsize,
    moment: OnceLock<Moment>,
    /// The memory of an earlier one.
    room: Mutex<Moment>,
}

impl Looks {
    /// The world has changed: bodies are elsewhere, or others.
    pub(super) fn forget(&mut self) {
        *self.asked.get_mut() = 0;
        if let Some(moment) = self.moment.take()
            && let Ok(room) = self.room.get_mut()
        {
            *room = moment;
        }
    }

    /// The boxes for so many more queries; none as long as they do not pay. `fit` makes them.
    ///
    /// Whether there are any makes no difference to what a query finds.
    pub(super) fn moment(
        &self,
        (queries, bodies): (usize, usize),
        fit: impl FnOnce(Moment) -> Moment,
    ) -> Option<&Moment> {
        if let Some(moment) = self.moment.get() {
            return Some(moment);
        }
        let before = self.asked.fetch_add(queries, Ordering::Relaxed);
        if before.saturating_add(queries) < bodies / BODIES {
            return None;
        }
        Some(self.moment.get_or_init(|| {
            let room = self.room.lock().map(|mut room| std::mem::take(&mut *room));
            fit(room.unwrap_or_default())
        }))
    }

    /// Bytes in use.
    pub(super) fn memory(&self) -> usize {
        let room = self.room.lock().map_or(0, |room| room.memory());
        room + self.moment.get().map_or(0, Moment::memory)
    }
}
