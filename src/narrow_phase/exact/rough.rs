//! Where a ray enters the difference of two bodies without very many vertices, in single precision.
//!
//! The search of [`portal`](super::portal) over again. If vertices are few, all are turned into the
//! ray's frame beforehand: a farthest one then costs a handful of instructions, and its place is at hand.
//! Of more, a table has those that may be farthest along a direction.
//! What is found is a guess that has yet to be [proven](super::proof); only that
//! the ray passes by is proven here, by a margin that rounding cannot reach.

use super::body::Body;
use super::cloud::{Cloud, Many, Turn, Turned, Unturned, Vector, dot, single};
use super::pair::Pair;
use crate::geometry::{LANES, Lanes, Polytope, Shape};
use glam::{DMat3, DVec3};

/// Blocks of vertices that a body may have, and those of the small ones.
const BLOCKS: usize = Lanes::FEW / LANES;
const SMALL: usize = 3;

/// By how much less than nothing the difference must reach over the ray to miss it for certain, in
/// shares of the pair's size: three times what rounding adds up to, most of it from
/// [`Lanes::highest`].
const MISS: f32 = 4e-5;

/// A face is found if the difference reaches over it by no more than this share of its size.
const LEVEL: f32 = 1e-5;

/// Steps before a search gives up; one or two to enclose the ray and three to refine as a rule, five with
/// a hundred vertices a body.
const MAX_STEPS: usize = 24;

/// Square of the radius of the ball that the difference is taken for, in shares of the pair's size: bodies do
/// not fill the spheres around them.
const BALL: f32 = 0.8;

/// How steeply a direction across the ray is tilted against it on the way to the first portal, so that
/// this lies near the entry.
const TILT: f32 = 1.0;

/// How far the direction of the second point leads beyond the ray, in shares of how far the first point lies
/// from it. Two would be as far, were the difference a ball; a ray missed takes more steps than a
/// larger triangle.
const BEYOND: f32 = 2.5;

/// What a search finds.
pub(super) enum Rough {
    /// Vertices of A and of B, three points of the difference whose triangle the ray goes through,
    /// but for rounding, and over which the difference does not reach.
    Near([[u32; 2]; 3]),
    Miss,
    Unclear,
}

#[inline]
fn minus([a, b, c]: Vector, [x, y, z]: Vector) -> Vector {
    [a - x, b - y, c - z]
}

