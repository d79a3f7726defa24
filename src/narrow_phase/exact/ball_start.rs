//! Where on a polytope the search for the first touch begins.

use super::ball_polytope::Cast;

/// A face near the first touch; none if the line passes the polytope by.
///
/// The line enters the polytope with its faces pushed out by the radius at the face where it
/// crosses the last of those that look towards it. That polytope holds the rounded one. The face is
/// found from neighbour to neighbour, beginning near to where the line comes in.
pub(super) fn start(cast: &Cast) -> Option<u32> {
    let map = cast.polytope.face_map();
    let line = &cast.line;
    let grown = cast.radius + cast.slack;
    let approach = |face: u32| {
        let (normal, offset) = map.plane(face);
        let room = offset + grown - normal.dot(line.origin);
        (normal.dot(line.direction), room)
    };
    let near = map.grown_entry(line.origin, line.direction, cast.radius);
    let mut face = map.against(line.direction, near);
    let (rate, room) = approach(face);
    if rate >= 0.0 {
        return Some(face);
    }
    let mut fraction = room / rate;
    loop {
        let (current, here) = (face, fraction);
        for side in map.sides(current) {
            let neighbour = side.face;
            let (rate, room) = approach(neighbour);
            // Neither crossed later nor left before.
            if room >= here * rate {
                continue;
            }
            if rate >= 0.0 {
                return None;
            }
            // Strictly larger, so that no face comes twice and the walk ends.
            let crossing = room / rate;
            if crossing > fraction {
                (face, fraction) = (neighbour, crossing);
            }
        }
        if face == current {
            return Some(face);
        }
    }
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
    for side in polytope.face_map().sides(face) {
        let number = side.edge;
        let edge = map.line(number);
        let across = normal.cross(edge.along).dot(point - edge.from);
        let inwards = if edge.faces[0] == face {
            across
        } else {
            -across
        };
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
