//! Two boxes in the usual case: one slab is entered last beyond doubt.

use super::Touching;
use super::box_body::{Body, Found, edge_at, number};
use super::box_shared::{self, Alike};
use super::box_slabs::{Boxes, Last};
use super::pair::STEEP;
use super::snap::FEATURE;
use crate::geometry::{Cuboid, Feature};
use crate::raycast::PLAIN_SQUARES;
use glam::{DQuat, DVec3};

/// Squared sine between two edges below which their common normal needs more care.
const CAREFUL: f64 = 1e-4;

/// Squared distance, in shares of the squared size, up to which where boxes are nearest is known to 1e-7
/// of their size.
const NEAR: f64 = 1e16;

/// What is plain to see.
pub(super) enum Plain {
    Touch(Touching),
    Miss,
    /// Rounding decides, or a number is extreme.
    Unclear,
}

/// How two boxes come to touch that move straight relative to each other.
///
/// Arguments are those of [`flat_touch`](super::flat_touch). Exchanging the boxes mirrors the answer, to the last bit.
///
/// If one slab is entered after all others, and all are entered before one is left, the boxes meet in
/// the plane where it begins. Of either the plane then holds what lies farthest along the normal: if that is
/// a vertex of one, it lies in the face of the other; if an edge of each, they cross. So neither needs to
/// be shown. Boxes that share axes meet in an edge or a face that lies level: what lies level is known from
/// what is shared.
pub(super) fn touch(
    a: (&Cuboid, &DQuat),
    b: (&Cuboid, &DQuat),
    between: DVec3,
    motion: DVec3,
) -> Plain {
    // In one order whichever is first.
    let leading = if motion.x != 0.0 {
        motion.x
    } else if motion.y != 0.0 {
        motion.y
    } else {
        motion.z
    };
    let swapped = leading < 0.0;
    let (first, second, sign) = if swapped { (b, a, -1.0) } else { (a, b, 1.0) };
    let (offset, way) = (sign * between, sign * motion);
    let (half_a, half_b) = (first.0.half_extents(), second.0.half_extents());
    let (radius_a, radius_b) = (half_a.length(), half_b.length());
    let size = radius_a + radius_b;
    let square = way.length_squared();
    let distance = offset.length_squared();
    // What is not finite fails one of the comparisons.
    if !(PLAIN_SQUARES.contains(&square) && distance <= NEAR * (size * size)) {
        return Plain::Unclear;
    }
    let along = offset.dot(way);
    let reach = size * (1.0 + 8.0 * f64::EPSILON);
    // No division: in most misses nothing else need be done.
    if (distance * (1.0 - 32.0 * f64::EPSILON) - reach * reach) * square > along * along {
        return Plain::Miss;
    }
    let scale = way.abs().max_element();
    let nearest = offset - (along / square) * way;
    // Lengths lie well within single precision; motions may not.
    let (per_size, per_scale) = ((1.0 / size) as f32, 1.0 / scale);
    let boxes = Boxes {
        half_a: half_a.as_vec3a() * per_size,
        half_b: half_b.as_vec3a() * per_size,
        orientation_a: first.1.as_quat(),
        orientation_b: second.1.as_quat(),
        nearest: nearest.as_vec3a() * per_size,
        motion: (per_scale * way).as_vec3a(),
    };
    let last = boxes.last();
    match last {
        Last::Miss => return Plain::Miss,
        Last::Unclear => return Plain::Unclear,
        _ => {}
    }
    let steep = STEEP * scale;
    if last == Last::Alike {
        return match box_shared::touch(&boxes, [first, second], offset, way, steep) {
            Alike::Touch { found, by_b } => told(found, by_b != swapped, between, motion),
            Alike::Miss => Plain::Miss,
            Alike::Unclear => Plain::Unclear,
        };
    }
    let bodies = [
        Body::new(half_a, radius_a, first.1),
        Body::new(half_b, radius_b, second.1),
    ];
    let (found, by_b) = match last {
        Last::Face { of_b, axis } => {
            let [of_face, of_corner] = [&bodies[usize::from(of_b)], &bodies[usize::from(!of_b)]];
            let sign = if of_b { 1.0 } else { -1.0 };
            (
                by_face([of_face, of_corner], axis, sign * offset, sign * way, steep),
                of_b,
            )
        }
        Last::Edges { of_a, of_b } => {
            let [body_a, body_b] = &bodies;
            (
                by_edges([body_b, body_a], [of_b, of_a], offset, way, steep),
                true,
            )
        }
        Last::Miss | Last::Alike | Last::Unclear => (None, true),
    };
    found.map_or(Plain::Unclear, |found| {
        told(found, by_b != swapped, between, motion)
    })
}

