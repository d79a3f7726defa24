//! A quick search for an axis that parts two hulls.

use super::pair::Pair;
use super::unit;
use glam::DVec3;

/// Steps after which the search gives up. Pairs that are apart by a share of
/// their size take 2 to 10; raising it helps only those that nearly touch.
const MAX_STEPS: usize = 24;

/// Whether an axis along which the pair is no wider than touch was found.
///
/// False means nothing: the pair may still be apart. Each answer of true rests
/// on one width, whatever rounding did to the search.
///
/// Source: Gilbert, Johnson & Keerthi (1988), in the form that keeps only
/// signs: a simplex of the Minkowski difference is led towards the origin.
pub(super) fn apart(pair: &Pair) -> bool {
    let mut simplex = Simplex::default();
    let mut direction = pair.offset;
    for _ in 0..MAX_STEPS {
        let Some(towards) = unit(direction) else {
            return false;
        };
        let point = pair.support(towards);
        if point.dot(towards) <= pair.touch {
            return true;
        }
        match simplex.add(point) {
            Some(next) => direction = next,
            None => return false,
        }
    }
    false
}

/// Up to four points, the newest first.
#[derive(Default)]
struct Simplex {
    points: [DVec3; 4],
    count: usize,
}

impl Simplex {
    fn set<const N: usize>(&mut self, points: [DVec3; N]) {
        self.points[..N].copy_from_slice(&points);
        self.count = N;
    }

    /// Adds a point, drops those the origin is turned away from, and returns the
    /// direction to the origin; none if the simplex holds it.
    fn add(&mut self, a: DVec3) -> Option<DVec3> {
        let [b, c, d, _] = self.points;
        match self.count {
            0 => {
                self.set([a]);
                Some(-a)
            }
            1 => Some(self.line(a, b)),
            2 => Some(self.triangle(a, b, c)),
            _ => self.tetrahedron([a, b, c, d]),
        }
    }

    fn line(&mut self, a: DVec3, b: DVec3) -> DVec3 {
        let along = b - a;
        if along.dot(-a) > 0.0 {
            self.set([a, b]);
            along.cross(-a).cross(along)
        } else {
            self.set([a]);
            -a
        }
    }

    fn triangle(&mut self, a: DVec3, b: DVec3, c: DVec3) -> DVec3 {
        let (to_b, to_c) = (b - a, c - a);
        let normal = to_b.cross(to_c);
        if normal.cross(to_c).dot(-a) > 0.0 {
            if to_c.dot(-a) > 0.0 {
                self.set([a, c]);
                to_c.cross(-a).cross(to_c)
            } else {
                self.line(a, b)
            }
        } else if to_b.cross(normal).dot(-a) > 0.0 {
            self.line(a, b)
        } else if normal.dot(-a) > 0.0 {
            self.set([a, b, c]);
            normal
        } else {
            self.set([a, c, b]);
            -normal
        }
    }

    /// `b`, `c`, `d` run so that the normal of `b c d` points to `a`.
    fn tetrahedron(&mut self, [a, b, c, d]: [DVec3; 4]) -> Option<DVec3> {
        for (p, q) in [(b, c), (c, d), (d, b)] {
            if (p - a).cross(q - a).dot(-a) > 0.0 {
                return Some(self.triangle(a, p, q));
            }
        }
        None
    }
}
