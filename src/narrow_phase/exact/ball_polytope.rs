//! A ball cast at a polytope: a line against the rounded polytope.
//!
//! Each face with its rim, rounded, is a piece of the rounded polytope, and the line comes
//! in where it comes into the first of them. A touch is the first if its normal is one of those
//! that the touched feature has between its neighbours; if it is not, then the neighbour
//! it leans to was touched earlier. So stepping to that neighbour ends, by convexity, at
//! the first touch. The same holds for the closest approach of a line that passes a
//! piece by, which it does until it comes to one it does not pass by, or to the
//! nearest of all, which says that there is no touch.

use super::ball_capsule::{Meeting, Place, meet};
use super::ball_line::{Line, Touch};
use super::ball_start::{over, start};
use super::ball_triangle::foot_on;
use crate::geometry::{Edge, Feature, Polytope};
use glam::DVec3;

/// What is cast at what. The line begins amid its way past the polytope.
pub(super) struct Cast<'a> {
    pub(super) line: Line,
    pub(super) polytope: &'a Polytope,
    pub(super) radius: f64,
    /// How far rounding may carry the line.
    pub(super) slack: f64,
}

/// The first touch.
enum First {
    Face { face: u32, fraction: f64 },
    Edge { edge: u32, meeting: Meeting },
}

impl First {
    fn fraction(&self) -> f64 {
        match self {
            Self::Face { fraction, .. } => *fraction,
            Self::Edge { meeting, .. } => meeting.fraction,
        }
    }
}

/// Some steps from neighbour to neighbour each way.
pub(super) fn of_polytope(line: &Line, polytope: &Polytope, radius: f64) -> Option<Touch> {
    let centre = polytope.centre();
    let offset = line.origin - centre;
    let size = centre.abs().max_element() + polytope.max_dist() + radius;
    let slack = line.slack(size);
    let middle = -offset.dot(line.direction) / line.square;
    let origin = line.origin + middle * line.direction;
    let reach = polytope.max_dist() + radius + slack;
    if (origin - centre).length_squared() > reach * reach {
        return None;
    }
    let mut cast = Cast {
        line: line.begun_at(origin),
        polytope,
        radius,
        slack,
    };
    let first = cast.first()?;
    let point = cast.line.origin + first.fraction() * line.direction;
    let enter = cast.polished(&first, line, middle);
    cast.line = cast.line.reversed();
    let leave = match cast.first() {
        Some(last) => -cast.polished(&last, &line.reversed(), -middle),
        None => enter,
    };
    let (foot, normal, feature) = cast.place(&first, point)?;
    Some(Touch {
        enter,
        leave,
        foot,
        normal,
        feature,
    })
}

