//! Planes between two shapes that do not turn.

use super::Touching;
use super::bridge::Bridge;
use crate::geometry::{Cuboid, Feature, Pose, Shape};
use crate::narrow_phase::distance::Separator;
use glam::{DMat3, DQuat, DVec3};

/// A plane that parts two shapes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Parted {
    /// Unit vector out of B, towards A.
    pub(super) normal: DVec3,
    /// How far they are apart along it, in metres: a lower bound of their distance. Negative if
    /// they overlap along it.
    pub(super) gap: f64,
    /// They touch if this is not above the least distance that counts.
    pub(super) distance: f64,
}

/// A pair of shapes, and planes between them wherever they stand.
pub(super) trait Parting {
    /// The plane between them where `between` leads from B's position to A's; none if they overlap
    /// and nothing tells which way out.
    fn part(&mut self, between: DVec3) -> Option<Parted>;

    /// The touch of two bodies that are parted by as little as counts for nothing, of which no cast can tell.
    fn grazed(&self, _parted: &Parted) -> Option<Touching> {
        None
    }

    /// By what the way from B's position to A's bends the gap of a plane besides its own bend, if it goes on at a
    /// velocity.
    fn rounding(&self, _parted: &Parted, _velocity: DVec3) -> f64 {
        0.0
    }

    /// A share of the time of a bridge until which they are apart by more than `floor` for certain, that are `parted`
    /// as it begins; none if they are so all the time.
    ///
    /// Plane after plane, each where the last one ends.
    fn clear_on(&mut self, bridge: &Bridge, parted: &Parted, floor: f64) -> Option<f64> {
        /// Two or three do as a rule.
        const PLANES: u32 = 8;
        /// A plane that does for no more than this share of the time is the last.
        const LITTLE: f64 = 1e-2;
        let (mut plane, mut at, mut from) = (*parted, bridge.points[0], 0.0);
        for _ in 0..PLANES {
            let next = bridge.above(&plane, at, from, floor)?;
            let little = next - from <= LITTLE;
            from = next;
            if little {
                break;
            }
            [at, ..] = bridge.at(from);
            match self.part(at) {
                Some(parted) if parted.gap > floor => plane = parted,
                _ => break,
            }
        }
        Some(from)
    }
}

/// Two balls.
pub(super) struct Balls {
    /// The sum of their radii.
    pub(super) radii: f64,
    /// The second one's.
    pub(super) radius: f64,
}

impl Parting for Balls {
    #[inline]
    fn part(&mut self, between: DVec3) -> Option<Parted> {
        let height = between.length();
        let gap = height - self.radii;
        (height > 0.0 && height < f64::INFINITY).then(|| Parted {
            normal: between / height,
            gap,
            distance: gap,
        })
    }

    fn grazed(&self, parted: &Parted) -> Option<Touching> {
        Some(Touching {
            fraction: 0.0,
            point: self.radius * parted.normal,
            normal: parted.normal,
            features: [Feature::Surface; 2],
        })
    }

    #[inline]
    fn rounding(&self, parted: &Parted, velocity: DVec3) -> f64 {
        let along = parted.normal.dot(velocity);
        (velocity.length_squared() - along * along) / (parted.gap + self.radii)
    }

    #[inline]
    fn clear_on(&mut self, bridge: &Bridge, _: &Parted, floor: f64) -> Option<f64> {
        bridge.beyond(self.radii + floor, 0.5 * floor)
    }
}

/// A ball and a box.
pub(super) struct BallAndBox {
    radius: f64,
    half: DVec3,
    rotation: DMat3,
    /// 1 if the ball is A, −1 if it is B.
    sense: f64,
}

impl BallAndBox {
    pub(super) fn new(radius: f64, cuboid: &Cuboid, orientation: DQuat, sense: f64) -> Self {
        Self {
            radius,
            half: cuboid.half_extents(),
            rotation: DMat3::from_quat(orientation),
            sense,
        }
    }
}

impl Parting for BallAndBox {
    #[inline]
    fn part(&mut self, between: DVec3) -> Option<Parted> {
        let local = self.rotation.transpose() * (self.sense * between);
        let beyond = (local.abs() - self.half).max(DVec3::ZERO);
        let height = beyond.length();
        let gap = height - self.radius;
        (height > 0.0 && height < f64::INFINITY).then(|| Parted {
            normal: self.rotation * (beyond.copysign(local) * (self.sense / height)),
            gap,
            distance: gap,
        })
    }
}

/// Two boxes that are turned alike: the widest of the gaps along three axes.
pub(super) struct AlignedBoxes {
    /// The sum of their half-extents.
    size: DVec3,
    rotation: DMat3,
}

impl AlignedBoxes {
    pub(super) fn new(a: &Cuboid, b: &Cuboid, orientation: DQuat) -> Self {
        Self {
            size: a.half_extents() + b.half_extents(),
            rotation: DMat3::from_quat(orientation),
        }
    }
}

