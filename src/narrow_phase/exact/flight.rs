//! A body in flight, and where it is at a moment.

use crate::geometry::{Pose, Shape};
use crate::motion::{FrameMotion, Motion, Path, Turning};
use glam::{DMat3, DQuat, DVec3};

/// A body that moves and turns in one frame.
///
/// Its *hub* is the point of the body about which it turns and that its motion carries: the point of
/// a spin's axis nearest to the shape's centre, the body's origin if it faces its way, or
/// the shape's centre.
#[derive(Clone, Copy)]
pub(crate) struct Flight<'a> {
    pub(super) shape: &'a Shape,
    pub(super) motion: &'a Motion,
    pub(super) frame: &'a FrameMotion,
    /// How the body was turned as its motion began.
    pub(super) orientation: DQuat,
    /// The hub in the body's own frame.
    pub(super) hub: DVec3,
    /// The same along the world's axes, as the motion begins.
    hub_shift: DVec3,
    /// No vertex of the core is farther from the hub, in metres; of a spin, from its axis.
    pub(super) arm: f64,
    /// The core lies between these heights above the hub along a spin's axis.
    extent: [f64; 2],
    /// How far the shape reaches beyond its core: a sphere's radius.
    pub(super) radius: f64,
    /// No point is farther from the hub, in metres.
    pub(super) reach: f64,
    /// The highest speed of the hub, in metres per frame.
    pub(super) speed: f64,
}

impl<'a> Flight<'a> {
    /// `orientation` is how the body was turned as its motion began.
    pub(crate) fn new(
        shape: &'a Shape,
        motion: &'a Motion,
        frame: &'a FrameMotion,
        orientation: DQuat,
    ) -> Self {
        let (centre, size) = (shape.centre(), shape.max_dist());
        let radius = match shape {
            Shape::Sphere(sphere) => sphere.radius(),
            _ => 0.0,
        };
        // Turning things rounds them by a few ulp of their size.
        let grown = |length: f64| length + 16.0 * f64::EPSILON * (length + centre.length());
        let mut flight = Self {
            shape,
            motion,
            frame,
            orientation,
            hub: centre,
            hub_shift: DVec3::ZERO,
            arm: size - radius,
            extent: [radius - size, size - radius],
            radius,
            reach: grown(size),
            speed: frame.highest_speed(motion),
        };
        match motion.turning() {
            Turning::Not => {}
            Turning::Facing(_) => {
                flight.hub = DVec3::ZERO;
                flight.reach = grown(size + centre.length());
                flight.arm = flight.reach - radius;
                flight.extent = [-flight.arm, flight.arm];
            }
            Turning::Spin(spin) => {
                let axis = orientation.conjugate() * spin.axis();
                flight.hub = spin.point() + (centre - spin.point()).dot(axis) * axis;
                let (mut arm, mut low, mut high) = (0.0_f64, 0.0_f64, 0.0_f64);
                if let Shape::Cuboid(cuboid) = shape
                    && flight.hub == DVec3::ZERO
                {
                    // Four corners and their opposites.
                    let half = cuboid.half_extents();
                    let along = half * axis;
                    let [x, y, z] = along.to_array();
                    let least = (x + y + z).abs().min((x + y - z).abs());
                    let least = least.min((x - y + z).abs()).min((y + z - x).abs());
                    let square = half.length_squared();
                    // What rounding takes off a bar about its long axis is put on.
                    arm = (square - least * least).max(0.0) + 16.0 * f64::EPSILON * square;
                    high = along.abs().element_sum();
                    low = -high;
                } else {
                    flight.each_vertex(|vertex| {
                        let offset = vertex - flight.hub;
                        let height = offset.dot(axis);
                        arm = arm.max((offset - height * axis).length_squared());
                        (low, high) = (low.min(height), high.max(height));
                    });
                }
                let rounding = grown(0.0) + 16.0 * f64::EPSILON * (size + flight.hub.length());
                flight.arm = arm.sqrt() + rounding;
                flight.extent = [low - rounding, high + rounding];
                let distance = (centre - flight.hub).length();
                flight.reach = grown(size + distance) + rounding;
            }
        }
        flight.hub_shift = orientation * flight.hub;
        flight
    }

    pub(super) fn each_vertex(&self, mut visit: impl FnMut(DVec3)) {
        match self.shape {
            Shape::Sphere(_) => visit(DVec3::ZERO),
            Shape::Cuboid(cuboid) => cuboid.vertices().into_iter().for_each(visit),
            Shape::Triangle(triangle) => triangle.vertices().into_iter().for_each(visit),
            Shape::Polytope(polytope) => polytope.vertices().iter().copied().for_each(visit),
        }
    }

