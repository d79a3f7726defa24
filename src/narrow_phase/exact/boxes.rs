//! Two boxes: fifteen slabs.

use super::edges::edge_normal;
use super::pair::{Pair, STEEP};
use super::slab::Slabs;
use super::snap::{FEATURE, Place, Touch};
use crate::geometry::{Cuboid, Feature};
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

/// What a sweep finds.
pub(super) enum Swept {
    Touch(Touch),
    Miss,
    /// Rounding decides between features; the normal along the world's axes, and when that
    /// plane is met, in scaled motions from where the boxes are nearest.
    Unclear(DVec3, f64),
}

/// Two boxes in B's frame.
struct Boxes<'a> {
    pair: &'a Pair<'a>,
    half_a: [f64; 3],
    half_b: [f64; 3],
    /// From A's frame to B's.
    turn: DMat3,
    /// Its columns: A's axes.
    axes: [[f64; 3]; 3],
    /// A's centre where it is nearest, and its motion.
    centre: DVec3,
    motion: DVec3,
}

impl<'a> Boxes<'a> {
    #[inline]
    fn new(pair: &'a Pair, a: &Cuboid, b: &Cuboid) -> Self {
        let to_b = pair.b.rotation.transpose();
        let turn = to_b * pair.a.rotation;
        Self {
            pair,
            half_a: a.half_extents().to_array(),
            half_b: b.half_extents().to_array(),
            turn,
            axes: turn.to_cols_array_2d(),
            centre: to_b * pair.nearest,
            motion: to_b * pair.motion,
        }
    }

    /// Whose slab is entered last, and when. None if the boxes miss each other.
    ///
    /// Source: Gottschalk, Lin & Manocha, *OBBTree* (1996), for the fifteen axes;
    /// swept as a ray is clipped by slabs.
    #[inline]
    fn entry(&self) -> Option<(Axis, f64)> {
        let Self {
            half_a,
            half_b,
            axes,
            ..
        } = self;
        let rounding = self.pair.rounding;
        let sizes = axes.map(|axis| axis.map(f64::abs));
        let (centre, motion) = (self.centre.to_array(), self.motion.to_array());
        let mut slabs = Slabs::new();
        for i in 0..3 {
            let reach = half_b[i]
                + (sizes[0][i] * half_a[0] + sizes[1][i] * half_a[1] + sizes[2][i] * half_a[2]);
            slabs.slab(reach, centre[i], motion[i], rounding, Axis::B(i));
        }
        if slabs.miss() {
            return None;
        }
        for j in 0..3 {
            let dot = |vector: &[f64; 3]| {
                axes[j][0] * vector[0] + axes[j][1] * vector[1] + axes[j][2] * vector[2]
            };
            let reach = half_a[j]
                + (sizes[j][0] * half_b[0] + sizes[j][1] * half_b[1] + sizes[j][2] * half_b[2]);
            slabs.slab(reach, dot(&centre), dot(&motion), rounding, Axis::A(j));
        }
        if slabs.miss() {
            return None;
        }
        for j in 0..3 {
            let (axis, size) = (&axes[j], &sizes[j]);
            let (p, q) = ((j + 1) % 3, (j + 2) % 3);
            #[expect(clippy::needless_range_loop, reason = "i counts axes, not sizes alone")]
            for i in 0..3 {
                let (u, v) = ((i + 1) % 3, (i + 2) % 3);
                // B's i-th axis times A's j-th: −axis[v] along u, axis[u] along v.
                let squared = axis[u] * axis[u] + axis[v] * axis[v];
                if squared < CAREFUL {
                    if squared > PARALLEL {
                        self.careful(&mut slabs, (j, i));
                    }
                    continue;
                }
                let reach = half_b[u] * size[v]
                    + half_b[v] * size[u]
                    + half_a[p] * sizes[q][i]
                    + half_a[q] * sizes[p][i];
                let height = axis[u] * centre[v] - axis[v] * centre[u];
                let speed = axis[u] * motion[v] - axis[v] * motion[u];
                slabs.slab(reach, height, speed, rounding, Axis::Edges(j, i));
            }
        }
        let by = slabs.enter_by?;
        (!slabs.miss()).then_some((by, slabs.enter))
    }

    /// An axis of two nearly parallel edges, measured along its unit vector.
    #[cold]
    fn careful(&self, slabs: &mut Slabs<Axis>, (j, i): (usize, usize)) {
        if let Some(normal) = edge_normal(self.turn.col(j), DVec3::AXES[i]) {
            let reach = (self.turn.transpose() * normal)
                .abs()
                .dot(DVec3::from_array(self.half_a))
                + normal.abs().dot(DVec3::from_array(self.half_b));
            let (height, speed) = (normal.dot(self.centre), normal.dot(self.motion));
            slabs.slab(reach, height, speed, self.pair.rounding, Axis::Edges(j, i));
        }
    }

    /// A unit vector across a slab, in B's frame, up to its sign.
    fn normal(&self, axis: Axis) -> Option<DVec3> {
        match axis {
            Axis::A(j) => Some(self.turn.col(j)),
            Axis::B(i) => Some(DVec3::AXES[i]),
            Axis::Edges(j, i) => edge_normal(self.turn.col(j), DVec3::AXES[i]),
        }
    }

