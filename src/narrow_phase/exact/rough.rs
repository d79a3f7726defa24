//! Where a ray enters the difference of two bodies without very many vertices, in single precision.
//!
//! The search of [`portal`](super::portal) over again. Many a ray passes by, as the point that is
//! farthest out beyond it tells. For others, if vertices are few, all are turned into the
//! ray's frame beforehand: a farthest one then costs a handful of instructions, and its place is at hand.
//! Of more, a table has those that may be farthest along a direction.
//! What is found is a guess that has yet to be [proven](super::proof); only that
//! the ray passes by is proven here, by a margin that rounding cannot reach.

use super::body::Body;
use super::cloud::{Cloud, Many, Turned, Vector, dot, farthest_of_many, single};
use super::pair::Pair;
use super::sight::Sight;
use crate::geometry::{LANES, Lanes, Polytope, Shape};
use glam::{Mat4, Vec3A, Vec4};

/// Blocks of vertices that a body may have, and those of the small ones.
const BLOCKS: usize = Lanes::FEW / LANES;
const SMALL: usize = 3;

/// By how much less than nothing the difference must reach over the ray to miss it for certain, in
/// shares of the pair's size: ten times what rounding adds up to.
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

/// Twice the area that two vectors span across the ray.
#[inline(always)]
fn area(p: Vec3A, q: Vec3A) -> f32 {
    p.x * q.y - p.y * q.x
}

