//! The faces of a small polytope once more, as a ray or a ball looks at them.

use super::Polytope;
use super::sketch::{self, Planes, Sketch};
use glam::{DVec3, Vec4};

/// Four times the same vector.
pub(crate) type FourTimes = [Vec4; 3];

/// The planes of a small polytope in its own frame, in single precision and moved out by
/// [`PAD`](Self::PAD), so that all of the body lies behind them whatever rounding does.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Facade {
    /// Four by four; the last four are filled up with planes that nothing lies before.
    planes: Vec<Planes>,
    reach: f64,
    square_of_reach: f64,
    margin: f32,
}

impl Facade {
    /// By how much the planes are moved out, as a share of the reach: of how far the farthest vertex
    /// lies from the frame's origin.
    ///
    /// For a ray twice what rounding adds up to, in units of 6e-8: 25 for turning a vector, 5 for its product
    /// with a normal, of the ray's point nearest to the origin and of the way from there, and 5 for the
    /// plane and the quotient. A ball adds as large a share of its radius, and is turned with more digits.
    pub(crate) const PAD: f64 = 8e-6;

    /// How far within all other faces a point counts as one of a face, as a share of the reach: fifty times what
    /// the planes are moved out by, so that rays at 7° to a face and more are told where they hit it.
    pub(crate) const MARGIN: f64 = 50.0 * Self::PAD;

    /// With more faces it is quicker to walk over them, and their numbers do not fit into as many bits.
    pub(crate) const FACES: usize = 32;

    /// Farther from the origin in shares of its size, a body's planes would be moved out by too much.
    const FAR: f64 = 16.0;

    /// That of a polytope which is complete but for this; an empty one of one with many faces or far from its
    /// frame's origin.
    pub(super) fn of(polytope: &Polytope) -> Self {
        let reach = polytope.reach();
        let normals = polytope.face_normals();
        if normals.len() > Self::FACES || reach > Self::FAR * polytope.max_dist() {
            return Self::default();
        }
        let offsets = polytope.face_offsets().iter();
        let faces: Vec<(DVec3, f64)> = (normals.iter().zip(offsets))
            .map(|(&normal, offset)| (normal, offset + Self::PAD * reach))
            .collect();
        let planes = faces.chunks(4).map(|four| {
            let at = |lane| four.get(lane).copied().unwrap_or(Sketch::NO_FACE);
            sketch::planes(std::array::from_fn(at))
        });
        Self {
            planes: planes.collect(),
            reach,
            square_of_reach: reach * reach,
            margin: (Self::MARGIN * reach) as f32,
        }
    }

    /// How far from the frame's origin all vertices surely lie; 0 if there are no planes.
    #[inline]
    pub(crate) fn reach(&self) -> f64 {
        self.reach
    }

    /// Of the reach, which no vertex comes near to by a millionth of it; 0 if there are no planes.
    #[inline]
    pub(crate) fn square_of_reach(&self) -> f64 {
        self.square_of_reach
    }

    /// [`MARGIN`](Self::MARGIN) in metres.
    #[inline]
    pub(crate) fn margin(&self) -> f32 {
        self.margin
    }

    /// How far along the normals of four planes a vector leads.
    #[inline(always)]
    pub(crate) fn heights(&[x, y, z, _]: &Planes, &[p, q, r]: &FourTimes) -> Vec4 {
        x * p + y * q + z * r
    }

    /// The faces, four by four, in the order of their numbers.
    #[inline]
    pub(crate) fn planes(&self) -> &[Planes] {
        &self.planes
    }
}

#[cfg(test)]
impl Polytope {
    /// The same, to be looked at without it.
    pub(crate) fn without_facade(mut self) -> Self {
        self.facade = Facade::default();
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points on a spiral around a sphere.
    fn hull(count: u32, shift: f64) -> Polytope {
        let points = (0..count).map(|index| {
            let z = f64::from(2 * index + 1) / f64::from(count) - 1.0;
            let (y, x) = libm::sincos(2.4 * f64::from(index));
            (1.0 - z * z).sqrt() * DVec3::new(x, y, 0.0) + z * DVec3::Z + DVec3::splat(shift)
        });
        Polytope::from_points(points).unwrap()
    }

    #[test]
    fn all_of_the_body_lies_behind_it() {
        for (count, shift) in [(4, 0.0), (5, 3.0), (12, -1.0), (18, 8.0)] {
            let hull = hull(count, shift);
            let facade = hull.facade();
            let faces = hull.face_normals().len();
            let reach = facade.square_of_reach().sqrt();
            assert_eq!(facade.planes().len(), faces.div_ceil(4));
            for vertex in hull.vertices() {
                assert!(vertex.length() < reach * (1.0 - 0.9e-6));
                let vertex = vertex.as_vec3();
                for &[x, y, z, offset] in facade.planes() {
                    let heights = vertex.x * x + vertex.y * y + vertex.z * z;
                    assert!(heights.cmplt(offset).all(), "{count} {heights} {offset}");
                }
            }
            let all = facade.planes().iter().copied().flat_map(sketch::transposed);
            let planes: Vec<Vec4> = all.collect();
            let given = hull.face_normals().iter().zip(hull.face_offsets());
            for (plane, (normal, offset)) in planes.iter().zip(given) {
                assert_eq!(plane.truncate(), normal.as_vec3());
                let out = f64::from(plane.w) - offset;
                assert!((0.5..2.0).contains(&(out / (Facade::PAD * reach))));
            }
        }
    }

    #[test]
    fn what_is_large_or_far_away_has_none() {
        for hull in [hull(20, 0.0), hull(12, 100.0)] {
            assert!(hull.facade().planes().is_empty());
            assert!(hull.facade().square_of_reach() <= 0.0);
        }
    }
}
