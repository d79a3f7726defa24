//! A ball cast at a polytope: a line against the rounded polytope.
//!
//! Each face with its rim, rounded, is a piece of the rounded polytope, and the line comes
//! in where it comes into the first of them. A touch is the first if its normal is one of those
//! that the touched feature has between its neighbours; if it is not, then the neighbour
//! it leans to was touched earlier. So stepping to that neighbour ends, by convexity, at
//! the first touch. The same holds for the closest approach of a line that passes a
//! piece by, which it does until it comes to one it does not pass by, or to the
//! nearest of all, which says that there is no touch.

use super::ball_approach::normal;
use super::ball_capsule::{Meeting, Place, meet};
use super::ball_glance::{Glance, glance};
use super::ball_line::{Line, Touch};
use super::ball_start::{Landing, landing, start};
use super::ball_triangle::foot_on;
use crate::geometry::{Feature, Polytope};
use glam::DVec3;

/// What is cast at what. The line begins amid its way past the polytope.
pub(super) struct Cast<'a> {
    pub(super) line: Line,
    pub(super) polytope: &'a Polytope,
    pub(super) radius: f64,
    /// How far rounding may carry the line.
    pub(super) slack: f64,
}

/// What the line comes to.
enum Piece {
    Face { face: u32, fraction: f64 },
    Edge { edge: u32, meeting: Meeting },
}

/// What to do after a touch with an edge.
enum Step {
    /// A neighbour is touched earlier.
    To(Piece),
    /// None is; whether the touch leans to one nevertheless.
    Stay { leans: bool },
}

/// Some steps from neighbour to neighbour.
pub(super) fn of_polytope(line: &Line, polytope: &Polytope, radius: f64) -> Option<Touch> {
    let centre = polytope.centre();
    let offset = line.origin - centre;
    let size = centre.abs().max_element() + polytope.max_dist() + radius;
    let slack = line.slack(size);
    // Of small ones a glance tells as soon.
    let is_large = polytope.facade().planes().is_empty();
    if is_large && line.passes_by(offset, polytope.max_dist() + radius + 4.0 * slack) {
        return None;
    }
    let middle = -offset.dot(line.direction) / line.square;
    let cast = Cast {
        line: line.begun_at(line.origin + middle * line.direction),
        polytope,
        radius,
        slack,
    };
    let (fraction, foot, normal, feature) = match cast.first()? {
        Piece::Face { face, fraction } => {
            let (normal, _) = polytope.face_map().plane(face);
            let centre = cast.line.origin + fraction * line.direction;
            let fraction = cast.polished(face, middle + fraction, line);
            (
                fraction,
                centre - radius * normal,
                normal,
                Feature::Face(face),
            )
        }
        Piece::Edge { edge, meeting } => {
            let (foot, feature) = cast.place(edge, &meeting);
            let fraction = middle + meeting.fraction;
            (fraction, foot, normal(meeting.away, radius), feature)
        }
    };
    Some(Touch {
        fraction,
        foot,
        normal,
        feature,
    })
}