/// A point of the difference, as seen from the ray.
#[derive(Clone, Copy)]
struct Probe {
    vertices: [u32; 2],
    /// In one register: parts of it would have to be put together again.
    point: Vec3A,
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
            point: Vec3A::new(p + x, q + y, r + z),
        }
    }

    /// From two points to three around the ray, as
    /// [`Shadow::enclose`](super::portal::Shadow::enclose) does it, then to the face; `ray` is its place as
    /// seen from B's centre.
    ///
    /// The first of the two points is near to where the ray would enter were the difference a ball, the
    /// second on the other side of the ray, about as far: from small triangles it is not far to the
    /// face.
    #[inline(always)]
    fn search(&self, [x, y, _]: Vector) -> Rough {
        let beyond = (BALL - x * x - y * y).max(0.05).sqrt();
        let first = self.support([x, y, -beyond]);
        let p = first.point;
        let mut second = self.support([x - BEYOND * p.x, y - BEYOND * p.y, -beyond]);
        if second.vertices == first.vertices {
            second = self.support([x, y, 0.0]);
        }
        let side = second.point - p;
        // To the right of the line.
        let (x, y) = (side.y, -side.x);
        // Towards the ray.
        let (mut simplex, mut towards) = if -(x * p.x + y * p.y) >= 0.0 {
            ([first, second], [x, y])
        } else {
            ([second, first], [-x, -y])
        };
        for _ in 0..MAX_STEPS {
            let [x, y] = towards;
            let mut new = self.support([x, y, -TILT * (x.abs() + y.abs())]);
            let reach = |point: Vec3A| point.x * x + point.y * y;
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
                new.point - p
            } else {
                simplex = [new, to];
                q - new.point
            };
            towards = [side.y, -side.x];
        }
        Rough::Unclear
    }

    fn refine(&self, mut probes: [Probe; 3]) -> Rough {
        for _ in 0..MAX_STEPS {
            let [p, q, r] = probes.map(|probe| probe.point);
            let normal = (r - p).cross(q - p);
            let new = self.support(normal.to_array());
            let gain = normal.dot(new.point - p);
            let known = probes.iter().any(|probe| probe.vertices == new.vertices);
            if known || gain <= 0.0 || gain * gain <= LEVEL * LEVEL * normal.length_squared() {
                return Rough::Near(probes.map(|probe| probe.vertices));
            }
            // Which two of the three enclose the ray together with the new point? By bits, for a branch
            // could not be predicted.
            let [p, q, r] = [p, q, r].map(|point| point.extend(0.0));
            let across = Mat4::from_cols(p, q, r, Vec4::ZERO).transpose();
            let sides = across.y_axis * new.point.x - across.x_axis * new.point.y;
            let before = sides.cmpge(Vec4::ZERO).bitmask();
            let after = sides.cmple(Vec4::ZERO).bitmask() & 7;
            let between = before & (after >> 1 | after << 2) & 7;
            // Of p and q, of q and r, of r and p: what is left is the place of the new point.
            const PLACES: [usize; 8] = [3, 2, 0, 2, 1, 2, 0, 2];
            match probes.get_mut(PLACES[between as usize]) {
                Some(probe) => *probe = new,
                None => return Rough::Unclear,
            }
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
                Some(Self::Triangle([Lanes::of([a, b, c, a])]))
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
#[derive(Clone, Copy)]
enum Among<'a> {
    Few(&'a [Lanes]),
    Many(&'a Polytope),
}

impl Among<'_> {
    /// How far the farthest vertex reaches along a direction, in shares of the radius.
    #[inline(always)]
    fn reach(&self, direction: Vector) -> f32 {
        match self {
            Self::Few(list) => Lanes::reach(list, direction),
            Self::Many(polytope) => dot(direction, farthest_of_many(polytope, direction).1),
        }
    }
}

/// Where A enters the difference; unclear too if one of the bodies has very many vertices.
pub(super) fn search(pair: &Pair) -> Rough {
    let (Some(a), Some(b)) = (Vertices::of(&pair.a), Vertices::of(&pair.b)) else {
        return Rough::Unclear;
    };
    let (a, b) = (a.list(), b.list());
    let sight = Sight::new(pair);
    if let Some(outside) = outside(pair, &sight, [a, b]) {
        return outside;
    }
    let few = |list: &[Lanes]| list.len() <= SMALL;
    match (a, b) {
        (Among::Few(a), Among::Few(b)) if few(a) && few(b) => {
            search_few::<SMALL>(pair, &sight, a, b)
        }
        (Among::Few(a), Among::Few(b)) => search_few::<BLOCKS>(pair, &sight, a, b),
        (Among::Many(a), Among::Many(b)) => search_many(pair, &sight, a, b),
        (Among::Few(list), Among::Many(polytope)) => {
            let turn = sight.turn_b(pair);
            let a = &Turned::<BLOCKS>::of(list, &sight.turn_a(pair));
            let b = Many { polytope, turn };
            Clouds { a, b }.search(sight.ray)
        }
        (Among::Many(polytope), Among::Few(list)) => {
            let turn = sight.turn_a(pair);
            let b = &Turned::<BLOCKS>::of(list, &sight.turn_b(pair));
            let a = Many { polytope, turn };
            Clouds { a, b }.search(sight.ray)
        }
    }
}

/// What the point that is farthest out beyond the ray tells: if the difference does not reach the ray
/// there, nothing else need be looked at.
#[inline(always)]
fn outside(pair: &Pair, sight: &Sight, [a, b]: [Among; 2]) -> Option<Rough> {
    let (outwards, square) = sight.outwards();
    let local = |body: &Body| {
        let rotation = &body.rotation;
        [rotation.x_axis, rotation.y_axis, rotation.z_axis].map(|axis| dot(single(axis), outwards))
    };
    let to_a = sight.share(&pair.a) * a.reach(local(&pair.a).map(|x| -x));
    let to_b = sight.share(&pair.b) * b.reach(local(&pair.b));
    let reach = to_a + to_b - square;
    if reach >= 0.0 {
        None
    } else if reach * reach > MISS * MISS * square {
        Some(Rough::Miss)
    } else {
        Some(Rough::Unclear)
    }
}

#[inline(always)]
fn search_few<const N: usize>(pair: &Pair, sight: &Sight, a: &[Lanes], b: &[Lanes]) -> Rough {
    let a = &Turned::<N>::of(a, &sight.turn_a(pair));
    let b = &Turned::<N>::of(b, &sight.turn_b(pair));
    Clouds { a, b }.search(sight.ray)
}

#[inline(never)]
fn search_many(pair: &Pair, sight: &Sight, a: &Polytope, b: &Polytope) -> Rough {
    let clouds = Clouds {
        a: Many {
            polytope: a,
            turn: sight.turn_a(pair),
        },
        b: Many {
            polytope: b,
            turn: sight.turn_b(pair),
        },
    };
    clouds.search(sight.ray)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Cuboid, Polytope};
    use glam::{DQuat, DVec3};
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
