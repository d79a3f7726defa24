//! The list of pairs worth a look.

use super::BroadPhase;
use super::bounds::{Kind, Slot};
use crate::geometry::Obb;

/// Up to this share of the slots (one in so many) may have changed for each to be
/// compared with all others; beyond, sorting them all is cheaper. Measured, the two
/// cost the same at one in 10 of 500 bodies and one in 50 of 2000.
const FEW_CHANGES: usize = 32;

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
/// use feeler::broad_phase::{BroadPhase, ObbTest, PairList, Volume};
/// use glam::DVec3;
///
/// let cube = |x, moving| {
///     let (centre, axes) = (DVec3::new(x, 0.0, 0.0), [DVec3::X, DVec3::Y, DVec3::Z]);
///     let obb = Obb { centre, axes, half_extents: DVec3::ONE };
///     Some(Volume { obb: Some(obb), moving })
/// };
/// let mut volumes = vec![cube(0.0, false), cube(1.0, true), cube(2.5, true), cube(9.0, true)];
/// let mut pairs = PairList::new(BroadPhase::SweptObb(ObbTest::Axes));
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
    /// Few changes: O(changed · bodies) comparisons of axis-aligned boxes around the
    /// volumes. Many: O(bodies · log bodies) and one for each two boxes that overlap along x.
    /// The volumes themselves are tested where these overlap. Then O(pairs · log pairs)
    /// at most to sort them in.
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
                self.slots[slot] = match self.broad_phase {
                    BroadPhase::AllPairs => Slot::unbounded(volume.as_ref()),
                    BroadPhase::Bvh | BroadPhase::SweptObb(_) => Slot::of(volume.as_ref()),
                };
            }
        }
        let changes = (0..volumes.len()).filter(|&slot| stale[slot]);
        if changes.clone().count() > volumes.len() / FEW_CHANGES {
            self.sweep(&stale, volumes);
        } else {
            for slot in changes {
                self.scan(slot, &stale, volumes);
            }
        }
        // What was kept is sorted already, and the stable sort takes it as it is.
        self.dynamic.sort();
        self.fixed.sort();
    }

    /// Adds the pairs of a stale slot with those that are not, and with stale ones after it.
    fn scan(&mut self, slot: usize, stale: &[bool], volumes: &[Option<Volume>]) {
        let this = self.slots[slot];
        for (other_slot, &stale) in stale.iter().enumerate().take(volumes.len()) {
            let other = &self.slots[other_slot];
            let found_from_other = stale && other_slot <= slot;
            if !found_from_other && this.aabb.overlaps(&other.aabb) {
                self.add(slot, other_slot, volumes);
            }
        }
    }

    /// Adds all pairs with a stale slot in them, in the order of the boxes along x:
    /// each box meets only those that begin before it ends.
    fn sweep(&mut self, stale: &[bool], volumes: &[Option<Volume>]) {
        let mut order: Vec<_> = (0..self.slots.len())
            .filter(|&slot| !self.slots[slot].is_vacant())
            .map(|slot| (self.slots[slot].aabb, slot))
            .collect();
        order.sort_by(|(a, _), (b, _)| a.min.x.total_cmp(&b.min.x));
        for (place, &(this, slot)) in order.iter().enumerate() {
            for &(other, other_slot) in &order[place + 1..] {
                if other.min.x > this.max.x {
                    break;
                }
                if this.overlaps(&other) && (stale[slot] || stale[other_slot]) {
                    self.add(slot, other_slot, volumes);
                }
            }
        }
    }

    /// Adds a pair whose bounds overlap if it is one and its volumes overlap too.
    fn add(&mut self, slot: usize, other_slot: usize, volumes: &[Option<Volume>]) {
        let (low, high) = (slot.min(other_slot), slot.max(other_slot));
        // The moving one first; of two moving ones the lower slot.
        let (list, a, b) = match (self.slots[low].kind, self.slots[high].kind) {
            (Kind::Moving, Kind::Moving) => (&mut self.dynamic, low, high),
            (Kind::Moving, Kind::Fixed) => (&mut self.fixed, low, high),
            (Kind::Fixed, Kind::Moving) => (&mut self.fixed, high, low),
            _ => return,
        };
        if overlap(self.broad_phase, volumes[a].as_ref(), volumes[b].as_ref()) {
            // Slots are u32 by contract: no world has more bodies.
            list.push((a as u32, b as u32));
        }
    }
}

/// Whether two volumes overlap; an unbounded one overlaps every other.
fn overlap(broad_phase: BroadPhase, a: Option<&Volume>, b: Option<&Volume>) -> bool {
    let obbs = (
        a.and_then(|a| a.obb.as_ref()),
        b.and_then(|b| b.obb.as_ref()),
    );
    match (broad_phase, obbs) {
        (BroadPhase::SweptObb(test), (Some(a), Some(b))) => test.overlap(a, b),
        _ => true,
    }
}
