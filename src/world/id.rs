//! Names of bodies.

use std::fmt;

/// Names one body of one world.
///
/// An id stays valid until its body is removed, and is known to be stale from
/// then on, even when another body has taken the place. Worlds count alike: an
/// id of another world may name a body of this one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BodyId {
    pub(crate) slot: u32,
    pub(crate) generation: u32,
}

impl fmt::Display for BodyId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}v{}", self.slot, self.generation)
    }
}
