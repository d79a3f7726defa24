//! A ball's first look at a small polytope, all faces side by side in single precision.

use super::ball_line::Line;
use crate::geometry::{Facade, FourTimes, Polytope};
use glam::{DVec3, Vec4};

/// How far the centre may lie from where it was found, as a share of the pair's size: a quarter of the margin, the
/// rest of which covers rounding and the moving out.
const OFF: f64 = 0.25 * Facade::MARGIN;

/// Squares of directions and sizes that keep all products within the range of `f32`.
const SQUARES: std::ops::RangeInclusive<f64> = 1e-12..=1e12;

/// Of larger balls, in shares of the polytope's reach, rounding makes more than of the polytope.
const LARGE: f64 = 1e3;

/// What is seen at first sight.
pub(super) enum Glance {
    /// The line comes onto this face, well within its rim.
    Over { face: u32, fraction: f64 },
    /// The line comes near to this edge, beyond a face's rim.
    Beyond { edge: u32 },
    /// The line passes the polytope by.
    Miss,
    /// This is not for single precision.
    Unclear,
}

#[inline(always)]
fn same(vector: DVec3) -> FourTimes {
    vector.as_vec3().to_array().map(Vec4::splat)
}

/// How a line that begins near the polytope comes to touch it with a ball.
///
/// The planes are moved out by the radius, and by more than rounding amounts to, the radius's share included. What
/// they enclose holds the rounded polytope: a line that passes them by touches nothing.
#[inline]
pub(super) fn glance(polytope: &Polytope, line: &Line, radius: f64) -> Glance {
    let facade = polytope.facade();
    let (size, planes) = (facade.reach() + radius, facade.planes());
    let plain = SQUARES.contains(&line.square)
        && SQUARES.contains(&facade.square_of_reach())
        && size <= LARGE * facade.reach();
    if !plain {
        return Glance::Unclear;
    }
    let [from, against] = [line.origin, -line.direction].map(same);
    let grown = Vec4::splat((radius * (1.0 + Facade::PAD)) as f32);
    let mut each = [Vec4::NEG_INFINITY; Facade::FACES / 4];
    let (mut enter, mut leave) = (Vec4::NEG_INFINITY, Vec4::INFINITY);
    for (plane, own) in planes.iter().zip(&mut each) {
        // As a ray's: along the plane the fraction is infinite on the right side, or NaN, which changes nothing.
        let rate = Facade::heights(plane, &against);
        let fraction = (Facade::heights(plane, &from) - (plane[3] + grown)) / rate;
        let side = Vec4::INFINITY.copysign(rate);
        *own = side.min(fraction);
        enter = own.max(enter);
        leave = side.max(fraction).min(leave);
    }
    let (enter, leave) = (enter.max_element(), leave.min_element());
    if enter > leave {
        return Glance::Miss;
    }
    let mut last = 0_u32;
    for (own, shift) in each.iter().zip((0..).step_by(4)).take(planes.len()) {
        last |= own.cmpeq(Vec4::splat(enter)).bitmask() << shift;
    }
    let face = last.trailing_zeros();
    if face as usize >= polytope.face_normals().len() {
        return Glance::Unclear;
    }
    // The foot of the ball's centre on that face's plane, and how far it lies behind the others.
    let map = polytope.face_map();
    let (normal, offset) = map.plane(face);
    let rate = normal.dot(line.direction);
    let room = offset + radius - normal.dot(line.origin);
    // From what has been read already: the face's own numbers take their time to come.
    let Some(four) = planes.get(face as usize / 4) else {
        return Glance::Unclear;
    };
    let back = |axis: usize| radius as f32 * four[axis][face as usize % 4];
    let ([p, q, r], [x, y, z]) = (from, against);
    let foot = [
        p - enter * x - back(0),
        q - enter * y - back(1),
        r - enter * z - back(2),
    ];
    let margin = facade.margin() + (Facade::MARGIN * radius) as f32;
    let mut near = 0_u32;
    for ((plane, room), shift) in planes.iter().zip(&mut each).zip((0..).step_by(4)) {
        *room = plane[3] - Facade::heights(plane, &foot);
        near |= room.cmplt(Vec4::splat(margin)).bitmask() << shift;
    }
    if near & !(1 << face) == 0 {
        let fraction = room / rate;
        let off = fraction - f64::from(enter);
        let sure = rate < 0.0 && off * off * line.square < OFF * OFF * size * size;
        return if sure {
            Glance::Over { face, fraction }
        } else {
            Glance::Unclear
        };
    }
    let (mut least, mut edge) = (f32::INFINITY, None);
    for side in map.sides(face) {
        let room = each[side.face as usize / 4][side.face as usize % 4];
        if room < least {
            (least, edge) = (room, Some(side.edge));
        }
    }
    edge.map_or(Glance::Unclear, |edge| Glance::Beyond { edge })
}

#[cfg(test)]
mod tests {
    use super::super::ball_polytope::of_polytope;
    use super::*;
    use crate::geometry::Feature;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::{Rng, SeedableRng};

    struct Draw(ChaCha8Rng);

