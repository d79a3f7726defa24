//! How a body that spins is turned at any time of its frame.

use super::flight::{Flight, Instant};
use crate::motion::Turning;
use glam::{DMat3, DVec3};

/// What a spin does to a body's axes, worked out for all times of a frame.
///
/// Each axis keeps what it has along the spin's axis, and the rest of it goes round (Rodrigues): two multiples of
/// what is known are added, where quaternions are multiplied, brought to unit length and made a matrix of elsewhere.
pub(super) struct Turner {
    /// Parts of the axes as the frame begins: along the spin's axis, across it, and a right angle on from there.
    along: DMat3,
    across: DMat3,
    ahead: DMat3,
    /// Radians per second.
    rate: f64,
    /// Of a spin about another point than the body's position: from the carried point to that one, and where it is in the body.
    beside: Option<[DVec3; 2]>,
}

impl Turner {
    /// None of a body that does not spin.
    pub(super) fn of(flight: &Flight<'_>) -> Option<Self> {
        let Turning::Spin(spin) = flight.motion.turning() else {
            return None;
        };
        let start = flight.pose_at(0.0).orientation;
        let (axis, rotation) = (spin.axis(), DMat3::from_quat(start));
        let [x, y, z] = [rotation.x_axis, rotation.y_axis, rotation.z_axis];
        let kept = |side: DVec3| axis.dot(side) * axis;
        let along = DMat3::from_cols(kept(x), kept(y), kept(z));
        let point = spin.point();
        Some(Self {
            along,
            across: rotation - along,
            ahead: DMat3::from_cols(axis.cross(x), axis.cross(y), axis.cross(z)),
            rate: spin.rate(),
            beside: (point != DVec3::ZERO).then(|| [flight.orientation * point, point]),
        })
    }

    /// Where the body is at a fraction of the frame, when its motion has carried it to `carried`; the orientation is
    /// not told but by the rotation.
    #[inline]
    pub(super) fn at<'a>(&self, flight: &Flight<'a>, fraction: f64, carried: DVec3) -> Instant<'a> {
        // Of half the angle: it is small more often, and then quickly told.
        let half = 0.5 * (self.rate * (fraction * flight.frame.seconds()));
        let (sine, cosine) = libm::sincos(half);
        let rotation = self.along
            + self.across * (1.0 - 2.0 * sine * sine)
            + self.ahead * (2.0 * sine * cosine);
        let position = match self.beside {
            Some([place, point]) => carried + (place - rotation * point),
            None => carried,
        };
        flight.turned(rotation, position)
    }
}

#[cfg(test)]
mod tests {
    use super::Turner;
    use crate::geometry::{Cuboid, Shape};
    use crate::motion::{FrameMotion, Motion};
    use crate::narrow_phase::exact::flight::Flight;
    use glam::{DMat3, DQuat, DVec3};

    #[test]
    fn bodies_are_where_their_flight_says() {
        for case in 0..300 {
            let at = |step: f64| DVec3::new(step.sin(), (1.3 * step).cos(), (0.7 * step).sin());
            let step = f64::from(case);
            let point = if case % 3 == 0 {
                DVec3::ZERO
            } else {
                at(5.0 * step)
            };
            let motion = Motion::free(9.0 * at(step), at(2.0 * step))
                .and_then(|motion| motion.spin_about(point, at(3.0 * step), 0.3 * step));
            let (Ok(cuboid), Ok(motion)) = (Cuboid::new([1.0, 0.5, 0.2]), motion) else {
                panic!("{case}: both are fine");
            };
            let shape = Shape::from(cuboid);
            let frame = FrameMotion::new(&motion, 0.25 * step, 1.5);
            let orientation = DQuat::from_axis_angle(at(4.0 * step).normalize(), step);
            let flight = Flight::new(&shape, &motion, &frame, orientation);
            let Some(turner) = Turner::of(&flight) else {
                panic!("{case}: it spins");
            };
            for share in [0.0, 0.1, 0.37, 0.999, 1.0] {
                let pose = flight.pose_at(share);
                let found = turner.at(&flight, share, flight.carried_at(share));
                let rotation = DMat3::from_quat(pose.orientation);
                // Angles of some hundred radians are rounded.
                assert!(
                    found.rotation.abs_diff_eq(rotation, 1e-13),
                    "{case} {share}"
                );
                assert!(
                    found.pose.position.distance(pose.position) < 1e-13,
                    "{case} {share}"
                );
            }
        }
    }
}