impl Cast<'_> {
    fn ends(&self, edge: &Edge) -> [DVec3; 2] {
        edge.vertices.map(|v| self.polytope.vertices()[v as usize])
    }

    fn meet(&self, edge: u32) -> Meeting {
        let [from, to] = self.ends(&self.polytope.edges()[edge as usize]);
        meet(&self.line, from, to, self.radius)
    }

    fn first(&self) -> Option<First> {
        let face = start(self)?;
        let (mut edge, mut best) = match self.onto(face, None) {
            Ok(fraction) => return Some(First::Face { face, fraction }),
            Err(rim) => rim?,
        };
        loop {
            match self.better(edge, &best) {
                Some(Ok((face, fraction))) => return Some(First::Face { face, fraction }),
                Some(Err((next, meeting))) => (edge, best) = (next, meeting),
                None => break,
            }
        }
        if self.leans(edge, &best) {
            // Into the neighbour from behind, through a thin body: its front is elsewhere.
            for face in 0..self.polytope.face_normals().len() as u32 {
                match self.onto(face, None) {
                    Ok(fraction) => return Some(First::Face { face, fraction }),
                    Err(Some((next, meeting))) if meeting.before(&best) => {
                        (edge, best) = (next, meeting);
                    }
                    Err(_) => {}
                }
            }
        }
        let reach = self.radius + self.slack;
        (best.hit || best.rank <= reach * reach).then_some(First::Edge {
            edge,
            meeting: best,
        })
    }

    /// Where the line comes onto a face; or else what it meets first of its rim, `but` for one edge.
    fn onto(&self, face: u32, but: Option<u32>) -> Result<f64, Option<(u32, Meeting)>> {
        if let Some(fraction) = over(self, face) {
            return Ok(fraction);
        }
        let mut first: Option<(u32, Meeting)> = None;
        for &edge in self.polytope.edge_map().around_face(face) {
            if Some(edge) == but {
                continue;
            }
            let meeting = self.meet(edge);
            if (first.as_ref()).is_none_or(|(_, before)| meeting.before(before)) {
                first = Some((edge, meeting));
            }
        }
        Err(first)
    }

    /// A neighbour that the line meets before the touch `best` with `edge`, if there is one:
    /// a face, or another edge.
    #[allow(clippy::type_complexity)]
    fn better(&self, edge: u32, best: &Meeting) -> Option<Result<(u32, f64), (u32, Meeting)>> {
        let this = &self.polytope.edges()[edge as usize];
        match best.place {
            Place::Inner => {
                let [from, to] = self.ends(this);
                let along = to - from;
                for (side, face) in this.faces.into_iter().enumerate() {
                    let normal = self.polytope.face_normals()[face as usize];
                    // Into the face, whose normal it is across from.
                    let lean = best.away.dot(normal.cross(along));
                    if (if side == 0 { lean } else { -lean }) <= 0.0 {
                        continue;
                    }
                    match self.onto(face, Some(edge)) {
                        Ok(fraction) => return Some(Ok((face, fraction))),
                        Err(Some((next, meeting))) if meeting.before(best) => {
                            return Some(Err((next, meeting)));
                        }
                        Err(_) => {}
                    }
                }
            }
            Place::End(end) => {
                let vertex = this.vertices[end];
                let point = self.polytope.vertices()[vertex as usize];
                for &next in self.polytope.edge_map().around_vertex(vertex) {
                    if next == edge {
                        continue;
                    }
                    let [from, to] = self.ends(&self.polytope.edges()[next as usize]);
                    // From the vertex to the other end, whichever of them it is.
                    if best.away.dot((from - point) + (to - point)) <= 0.0 {
                        continue;
                    }
                    let meeting = self.meet(next);
                    if meeting.before(best) {
                        return Some(Err((next, meeting)));
                    }
                }
            }
        }
        None
    }

    /// Whether the normal of a touch leans over a neighbour by more than rounding.
    ///
    /// A lean of 1e-7 radians is an overlap of 1e-14 radii.
    fn leans(&self, edge: u32, best: &Meeting) -> bool {
        let this = &self.polytope.edges()[edge as usize];
        let margin = 1e-7 * best.away.length();
        match best.place {
            Place::Inner => {
                let [from, to] = self.ends(this);
                let along = to - from;
                (this.faces.into_iter().zip([along, -along])).any(|(face, along)| {
                    let inwards = self.polytope.face_normals()[face as usize].cross(along);
                    best.away.dot(inwards) > margin * inwards.length()
                })
            }
            Place::End(end) => {
                let vertex = this.vertices[end];
                let point = self.polytope.vertices()[vertex as usize];
                let edges = self.polytope.edge_map().around_vertex(vertex);
                edges.iter().any(|&next| {
                    let [from, to] = self.ends(&self.polytope.edges()[next as usize]);
                    let along = (from - point) + (to - point);
                    best.away.dot(along) > margin * along.length()
                })
            }
        }
    }

    /// The fraction from the coordinates as they were `given`, `middle` before the line's origin.
    ///
    /// Only a face gains by that: across a wide slab's face the line's shift rounds more than
    /// the height over it does.
    fn polished(&self, first: &First, given: &Line, middle: f64) -> f64 {
        let fraction = middle + first.fraction();
        let First::Face { face, .. } = first else {
            return fraction;
        };
        let (normal, offset) = self.polytope.face_map().plane(*face);
        let room = offset + self.radius - normal.dot(given.origin);
        let polished = room / normal.dot(given.direction);
        // A line along the face has no fraction to speak of.
        let change = (polished - fraction).abs() * given.square.sqrt();
        if change <= 1e-9 * self.radius.max(self.polytope.max_dist()) {
            polished
        } else {
            fraction
        }
    }

    /// Point, normal and feature of the touch in which the ball's centre is at `centre`.
    fn place(&self, first: &First, centre: DVec3) -> Option<(DVec3, DVec3, Feature)> {
        Some(match first {
            First::Face { face, .. } => {
                let normal = self.polytope.face_normals()[*face as usize];
                let foot = centre - self.radius * normal;
                (foot, normal, Feature::Face(*face))
            }
            First::Edge { edge, meeting } => {
                let this = &self.polytope.edges()[*edge as usize];
                let ends = self.ends(this);
                let outwards = self.polytope.face_normals()[this.faces[0] as usize];
                let normal = meeting.away.normalize_or(outwards);
                match meeting.place {
                    Place::Inner => (
                        foot_on(ends[0], ends[1], centre),
                        normal,
                        Feature::Edge(*edge),
                    ),
                    Place::End(end) => (ends[end], normal, Feature::Vertex(this.vertices[end])),
                }
            }
        })
    }
}
