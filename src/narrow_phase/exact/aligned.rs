//! Two boxes turned alike that touch face to face.

use super::Touching;
use crate::geometry::{Cuboid, Feature};
use glam::{DMat3, DQuat, DVec3};

/// Share of the boxes' size by which faces must lie over each other: less, and an edge may be what touches.
const SHARED: f64 = 1e-6;

/// How two boxes come to touch that are turned alike, if it is with faces that share an area.
///
/// `between` leads from B's position to A's, `motion` is A's relative to B's; a moment before they
/// touch. The point is the middle of what the faces share, as that of any two faces.
pub(super) fn touch(
    [a, b]: [&Cuboid; 2],
    orientation: DQuat,
    between: DVec3,
    motion: DVec3,
) -> Option<Touching> {
    let rotation = DMat3::from_quat(orientation);
    let to_box = rotation.transpose();
    let (offset, motion) = (to_box * between, to_box * motion);
    let (a, b) = (a.half_extents(), b.half_extents());
    let gaps = offset.abs() - (a + b);
    let axis = gaps.max_position();
    let side = 1.0_f64.copysign(offset[axis]);
    let fraction = gaps[axis] / (-side * motion[axis]);
    let there = offset + fraction * motion;
    let (low, high) = ((-b).max(there - a), b.min(there + a));
    let mut point = 0.5 * (low + high);
    point[axis] = side * b[axis];
    let size = (a + b).max_element();
    let shared = (0..3).all(|other| other == axis || high[other] - low[other] > SHARED * size);
    let face = |side: f64| Feature::Face(2 * axis as u32 + u32::from(side > 0.0));
    // False for NaN, of boxes that do not move along that axis.
    (shared && fraction.is_finite()).then(|| Touching {
        fraction,
        point: rotation * point,
        normal: rotation.col(axis) * side,
        features: [face(-side), face(side)],
    })
}

#[cfg(test)]
mod tests {
    use super::touch;
    use crate::geometry::{Cuboid, Pose, Shape};
    use crate::narrow_phase::exact;
    use glam::{DQuat, DVec3};

    /// What any two boxes are told.
    #[test]
    fn faces_that_meet_are_told_as_by_a_cast() {
        let mut state = 7_u64;
        let mut next = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let (mut told, mut compared) = (0, 0);
        for _ in 0..2000 {
            let mut vector = || DVec3::new(next(), next(), next());
            let (a, b) = (vector() + 0.1, vector() + 0.1);
            let (Ok(a), Ok(b)) = (Cuboid::new(a), Cuboid::new(b)) else {
                panic!("the boxes have sizes");
            };
            let axis = (vector() - 0.5).normalize_or(DVec3::X);
            let orientation = DQuat::from_axis_angle(axis, 6.0 * vector().x);
            let way = vector() - 0.5;
            let reach = (a.half_extents() + b.half_extents()) * 1.5;
            let between =
                orientation * ((vector() - 0.5).signum() * reach * (0.7 + 0.3 * vector()));
            let motion = way - between;
            let Some(found) = touch([&a, &b], orientation, between, motion) else {
                continue;
            };
            told += 1;
            let poses = [
                Pose::new(between, orientation),
                Pose::new(DVec3::ZERO, orientation),
            ];
            let shapes = [Shape::from(a), Shape::from(b)];
            let Some(cast) = exact::touch(&shapes[0], &poses[0], &shapes[1], &poses[1], motion)
            else {
                continue;
            };
            // A cast may meet another face first, where this one looks a moment before.
            if cast.fraction < 0.0 || cast.normal.dot(found.normal) < 0.9 {
                continue;
            }
            compared += 1;
            assert!((cast.fraction - found.fraction).abs() < 1e-12);
            assert!(
                cast.point.distance(found.point) < 1e-12,
                "{cast:?} {found:?}"
            );
            assert!(cast.normal.distance(found.normal) < 1e-12);
            assert_eq!(cast.features, found.features);
        }
        assert!(told > 500 && compared > 200, "{told} {compared}");
    }
}
