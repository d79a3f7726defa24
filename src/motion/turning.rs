//! How a body turns while it moves.

use crate::motion::facing::Attitude;
use crate::motion::spin::Spin;

/// How a body turns while it moves.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) enum Turning {
    /// Not at all.
    #[default]
    Not,
    /// At a constant rate.
    Spin(Spin),
    /// With the tangent of its path.
    Facing(Attitude),
}
