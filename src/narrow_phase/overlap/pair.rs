//! Two hulls in one frame, and their Minkowski difference.

use super::expand::{self, Expansion};
use super::hull::Hull;
use super::{Width, enclose, faces, few};
use crate::geometry::{Pose, Shape};
use glam::DVec3;

/// Two hulls seen from B's centre, along the world's axes.
pub(super) struct Pair<'a> {
    pub(super) a: Hull<'a>,
    pub(super) b: Hull<'a>,
    /// From B's centre to A's, in metres.
    pub(super) offset: DVec3,
    /// The pair's origin in the world: B's centre.
    pub(super) origin: DVec3,
    /// The sum of the bounding radii, in metres.
    pub(super) size: f64,
    /// Overlaps up to this depth in metres count as touch.
    pub(super) touch: f64,
}

impl<'a> Pair<'a> {
    /// None if one of the shapes is a sphere.
    #[inline]
    pub(super) fn new(
        a: &'a Shape,
        pose_a: &Pose,
        b: &'a Shape,
        pose_b: &Pose,
        touch: f64,
    ) -> Option<Self> {
        let centre_b = pose_b.direction(b.centre());
        // The positions first: far from the origin their difference is exact.
        let offset =
            (pose_a.position - pose_b.position) + (pose_a.direction(a.centre()) - centre_b);
        let a = Hull::new(a, pose_a, offset)?;
        let b = Hull::new(b, pose_b, DVec3::ZERO)?;
        let size = a.radius + b.radius;
        Some(Self {
            a,
            b,
            offset,
            origin: pose_b.position + centre_b,
            size,
            touch,
        })
    }

    /// The point of the Minkowski difference farthest along `direction`.
    pub(super) fn support(&self, direction: DVec3) -> DVec3 {
        self.b.support(direction) - self.a.support(-direction)
    }

    /// How far A must move along `direction` to part the two; negative if they are apart.
    pub(super) fn width(&self, direction: DVec3) -> Width {
        Width {
            direction,
            width: self.support(direction).dot(direction),
        }
    }

    /// Widths that differ by less are the same but for rounding.
    pub(super) fn rounding(&self) -> f64 {
        8.0 * f64::EPSILON * (self.size + self.offset.length())
    }

    /// The least width over all directions; none if the pair is apart or in touch.
    pub(super) fn least(&self) -> Option<Width> {
        if few::are_few(self)
            && let Some(least) = few::least(self)
        {
            return (least.width > self.touch).then_some(least);
        }
        let least = match enclose::tetrahedron(self).map(|start| expand::least(self, start)) {
            Some(Expansion::Apart) => return None,
            Some(Expansion::Least(near)) => faces::sharpened(self, near),
            // The Minkowski difference is flat, or out of the budget.
            Some(Expansion::Undecided) | None => faces::least(self),
        }?;
        (least.width > self.touch).then_some(least)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Cuboid, Polytope, Triangle};
    use crate::narrow_phase::overlap::{boxes, separate};
    use glam::DQuat;

    /// Boxes and triangles at all sorts of poses, some of them parallel.
    fn bodies() -> Vec<(Shape, Pose)> {
        let cuboid = Cuboid::new([1.0, 0.4, 0.02]).unwrap();
        let triangle = Triangle::new([-1.0, -0.5, 0.1], [1.2, 0.0, 0.0], [0.0, 0.7, 0.3]).unwrap();
        let mut bodies = Vec::new();
        for step in 0..12 {
            let angle = 0.5 * f64::from(step / 2);
            let axis = DVec3::new(1.0, f64::from(step % 3) - 1.0, f64::from(step % 5) - 2.0);
            let turn = DQuat::from_axis_angle(axis.normalize(), angle);
            let at = 0.25 * f64::from(step % 4) * axis;
            bodies.push((Shape::from(cuboid), Pose::new(at, turn)));
            bodies.push((Shape::from(triangle), Pose::new(at, turn)));
        }
        bodies
    }

