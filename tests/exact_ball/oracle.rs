//! The answers by brute force, in numbers of 32 digits: every face pushed out, every edge
//! as a cylinder, every vertex as a sphere, by the school formula; the first of them counts.

use crate::draw::Cast;
use crate::twofold::{Twofold, Vector, cross, dot, sub, vector};
use feeler::{Feature, Shape};
use glam::{DQuat, DVec3};

/// A shape's surface in the world's axes.
pub(crate) struct Surface {
    corners: Vec<Vector>,
    triangles: Vec<([usize; 3], Feature)>,
    edges: Vec<([usize; 2], Option<Feature>)>,
}

/// The ball's centre relative to the shape, its motion, its radius.
pub(crate) struct Flight {
    pub(crate) origin: Vector,
    pub(crate) motion: Vector,
    pub(crate) radius: Twofold,
}

#[derive(Debug, Clone, Copy)]
pub(crate) struct Answer {
    pub(crate) enter: f64,
    pub(crate) leave: f64,
    pub(crate) normal: DVec3,
    pub(crate) foot: DVec3,
    /// The feature, if no other is within a millionth.
    pub(crate) feature: Option<Feature>,
}

fn rotated(turn: DQuat, point: DVec3) -> Vector {
    let axis = vector(DVec3::new(turn.x, turn.y, turn.z));
    let once = cross(axis, vector(point));
    let twice = cross(axis, once);
    let (two, w) = (Twofold::from(2.0), Twofold::from(turn.w));
    let point = vector(point);
    std::array::from_fn(|i| point[i] + two * (w * once[i] + twice[i]))
}

fn near(v: Vector) -> DVec3 {
    DVec3::new(v[0].0, v[1].0, v[2].0)
}

fn scaled(v: Vector, factor: Twofold) -> Vector {
    v.map(|x| x * factor)
}

fn add(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|i| a[i] + b[i])
}

impl Surface {
    /// None for a ball.
    pub(crate) fn of(shape: &Shape, orientation: DQuat) -> Option<Self> {
        let (corners, triangles) = match shape {
            Shape::Sphere(_) => return None,
            Shape::Cuboid(cuboid) => {
                let mut triangles = Vec::new();
                for axis in 0..3 {
                    let (u, v) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
                    for side in 0..2 {
                        let base = side << axis;
                        let face = Feature::Face((2 * axis + side) as u32);
                        for [from, to] in [[u, u + v], [u + v, v]] {
                            let (from, to) = if side == 1 { (from, to) } else { (to, from) };
                            triangles.push(([base, base + from, base + to], face));
                        }
                    }
                }
                (cuboid.vertices().to_vec(), triangles)
            }
            Shape::Triangle(triangle) => (
                triangle.vertices().to_vec(),
                vec![([0, 1, 2], Feature::Face(0)), ([0, 2, 1], Feature::Face(1))],
            ),
            Shape::Polytope(polytope) => (
                polytope.vertices().to_vec(),
                (polytope.triangles().iter())
                    .zip(polytope.triangle_faces())
                    .map(|(corners, &face)| (corners.map(|c| c as usize), Feature::Face(face)))
                    .collect(),
            ),
        };
        let mut edges = Vec::new();
        for (corners, _) in &triangles {
            for slot in 0..3 {
                let (from, to) = (corners[slot], corners[(slot + 1) % 3]);
                if from < to {
                    edges.push(([from, to], edge_feature(shape, from, to)));
                }
            }
        }
        Some(Self {
            corners: corners
                .into_iter()
                .map(|c| rotated(orientation, c))
                .collect(),
            triangles,
            edges,
        })
    }

    fn outwards(&self, [a, b, c]: [usize; 3]) -> Vector {
        let [a, b, c] = [a, b, c].map(|corner| self.corners[corner]);
        cross(sub(b, a), sub(c, a))
    }

    /// Whether `normal` lies more than a millionth within all that a corner or edge has.
    fn well_between(&self, normal: DVec3, corners: &[usize]) -> bool {
        self.edges.iter().all(|([from, to], _)| {
            let (here, there) = match (corners.contains(from), corners.contains(to)) {
                (true, false) => (*from, *to),
                (false, true) => (*to, *from),
                _ => return true,
            };
            let along = near(sub(self.corners[there], self.corners[here]));
            normal.dot(along.normalize()) < -1e-6
        })
    }