    /// Which of two is looked at first, whoever asks: one of them comes before the other, unless they are the
    /// same in all that is compared.
    pub(crate) fn comes_before(&self, other: &Self) -> bool {
        let values = |flight: &Self| {
            let (start, way) = (flight.frame.start, flight.frame.displacement);
            [
                start.x,
                start.y,
                start.z,
                way.x,
                way.y,
                way.z,
                flight.reach,
                flight.arm,
            ]
        };
        values(self) < values(other)
    }

    /// Where the body is at a fraction of the frame, and how it is turned.
    pub(super) fn pose_at(&self, fraction: f64) -> Pose {
        self.frame.pose_at(self.motion, self.orientation, fraction)
    }

    /// Where its motion has carried it at a fraction of the frame.
    pub(super) fn carried_at(&self, fraction: f64) -> DVec3 {
        self.frame.position_at(self.motion, fraction)
    }

    /// From the carried point to the hub, which no spin moves: it lies beside the point along the
    /// axis.
    pub(super) fn hub_shift(&self) -> DVec3 {
        self.hub_shift
    }

    /// Whether it moves as its carried point does: it does not turn, or is a ball about that point.
    pub(super) fn glides(&self) -> bool {
        match (self.motion.turning(), self.shape) {
            (Turning::Not, _) | (Turning::Facing(_), Shape::Sphere(_)) => true,
            (Turning::Spin(spin), Shape::Sphere(_)) => spin.point() == DVec3::ZERO,
            _ => false,
        }
    }

    /// Where the body is at a fraction of the frame, when its motion has carried it to `carried`.
    #[inline]
    pub(super) fn at(&self, fraction: f64, carried: DVec3) -> Instant<'a> {
        let pose = self
            .frame
            .turned_at(self.motion, self.orientation, fraction, carried);
        Instant {
            shape: self.shape,
            hub: self.hub,
            rotation: DMat3::from_quat(pose.orientation),
            pose,
        }
    }

    /// The body where it is, turned by `rotation`; its pose knows no orientation.
    #[inline]
    pub(super) fn turned(&self, rotation: DMat3, position: DVec3) -> Instant<'a> {
        Instant {
            shape: self.shape,
            hub: self.hub,
            rotation,
            pose: Pose::at(position),
        }
    }

    /// How fast the body's point moves that is at `point` of the world at `fraction`, metres per
    /// frame, by a difference.
    pub(super) fn point_velocity(&self, point: DVec3, fraction: f64) -> DVec3 {
        /// Of the frame: half of the digits.
        const LEAST: f64 = 1e-7;
        const MOST: f64 = 1e-3;
        let pose = |fraction: f64| self.pose_at(fraction);
        let now = pose(fraction);
        // Far from the origin, and in short frames, a short way has few digits: half of those that the
        // frame's whole way has.
        let rounding = f64::EPSILON * now.position.abs().max_element();
        let share = (rounding / self.speed).sqrt();
        let share = if share > LEAST {
            share.min(MOST)
        } else {
            LEAST
        };
        let (other, share) = if fraction + share <= 1.0 {
            (pose(fraction + share), share)
        } else {
            (pose(fraction - share), -share)
        };
        let local = now.local_point(point);
        let moved =
            (other.position - now.position) + (other.direction(local) - now.direction(local));
        moved / share
    }

    /// Whether it turns in a way that moves its surface.
    pub(super) fn turns(&self) -> bool {
        self.motion.turns() && self.arm > 0.0
    }

    /// No point of it moves faster, in metres per frame; infinite if nothing is known of how it turns.
    pub(super) fn fastest(&self) -> f64 {
        let turning = match self.motion.turning() {
            Turning::Not => 0.0,
            Turning::Spin(spin) => self.frame.seconds() * spin.rate().abs() * self.arm,
            // To and fro on a line it keeps its heading.
            Turning::Facing(_)
                if !self.turns() || self.motion.path().is_some_and(Path::is_straight) =>
            {
                0.0
            }
            Turning::Facing(_) => f64::INFINITY,
        };
        self.speed + turning
    }

    /// The least `n · r` of all points `r` of the core from the hub, however a spin about
    /// `axis` has turned them; of a body that turns otherwise, however it is turned.
    pub(super) fn lowest_ever(&self, normal: DVec3) -> f64 {
        match self.motion.turning() {
            Turning::Spin(spin) => {
                let height = normal.dot(spin.axis());
                let aside = normal.cross(spin.axis()).length();
                let [low, high] = self.extent;
                (height * low).min(height * high) - aside * self.arm
            }
            Turning::Not | Turning::Facing(_) => -self.arm * normal.length(),
        }
    }
}

