//! Which of the fifteen slabs between two boxes is entered last, in single precision.
//!
//! Three slabs at a time, and only what is certain: rounding is bounded, and whatever lies within
//! the bound is left to [`boxes`](super::boxes). What is told of the slab is worked out elsewhere from the numbers
//! given.

use glam::{Quat, Vec3A, Vec3Swizzles, Vec4};

/// By how much the height of one box above the other may be wrong, in shares of the pair's size.
///
/// Where u is 2⁻²⁴, a component of the relative rotation is off by 120 u at most: 40 u by rounding, the rest
/// by orientations not quite of unit length. So a reach is off by 210 u, a height by 230 u, and by as much what
/// motion adds to it, which is no longer than the pair's size while the spheres around the boxes meet;
/// with what dividing adds, 680 u. In double precision 1e-7 is lost where boxes begin far apart.
const ERROR: f32 = 1.0 / 16_384.0;

/// By how much the square of the relative orientation may seem to differ from 1: another 15 u are rounding.
const UNIT: f32 = 3e-7;

/// Components of the relative orientation below which it is worth asking whether axes are shared.
const ASKED: f32 = 5e-7;

/// Slower than this counts as this fast: the difference is next to nothing beside [`ERROR`].
const FASTEST: f32 = 1e12;

/// Two boxes and a line, with lengths in shares of the pair's size.
pub(super) struct Boxes {
    pub(super) half_a: Vec3A,
    pub(super) half_b: Vec3A,
    pub(super) orientation_a: Quat,
    pub(super) orientation_b: Quat,
    /// A's centre where it is nearest to B's, from there.
    pub(super) nearest: Vec3A,
    /// Of which the largest component is 1.
    pub(super) motion: Vec3A,
}

/// What is certain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Last {
    /// Across this axis of one of the boxes.
    Face {
        of_b: bool,
        axis: usize,
    },
    /// Across an edge of each along these axes.
    Edges {
        of_a: usize,
        of_b: usize,
    },
    Miss,
    /// Axes are shared or nearly so: for [`Boxes::last_face`].
    Alike,
    Unclear,
}

/// Three slabs.
#[derive(Clone, Copy)]
struct Slabs {
    /// When they are entered and left at the soonest and at the latest.
    enter: [Vec3A; 2],
    leave: [Vec3A; 2],
}

impl Slabs {
    /// Around points `depth` below that move upwards by `speed`; the reach is larger than it is by
    /// [`ERROR`].
    #[inline(always)]
    fn new(reach: Vec3A, depth: Vec3A, speed: Vec3A) -> Self {
        let (slow, quick) = (Vec3A::splat(-FASTEST), Vec3A::splat(FASTEST));
        // The order makes no difference but for NaN.
        let per_speed = (Vec3A::ONE / speed).max(slow).min(quick);
        let size = per_speed.abs();
        let middle = depth * per_speed;
        let outer = reach * size;
        let inner = outer - size * (2.0 * ERROR);
        Self {
            enter: [middle - outer, middle - inner],
            leave: [middle + inner, middle + outer],
        }
    }
}

impl Boxes {
    /// The slab entered last, if the boxes meet. All fifteen alike, without a branch, unless axes may be shared.
    ///
    /// Source: Gottschalk, Lin & Manocha, *OBBTree* (1996), for the fifteen axes.
    #[inline(always)]
    pub(super) fn last(&self) -> Last {
        let Self {
            half_a: a,
            half_b: b,
            orientation_a,
            orientation_b,
            nearest,
            motion,
        } = *self;
        let turn = orientation_b.conjugate() * orientation_a;
        // False for NaN too.
        let unit = (turn.length_squared() - 1.0).abs() <= UNIT;
        if !unit {
            return Last::Unclear;
        }
        let small = (Vec4::from(turn).abs().cmple(Vec4::splat(ASKED))).bitmask() & 0b111;
        if matches!(small, 0b011 | 0b101 | 0b110 | 0b111) {
            return Last::Alike;
        }
        let to_b = Diagonals::of(orientation_b);
        let (c, m) = (to_b.back(-nearest), to_b.back(motion));
        let turn = Diagonals::of(turn);
        let Diagonals { d, p, n } = turn;
        // Row i + 2 and column i, row i and column i + 2.
        let (n2, p2) = (n.zxy(), p.zxy());
        let (d1, d2, p1, n1) = (d.yzx(), d.zxy(), p.yzx(), n.yzx());
        let (sd, sp, sn, sn2, sp2) = (d.abs(), p.abs(), n.abs(), n2.abs(), p2.abs());
        let (sd1, sd2, sp1, sn1) = (d1.abs(), d2.abs(), p1.abs(), n1.abs());
        let (a1, a2, b1, b2) = (a.yzx(), a.zxy(), b.yzx(), b.zxy());
        let (c1, c2, m1, m2) = (c.yzx(), c.zxy(), m.yzx(), m.zxy());
        let error = Vec3A::splat(ERROR);
        let [of_b, of_a] = self.faces(&turn, c, m);
        let groups = [
            of_b,
            of_a,
            // B's i-th axis times A's i-th, (i + 1)-th and (i + 2)-th.
            Slabs::new(
                (error + b1 * sn2 + b2 * sp) + (a1 * sp2 + a2 * sn),
                p * c2 - n2 * c1,
                p * m2 - n2 * m1,
            ),
            Slabs::new(
                (error + b1 * sp1 + b2 * sd1) + (a2 * sd + a * sp2),
                d1 * c2 - p1 * c1,
                d1 * m2 - p1 * m1,
            ),
            Slabs::new(
                (error + b1 * sd2 + b2 * sn1) + (a * sn + a1 * sd),
                n1 * c2 - d2 * c1,
                n1 * m2 - d2 * m1,
            ),
        ];
        told(&groups, 0)
    }

