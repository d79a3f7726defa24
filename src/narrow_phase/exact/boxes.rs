//! Two boxes: fifteen slabs.

use super::edges::edge_normal;
use super::pair::{Ends, Pair};
use super::slab::Slabs;
use crate::geometry::Cuboid;
use glam::{DMat3, DVec3};

/// Squared sine between two edges below which their common normal is computed
/// with more care: above, rounding turns it by no more than 1e-14.
const CAREFUL: f64 = 1e-4;

/// Squared sine below which the face two edges span is thinner than rounding.
const PARALLEL: f64 = 1e-28;

/// Whose axes a slab lies across.
#[derive(Clone, Copy)]
enum Axis {
    A(usize),
    B(usize),
    Edges(usize, usize),
}

/// How two boxes enter and leave each other.
///
/// Source: Gottschalk, Lin & Manocha, *OBBTree* (1996), for the fifteen axes;
/// swept as a ray is clipped by slabs.
pub(super) fn ends(pair: &Pair, a: &Cuboid, b: &Cuboid) -> Option<Ends> {
    let (axes_a, axes_b) = (pair.a.rotation, pair.b.rotation);
    let (half_a, half_b) = (a.half_extents(), b.half_extents());
    let to_a = axes_a.transpose();
    // Everything in A's frame: B's axes, the offset and the motion.
    let turn = to_a * axes_b;
    let (offset, motion) = (to_a * pair.nearest, to_a * pair.motion);
    let sizes = DMat3::from_cols(turn.x_axis.abs(), turn.y_axis.abs(), turn.z_axis.abs());
    let rounding = pair.rounding;
    let mut slabs = Slabs::new();
    let reach = half_a + sizes * half_b;
    for i in 0..3 {
        slabs.slab(reach[i], offset[i], motion[i], rounding, Axis::A(i));
    }
    if slabs.miss() {
        return None;
    }
    let back = turn.transpose();
    let reach = half_b + sizes.transpose() * half_a;
    let (offset_b, motion_b) = (back * offset, back * motion);
    for j in 0..3 {
        slabs.slab(reach[j], offset_b[j], motion_b[j], rounding, Axis::B(j));
    }
    if slabs.miss() {
        return None;
    }
    for j in 0..3 {
        let (column, size) = (turn.col(j), sizes.col(j));
        let (p, q) = ((j + 1) % 3, (j + 2) % 3);
        for i in 0..3 {
            let (u, v) = ((i + 1) % 3, (i + 2) % 3);
            // The axis is A's i-th times B's j-th: −column[v] along u, column[u] along v.
            let squared = column[u] * column[u] + column[v] * column[v];
            if squared < CAREFUL {
                if squared > PARALLEL {
                    careful(pair, &mut slabs, [half_a, half_b], (i, j));
                }
                continue;
            }
            let reach = half_a[u] * size[v]
                + half_a[v] * size[u]
                + half_b[p] * sizes.col(q)[i]
                + half_b[q] * sizes.col(p)[i];
            let height = column[u] * offset[v] - column[v] * offset[u];
            let speed = column[u] * motion[v] - column[v] * motion[u];
            slabs.slab(reach, height, speed, rounding, Axis::Edges(i, j));
        }
    }
    if slabs.miss() {
        return None;
    }
    let normal = |axis| match axis {
        Axis::A(i) => Some(axes_a.col(i)),
        Axis::B(j) => Some(axes_b.col(j)),
        Axis::Edges(i, j) => edge_normal(axes_a.col(i), axes_b.col(j)),
    };
    let enter = (normal(slabs.enter_by?)?, slabs.enter);
    let leave = (normal(slabs.leave_by?)?, slabs.leave);
    Some(Ends::new(pair, enter, leave))
}

/// An axis of two nearly parallel edges, measured along its unit vector.
#[cold]
fn careful(pair: &Pair, slabs: &mut Slabs<Axis>, half: [DVec3; 2], (i, j): (usize, usize)) {
    let (axes_a, axes_b) = (pair.a.rotation, pair.b.rotation);
    if let Some(normal) = edge_normal(axes_a.col(i), axes_b.col(j)) {
        let reach = (axes_a.transpose() * normal).abs().dot(half[0])
            + (axes_b.transpose() * normal).abs().dot(half[1]);
        let (height, speed) = (normal.dot(pair.nearest), normal.dot(pair.motion));
        slabs.slab(reach, height, speed, pair.rounding, Axis::Edges(i, j));
    }
}