    /// The touch at the plane entered last, if plain features make it.
    #[inline]
    fn touch(&self, by: Axis, normal: DVec3, enter: f64) -> Option<Touch> {
        let pair = self.pair;
        let against = self.turn.transpose() * -normal;
        // How much higher one end of each edge is than the other, and which.
        let drop_a = 2.0 * DVec3::from_array(self.half_a) * against.abs();
        let drop_b = 2.0 * DVec3::from_array(self.half_b) * normal.abs();
        let corner_a = DVec3::from_array(self.half_a).copysign(against);
        let corner_b = DVec3::from_array(self.half_b).copysign(normal);
        let (margin_a, margin_b) = (FEATURE * pair.a.radius, FEATURE * pair.b.radius);
        let outward = pair.b.rotation * normal;
        let speed = outward.dot(pair.motion);
        let height = normal.dot(corner_b) - normal.dot(self.turn * corner_a);
        // Of what is nearly along the motion rounding makes long times.
        let time = if speed < -STEEP {
            (height - outward.dot(pair.offset)) / speed
        } else {
            pair.nearest_distance + enter
        };
        let to_a = self.centre + (time - pair.nearest_distance) * self.motion;
        let slack = pair.rounding;
        // By the ends of the edges that lie across the normal.
        let number = |corner: DVec3| {
            u32::from(corner.x > 0.0)
                | u32::from(corner.y > 0.0) << 1
                | u32::from(corner.z > 0.0) << 2
        };
        let plain = |point: DVec3, half: [f64; 3]| {
            (point.abs() - DVec3::from_array(half)).max_element() <= slack
        };
        let (features, point) = match by {
            Axis::B(i) => {
                if drop_a.min_element() <= margin_a
                    || !plain(self.turn * corner_a + to_a, self.half_b)
                {
                    return None;
                }
                let face = 2 * i as u32 + u32::from(normal.to_array()[i] > 0.0);
                (
                    [Feature::Vertex(number(corner_a)), Feature::Face(face)],
                    Place::OnA(pair.a.rotation * corner_a),
                )
            }
            Axis::A(j) => {
                let inverse = self.turn.transpose();
                if drop_b.min_element() <= margin_b
                    || !plain(inverse * (corner_b - to_a), self.half_a)
                {
                    return None;
                }
                let face = 2 * j as u32 + u32::from(against.to_array()[j] > 0.0);
                (
                    [Feature::Face(face), Feature::Vertex(number(corner_b))],
                    Place::OnB(pair.b.rotation * corner_b),
                )
            }
            Axis::Edges(j, i) => {
                let clear = |drop: DVec3, along: usize, margin: f64| {
                    let drop = drop.to_array();
                    drop[(along + 1) % 3].min(drop[(along + 2) % 3]) > margin
                };
                if !(clear(drop_a, j, margin_a) && clear(drop_b, i, margin_b)) {
                    return None;
                }
                let (axis_a, axis_b) = (self.turn.col(j), DVec3::AXES[i]);
                let cross = axis_a.cross(axis_b);
                let square = cross.length_squared();
                if square < CAREFUL {
                    return None;
                }
                // From the middles of both edges.
                let middle_a = self.turn * without(corner_a, j) + to_a;
                let middle_b = without(corner_b, i);
                let between = middle_b - middle_a;
                let along_a = between.cross(axis_b).dot(cross) / square;
                let along_b = between.cross(axis_a).dot(cross) / square;
                if along_a.abs() > self.half_a[j] + slack || along_b.abs() > self.half_b[i] + slack
                {
                    return None;
                }
                let point = middle_b + along_b * axis_b;
                (
                    [
                        Feature::Edge(edge(number(corner_a), j)),
                        Feature::Edge(edge(number(corner_b), i)),
                    ],
                    Place::OnB(pair.b.rotation * point),
                )
            }
        };
        let agrees = ((time - pair.nearest_distance - enter) * speed).abs() <= pair.doubt();
        (speed < 0.0 && agrees).then_some(Touch {
            time,
            normal: outward,
            features,
            point,
            certain: true,
        })
    }
}

fn without(mut corner: DVec3, axis: usize) -> DVec3 {
    corner[axis] = 0.0;
    corner
}

/// The edge along an axis that ends at a corner, as `Cuboid::EDGES` has them.
fn edge(corner: u32, axis: usize) -> u32 {
    match axis {
        0 => corner >> 1,
        1 => 4 + (corner & 1 | corner >> 1 & 2),
        _ => 8 + (corner & 3),
    }
}

/// How two boxes touch.
pub(super) fn touch(pair: &Pair, a: &Cuboid, b: &Cuboid) -> Swept {
    let boxes = Boxes::new(pair, a, b);
    let Some((by, enter)) = boxes.entry() else {
        return Swept::Miss;
    };
    let Some(normal) = boxes.normal(by) else {
        return Swept::Miss;
    };
    let normal = normal * -1.0_f64.copysign(normal.dot(boxes.motion));
    (boxes.touch(by, normal, enter)).map_or_else(
        || Swept::Unclear(pair.b.rotation * normal, enter),
        Swept::Touch,
    )
}
