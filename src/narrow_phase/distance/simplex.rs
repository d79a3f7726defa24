//! Up to four points of the Minkowski difference, and what of them is nearest to the origin.
//!
//! Every answer is the closed form of one pair of vertices, of edges, or of a
//! vertex and a face: directions are taken from differences within one
//! body, never from those of points that are close by chance, so that they are as right
//! for a gap of 1e-12 of the bodies' size as for a wide one.

use super::frame::Frame;
use glam::DVec3;

/// Share of the longest edge below which a tetrahedron's height tells no sides apart.
///
/// Rounding of the height is some 1e-15; flat tetrahedra are what parallel faces
/// make. Higher only costs time.
const FLAT: f64 = 1e-10;

/// Squared sine of a triangle's angle below which its plane is laid by [`Frame`].
const SHARP: f64 = 1e-3;

/// What rounding does to a height over a triangle times its area, as a share of the lengths that
/// went in: a dozen half ulp. Lower, and a sliver's plane hides a gap of 1e-10.
const ROUNDED: f64 = 16.0 * f64::EPSILON;

/// A point of A − B: a vertex of each.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Probe {
    pub(super) vertices: [u32; 2],
    pub(super) a: DVec3,
    pub(super) b: DVec3,
    /// A's vertex seen from B's.
    pub(super) point: DVec3,
}

impl Probe {
    /// To another point, from differences within each body.
    #[inline]
    fn to(&self, other: &Self) -> DVec3 {
        (other.a - self.a) - (other.b - self.b)
    }
}

/// Probes of which none can be left out.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Simplex {
    probes: [Probe; 4],
    count: usize,
}

/// The point of a simplex nearest to the origin.
#[derive(Debug, Clone, Copy)]
pub(super) struct Nearest {
    corners: [usize; 3],
    count: usize,
    /// The nearest point.
    pub(super) point: DVec3,
    /// Its squared distance.
    pub(super) square: f64,
}

impl Nearest {
    fn better(self, other: Self) -> Self {
        if other.square < self.square {
            other
        } else {
            self
        }
    }
}

impl Simplex {
    #[inline]
    pub(super) fn push(&mut self, probe: Probe) {
        if let Some(place) = self.probes.get_mut(self.count) {
            *place = probe;
            self.count += 1;
        }
    }

    #[inline]
    pub(super) fn probes(&self) -> &[Probe] {
        &self.probes[..self.count]
    }

    /// Reduces the simplex to the part whose inside is nearest to the origin; none if it holds the
    /// origin, or nothing.
    #[inline]
    pub(super) fn reduce(&mut self) -> Option<Nearest> {
        let nearest = match self.count {
            0 => return None,
            1 => return Some(self.corner(0)),
            2 => self.edge(0, 1),
            3 => self.face(0, 1, 2),
            _ => self.body()?,
        };
        if nearest.count < self.count {
            let probes = nearest.corners.map(|corner| self.probes[corner]);
            for (place, probe) in self.probes.iter_mut().zip(probes) {
                *place = probe;
            }
            self.count = nearest.count;
        }
        Some(nearest)
    }

    #[inline]
    fn corner(&self, i: usize) -> Nearest {
        let point = self.probes[i].point;
        Nearest {
            corners: [i, 0, 0],
            count: 1,
            point,
            square: point.length_squared(),
        }
    }

    #[inline]
    fn edge(&self, i: usize, j: usize) -> Nearest {
        let (from, along) = (self.probes[i].point, self.probes[i].to(&self.probes[j]));
        let square = along.length_squared();
        let share = -from.dot(along) / square;
        // NaN, of an edge without length, is no share.
        if share.is_nan() || share <= 0.0 {
            return self.corner(i);
        }
        if share >= 1.0 {
            return self.corner(j);
        }
        let point = from + share * along;
        // Once more: what is left of a short distance must be across the edge.
        let point = point - (point.dot(along) / square) * along;
        Nearest {
            corners: [i, j, 0],
            count: 2,
            point,
            square: point.length_squared(),
        }
    }

    #[inline]
    fn face(&self, i: usize, j: usize, k: usize) -> Nearest {
        let probe = &self.probes;
        let (to_j, to_k) = (probe[i].to(&probe[j]), probe[i].to(&probe[k]));
        let normal = to_j.cross(to_k);
        let square = normal.length_squared();
        if square < SHARP * to_j.length_squared() * to_k.length_squared() {
            return self.sharp_face([i, j, k]);
        }
        let from = probe[i].point;
        let of_j = normal.dot(to_k.cross(from));
        let of_k = normal.dot(from.cross(to_j));
        let of_i = square - of_j - of_k;
        if of_i > 0.0 && of_j > 0.0 && of_k > 0.0 {
            let height = normal.dot(from);
            return Nearest {
                corners: [i, j, k],
                count: 3,
                point: height / square * normal,
                square: height * height / square,
            };
        }
        self.rim([i, j, k], [of_i, of_j, of_k])
    }