impl Cast<'_> {
    #[inline]
    fn meet(&self, edge: u32) -> Meeting {
        let edge = self.polytope.edge_map().line(edge);
        meet(&self.line, edge.from, edge.along, self.radius)
    }

    fn first(&self) -> Option<Piece> {
        match glance(self.polytope, &self.line, self.radius) {
            Glance::Miss => None,
            Glance::Over { face, fraction } => Some(Piece::Face { face, fraction }),
            Glance::Beyond { edge } => self.onwards(edge, self.meet(edge)),
            Glance::Unclear => self.carefully(),
        }
    }

    /// What [`first`](Self::first) finds where there is nothing to be seen at first sight.
    #[inline(never)]
    fn carefully(&self) -> Option<Piece> {
        match self.onto(start(self)?, None, None)? {
            Piece::Edge { edge, meeting } => self.onwards(edge, meeting),
            face @ Piece::Face { .. } => Some(face),
        }
    }

    /// The first touch, by way of one with an edge near to it.
    fn onwards(&self, mut edge: u32, mut best: Meeting) -> Option<Piece> {
        let leans = loop {
            match self.step(edge, &best) {
                Step::To(Piece::Edge {
                    edge: next,
                    meeting,
                }) => (edge, best) = (next, meeting),
                Step::To(face @ Piece::Face { .. }) => return Some(face),
                Step::Stay { leans } => break leans,
            }
        };
        if leans && self.leans(edge, &best) {
            // Into the neighbour from behind, through a thin body: its front is elsewhere.
            for face in 0..self.polytope.face_normals().len() as u32 {
                match self.onto(face, None, Some(&best)) {
                    Some(Piece::Edge {
                        edge: next,
                        meeting,
                    }) => (edge, best) = (next, meeting),
                    face @ Some(Piece::Face { .. }) => return face,
                    None => {}
                }
            }
        }
        let reach = self.radius + self.slack;
        (best.hit || best.rank <= reach * reach).then_some(Piece::Edge {
            edge,
            meeting: best,
        })
    }

    /// Where the line comes onto a face, or else a touch with its rim, `but` for one edge, that is
    /// before `best`.
    #[inline]
    fn onto(&self, face: u32, but: Option<u32>, best: Option<&Meeting>) -> Option<Piece> {
        let before = |edge: u32| {
            let meeting = self.meet(edge);
            let earlier = best.is_none_or(|best| meeting.before(best));
            earlier.then_some(Piece::Edge { edge, meeting })
        };
        match landing(self, face, but) {
            Landing::Over { fraction } => return Some(Piece::Face { face, fraction }),
            // As a rule this is the one.
            Landing::Beyond { edge } => {
                if let Some(piece) = before(edge) {
                    return Some(piece);
                }
            }
            Landing::Behind => {}
        }
        (self.polytope.face_map().sides(face).iter())
            .filter(|side| Some(side.edge) != but)
            .find_map(|side| before(side.edge))
    }

    /// To a neighbour that the line meets before the touch `best` with `edge`, if there is one.
    #[inline]
    fn step(&self, edge: u32, best: &Meeting) -> Step {
        let map = self.polytope.edge_map();
        let this = map.line(edge);
        let mut leans = false;
        match best.place {
            Place::Inner => {
                for (side, face) in this.faces.into_iter().enumerate() {
                    let (normal, _) = self.polytope.face_map().plane(face);
                    // Into the face, whose normal it is across from.
                    let lean = best.away.dot(normal.cross(this.along));
                    if (if side == 0 { lean } else { -lean }) <= 0.0 {
                        continue;
                    }
                    leans = true;
                    if let Some(piece) = self.onto(face, Some(edge), Some(best)) {
                        return Step::To(piece);
                    }
                }
            }
            Place::End(end) => {
                let vertex = this.vertices[end];
                for &next in map.around_vertex(vertex) {
                    let other = map.line(next);
                    let lean = best.away.dot(other.along);
                    // From the vertex to the other end, whichever of them it is.
                    let outwards = if other.vertices[0] == vertex {
                        lean
                    } else {
                        -lean
                    };
                    if outwards <= 0.0 || next == edge {
                        continue;
                    }
                    leans = true;
                    let meeting = self.meet(next);
                    if meeting.before(best) {
                        return Step::To(Piece::Edge {
                            edge: next,
                            meeting,
                        });
                    }
                }
            }
        }
        Step::Stay { leans }
    }

    /// Whether the normal of a touch leans over a neighbour by more than rounding.
    ///
    /// A lean of 1e-7 radians is an overlap of 1e-14 radii.
    #[cold]
    fn leans(&self, edge: u32, best: &Meeting) -> bool {
        let map = self.polytope.edge_map();
        let this = map.line(edge);
        let margin = 1e-7 * best.away.length();
        match best.place {
            Place::Inner => {
                let sides = this.faces.into_iter().zip([this.along, -this.along]);
                sides.into_iter().any(|(face, along)| {
                    let inwards = self.polytope.face_normals()[face as usize].cross(along);
                    best.away.dot(inwards) > margin * inwards.length()
                })
            }
            Place::End(end) => {
                let vertex = this.vertices[end];
                map.around_vertex(vertex).iter().any(|&next| {
                    let other = map.line(next);
                    let lean = best.away.dot(other.along);
                    let outwards = if other.vertices[0] == vertex {
                        lean
                    } else {
                        -lean
                    };
                    outwards > margin * other.along.length()
                })
            }
        }
    }

    /// The `fraction` at which the line comes onto a face, from the coordinates as they were `given`.
    ///
    /// Only a face gains by that: across a wide slab's face the line's shift rounds more than
    /// the height over it does.
    fn polished(&self, face: u32, fraction: f64, given: &Line) -> f64 {
        let (normal, offset) = self.polytope.face_map().plane(face);
        let room = offset + self.radius - normal.dot(given.origin);
        let polished = room / normal.dot(given.direction);
        // A line along the face has no fraction to speak of.
        let change = polished - fraction;
        let allowed = 1e-9 * self.radius.max(self.polytope.max_dist());
        if change * change * given.square <= allowed * allowed {
            polished
        } else {
            fraction
        }
    }

    /// Point and feature of a touch with an edge.
    fn place(&self, edge: u32, meeting: &Meeting) -> (DVec3, Feature) {
        let this = self.polytope.edge_map().line(edge);
        match meeting.place {
            Place::Inner => {
                let centre = self.line.origin + meeting.fraction * self.line.direction;
                let foot = foot_on(this.from, this.along, centre);
                (foot, Feature::Edge(edge))
            }
            Place::End(end) => {
                let vertex = this.vertices[end];
                let foot = self.polytope.vertices()[vertex as usize];
                (foot, Feature::Vertex(vertex))
            }
        }
    }
}