    /// The same of [`Last::Alike`] by faces alone, of which A's named `twice`, by their places among
    /// the slabs, are B's as well.
    #[inline(always)]
    pub(super) fn last_face(&self, twice: u32) -> Last {
        let to_b = Diagonals::of(self.orientation_b);
        let turn = Diagonals::of(self.orientation_b.conjugate() * self.orientation_a);
        let faces = self.faces(&turn, to_b.back(-self.nearest), to_b.back(self.motion));
        told(&faces, twice)
    }

    /// B's slabs and A's; B's centre and the motion lie along B's axes.
    #[inline(always)]
    fn faces(&self, turn: &Diagonals, centre: Vec3A, motion: Vec3A) -> [Slabs; 2] {
        let (a, b) = (self.half_a, self.half_b);
        let Diagonals { d, p, n } = *turn;
        let (sd, sp, sn) = (d.abs(), p.abs(), n.abs());
        let (sn2, sp2) = (sn.zxy(), sp.zxy());
        let error = Vec3A::splat(ERROR);
        [
            Slabs::new(
                (b + error) + sd * a + (sn * a.yzx() + sp2 * a.zxy()),
                centre,
                motion,
            ),
            Slabs::new(
                (a + error) + sd * b + (sp * b.yzx() + sn2 * b.zxy()),
                turn.back(centre),
                turn.back(motion),
            ),
        ]
    }
}

/// A rotation by diagonals, so that no lane need be spread over the others.
///
/// In lane i: row i and column i, row i + 1 and column i, row i and column i + 1.
#[derive(Clone, Copy)]
struct Diagonals {
    d: Vec3A,
    p: Vec3A,
    n: Vec3A,
}

impl Diagonals {
    #[inline(always)]
    fn of(orientation: Quat) -> Self {
        let v = Vec3A::from_vec4(orientation.into());
        let (y, z) = (v.yzx(), v.zxy());
        let (mixed, along) = (v * (y + y), z * (orientation.w + orientation.w));
        let squares = y * y + z * z;
        Self {
            d: Vec3A::ONE - (squares + squares),
            p: mixed + along,
            n: mixed - along,
        }
    }

    /// The vector turned the other way round.
    #[inline(always)]
    fn back(&self, vector: Vec3A) -> Vec3A {
        self.d * vector + (self.p * vector.yzx() + self.n.zxy() * vector.zxy())
    }
}

/// What the times say; the slabs of `twice` are others once more.
#[inline(always)]
fn told<const N: usize>(groups: &[Slabs; N], twice: u32) -> Last {
    let largest = |of: fn(&Slabs) -> Vec3A| {
        let all = groups.each_ref().map(of);
        all.into_iter().fold(all[0], Vec3A::max).max_element()
    };
    let smallest = |of: fn(&Slabs) -> Vec3A| {
        let all = groups.each_ref().map(of);
        all.into_iter().fold(all[0], Vec3A::min).min_element()
    };
    let enter = largest(|slabs| slabs.enter[0]);
    if enter > smallest(|slabs| slabs.leave[1]) {
        return Last::Miss;
    }
    let (latest, leave) = (
        largest(|slabs| slabs.enter[1]),
        smallest(|slabs| slabs.leave[0]),
    );
    // False for NaN too.
    let inside = latest <= leave;
    if !inside {
        return Last::Unclear;
    }
    // All that may be entered last.
    let bar = Vec3A::splat(enter);
    let mask = groups.iter().enumerate().fold(0, |mask, (group, slabs)| {
        mask | slabs.enter[1].cmpge(bar).bitmask() << (3 * group)
    }) & !twice;
    if mask & mask.wrapping_sub(1) != 0 {
        return Last::Unclear;
    }
    let place = mask.trailing_zeros() as usize;
    match place {
        0..6 => Last::Face {
            of_b: place < 3,
            axis: place % 3,
        },
        6..15 => {
            let (of_b, further) = ((place - 6) % 3, (place - 6) / 3);
            Last::Edges {
                of_a: (of_b + further) % 3,
                of_b,
            }
        }
        _ => Last::Unclear,
    }
}
