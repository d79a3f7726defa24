use crate::broad_phase::Volume;
use crate::world::slots::Resident;
pub(super) fn of(r: &Resident) -> Volume {
    Volume {
        moving: !r.body.motion().is_fixed(),
    }
}
