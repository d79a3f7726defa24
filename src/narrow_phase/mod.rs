//! What two bodies do: the methods that find their contact.

pub mod distance;
pub mod exact;
pub mod overlap;
pub mod rays;