/// The touch as the caller sees it; whether the body that the normal leads out of is the caller's B.
#[inline(always)]
fn told(found: Found, out_of_b: bool, between: DVec3, motion: DVec3) -> Plain {
    let Found {
        fraction,
        normal,
        features: [behind, before],
        corner,
    } = found;
    Plain::Touch(if out_of_b {
        Touching {
            fraction,
            point: corner + (between + fraction * motion),
            normal,
            features: [before, behind],
        }
    } else {
        Touching {
            fraction,
            point: corner,
            normal: -normal,
            features: [behind, before],
        }
    })
}

/// The touch of a corner of the second body with a face of the first across this axis.
///
/// `offset` leads from the first to the second, which moves by `way`; not if it comes less steeply than
/// `steep`.
#[inline(always)]
fn by_face(
    [of_face, of_corner]: [&Body; 2],
    axis: usize,
    offset: DVec3,
    way: DVec3,
    steep: f64,
) -> Option<Found> {
    let across = of_face.axes[axis];
    let side = -1.0_f64.copysign(across.dot(way));
    let normal = side * across;
    let speed = normal.dot(way);
    let half = of_corner.half_extents;
    let against = -of_corner.levels(normal);
    let rises = half * against.abs();
    // False for NaN too.
    let plain = 2.0 * rises.min_element() > FEATURE * of_corner.radius && speed < -steep;
    if !plain {
        return None;
    }
    let corner = half.copysign(against);
    let height = of_face.half_extents[axis] + (rises.x + rises.y + rises.z);
    Some(Found {
        fraction: (height - normal.dot(offset)) / speed,
        normal,
        features: [
            Feature::Face(2 * axis as u32 + u32::from(side > 0.0)),
            Feature::Vertex(number(corner)),
        ],
        corner: of_corner.turned(corner),
    })
}

/// The touch of two edges along these axes; arguments as those of [`by_face`].
#[inline(always)]
fn by_edges(
    [first, second]: [&Body; 2],
    [i, j]: [usize; 2],
    offset: DVec3,
    way: DVec3,
    steep: f64,
) -> Option<Found> {
    let (along_first, along_second) = (first.axes[i], second.axes[j]);
    let cross = along_second.cross(along_first);
    let square = cross.length_squared();
    let side = -1.0_f64.copysign(cross.dot(way));
    let normal = (side / square.sqrt()) * cross;
    let speed = normal.dot(way);
    let first = edge(first, i, normal);
    let second = edge(second, j, -normal);
    // False for NaN too.
    let plain = square >= CAREFUL && first.plain && second.plain && speed < -steep;
    if !plain {
        return None;
    }
    let height = first.height + second.height;
    let fraction = (height - normal.dot(offset)) / speed;
    // From the middles of both edges.
    let between = first.middle - second.middle - (offset + fraction * way);
    let reached = between.cross(along_first).dot(cross) / square;
    Some(Found {
        fraction,
        normal,
        features: [first.feature, second.feature],
        corner: second.middle + reached * along_second,
    })
}

/// The edge along an axis that lies farthest along a direction.
struct Farthest {
    feature: Feature,
    middle: DVec3,
    height: f64,
    /// Whether no other lies as far.
    plain: bool,
}

#[inline(always)]
fn edge(body: &Body, along: usize, direction: DVec3) -> Farthest {
    let levels = body.levels(direction);
    // All of the edge lies level, but for rounding.
    let across = DVec3::ONE - DVec3::AXES[along];
    let rises = body.half_extents * levels.abs() * across;
    let corner = body.half_extents.copysign(levels);
    Farthest {
        feature: Feature::Edge(edge_at(number(corner), along)),
        middle: body.turned(corner * across),
        height: rises.x + rises.y + rises.z,
        plain: 2.0 * (rises + DVec3::AXES[along] * f64::MAX).min_element() > FEATURE * body.radius,
    }
}

#[cfg(test)]
mod tests {
    use super::super::flat;
    use super::super::pair::Pair;
    use super::super::snap::Place;
    use super::{Plain, touch};
    use crate::geometry::{Cuboid, Feature, Shape};
    use glam::{DQuat, DVec3};
    use std::f64::consts::{FRAC_PI_2, PI};

    /// Numbers in −1..1.
    struct Random(u64);