    impl Draw {
        fn unit(&mut self) -> f64 {
            (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
        }

        fn cube(&mut self) -> DVec3 {
            DVec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0
        }

        /// Evenly distributed by its logarithm.
        fn log(&mut self, low: f64, high: f64) -> f64 {
            low * libm::pow(high / low, self.unit())
        }

        fn below(&mut self, count: usize) -> usize {
            (self.0.next_u64() % count as u64) as usize
        }

        /// Round, flat, thin or away from its frame's origin.
        fn hull(&mut self) -> Polytope {
            let thin = self.log(1e-3, 1.0);
            let stretch = [
                DVec3::ONE,
                DVec3::new(1.0, 1.0, thin),
                DVec3::new(1.0, thin, thin),
            ];
            let (stretch, shift) = (stretch[self.below(3)], 4.0 * self.cube());
            let shift = if self.below(4) == 0 {
                shift
            } else {
                DVec3::ZERO
            };
            let (count, scale) = (4 + self.below(14), self.log(1e-3, 1e3));
            let points = (0..count).map(|_| scale * (shift + stretch * self.cube()));
            Polytope::from_points(points.collect::<Vec<_>>()).unwrap()
        }

        /// A line by which a ball is aimed at a point of a face: anywhere, near its rim or at its normal's foot,
        /// or past the hull to within very little.
        fn line(&mut self, hull: &Polytope, radius: f64) -> Line {
            let size = hull.max_dist() + radius;
            let triangle = hull.triangles()[self.below(hull.triangles().len())];
            let [a, b, c] = triangle.map(|vertex| hull.vertices()[vertex as usize]);
            let normal = (b - a).cross(c - a).normalize();
            let (share, across) = (self.unit(), self.unit());
            let tiny = size * self.log(1e-17, 1e-2) * if self.below(2) == 0 { -1.0 } else { 1.0 };
            let mut way = self.cube().normalize();
            let foot = match self.below(5) {
                0 => a + share * (b - a) + across * (1.0 - share) * (c - a),
                1 => a + share * (b - a) + tiny * self.cube(),
                2 => a + share * (b - a) + tiny * normal.cross(b - a).normalize(),
                3 => a + 3.0 * size * self.cube(),
                _ => {
                    way = normal.cross(self.cube()).normalize() + 0.1 * self.unit() * normal;
                    a + share * (b - a) + tiny * normal
                }
            };
            let lean = if self.below(3) == 0 {
                self.cube()
            } else {
                normal
            };
            let at = foot + radius * lean.normalize();
            let direction = self.log(1e-5, 1e5) * way;
            let back = size * self.log(1e-3, 1e3) / direction.length();
            Line::new(at - back * direction, direction).unwrap()
        }
    }

    /// The glance says nothing that the way from neighbour to neighbour does not: of faces to the bit.
    #[test]
    fn agrees_with_the_careful_way() {
        let mut draw = Draw(ChaCha8Rng::seed_from_u64(11));
        let (mut over, mut beyond, mut miss) = (0, 0, 0);
        for _ in 0..4_000 {
            let hull = draw.hull();
            let bare = hull.clone().without_facade();
            for _ in 0..25 {
                let radius = hull.max_dist() * draw.log(1e-4, 1e2);
                let line = draw.line(&hull, radius);
                let size = hull.centre().length() + hull.max_dist() + radius;
                let room = 1e-12 * size + 16.0 * f64::EPSILON * line.origin.length();
                let about = || format!("{hull:?} {} {} {radius}", line.origin, line.direction);
                let [got, want] = [&hull, &bare].map(|hull| of_polytope(&line, hull, radius));
                let middle = (hull.centre() - line.origin).dot(line.direction) / line.square;
                let begun = line.begun_at(line.origin + middle * line.direction);
                match glance(&hull, &begun, radius) {
                    Glance::Over { .. } => over += 1,
                    Glance::Beyond { .. } => beyond += 1,
                    Glance::Miss => miss += 1,
                    Glance::Unclear => {}
                }
                let (got, want) = match (got, want) {
                    (Some(got), Some(want)) => (got, want),
                    (None, None) => continue,
                    // Of grazes rounding decides.
                    (Some(_), None) => {
                        let grown = of_polytope(&line, &bare, radius + room);
                        assert!(grown.is_some(), "a ghost: {}", about());
                        continue;
                    }
                    (None, Some(_)) => {
                        let shrunk = of_polytope(&line, &bare, radius - room);
                        assert!(
                            shrunk.is_none() || radius < 2.0 * room,
                            "a miss: {}",
                            about()
                        );
                        continue;
                    }
                };
                let off = (got.fraction - want.fraction) * got.normal.dot(line.direction);
                assert!(off.abs() <= room, "{off:e} m: {}", about());
                if matches!(got.feature, Feature::Face(_)) && got.feature == want.feature {
                    let same = got.fraction.to_bits() == want.fraction.to_bits()
                        && got.normal == want.normal
                        && got.foot == want.foot;
                    assert!(same, "{} {}: {}", got.fraction, want.fraction, about());
                }
            }
        }
        assert!(
            over > 4_000 && beyond > 20_000 && miss > 2_000,
            "{over} {beyond} {miss}"
        );
    }
}