#[inline]
fn cross([a, b, c]: Vector, [x, y, z]: Vector) -> Vector {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

/// Twice the area that two vectors span across the ray.
#[inline]
fn area([a, b, _]: Vector, [x, y, _]: Vector) -> f32 {
    a * y - b * x
}

/// A point of the difference, as seen from the ray.
#[derive(Clone, Copy)]
struct Probe {
    vertices: [u32; 2],
    point: Vector,
}

/// B's vertices and A's turned round.
struct Clouds<A, B> {
    a: A,
    b: B,
}

impl<A: Cloud, B: Cloud> Clouds<A, B> {
    #[inline(always)]
    fn support(&self, direction: Vector) -> Probe {
        let (a, [p, q, r]) = self.a.farthest(direction);
        let (b, [x, y, z]) = self.b.farthest(direction);
        Probe {
            vertices: [a, b],
            point: [p + x, q + y, r + z],
        }
    }

    /// The point that is farthest out beyond the ray. If the difference does not reach the ray there,
    /// nothing else need be looked at.
    #[inline(always)]
    fn outermost(&self, [x, y, _]: Vector) -> Result<Probe, Rough> {
        let outermost = self.support([x, y, 0.0]);
        let reach = outermost.point[0] * x + outermost.point[1] * y;
        if reach >= 0.0 {
            Ok(outermost)
        } else if reach * reach > MISS * MISS * (x * x + y * y) {
            Err(Rough::Miss)
        } else {
            Err(Rough::Unclear)
        }
    }

    /// From two points to three around the ray, as
    /// [`Shadow::enclose`](super::portal::Shadow::enclose) does it, then to the face; `ray` is its place as
    /// seen from B's centre.
    ///
    /// The first of the two points is near to where the ray would enter were the difference a ball, the
    /// second on the other side of the ray, about as far: from small triangles it is not far to the
    /// face.
    fn search(&self, [x, y, _]: Vector, outermost: Probe) -> Rough {
        let beyond = (BALL - x * x - y * y).max(0.05).sqrt();
        let first = self.support([x, y, -beyond]);
        let p = first.point;
        let mut second = self.support([x - BEYOND * p[0], y - BEYOND * p[1], -beyond]);
        if second.vertices == first.vertices {
            second = outermost;
        }
        let side = minus(second.point, p);
        // To the right of the line.
        let (x, y) = (side[1], -side[0]);
        // Towards the ray.
        let (mut simplex, mut towards) = if -(x * p[0] + y * p[1]) >= 0.0 {
            ([first, second], [x, y])
        } else {
            ([second, first], [-x, -y])
        };
        for _ in 0..MAX_STEPS {
            let [x, y] = towards;
            let mut new = self.support([x, y, -TILT * (x.abs() + y.abs())]);
            let reach = |point: Vector| point[0] * x + point[1] * y;
            if reach(new.point) < 0.0 {
                new = self.support([x, y, 0.0]);
                let reach = reach(new.point);
                if reach < 0.0 {
                    return if reach * reach > MISS * MISS * (x * x + y * y) {
                        Rough::Miss
                    } else {
                        Rough::Unclear
                    };
                }
            }
            let [from, to] = simplex;
            let (p, q) = (from.point, to.point);
            if new.vertices == from.vertices || new.vertices == to.vertices {
                return Rough::Unclear;
            }
            let (before, after) = (-area(new.point, p), area(new.point, q));
            if before >= 0.0 && after >= 0.0 {
                return self.refine([from, new, to]);
            }
            let side = if before < after {
                simplex = [from, new];
                minus(new.point, p)
            } else {
                simplex = [new, to];
                minus(q, new.point)
            };
            towards = [side[1], -side[0]];
        }
        Rough::Unclear
    }

    fn refine(&self, mut probes: [Probe; 3]) -> Rough {
        for _ in 0..MAX_STEPS {
            let [p, q, r] = probes.map(|probe| probe.point);
            let normal = cross(minus(r, p), minus(q, p));
            let new = self.support(normal);
            let gain = dot(normal, minus(new.point, p));
            let known = probes.iter().any(|probe| probe.vertices == new.vertices);
            if known || gain <= 0.0 || gain * gain <= LEVEL * LEVEL * dot(normal, normal) {
                return Rough::Near(probes.map(|probe| probe.vertices));
            }
            // Which two of the three enclose the ray together with the new point?
            let [to_p, to_q, to_r] = [p, q, r].map(|point| area(new.point, point));
            let pq = (to_p >= 0.0) & (to_q <= 0.0);
            let qr = (to_q >= 0.0) & (to_r <= 0.0);
            let rp = (to_r >= 0.0) & (to_p <= 0.0);
            if !(pq | qr | rp) {
                return Rough::Unclear;
            }
            let place = 2 * usize::from(pq) + usize::from(!pq & !qr);
            probes[place] = new;
        }
        Rough::Unclear
    }
}

/// What of a body's vertices a search begins with.
enum Vertices<'a> {
    Few(&'a [Lanes]),
    Box([Lanes; 2]),
    Triangle([Lanes; 1]),
    Many(&'a Polytope),
}

impl<'a> Vertices<'a> {
    /// None if there are very many.
    #[inline(always)]
    fn of(body: &Body<'a>) -> Option<Self> {
        match body.shape {
            Shape::Sphere(_) => None,
            Shape::Cuboid(cuboid) => Some(Self::Box(Lanes::of_box(
                cuboid.half_extents() / body.radius,
            ))),
            Shape::Triangle(triangle) => {
                let [a, b, c] = triangle
                    .vertices()
                    .map(|vertex| (vertex - body.centre) / body.radius);
                Some(Self::Triangle([Lanes::of([a, b, c, DVec3::NAN])]))
            }
            Shape::Polytope(polytope) => match polytope.lanes() {
                [] => (!polytope.summits().is_empty()).then_some(Self::Many(polytope)),
                lanes => Some(Self::Few(lanes)),
            },
        }
    }

    #[inline(always)]
    fn list(&self) -> Among<'_> {
        match self {
            Self::Few(list) => Among::Few(list),
            Self::Box(list) => Among::Few(list),
            Self::Triangle(list) => Among::Few(list),
            Self::Many(polytope) => Among::Many(polytope),
        }
    }
}

/// Few vertices or many.
enum Among<'a> {
    Few(&'a [Lanes]),
    Many(&'a Polytope),
}

/// Where A enters the difference; unclear too if one of the bodies has very many vertices.
pub(super) fn search(pair: &Pair) -> Rough {
    let (Some(a), Some(b)) = (Vertices::of(&pair.a), Vertices::of(&pair.b)) else {
        return Rough::Unclear;
    };
    match (a.list(), b.list()) {
        (Among::Few(a), Among::Few(b)) if a.len().max(b.len()) <= SMALL => {
            search_few::<SMALL>(pair, a, b)
        }
        (Among::Few(a), Among::Few(b)) => search_few::<BLOCKS>(pair, a, b),
        (Among::Many(a), Among::Many(b)) => search_many(pair, a, b),
        (Among::Few(list), Among::Many(polytope)) => {
            let Seen {
                ray,
                turn_a,
                turn_b,
            } = Seen::new(pair);
            let mut clouds = Clouds {
                a: Turned::<BLOCKS>::EMPTY,
                b: Many {
                    polytope,
                    turn: turn_b,
                },
            };
            clouds.a.fill(list, &turn_a);
            clouds
                .outermost(ray)
                .map_or_else(|miss| miss, |outermost| clouds.search(ray, outermost))
        }
        (Among::Many(polytope), Among::Few(list)) => {
            let Seen {
                ray,
                turn_a,
                turn_b,
            } = Seen::new(pair);
            let mut clouds = Clouds {
                a: Many {
                    polytope,
                    turn: turn_a,
                },
                b: Turned::<BLOCKS>::EMPTY,
            };
            clouds.b.fill(list, &turn_b);
            clouds
                .outermost(ray)
                .map_or_else(|miss| miss, |outermost| clouds.search(ray, outermost))
        }
    }
}

#[inline(always)]
fn search_few<const N: usize>(pair: &Pair, a: &[Lanes], b: &[Lanes]) -> Rough {
    let Seen {
        ray,
        turn_a,
        turn_b,
    } = Seen::new(pair);
    // Many a ray passes by: only for others all vertices are turned.
    let unturned = Clouds {
        a: Unturned {
            list: a,
            turn: turn_a,
        },
        b: Unturned {
            list: b,
            turn: turn_b,
        },
    };
    let outermost = match unturned.outermost(ray) {
        Ok(outermost) => outermost,
        Err(miss) => return miss,
    };
    // In place: a copy would cost as much as the turning.
    let mut clouds = Clouds {
        a: Turned::<N>::EMPTY,
        b: Turned::<N>::EMPTY,
    };
    clouds.a.fill(a, &turn_a);
    clouds.b.fill(b, &turn_b);
    clouds.search(ray, outermost)
}

#[inline(never)]
fn search_many(pair: &Pair, a: &Polytope, b: &Polytope) -> Rough {
    let Seen {
        ray,
        turn_a,
        turn_b,
    } = Seen::new(pair);
    let clouds = Clouds {
        a: Many {
            polytope: a,
            turn: turn_a,
        },
        b: Many {
            polytope: b,
            turn: turn_b,
        },
    };
    clouds
        .outermost(ray)
        .map_or_else(|miss| miss, |outermost| clouds.search(ray, outermost))
}

/// A pair in the frame of the ray, in shares of its size.
struct Seen {
    /// The ray's place from B's centre.
    ray: Vector,
    /// A's vertices are turned round as well.
    turn_a: Turn,
    turn_b: Turn,
}

impl Seen {
    #[inline(always)]
    fn new(pair: &Pair) -> Self {
        let frame = Frame::new(pair.motion);
        let per_size = 1.0 / pair.size;
        let columns = |rotation: &DMat3, share: f32| {
            let [x, y, z] = rotation.to_cols_array_2d();
            [x, y, z].map(|column| frame.seen(column.map(|x| x as f32)).map(|x| share * x))
        };
        let (share_a, share_b) = (pair.a.radius * per_size, pair.b.radius * per_size);
        let ray = frame.seen(single(per_size * pair.nearest));
        Self {
            ray,
            turn_a: Turn {
                columns: columns(&pair.a.rotation, -share_a as f32),
                shift: [0.0; 3],
            },
            turn_b: Turn {
                columns: columns(&pair.b.rotation, share_b as f32),
                shift: ray.map(|x| -x),
            },
        }
    }
}

/// Axes of which the third is the ray's.
struct Frame([Vector; 3]);

impl Frame {
    /// Source: Duff et al., *Building an Orthonormal Basis, Revisited* (2017).
    #[inline(always)]
    fn new(motion: DVec3) -> Self {
        let along = single(motion);
        let per_length = 1.0 / dot(along, along).sqrt();
        let [x, y, z] = along.map(|x| per_length * x);
        let sign = 1.0_f32.copysign(z);
        let a = -1.0 / (sign + z);
        let b = x * y * a;
        Self([
            [1.0 + sign * x * x * a, sign * b, -sign * x],
            [b, sign + y * y * a, -y],
            [x, y, z],
        ])
    }

    #[inline(always)]
    fn seen(&self, vector: Vector) -> Vector {
        self.0.map(|axis| dot(axis, vector))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Cuboid, Polytope};
    use glam::DQuat;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::{Rng, SeedableRng};
    use std::error::Error;

    fn vector(rng: &mut ChaCha8Rng) -> DVec3 {
        let mut number = || (rng.next_u64() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0;
        DVec3::new(number(), number(), number())
    }

    fn turn(rng: &mut ChaCha8Rng) -> DQuat {
        let (axis, angle) = (vector(rng).normalize_or(DVec3::X), 3.0 * vector(rng).x);
        DQuat::from_axis_angle(axis, angle)
    }

    /// The careful search would hide it if the rough one were of no use.
    #[test]
    fn hardly_a_cast_is_left_to_the_careful_search() -> Result<(), Box<dyn Error>> {
        let mut rng = ChaCha8Rng::seed_from_u64(12);
        let (mut proven, mut missed, mut left) = (0, 0, 0);
        for number in 0..2000 {
            let mut hull = |count: usize| -> Result<Shape, Box<dyn Error>> {
                let points: Vec<DVec3> = (0..count).map(|_| vector(&mut rng)).collect();
                Ok(Polytope::from_points(points)?.into())
            };
            let a = hull(if number % 2 == 0 { 12 } else { 24 })?;
            let b = if number % 3 == 0 {
                Cuboid::new([0.5, 1.0, 0.7])?.into()
            } else {
                hull(12)?
            };
            let (turn_a, turn_b) = (turn(&mut rng), turn(&mut rng));
            let (offset, motion) = (vector(&mut rng), vector(&mut rng));
            let pair = Pair::new((&a, turn_a), (&b, turn_b), 2.0 * offset, motion)
                .ok_or("neither is a ball")?;
            if pair.spheres_miss() {
                continue;
            }
            match search(&pair) {
                Rough::Miss => missed += 1,
                Rough::Near(probes) if pair.prove(probes).is_some() => proven += 1,
                _ => left += 1,
            }
        }
        assert!(proven > 800 && missed > 100, "{proven} {missed} {left}");
        assert!(
            left < 40,
            "{left} of {proven} are left to the careful search"
        );
        Ok(())
    }
}
