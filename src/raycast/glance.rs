//! A ray's first look at a small polytope, all faces side by side in single precision.
//!
//! The planes are moved out by more than rounding amounts to, so a line that passes them by passes the
//! polytope by for certain. One that does not is met by the face it comes through last; the hit is computed
//! from that face's own numbers, and believed if it lies well within all other faces: whatever
//! led there, such a face is the one. The few rays that come near to an edge, that graze or that start at the
//! surface or inside are left to the [walk](super::walk).

use super::SurfacePoint;
use crate::geometry::{Facade, Feature, FourTimes, Polytope, Pose, Ray};
use glam::{DQuat, DVec3, Vec4};

/// How far the hit may lie from where it was found, as a share of the reach: a quarter of
/// the margin, the rest of which covers rounding and the moving out.
const OFF: f64 = 0.25 * Facade::MARGIN;

/// Farther away, in shares of the reach, a ray's origin brings too much rounding along.
const FAR: f64 = 1e6;

/// Squares of directions that keep all products within the range of `f32`.
const SQUARES: std::ops::RangeInclusive<f64> = 1e-12..=1e12;

/// Hits within so many reaches of the ray's origin are left to those who know inside from outside.
const NEAR: f64 = 1e-6;

/// What is seen at first sight.
pub(super) enum Glance {
    Hit(SurfacePoint),
    Miss,
    Unclear,
}

/// The ray's first hit with a polytope that stands at `pose`.
#[inline]
pub(super) fn glance(polytope: &Polytope, pose: &Pose, ray: &Ray) -> Glance {
    let facade = polytope.facade();
    let (origin, direction) = (ray.origin - pose.position, ray.direction);
    let size = facade.square_of_reach();
    let (distance, square) = (origin.length_squared(), direction.length_squared());
    let along = origin.dot(direction);
    let plain = distance <= FAR * FAR * size && SQUARES.contains(&square);
    // False for NaN too.
    if !plain {
        return Glance::Unclear;
    }
    // The sphere around the frame's origin needs no turning. From afar squares are rounded by more than
    // there is room around the vertices.
    if (distance * (1.0 - 32.0 * f64::EPSILON) - size) * square > along * along {
        return Glance::Miss;
    }
    let nearest = -along / square;
    let turned = [origin + nearest * direction, -direction];
    let [from, against] = turned_back(pose.orientation, turned);
    let (enter, leave) = span(facade, &from, &against);
    if enter > leave {
        return Glance::Miss;
    }
    let Some(face) = face_at(facade, &from, &against, enter) else {
        return Glance::Unclear;
    };
    let (normal, offset) = polytope.face_map().plane(face);
    let normal = pose.orientation * normal;
    let rate = normal.dot(direction);
    let fraction = (offset - normal.dot(origin)) / rate;
    let off = fraction - (nearest + f64::from(enter));
    let sure = rate < 0.0
        && fraction > 0.0
        && fraction * fraction * square > NEAR * NEAR * size
        && off * off * square < OFF * OFF * size;
    if !sure {
        return Glance::Unclear;
    }
    Glance::Hit(SurfacePoint {
        fraction,
        normal,
        feature: Feature::Face(face),
    })
}

/// Two vectors of the world in the body's frame.
#[inline(always)]
fn turned_back(orientation: DQuat, vectors: [DVec3; 2]) -> [FourTimes; 2] {
    let axis = -orientation.xyz().as_vec3a();
    let share = orientation.w as f32;
    vectors.map(|vector| {
        let vector = vector.as_vec3a();
        let across = 2.0 * axis.cross(vector);
        let turned = vector + share * across + axis.cross(across);
        [turned.x, turned.y, turned.z].map(Vec4::splat)
    })
}

/// The fractions between which the line that was `from` somewhere and comes `against` the way it goes lies behind all
/// planes; if the first is the larger, it passes them by.
#[inline(always)]
fn span(facade: &Facade, from: &FourTimes, against: &FourTimes) -> (f32, f32) {
    let (mut enter, mut leave) = (Vec4::NEG_INFINITY, Vec4::INFINITY);
    for plane in facade.planes() {
        // How fast the line nears the plane. Along the plane it is 0, and the fraction infinite on
        // the right side; NaN if the line lies in the plane that was moved out, which is a miss, found or not.
        let rate = Facade::heights(plane, against);
        let fraction = (Facade::heights(plane, from) - plane[3]) / rate;
        // The fraction is the one or the other, and in the other's place an infinity says nothing:
        // no mask is needed.
        let side = Vec4::INFINITY.copysign(rate);
        enter = side.min(fraction).max(enter);
        leave = side.max(fraction).min(leave);
    }
    (enter.max_element(), leave.min_element())
}

/// The only face that the line's point at a fraction lies near to, or beyond, if there is one.
#[inline(always)]
fn face_at(facade: &Facade, from: &FourTimes, against: &FourTimes, fraction: f32) -> Option<u32> {
    let ([p, q, r], [x, y, z]) = (*from, *against);
    let point = [p - fraction * x, q - fraction * y, r - fraction * z];
    let margin = Vec4::splat(facade.margin());
    let mut near = 0_u32;
    for plane in facade.planes().iter().rev() {
        let room = plane[3] - Facade::heights(plane, &point);
        near = near << 4 | room.cmplt(margin).bitmask();
    }
    (near.count_ones() == 1).then_some(near.trailing_zeros())
}
