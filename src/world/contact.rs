//! Contacts.

use crate::geometry::Feature;
use crate::world::BodyId;
use glam::DVec3;

/// Two bodies meet.
///
/// `a` is the moving one if the other is fixed, else the one with the lower id.
/// Touching counts as contact, parting or sliding along does not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// The first body.
    pub a: BodyId,
    /// The second body.
    pub b: BodyId,
    /// When, in seconds of the world's clock.
    pub time: f64,
    /// When, as a share of the frame, in `0..=1`.
    pub fraction: f64,
    /// Where, in metres, with both bodies where they are at `time`.
    pub point: DVec3,
    /// Unit normal, out of `b` towards `a`.
    pub normal: DVec3,
    /// The part of `a` that touches.
    pub feature_a: Feature,
    /// The part of `b` that touches.
    pub feature_b: Feature,
    /// How it came about.
    pub kind: ContactKind,
}

/// How a contact came about.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum ContactKind {
    /// The bodies touch first at the contact's time; or they were apart a frame
    /// ago, touched unseen by rounding or for want of rays, and overlap now.
    Touch,
    /// The bodies overlapped already as the frame began, because they were put
    /// there or because they did not stop when they touched; the contact's normal
    /// is the direction of least separation.
    Overlap {
        /// How far `a` would have to be shifted along the normal to part them, in metres.
        depth: f64,
    },
}

impl Contact {
    /// Whether the two bodies touched and did not overlap before.
    #[must_use]
    pub fn is_touch(&self) -> bool {
        matches!(self.kind, ContactKind::Touch)
    }
}
