//! Two boxes that share axes: upright ones, and ones turned alike.

use super::box_body::{Body, Found, edge_at, number};
use super::box_slabs::{Boxes, Last};
use super::snap::FEATURE;
use crate::geometry::{Cuboid, Feature};
use crate::narrow_phase::overlap::witness;
use glam::{DQuat, DVec2, DVec3};

/// Components of the relative orientation up to which axes are shared.
///
/// They then are some 1e-15 apart: less than what heights are grown by to make up for rounding, and far
/// less than what [`FEATURE`] takes for one feature.
const SHARED: f64 = 4e-16;

/// Axes of A that are axes of B as well, but for rounding: boxes on level ground share the upright one.
///
/// What edges along a shared axis span with others is a face of one of the boxes, or nothing; and what the
/// others span is the face across the shared axis. So only faces count, and of equal ones B's.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shared {
    None,
    /// The axis of this number of either box, one way.
    Axis(usize),
    /// Each is one, maybe of another number, or the other way.
    All,
}

impl Shared {
    /// Of boxes of which one is turned like this, as seen from the other.
    fn new(turn: DQuat) -> Self {
        let parts = DVec3::new(turn.x, turn.y, turn.z).abs();
        let small = parts.cmple(DVec3::splat(SHARED)).bitmask();
        let axis = match small {
            0b111 => return Self::All,
            0b110 => 0,
            0b101 => 1,
            0b011 => 2,
            _ => return Self::None,
        };
        let (sine, cosine) = (parts[axis], turn.w.abs());
        if cosine <= SHARED || (sine - cosine).abs() <= SHARED {
            Self::All
        } else {
            Self::Axis(axis)
        }
    }

    /// The faces of A that are faces of B, by their places among the slabs.
    #[inline]
    fn twice(self) -> u32 {
        match self {
            Self::None => 0,
            Self::Axis(axis) => 0b1000 << axis,
            Self::All => 0b11_1000,
        }
    }
}

/// What is plain of two boxes that may share axes.
pub(super) enum Alike {
    Touch {
        found: Found,
        /// Whether the normal leads out of the second box.
        by_b: bool,
    },
    Miss,
    Unclear,
}

/// How two boxes touch that may share axes. Kept apart, so that other boxes do not pay for it.
#[inline(never)]
pub(super) fn touch(
    boxes: &Boxes,
    [first, second]: [(&Cuboid, &DQuat); 2],
    offset: DVec3,
    way: DVec3,
    steep: f64,
) -> Alike {
    let shared = Shared::new(second.1.conjugate() * *first.1);
    let (of_b, axis) = match boxes.last_face(shared.twice()) {
        Last::Face { of_b, axis } if shared != Shared::None => (of_b, axis),
        // Whatever the edges are.
        Last::Miss => return Alike::Miss,
        _ => return Alike::Unclear,
    };
    let found = if of_b {
        by_face([second, first], axis, shared, offset, way, steep)
    } else {
        by_face([first, second], axis, shared, -offset, -way, steep)
    };
    found.map_or(Alike::Unclear, |found| Alike::Touch { found, by_b: of_b })
}

/// The touch of an edge along a shared axis, or of a face, of the second body with a face of the first.
///
/// The point is the middle of what they share. Arguments are those of `by_face` in
/// [`box_touch`](super::box_touch).
#[inline]
fn by_face(
    boxes: [(&Cuboid, &DQuat); 2],
    axis: usize,
    shared: Shared,
    offset: DVec3,
    way: DVec3,
    steep: f64,
) -> Option<Found> {
    let [of_face, other] = boxes.map(|(cuboid, orientation)| {
        let half_extents = cuboid.half_extents();
        Body::new(half_extents, half_extents.length(), orientation)
    });
    let across = of_face.axes[axis];
    let side = -1.0_f64.copysign(across.dot(way));
    let normal = side * across;
    let speed = normal.dot(way);
    // False for NaN too.
    let plain = speed < -steep;
    if !plain {
        return None;
    }
    let (half, reach) = (other.half_extents, of_face.half_extents);
    let against = -other.levels(normal);
    let rises = half * against.abs();
    let corner = half.copysign(against);
    let height = reach[axis] + (rises.x + rises.y + rises.z);
    let fraction = (height - normal.dot(offset)) / speed;
    let there = offset + fraction * way;
    let (feature, corner) = match shared {
        Shared::Axis(along) if along != axis => {
            let others = rises + DVec3::AXES[along] * f64::MAX;
            let clear = 2.0 * others.min_element() > FEATURE * other.radius;
            if !clear {
                return None;
            }
            let level = there.dot(of_face.axes[along]);
            let mut middle = corner;
            middle[along] = middle_of(level, reach[along], half[along]) - level;
            (
                Feature::Edge(edge_at(number(corner), along)),
                other.turned(middle),
            )
        }
        _ => {
            let top = against.abs().max_position();
            let mut middle = side * reach[axis] * DVec3::AXES[axis];
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            if shared == Shared::All {
                for along in [u, v] {
                    let direction = of_face.axes[along];
                    let extent = half.dot(other.levels(direction).abs());
                    middle[along] = middle_of(there.dot(direction), reach[along], extent);
                }
            } else {
                let flat = |vector: DVec3| {
                    DVec2::new(vector.dot(of_face.axes[u]), vector.dot(of_face.axes[v]))
                };
                let there = flat(there);
                let (x, y) = (half[u] * flat(other.axes[u]), half[v] * flat(other.axes[v]));
                let theirs = [there + x + y, there - x + y, there - x - y, there + x - y];
                let (x, y) = (reach[u], reach[v]);
                let ours = [(x, y), (-x, y), (-x, -y), (x, -y)].map(DVec2::from);
                let point = witness::middle(&ours, &theirs);
                (middle[u], middle[v]) = (point.x, point.y);
            }
            let face = 2 * top as u32 + u32::from(against[top] > 0.0);
            (Feature::Face(face), of_face.turned(middle) - there)
        }
    };
    Some(Found {
        fraction,
        normal,
        features: [
            Feature::Face(2 * axis as u32 + u32::from(side > 0.0)),
            feature,
        ],
        corner,
    })
}

/// The middle of what `other` to both sides of `level` shares with `reach` to both sides of 0.
#[inline(always)]
fn middle_of(level: f64, reach: f64, other: f64) -> f64 {
    0.5 * ((level - other).max(-reach) + (level + other).min(reach))
}