    /// The same of a thin triangle, whose edges' cross product is rounding.
    #[cold]
    fn sharp_face(&self, [i, j, k]: [usize; 3]) -> Nearest {
        let probe = &self.probes;
        // The longest edge leads from i to j.
        let square = |from: usize, to: usize| probe[from].to(&probe[to]).length_squared();
        let (ij, ik, jk) = (square(i, j), square(i, k), square(j, k));
        let [i, j, k] = if ij >= ik && ij >= jk {
            [i, j, k]
        } else if ik >= jk {
            [i, k, j]
        } else {
            [j, k, i]
        };
        let Some(frame) = Frame::new(probe[i].to(&probe[j]), probe[i].to(&probe[k])) else {
            return self.rim([i, j, k], [0.0; 3]);
        };
        let from = probe[i].point;
        let shares = frame.shares(-from);
        if shares.iter().all(|&share| share > 0.0) {
            let height = frame.normal.dot(from);
            return Nearest {
                corners: [i, j, k],
                count: 3,
                point: height * frame.normal,
                square: height * height,
            };
        }
        self.rim([i, j, k], shares)
    }

    /// The nearest edge of a triangle of those whose corner opposite has no share of the foot.
    fn rim(&self, [i, j, k]: [usize; 3], [of_i, of_j, of_k]: [f64; 3]) -> Nearest {
        let mut best: Option<Nearest> = None;
        for (weight, [from, to]) in [(of_i, [j, k]), (of_j, [i, k]), (of_k, [i, j])] {
            if weight.is_nan() || weight <= 0.0 {
                let edge = self.edge(from, to);
                best = Some(best.map_or(edge, |best| best.better(edge)));
            }
        }
        best.unwrap_or_else(|| self.corner(i))
    }

    /// None if the tetrahedron holds the origin.
    fn body(&self) -> Option<Nearest> {
        const FACES: [[usize; 4]; 4] = [[0, 1, 2, 3], [0, 1, 3, 2], [0, 2, 3, 1], [1, 2, 3, 0]];
        let probe = &self.probes;
        let (mut flat, mut within) = (false, true);
        let mut outside = [false; 4];
        for ([i, j, k, apex], outside) in FACES.into_iter().zip(&mut outside) {
            let (to_j, to_k) = (probe[i].to(&probe[j]), probe[i].to(&probe[k]));
            let to_apex = probe[i].to(&probe[apex]);
            let normal = to_j.cross(to_k);
            let (height, origin) = (normal.dot(to_apex), -normal.dot(probe[i].point));
            let longest = to_j
                .length_squared()
                .max(to_k.length_squared())
                .max(to_apex.length_squared());
            flat |= height * height <= FLAT * FLAT * normal.length_squared() * longest;
            // On which side of a sliver's plane a point lies, rounding of its normal tells.
            let spread = to_j.length_squared() * to_k.length_squared();
            let doubt = ROUNDED * ROUNDED * spread * probe[i].point.length_squared().max(longest);
            *outside =
                (origin * height).is_nan() || origin * height <= 0.0 || origin * origin <= doubt;
            within &= origin.abs() < height.abs();
        }
        if !flat && within && !outside.contains(&true) {
            return None;
        }
        // Of a flat tetrahedron rounding tells the sides.
        let all = flat || !outside.contains(&true);
        let mut best: Option<Nearest> = None;
        for ([i, j, k, _], outside) in FACES.into_iter().zip(outside) {
            if all || outside {
                let face = self.face(i, j, k);
                best = Some(best.map_or(face, |best| best.better(face)));
            }
        }
        best
    }

    /// The nearest points of A and of B, as offsets from their centres, of a reduced simplex.
    pub(super) fn witness(&self, nearest: DVec3) -> (DVec3, DVec3) {
        let [first, second, third, _] = &self.probes;
        let mut shares = [0.0, 0.0];
        let (along, other) = (first.to(second), first.to(third));
        // Twice: the second time takes off the rounding of the first.
        for _ in 0..2 {
            let [share, other_share] = shares;
            match self.count {
                2 => {
                    let rest = first.point + share * along - nearest;
                    shares[0] -= rest.dot(along) / along.length_squared();
                }
                3 => {
                    let rest = first.point + share * along + other_share * other - nearest;
                    let normal = along.cross(other);
                    let square = normal.length_squared();
                    shares[0] += normal.dot(other.cross(rest)) / square;
                    shares[1] += normal.dot(rest.cross(along)) / square;
                }
                _ => {}
            }
        }
        let share = shares[0].clamp(0.0, 1.0);
        let other_share = shares[1].clamp(0.0, 1.0 - share);
        let mix = |of: fn(&Probe) -> DVec3| {
            let (first, second, third) = (of(first), of(second), of(third));
            match self.count {
                2 => first + share * (second - first),
                3 => first + share * (second - first) + other_share * (third - first),
                _ => first,
            }
        };
        (mix(|probe| probe.a), mix(|probe| probe.b))
    }
}
