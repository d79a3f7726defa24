//! What the broad phase sees of a body.

use crate::broad_phase::Volume;
use crate::geometry::{Obb, Pose};
use crate::sweep::{along_line, along_spline, around_static};
use crate::world::Body;

/// The volume of a body over its whole motion.
pub(super) fn of(body: &Body) -> Volume {
    Volume {
        obb: swept(body),
        moving: !body.motion().is_fixed(),
    }
}

/// The box around all places where a body will be; none in free flight.
fn swept(body: &Body) -> Option<Obb> {
    let motion = body.motion();
    if motion.is_free() {
        return None;
    }
    let Some(path) = motion.path() else {
        let pose = Pose::new(motion.position_after(0.0), body.orientation());
        return Some(around_static(body.shape(), &pose));
    };
    let offset = body.orientation() * body.shape().centre();
    let reach = body.shape().max_dist();
    Some(match path.as_spline() {
        Some(spline) => along_spline(spline, offset, reach),
        None => along_line(path.start(), path.end(), offset, reach),
    })
}
