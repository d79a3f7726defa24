//! Polytopes that surely do not meet while they move straight.

use super::unit;
use crate::geometry::Polytope;
use crate::geometry::sketch::Sketch;
use glam::{DMat3, DQuat, DVec3};

/// Polytopes with more vertices are left to searches that need not look at all of them.
const FEW: usize = 32;

/// Whether two small polytopes are apart by more than `slack` along the line between their centres, when
/// A has come half of its way, and are so all the way that A moves by `motion` relative to B.
///
/// `offset` leads from B's centre to A's. As wide as the pair is along one direction in the
/// beginning, less how far A moves against it, it is in the end, and in between evenly from one to the
/// other. False means nothing.
///
/// Roughly: what is read of a small polytope is its sketch. For pairs near each other, a third of which
/// are told apart like this: a twentieth of what it takes to look for an overlap and a touch. More
/// directions, as [`separate`](super::separate) finds them, cost more than they spare.
pub(crate) fn keep_apart(
    (a, turn_a): (&Polytope, DQuat),
    (b, turn_b): (&Polytope, DQuat),
    offset: DVec3,
    motion: DVec3,
    slack: f64,
) -> bool {
    if a.vertices().len().max(b.vertices().len()) > FEW {
        return false;
    }
    let Some(direction) = unit(offset + 0.5 * motion) else {
        return false;
    };
    let reach_a = reach(a, DMat3::from_quat(turn_a).transpose() * -direction);
    let reach_b = reach(b, DMat3::from_quat(turn_b).transpose() * direction);
    let width = (reach_a + reach_b) - offset.dot(direction);
    // What rounding does to all of this.
    let size = a.max_dist() + b.max_dist();
    let way = offset.length() + motion.length();
    let rounding = f64::from(Sketch::ERROR) * size + 64.0 * f64::EPSILON * (size + way);
    let least = -slack - rounding;
    width < least && width - motion.dot(direction) < least
}

/// How far a polytope reaches along `direction` from its centre, to within what a sketch is off by.
#[inline]
fn reach(hull: &Polytope, direction: DVec3) -> f64 {
    if let Some(sketch) = hull.sketch() {
        return f64::from(sketch.reach(direction));
    }
    let centre = hull.centre();
    let height = |&vertex: &DVec3| (vertex - centre).dot(direction);
    hull.vertices()
        .iter()
        .map(height)
        .fold(f64::NEG_INFINITY, |a, b| if b > a { b } else { a })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Pose, Shape};
    use crate::narrow_phase::overlap::overlap;

    #[test]
    fn what_keeps_apart_never_overlaps_on_the_way() {
        let hull = |count: u32| {
            let points = (0..count).map(|index| {
                let z = f64::from(2 * index + 1) / f64::from(count) - 1.0;
                let (y, x) = (2.4 * f64::from(index)).sin_cos();
                (1.0 - z * z).sqrt() * DVec3::new(x, y, 0.0) + z * DVec3::Z
            });
            Polytope::from_points(points).unwrap()
        };
        let (a, b) = (hull(12), hull(7));
        let shapes = [Shape::from(a.clone()), Shape::from(b.clone())];
        let (mut kept, mut met) = (0, 0);
        for step in 0..4000 {
            let step = f64::from(step);
            let place = DVec3::new((0.7 * step).sin(), (1.1 * step).cos(), (1.7 * step).sin());
            let turn = DQuat::from_axis_angle(place.normalize(), 0.3 * step);
            let far = if step % 2.0 == 0.0 { 0.0 } else { 1e6 };
            let base = far * DVec3::new(1.0, -0.3, 0.7);
            let (pose_a, pose_b) = (Pose::new(base + 1.8 * place, turn), Pose::at(base));
            let motion = 0.5 * DVec3::new((0.3 * step).cos(), (0.9 * step).sin(), 0.2);
            let offset = (pose_a.position - pose_b.position)
                + (pose_a.direction(a.centre()) - pose_b.direction(b.centre()));
            let (of_a, of_b) = ((&a, turn), (&b, DQuat::IDENTITY));
            let slack = 1e-11 * (1.0 + far);
            let keeps = keep_apart(of_a, of_b, offset, motion, slack);
            assert_eq!(keeps, keep_apart(of_b, of_a, -offset, -motion, slack));
            let on_the_way = |share: u32| {
                let at = pose_a.position + f64::from(share) / 16.0 * motion;
                overlap(&shapes[0], &Pose::new(at, turn), &shapes[1], &pose_b).is_some()
            };
            let meets = (0..=16).any(on_the_way);
            assert!(!(keeps && meets), "{step}");
            kept += u32::from(keeps);
            met += u32::from(meets);
        }
        assert!(kept > 500 && met > 500, "{kept} {met}");
    }
}