impl Parting for AlignedBoxes {
    #[inline]
    fn part(&mut self, between: DVec3) -> Option<Parted> {
        let local = self.rotation.transpose() * between;
        let gaps = local.abs() - self.size;
        let (mut gap, mut height, mut axis) = (gaps.x, local.x, self.rotation.x_axis);
        if gaps.y > gap {
            (gap, height, axis) = (gaps.y, local.y, self.rotation.y_axis);
        }
        if gaps.z > gap {
            (gap, height, axis) = (gaps.z, local.z, self.rotation.z_axis);
        }
        gap.is_finite().then(|| Parted {
            normal: if height < 0.0 { -axis } else { axis },
            gap,
            distance: gap,
        })
    }
}

/// Two boxes: the widest of the gaps along fifteen axes. Where two boxes are apart one of them is.
pub(super) struct Boxes {
    x: [f64; LANES],
    y: [f64; LANES],
    z: [f64; LANES],
    reach: [f64; LANES],
}

/// Fifteen axes, and one that repeats another.
const LANES: usize = 16;

/// Squared sine between two edges below which what is across both is left out.
///
/// The faces across either edge are turned by so little from each other that they do instead, but for what
/// rounding is of the boxes' size: corners beyond each other by less than this sine count as touching.
const PARALLEL: f64 = 1e-20;

impl Boxes {
    pub(super) fn new(a: (&Cuboid, DQuat), b: (&Cuboid, DQuat)) -> Self {
        let rotations = [a.1, b.1].map(DMat3::from_quat);
        let edges = [
            rotations[0] * DMat3::from_diagonal(a.0.half_extents()),
            rotations[1] * DMat3::from_diagonal(b.0.half_extents()),
        ];
        let mut boxes = Self {
            x: [0.0; LANES],
            y: [0.0; LANES],
            z: [0.0; LANES],
            reach: [f64::INFINITY; LANES],
        };
        let [of_a, of_b] = rotations.map(|r| [r.x_axis, r.y_axis, r.z_axis]);
        for axis in 0..3 {
            boxes.put(axis, of_b[axis], &edges);
            boxes.put(3 + axis, of_a[axis], &edges);
            for (other, along) in of_b.iter().enumerate() {
                let cross = of_a[axis].cross(*along);
                let square = cross.length_squared();
                if square > PARALLEL {
                    boxes.put(6 + 3 * axis + other, cross / square.sqrt(), &edges);
                }
            }
        }
        boxes
    }

    #[inline]
    fn put(&mut self, lane: usize, axis: DVec3, edges: &[DMat3; 2]) {
        (self.x[lane], self.y[lane], self.z[lane]) = axis.into();
        let shares = |edges: &DMat3| {
            axis.dot(edges.x_axis).abs()
                + axis.dot(edges.y_axis).abs()
                + axis.dot(edges.z_axis).abs()
        };
        self.reach[lane] = shares(&edges[0]) + shares(&edges[1]);
    }
}

impl Parting for Boxes {
    #[inline]
    fn part(&mut self, between: DVec3) -> Option<Parted> {
        let mut heights = [0.0; LANES];
        let mut gaps = [0.0; LANES];
        for lane in 0..LANES {
            heights[lane] =
                self.x[lane] * between.x + self.y[lane] * between.y + self.z[lane] * between.z;
            gaps[lane] = heights[lane].abs() - self.reach[lane];
        }
        let mut best = 0;
        for lane in 1..LANES {
            if gaps[lane] > gaps[best] {
                best = lane;
            }
        }
        let axis = DVec3::new(self.x[best], self.y[best], self.z[best]);
        let gap = gaps[best];
        gap.is_finite().then(|| Parted {
            normal: if heights[best] < 0.0 { -axis } else { axis },
            gap,
            distance: gap,
        })
    }
}

/// Two spheres farther apart than this share of their radii are not looked into.
const FAR: f64 = 0.05;

/// Any two shapes.
pub(super) struct Hulls<'a> {
    separator: Separator<'a>,
    /// From B's position to A's, to what leads from B's middle to A's.
    shift: DVec3,
    /// Sum of the radii around both middles.
    reach: f64,
}

impl<'a> Hulls<'a> {
    pub(super) fn new((a, pose_a): (&'a Shape, &Pose), (b, pose_b): (&'a Shape, &Pose)) -> Self {
        let middle = |shape: &Shape, pose: &Pose| pose.direction(shape.centre());
        let size = |shape: &Shape| shape.max_dist() + shape.centre().length();
        Self {
            separator: Separator::new(a, pose_a.orientation, b, pose_b.orientation),
            shift: middle(a, pose_a) - middle(b, pose_b),
            // What turning rounds the middles by is some ulp of the sizes.
            reach: a.max_dist() + b.max_dist() + 16.0 * f64::EPSILON * (size(a) + size(b)),
        }
    }
}

impl Parting for Hulls<'_> {
    fn part(&mut self, between: DVec3) -> Option<Parted> {
        let offset = between + self.shift;
        let distance = offset.length();
        let room = distance - self.reach;
        if room > FAR * self.reach {
            return Some(Parted {
                normal: offset / distance,
                gap: room,
                distance: room,
            });
        }
        let found = self.separator.separation(between, 1e-6)?;
        Some(Parted {
            normal: found.normal,
            gap: found.gap,
            distance: found.distance,
        })
    }
}