    pub(crate) fn first(&self, flight: &Flight) -> Option<Answer> {
        let mut best: Option<Answer> = None;
        let mut take = |enter: Option<Answer>, leave: f64| {
            best = Some(match (best, enter) {
                (None, enter) => Answer {
                    leave,
                    ..enter.unwrap_or(Answer {
                        enter: f64::INFINITY,
                        leave,
                        normal: DVec3::ZERO,
                        foot: DVec3::ZERO,
                        feature: None,
                    })
                },
                (Some(old), Some(new)) if new.enter < old.enter => Answer {
                    leave: leave.max(old.leave),
                    ..new
                },
                (Some(old), _) => Answer {
                    leave: leave.max(old.leave),
                    ..old
                },
            });
        };
        let Flight {
            origin,
            motion,
            radius,
        } = flight;
        let at = |fraction: Twofold| add(*origin, scaled(*motion, fraction));
        for (corner, position) in self.corners.iter().enumerate() {
            let start = sub(*origin, *position);
            let Some((enter, leave)) = roots(start, *motion, *radius * *radius) else {
                continue;
            };
            let normal = near(add(start, scaled(*motion, enter))).normalize();
            take(
                Some(Answer {
                    enter: enter.0,
                    leave: 0.0,
                    normal,
                    foot: near(*position),
                    feature: Some(Feature::Vertex(corner as u32))
                        .filter(|_| self.well_between(normal, &[corner])),
                }),
                leave.0,
            );
        }
        for ([from, to], feature) in &self.edges {
            let along = sub(self.corners[*to], self.corners[*from]);
            let square = dot(along, along);
            let start = sub(*origin, self.corners[*from]);
            let (aside, speed) = (cross(start, along), cross(*motion, along));
            let Some((enter, leave)) = roots(aside, speed, *radius * *radius * square) else {
                continue;
            };
            let share =
                |fraction: Twofold| dot(sub(at(fraction), self.corners[*from]), along) / square;
            let (first, last) = (share(enter), share(leave));
            let within =
                |share: Twofold| !share.negative() && !(share - Twofold::from(1.0)).positive();
            let foot = add(self.corners[*from], scaled(along, first));
            let normal = near(sub(at(enter), foot)).normalize();
            let entered = within(first).then(|| Answer {
                enter: enter.0,
                leave: 0.0,
                normal,
                foot: near(foot),
                feature: feature.filter(|_| {
                    // Beside a vertex the edge is touched earlier than that by the square of what is
                    // between over twice the radius, which may be less than coordinates tell.
                    let told = 8.0 * f64::EPSILON * dot(start, start).sqrt().0 * radius.0;
                    let margin = 1e-6 + (told / square.0).sqrt();
                    (margin..1.0 - margin).contains(&first.0)
                        && self.leans_off_faces(normal, [*from, *to])
                }),
            });
            if entered.is_some() || within(last) {
                take(
                    entered,
                    if within(last) {
                        leave.0
                    } else {
                        f64::NEG_INFINITY
                    },
                );
            }
        }
        for (corners, face) in &self.triangles {
            let outwards = self.outwards(*corners);
            let length = dot(outwards, outwards).sqrt();
            let rate = dot(outwards, *motion);
            if !rate.negative() && !rate.positive() {
                continue;
            }
            let start = sub(*origin, self.corners[corners[0]]);
            let fraction = (*radius * length - dot(outwards, start)) / rate;
            let point = at(fraction);
            let shares: [Twofold; 3] = std::array::from_fn(|slot| {
                let (from, to) = (corners[slot], corners[(slot + 1) % 3]);
                let (from, to) = (self.corners[from], self.corners[to]);
                dot(outwards, cross(sub(to, from), sub(point, from))) / (length * length)
            });
            if shares.iter().any(|share| share.negative()) {
                continue;
            }
            let normal = near(outwards).normalize();
            let entered = rate.negative().then(|| Answer {
                enter: fraction.0,
                leave: 0.0,
                normal,
                foot: near(point) - radius.0 * normal,
                feature: Some(*face).filter(|_| shares.iter().all(|share| share.0 > 1e-6)),
            });
            take(
                entered,
                if rate.positive() {
                    fraction.0
                } else {
                    f64::NEG_INFINITY
                },
            );
        }
        best
    }

