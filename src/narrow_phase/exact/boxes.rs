//! Two boxes: fifteen slabs.

use super::edges::edge_normal;
use super::pair::{Pair, STEEP};
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

impl Axis {
    /// By its place among the fifteen: B's, A's, then B's three across each of A's.
    fn of(place: usize) -> Self {
        match place {
            0..3 => Self::B(place),
            3..6 => Self::A(place - 3),
            _ => Self::Edges((place - 6) / 3, (place - 6) % 3),
        }
    }
}

/// When the fifteen slabs are entered and left.
///
/// All are written down before any is compared, so that the processor works on several at
/// once. Lengths are grown by what rounding may do to them: entries are as early and exits as
/// late as it allows.
struct Spans {
    enter: [f64; 15],
    leave: [f64; 15],
    rounding: f64,
}

impl Spans {
    #[inline]
    fn new(rounding: f64) -> Self {
        Self {
            enter: [f64::NEG_INFINITY; 15],
            leave: [f64::INFINITY; 15],
            rounding,
        }
    }

    /// The slab `|height| ≤ reach` around a point at `height` that moves by `speed`.
    #[inline]
    fn put(&mut self, place: usize, reach: f64, height: f64, speed: f64) {
        let reach = reach + self.rounding;
        // A speed of zero gives infinities of the right signs, or NaN on the
        // very surface, which every comparison passes over.
        let per_speed = 1.0 / speed;
        let (low, high) = ((-reach - height) * per_speed, (reach - height) * per_speed);
        let forward = per_speed > 0.0;
        self.enter[place] = if forward { low } else { high };
        self.leave[place] = if forward { high } else { low };
    }

    fn clear(&mut self, place: usize) {
        self.enter[place] = f64::NEG_INFINITY;
        self.leave[place] = f64::INFINITY;
    }

    #[inline]
    fn ends(&self) -> (f64, f64) {
        let later = |late: f64, &time: &f64| if time > late { time } else { late };
        let sooner = |soon: f64, &time: &f64| if time < soon { time } else { soon };
        (
            self.enter.iter().fold(f64::NEG_INFINITY, later),
            self.leave.iter().fold(f64::INFINITY, sooner),
        )
    }

    #[inline]
    fn miss(&self) -> bool {
        let (enter, leave) = self.ends();
        enter > leave
    }

    /// The slab entered last, and when; none if another is left before.
    #[inline]
    fn last(&self) -> Option<(usize, f64)> {
        let (enter, leave) = self.ends();
        if enter > leave {
            return None;
        }
        #[expect(clippy::float_cmp, reason = "it is one of them")]
        let place = self.enter.iter().position(|&time| time == enter)?;
        Some((place, enter))
    }
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
        let DMat3 {
            x_axis,
            y_axis,
            z_axis,
        } = self.turn;
        let sizes = [x_axis, y_axis, z_axis].map(|axis| axis.abs().to_array());
        let (centre, motion) = (self.centre.to_array(), self.motion.to_array());
        let mut spans = Spans::new(self.pair.rounding);
        for i in 0..3 {
            let reach = half_b[i]
                + (sizes[0][i] * half_a[0] + sizes[1][i] * half_a[1] + sizes[2][i] * half_a[2]);
            spans.put(i, reach, centre[i], motion[i]);
        }
        for j in 0..3 {
            let dot = |[x, y, z]: &[f64; 3]| axes[j][0] * x + axes[j][1] * y + axes[j][2] * z;
            let reach = half_a[j]
                + (sizes[j][0] * half_b[0] + sizes[j][1] * half_b[1] + sizes[j][2] * half_b[2]);
            spans.put(3 + j, reach, dot(&centre), dot(&motion));
        }
        if spans.miss() {
            return None;
        }
        let mut nearly_parallel = false;
        for j in 0..3 {
            let (axis, size) = (&axes[j], &sizes[j]);
            let (p, q) = (&sizes[(j + 1) % 3], &sizes[(j + 2) % 3]);
            let (half_p, half_q) = (half_a[(j + 1) % 3], half_a[(j + 2) % 3]);
            for i in 0..3 {
                let (u, v) = ((i + 1) % 3, (i + 2) % 3);
                // B's i-th axis times A's j-th: −axis[v] along u, axis[u] along v.
                nearly_parallel |= axis[u] * axis[u] + axis[v] * axis[v] < CAREFUL;
                let reach =
                    half_b[u] * size[v] + half_b[v] * size[u] + half_p * q[i] + half_q * p[i];
                let height = axis[u] * centre[v] - axis[v] * centre[u];
                let speed = axis[u] * motion[v] - axis[v] * motion[u];
                spans.put(6 + 3 * j + i, reach, height, speed);
            }
        }
        if nearly_parallel {
            self.mend(&mut spans);
        }
        spans.last().map(|(by, enter)| (Axis::of(by), enter))
    }

    /// Measures the axes of nearly parallel edges once more, along unit vectors.
    #[cold]
    fn mend(&self, spans: &mut Spans) {
        for j in 0..3 {
            for i in 0..3 {
                let axis = &self.axes[j];
                let (u, v) = ((i + 1) % 3, (i + 2) % 3);
                let squared = axis[u] * axis[u] + axis[v] * axis[v];
                if squared >= CAREFUL {
                    continue;
                }
                let by = 6 + 3 * j + i;
                spans.clear(by);
                if squared <= PARALLEL {
                    continue;
                }
                if let Some(normal) = edge_normal(self.turn.col(j), DVec3::AXES[i]) {
                    let reach = (self.turn.transpose() * normal)
                        .abs()
                        .dot(DVec3::from_array(self.half_a))
                        + normal.abs().dot(DVec3::from_array(self.half_b));
                    let (height, speed) = (normal.dot(self.centre), normal.dot(self.motion));
                    spans.put(by, reach, height, speed);
                }
            }
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
