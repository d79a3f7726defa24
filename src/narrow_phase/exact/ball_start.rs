//! Where on a polytope the search for the first touch begins.

use super::ball_polytope::Cast;

/// A face near the first touch; none if the line passes the polytope by.
///
/// The line enters the polytope with its faces pushed out by the radius at the face where it
/// crosses the last of those that look towards it. That polytope holds the rounded one. The face is
/// found from neighbour to neighbour, beginning where the line enters the sphere around all.
pub(super) fn start(cast: &Cast) -> Option<u32> {
    let map = cast.polytope.face_map();
    let line = &cast.line;
    let grown = cast.radius + cast.slack;
    let approach = |face: u32| {
        let (normal, offset) = map.plane(face);
        let room = offset + grown - normal.dot(line.origin);
        (normal.dot(line.direction), room)
    };
    let mut face = near(cast);
    let (mut rate, mut room) = approach(face);
    if rate >= 0.0 {
        if room < 0.0 && rate == 0.0 {
            return None;
        }
        // The one furthest along −direction looks towards the line.
        (face, _) = map.facing(cast.polytope, -line.direction, face);
        (rate, room) = approach(face);
        if rate >= 0.0 {
            return Some(face);
        }
    }
    let mut fraction = room / rate;
    loop {
        let (current, here) = (face, fraction);
        for &neighbour in map.neighbours(current) {
            let (rate, room) = approach(neighbour);
            if rate < 0.0 {
                // Strictly larger, so that no face comes twice and the walk ends.
                let crossing = room / rate;
                if crossing > fraction {
                    (face, fraction) = (neighbour, crossing);
                }
            } else if room < here * rate {
                // Left before it was entered.
                return None;
            }
        }
        if face == current {
            return Some(face);
        }
    }
}

/// A face near to where the line enters the sphere around the rounded polytope.
fn near(cast: &Cast) -> u32 {
    let (line, polytope) = (&cast.line, cast.polytope);
    let map = polytope.face_map();
    let offset = line.origin - polytope.centre();
    let reach = polytope.max_dist() + cast.radius;
    let half = ((reach * reach - offset.length_squared()).max(0.0) / line.square).sqrt();
    let outwards = offset - half * line.direction;
    // From the centre of the bounds to the side that this leads to.
    let bounds = map.bounds();
    let room = 0.5 * (bounds.max - bounds.min);
    let share = (outwards / room).abs();
    let axis = share.max_position();
    let point = 0.5 * (bounds.max + bounds.min) + outwards / share[axis];
    map.near(2 * axis + usize::from(outwards[axis] > 0.0), point)
}

/// How a line comes to a face pushed out by the radius.
pub(super) enum Landing {
    /// Over the face itself.
    Over { fraction: f64 },
    /// Beyond its rim, and furthest beyond this edge.
    Beyond { edge: u32 },
    /// From behind.
    Behind,
}

/// How the line comes to a face, of whose rim `but` is left out.
#[inline]
pub(super) fn landing(cast: &Cast, face: u32, but: Option<u32>) -> Landing {
    let polytope = cast.polytope;
    let (normal, offset) = polytope.face_map().plane(face);
    let line = &cast.line;
    let rate = normal.dot(line.direction);
    // False for NaN too.
    let towards = rate < 0.0;
    if !towards {
        return Landing::Behind;
    }
    let fraction = (offset + cast.radius - normal.dot(line.origin)) / rate;
    let point = line.origin + fraction * line.direction;
    let map = polytope.edge_map();
    let (mut over, mut lowest, mut beyond) = (true, f64::INFINITY, None);
    for &number in map.around_face(face) {
        let edge = map.line(number);
        let side = normal.cross(edge.along).dot(point - edge.from);
        let inwards = if edge.faces[0] == face { side } else { -side };
        over &= inwards >= 0.0;
        if inwards < lowest && Some(number) != but {
            (lowest, beyond) = (inwards, Some(number));
        }
    }
    match beyond {
        Some(edge) if !over => Landing::Beyond { edge },
        _ => Landing::Over { fraction },
    }
}