    fn leans_off_faces(&self, normal: DVec3, edge: [usize; 2]) -> bool {
        self.triangles.iter().all(|(corners, _)| {
            !edge.iter().all(|corner| corners.contains(corner))
                || normal
                    .cross(near(self.outwards(*corners)).normalize())
                    .length()
                    > 1e-6
        })
    }

    /// From a point outside to the surface.
    pub(crate) fn distance(&self, point: Vector) -> f64 {
        let mut least = f64::INFINITY;
        for corner in &self.corners {
            let offset = sub(point, *corner);
            least = least.min(dot(offset, offset).sqrt().0);
        }
        for ([from, to], _) in &self.edges {
            let along = sub(self.corners[*to], self.corners[*from]);
            let offset = sub(point, self.corners[*from]);
            let share = dot(offset, along) / dot(along, along);
            if share.positive() && share.0 < 1.0 {
                let rest = sub(offset, scaled(along, share));
                least = least.min(dot(rest, rest).sqrt().0);
            }
        }
        for (corners, _) in &self.triangles {
            let outwards = self.outwards(*corners);
            let over = (0..3).all(|slot| {
                let (from, to) = (corners[slot], corners[(slot + 1) % 3]);
                let (from, to) = (self.corners[from], self.corners[to]);
                !dot(outwards, cross(sub(to, from), sub(point, from))).negative()
            });
            let offset = sub(point, self.corners[corners[0]]);
            if over {
                let height = dot(offset, outwards) / dot(outwards, outwards).sqrt();
                least = least.min(height.0.abs());
            }
        }
        least
    }
}

fn edge_feature(shape: &Shape, from: usize, to: usize) -> Option<Feature> {
    match shape {
        Shape::Sphere(_) => None,
        Shape::Cuboid(_) => match from ^ to {
            1 => Some(Feature::Edge((from >> 1) as u32)),
            2 => Some(Feature::Edge((4 + (from & 1) + (from >> 2) * 2) as u32)),
            4 => Some(Feature::Edge((8 + (from & 3)) as u32)),
            _ => None,
        },
        Shape::Triangle(_) => Some(Feature::Edge(if from + to == 2 { 2 } else { from as u32 })),
        Shape::Polytope(polytope) => (polytope.edges().iter())
            .position(|edge| {
                edge.vertices.map(|v| v as usize) == [from.min(to), from.max(to)]
                    || edge.vertices.map(|v| v as usize) == [from.max(to), from.min(to)]
            })
            .map(|edge| Feature::Edge(edge as u32)),
    }
}

/// When `|start + fraction · speed|²` is `square`.
pub(crate) fn roots(start: Vector, speed: Vector, square: Twofold) -> Option<(Twofold, Twofold)> {
    let a = dot(speed, speed);
    let b = dot(start, speed);
    let c = dot(start, start) - square;
    let discriminant = b * b - a * c;
    if discriminant.negative() || !a.positive() {
        return None;
    }
    let root = discriminant.sqrt();
    Some(((-b - root) / a, (-b + root) / a))
}

impl Flight {
    pub(crate) fn of(cast: &Cast, growth: f64) -> Self {
        Self {
            origin: vector(cast.position),
            motion: vector(cast.motion),
            radius: Twofold::from(cast.ball.radius()) + Twofold::from(growth),
        }
    }

    pub(crate) fn at(&self, fraction: f64) -> Vector {
        add(self.origin, scaled(self.motion, Twofold::from(fraction)))
    }
}

/// What the cast ought to give with a ball larger by `growth`.
pub(crate) fn answer(cast: &Cast, surface: Option<&Surface>, growth: f64) -> Option<Answer> {
    let flight = Flight::of(cast, growth);
    if let Some(surface) = surface {
        return surface.first(&flight);
    }
    let Shape::Sphere(other) = &cast.shape else {
        panic!("only balls have no corners");
    };
    let radius = flight.radius + Twofold::from(other.radius());
    let (enter, leave) = roots(flight.origin, flight.motion, radius * radius)?;
    let normal = near(add(flight.origin, scaled(flight.motion, enter))).normalize();
    Some(Answer {
        enter: enter.0,
        leave: leave.0,
        normal,
        foot: other.radius() * normal,
        feature: Some(Feature::Surface),
    })
}
