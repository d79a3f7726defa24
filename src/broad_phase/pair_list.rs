//! The list of pairs worth a look.

use super::bounds::Slot;
use super::{BroadPhase, ObbTest};
use crate::geometry::Obb;

/// Where a body can be during the whole of its motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Volume {
    /// The box around its whole path; none if nothing bounds it, as in free
    /// flight: then it pairs with everything.
    pub obb: Option<Obb>,
    /// Whether it moves at all.
    pub moving: bool,
}

/// The pairs of bodies whose volumes overlap.
///
/// Bodies are named by slot: their index in the volumes given, where a body that
/// was removed leaves `None`. Two bodies that never move make no pair. Each pair
/// is listed once, and the lists are sorted: how they came about does not show.
///
/// ```
/// use feeler::Obb;
/// use feeler::broad_phase::{BroadPhase, PairList, Volume};
/// use glam::DVec3;
///
/// let cube = |x, moving| {
///     let (centre, axes) = (DVec3::new(x, 0.0, 0.0), [DVec3::X, DVec3::Y, DVec3::Z]);
///     let obb = Obb { centre, axes, half_extents: DVec3::ONE };
///     Some(Volume { obb: Some(obb), moving })
/// };
/// let mut volumes = vec![cube(0.0, false), cube(1.0, true), cube(2.5, true), cube(9.0, true)];
/// let mut pairs = PairList::new(BroadPhase::default());
/// pairs.update(&[0, 1, 2, 3], &volumes);
/// assert_eq!(pairs.dynamic(), [(1, 2)]);
/// assert_eq!(pairs.fixed(), [(1, 0)]);
///
/// // The third body is taken away.
/// volumes[2] = None;
/// pairs.update(&[2], &volumes);
/// assert!(pairs.dynamic().is_empty());
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct PairList {
    broad_phase: BroadPhase,
    slots: Vec<Slot>,
    dynamic: Vec<(u32, u32)>,
    fixed: Vec<(u32, u32)>,
}

impl PairList {
    /// No bodies, no pairs.
    #[must_use]
    pub fn new(broad_phase: BroadPhase) -> Self {
        Self {
            broad_phase,
            slots: Vec::new(),
            dynamic: Vec::new(),
            fixed: Vec::new(),
        }
    }

    /// The list for `volumes`, all at once.
    #[must_use]
    pub fn build(broad_phase: BroadPhase, volumes: &[Option<Volume>]) -> Self {
        let mut pairs = Self::new(broad_phase);
        pairs.update(&[], volumes);
        pairs
    }

    /// The pairs of moving bodies, the lower slot first.
    #[must_use]
    pub fn dynamic(&self) -> &[(u32, u32)] {
        &self.dynamic
    }

    /// The pairs of a moving body, first, and one that never moves, second.
    #[must_use]
    pub fn fixed(&self) -> &[(u32, u32)] {
        &self.fixed
    }

    /// How many bodies there are.
    #[must_use]
    pub fn bodies(&self) -> usize {
        self.slots.iter().filter(|slot| !slot.is_vacant()).count()
    }

    /// Brings the list up to date after the bodies in slots `changed` were
    /// inserted, removed or given another volume.
    ///
    /// Slots beyond those of the last call count as changed, slots that
    /// `volumes` no longer has as removed. Afterwards the list is the one that
    /// [`build`](Self::build) makes of `volumes`.
    ///
    /// O(changed · bodies) tests, each a comparison of axis-aligned boxes and,
    /// seldom, one of oriented boxes; then O(pairs) to put them in place.
    pub fn update(&mut self, changed: &[u32], volumes: &[Option<Volume>]) {
        // `stale[slot]`: whether the pairs of that slot are to be found anew.
        let known = self.slots.len().min(volumes.len());
        let mut stale = vec![true; self.slots.len().max(volumes.len())];
        stale[..known].fill(false);
        for &slot in changed {
            if let Some(stale) = stale.get_mut(slot as usize) {
                *stale = true;
            }
        }
        let is_kept = |&(a, b): &(u32, u32)| !stale[a as usize] && !stale[b as usize];
        self.dynamic.retain(is_kept);
        self.fixed.retain(is_kept);

        self.slots.resize(volumes.len(), Slot::VACANT);
        for (slot, volume) in volumes.iter().enumerate() {
            if stale[slot] {
                self.slots[slot] = Slot::of(volume.as_ref());
            }
        }
        for slot in 0..volumes.len() {
            if stale[slot] {
                self.find_pairs_of(slot, &stale, volumes);
            }
        }
        // Runs that are sorted already, as these are, are merged.
        self.dynamic.sort();
        self.fixed.sort();
    }

    /// Adds the pairs of a stale slot with those that are not, and with stale ones after it.
    fn find_pairs_of(&mut self, slot: usize, stale: &[bool], volumes: &[Option<Volume>]) {
        let this = self.slots[slot];
        if this.is_vacant() {
            return;
        }
        let test = match self.broad_phase {
            BroadPhase::SweptObb(test) => Some(test),
            BroadPhase::AllPairs => None,
        };
        for (other_slot, other) in self.slots.iter().enumerate() {
            if test.is_some() && !this.aabb.overlaps(&other.aabb) {
                continue;
            }
            let found_from_other = stale[other_slot] && other_slot <= slot;
            if found_from_other || other.is_vacant() || !(this.is_moving() || other.is_moving()) {
                continue;
            }
            // The moving one first; of two moving ones the lower slot.
            let (list, a, b) = match (this.is_moving(), other.is_moving()) {
                (true, true) => (
                    &mut self.dynamic,
                    slot.min(other_slot),
                    slot.max(other_slot),
                ),
                (true, false) => (&mut self.fixed, slot, other_slot),
                (false, _) => (&mut self.fixed, other_slot, slot),
            };
            if test.is_none_or(|test| overlap(test, volumes[a].as_ref(), volumes[b].as_ref())) {
                // Slots are u32 by contract: no world has more bodies.
                list.push((a as u32, b as u32));
            }
        }
    }
}

/// Whether two volumes overlap; an unbounded one overlaps every other.
fn overlap(test: ObbTest, a: Option<&Volume>, b: Option<&Volume>) -> bool {
    match (
        a.and_then(|a| a.obb.as_ref()),
        b.and_then(|b| b.obb.as_ref()),
    ) {
        (Some(a), Some(b)) => test.overlap(a, b),
        _ => true,
    }
}
