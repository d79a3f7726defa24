//! Which bodies have to do with each other.

/// Groups that a body belongs to, and groups that it meets; a bit for each.
///
/// Two bodies meet only if each meets a group that the other belongs to. That is
/// how rapier's interaction groups and the collision layers of Bevy's physics
/// crates work. By default a body belongs to all groups and meets all.
///
/// ```
/// use feeler::Groups;
///
/// let player = Groups::new(0b001, 0b110);
/// let wall = Groups::new(0b010, u32::MAX);
/// let ghost = Groups::new(0b010, 0b010);
/// assert!(player.meets(wall) && !player.meets(ghost) && !player.meets(player));
/// assert!(Groups::ALL.meets(wall) && !Groups::NONE.meets(Groups::ALL));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Groups {
    /// The groups that the body belongs to.
    pub memberships: u32,
    /// The groups that it meets.
    pub mask: u32,
}

impl Groups {
    /// In every group, and meeting every group.
    pub const ALL: Self = Self::new(u32::MAX, u32::MAX);

    /// In no group, and meeting none.
    pub const NONE: Self = Self::new(0, 0);

    /// In the groups `memberships`, meeting the groups of `mask`.
    #[must_use]
    pub const fn new(memberships: u32, mask: u32) -> Self {
        Self { memberships, mask }
    }

    /// Whether the two meet.
    #[must_use]
    #[inline]
    pub const fn meets(self, other: Self) -> bool {
        self.memberships & other.mask != 0 && other.memberships & self.mask != 0
    }

    /// Whether these are the default: all of all.
    #[cfg(feature = "serde")]
    pub(crate) fn are_all(&self) -> bool {
        *self == Self::ALL
    }
}

impl Default for Groups {
    fn default() -> Self {
        Self::ALL
    }
}