    #[test]
    fn growing_and_looking_at_every_face_agree() {
        let (mut hits, mut apart) = (0, 0);
        let bodies = bodies();
        for (a, pose_a) in &bodies {
            for (b, pose_b) in &bodies {
                let pair = Pair::new(a, pose_a, b, pose_b, 1e-12).unwrap();
                let slow = faces::least(&pair).unwrap();
                let slow = (slow.width > pair.touch).then_some(slow.width);
                let fast = pair.least().map(|least| least.width);
                match (slow, fast) {
                    (Some(slow), Some(fast)) => {
                        assert!((slow - fast).abs() < 1e-14, "{slow} {fast}");
                        assert!(!separate::apart(&pair));
                        hits += 1;
                    }
                    (None, None) => apart += 1,
                    _ => panic!("{slow:?} {fast:?}"),
                }
            }
        }
        assert!(hits > 100 && apart > 50, "{hits} {apart}");
    }

    #[test]
    fn the_fifteen_axes_and_the_hulls_agree() {
        for (a, pose_a) in &bodies() {
            for (b, pose_b) in &bodies() {
                let (Shape::Cuboid(box_a), Shape::Cuboid(box_b)) = (a, b) else {
                    continue;
                };
                let pair = Pair::new(a, pose_a, b, pose_b, 1e-12).unwrap();
                let axes = boxes::least(box_a, pose_a, box_b, pose_b, pair.offset, pair.touch);
                let hulls = pair.least();
                assert_eq!(axes.is_some(), hulls.is_some());
                if let (Some(axes), Some(hulls)) = (axes, hulls) {
                    assert!((axes.width - hulls.width).abs() < 1e-14);
                }
            }
        }
    }

    /// A hull of points on a spiral around a sphere, squeezed to an ellipsoid.
    fn hull(count: u32, squeeze: DVec3) -> Shape {
        let points = (0..count).map(|index| {
            let z = (f64::from(2 * index) + 1.0) / f64::from(count) - 1.0;
            let (y, x) = (2.399_963_229_728_653 * f64::from(index)).sin_cos();
            squeeze * ((1.0 - z * z).sqrt() * DVec3::new(x, y, 0.0) + z * DVec3::Z)
        });
        Polytope::from_points(points).unwrap().into()
    }

    #[test]
    fn small_hulls_and_every_face_agree() {
        let (mut hits, mut apart) = (0, 0);
        let flat = DVec3::new(1.0, 0.7, 0.05);
        for (step, count) in (0..600).zip([4, 6, 12, 16].into_iter().cycle()) {
            let step = f64::from(step);
            let squeeze = if step % 3.0 == 0.0 { flat } else { DVec3::ONE };
            let (a, b) = (hull(count, squeeze), hull(20 - count, DVec3::ONE));
            let axis = DVec3::new((0.7 * step).sin(), (1.1 * step).cos(), 0.3);
            let turn = DQuat::from_axis_angle(axis.normalize(), 0.37 * step);
            let pose = Pose::new(2.2 * (0.13 * step).sin() * axis, turn);
            let pair = Pair::new(&a, &pose, &b, &Pose::IDENTITY, 1e-12).unwrap();
            assert!(few::are_few(&pair));
            let slow = faces::least(&pair).map_or(0.0, |least| least.width.max(0.0));
            let fast = pair.least().map_or(0.0, |least| least.width);
            assert!((slow - fast).abs() < 1e-14, "{step}: {slow} {fast}");
            if fast > 0.0 {
                hits += 1;
            } else {
                apart += 1;
            }
        }
        assert!(hits > 100 && apart > 100, "{hits} {apart}");
    }

    #[test]
    fn growing_and_looking_at_every_face_agree_on_large_hulls() {
        let (a, b) = (hull(200, DVec3::ONE), hull(150, DVec3::new(1.0, 0.5, 0.9)));
        for step in 0..6 {
            let turn = DQuat::from_rotation_x(f64::from(step));
            // From one centre, where hundreds of faces are about as near.
            let pose = Pose::new(0.3 * f64::from(step) * DVec3::new(0.5, 0.6, -0.6), turn);
            for (b, pose_b) in [(&b, Pose::IDENTITY), (&a, Pose::IDENTITY), (&a, pose)] {
                let pair = Pair::new(&a, &pose, b, &pose_b, 1e-12).unwrap();
                let (slow, fast) = (faces::least(&pair).unwrap(), pair.least());
                let fast = fast.map_or(0.0, |least| least.width);
                assert!(
                    (slow.width.max(0.0) - fast).abs() < 1e-14,
                    "{} {fast}",
                    slow.width
                );
            }
        }
    }
}