    impl Random {
        fn next(&mut self) -> f64 {
            self.0 = (self.0.wrapping_mul(6_364_136_223_846_793_005)).wrapping_add(1);
            (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        }

        fn vector(&mut self) -> DVec3 {
            DVec3::new(self.next(), self.next(), self.next())
        }

        /// Any, but often along an axis or nearly so.
        fn turn(&mut self) -> DQuat {
            let axis = match (8.0 * self.next()) as i32 {
                0 => DVec3::Y,
                _ => self.vector().normalize_or(DVec3::X),
            };
            let angle = match (6.0 * self.next()) as i32 {
                -1 => 0.0,
                1 => 10_f64.powf(8.0 * self.next() - 8.0),
                _ => 3.0 * self.next(),
            };
            DQuat::from_axis_angle(axis, angle)
        }

        /// Often such that the axes of both are the same, all or one of them, or nearly so.
        fn turns(&mut self) -> [DQuat; 2] {
            let (base, other) = (self.turn(), self.turn());
            let axis = DVec3::AXES[((1.5 * self.next() + 1.5) as usize).min(2)];
            let spin = |angle: f64| DQuat::from_axis_angle(axis, angle);
            let quarters = (4.0 * self.next()).round() * FRAC_PI_2;
            match (8.0 * self.next()) as i32 {
                // Of boxes upright in the world rounding leaves the axis as it is.
                -1 | 0 => [spin(3.0 * self.next()), spin(3.0 * self.next())],
                1 => [base, base],
                2 => [base * spin(3.0 * self.next()), base],
                -2 => [base * spin(10_f64.powf(8.0 * self.next() - 8.0)), base],
                3 => [base * spin(quarters), base],
                4 => [base * spin(quarters) * DQuat::from_rotation_x(PI), base],
                5 => {
                    let tilt = 10_f64.powf(5.0 * self.next() - 11.0);
                    let tilt = DQuat::from_axis_angle(self.vector().normalize_or(DVec3::X), tilt);
                    [base * spin(3.0 * self.next()) * tilt, base]
                }
                _ => [base, other],
            }
        }
    }

    /// What single precision decides is what double precision says.
    #[test]
    fn what_is_plain_is_what_all_fifteen_slabs_tell() {
        let mut random = Random(1);
        let (mut touches, mut misses, mut unclear) = (0, 0, 0);
        let (mut edges_on_faces, mut faces) = (0, 0);
        for _ in 0..40_000 {
            let mut half = || (random.vector() * 2.0).exp2();
            let (half_a, half_b) = (half(), half());
            let thin = DVec3::new(1.0, 1.0, 10_f64.powf(2.0 * random.next() - 2.0));
            let (Ok(a), Ok(b)) = (Cuboid::new(half_a), Cuboid::new(thin * half_b)) else {
                panic!("the boxes have sizes");
            };
            let [turn_a, turn_b] = random.turns();
            let size = half_a.length() + b.half_extents().length();
            let mut motion = match (8.0 * random.next()) as i32 {
                0 => DVec3::Z,
                1 => turn_b * DVec3::X,
                _ => random.vector(),
            };
            motion /= motion.abs().max_element();
            motion *= motion
                .to_array()
                .into_iter()
                .find(|&x| x != 0.0)
                .map_or(1.0, f64::signum);
            let past = match (4.0 * random.next()) as i32 {
                // A corner past a corner by a hair.
                2 => turn_b * b.half_extents() - turn_a * half_a + 1e-7 * random.vector(),
                _ => 0.8 * size * random.vector(),
            };
            let between = past - 3.0 * size * motion;
            let plain = touch((&a, &turn_a), (&b, &turn_b), between, motion);
            let shapes = [Shape::from(a), Shape::from(b)];
            let (one, other) = ((&shapes[0], turn_a), (&shapes[1], turn_b));
            let Some(pair) = Pair::new(one, other, between, motion) else {
                panic!("they are boxes");
            };
            match (plain, flat::touch(&pair)) {
                (Plain::Unclear, _) => unclear += 1,
                (Plain::Miss, None) => misses += 1,
                (Plain::Touch(found), Some(known)) => {
                    touches += 1;
                    match found.features {
                        [Feature::Face(_), Feature::Face(_)] => faces += 1,
                        [Feature::Face(_), Feature::Edge(_)]
                        | [Feature::Edge(_), Feature::Face(_)] => edges_on_faces += 1,
                        _ => {}
                    }
                    assert!(known.certain);
                    assert_eq!(found.features, known.features);
                    assert!(
                        (found.fraction - known.time).abs() < 1e-12 * size,
                        "{found:?}"
                    );
                    let point = match known.point {
                        Place::OnA(point) => point + between + known.time * motion,
                        Place::OnB(point) => point,
                    };
                    assert!(found.point.distance(point) < 1e-11 * size, "{found:?}");
                    assert!(found.normal.distance(known.normal) < 1e-12, "{found:?}");
                    assert!((found.normal.length() - 1.0).abs() < 1e-14, "{found:?}");
                }
                (Plain::Touch(found), None) => panic!("{found:?} of boxes that miss"),
                (Plain::Miss, Some(_)) => panic!("{a:?} {b:?} {between:?} meet by {motion:?}"),
            }
        }
        assert!(touches > 8000 && misses > 8000, "{touches} {misses}");
        assert!((10..8000).contains(&unclear), "{unclear}");
        assert!(
            edges_on_faces > 500 && faces > 500,
            "{edges_on_faces} {faces}"
        );
    }
}
