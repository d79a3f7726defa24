//! What the broad phase sees of a body.

use crate::broad_phase::{BroadPhase, Flight, FrameBox, Volume};
use crate::geometry::Obb;
use crate::sweep::{along_line, along_spline, around_static};
use crate::world::Body;
use crate::world::tracks::{Course, Span, Track};

/// The volume of a body over its whole motion; none if it is not to be listed
/// by volume: in free flight nothing bounds it.
pub(super) fn of(body: &Body, broad_phase: BroadPhase) -> Option<Volume> {
    let obb = match broad_phase {
        BroadPhase::AllPairs => None,
        BroadPhase::Bvh | BroadPhase::SweptObb(_) => Some(swept(body)?),
    };
    let moving = !body.motion().is_fixed();
    Some(Volume { obb, moving })
}

/// The box around all places where a body will be; none in free flight.
fn swept(body: &Body) -> Option<Obb> {
    let motion = body.motion();
    if motion.is_free() {
        return None;
    }
    let (offset, reach) = body.hub();
    // Whatever happens at its ends, it does not leave its path.
    Some(match motion.path() {
        Some(path) => match path.as_spline() {
            Some(spline) => along_spline(spline, offset, reach),
            None => along_line(path.start(), path.end(), offset, reach),
        },
        None if motion.turns() => {
            let position = motion.position_after(0.0);
            along_line(position, position, offset, reach)
        }
        None => around_static(body.shape(), &body.pose_after(0.0)),
    })
}

/// The box around all places where a body will be in the frame at hand.
pub(super) fn in_frame(slot: u32, track: &Track, span: Span) -> FrameBox {
    FrameBox {
        slot,
        aabb: track.swept(span),
        flight: match track.course {
            Course::Free => Flight::Free,
            Course::Path => Flight::Path,
            Course::Fixed => Flight::Fixed,
        },
    }
}