/// A body where it is at a moment of its flight.
#[derive(Clone, Copy)]
pub(super) struct Instant<'a> {
    shape: &'a Shape,
    hub: DVec3,
    pub(super) rotation: DMat3,
    pub(super) pose: Pose,
}

impl<'a> Instant<'a> {
    /// From the body's position to its hub, along the world's axes.
    pub(super) fn hub_offset(&self) -> DVec3 {
        self.rotation * self.hub
    }

    /// From the hub to a vertex of the core, along the world's axes.
    pub(super) fn vertex(&self, index: u32) -> DVec3 {
        self.rotation * (self.local(index) - self.hub)
    }

    fn local(&self, index: u32) -> DVec3 {
        match self.shape {
            Shape::Sphere(_) => DVec3::ZERO,
            Shape::Cuboid(cuboid) => {
                let side = |bit: u32| 2.0 * f64::from(index >> bit & 1) - 1.0;
                cuboid.half_extents() * DVec3::new(side(0), side(1), side(2))
            }
            Shape::Triangle(triangle) => triangle.vertices()[index as usize % 3],
            Shape::Polytope(polytope) => polytope.vertices()[index as usize],
        }
    }

    /// The core's least heights across a plane that turns.
    pub(super) fn heights(&self, normal: DVec3, turn: DVec3) -> Heights<'_, 'a> {
        let Shape::Cuboid(cuboid) = self.shape else {
            return Heights::Other(self, normal, turn);
        };
        let to_body = self.rotation.transpose();
        let (normal, turn) = (to_body * normal, to_body * turn);
        let half = cuboid.half_extents();
        Heights::Cuboid {
            normals: half * normal,
            turns: half * turn,
            middle: (-normal.dot(self.hub), -turn.dot(self.hub)),
        }
    }

    /// From the hub to the point of the core that lies least far along a direction.
    pub(super) fn lowest(&self, direction: DVec3) -> DVec3 {
        let local = self.rotation.transpose() * direction;
        let offset = match self.shape {
            Shape::Sphere(_) => -self.hub,
            Shape::Cuboid(cuboid) => {
                let half = cuboid.half_extents();
                // Not `signum`, which of zero depends on its sign.
                let side = |length: f64, along: f64| if along > 0.0 { -length } else { length };
                DVec3::new(
                    side(half.x, local.x),
                    side(half.y, local.y),
                    side(half.z, local.z),
                ) - self.hub
            }
            Shape::Triangle(triangle) => {
                let [a, b, c] = triangle.vertices().map(|vertex| vertex - self.hub);
                let heights = [a, b, c].map(|vertex| vertex.dot(local));
                if heights[0] <= heights[1] && heights[0] <= heights[2] {
                    a
                } else if heights[1] <= heights[2] {
                    b
                } else {
                    c
                }
            }
            Shape::Polytope(polytope) => {
                polytope.vertices()[polytope.support(-local) as usize] - self.hub
            }
        };
        self.rotation * offset
    }
}

/// What is asked again and again of a core beside a plane that turns.
pub(super) enum Heights<'i, 'a> {
    /// Of a box, along its own axes: the half-extents across the plane, how these change as it turns,
    /// and both of the middle.
    Cuboid {
        normals: DVec3,
        turns: DVec3,
        middle: (f64, f64),
    },
    Other(&'i Instant<'a>, DVec3, DVec3),
}

impl Heights<'_, '_> {
    /// Of the vertex that lies lowest across `normal + time · turn`: its heights along `normal` and
    /// along `turn`.
    #[inline]
    pub(super) fn lowest(&self, time: f64) -> (f64, f64) {
        match self {
            Self::Cuboid {
                normals,
                turns,
                middle,
            } => {
                let along = *normals + time * *turns;
                let (mut height, mut change) = *middle;
                for axis in 0..3 {
                    let side = if along[axis] > 0.0 { -1.0 } else { 1.0 };
                    height += side * normals[axis];
                    change += side * turns[axis];
                }
                (height, change)
            }
            Self::Other(instant, normal, turn) => {
                let vertex = instant.lowest(*normal + time * *turn);
                (normal.dot(vertex), turn.dot(vertex))
            }
        }
    }
}
