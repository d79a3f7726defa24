//! Rays against polytopes.

use super::clip::{self, Plane};
use super::glance::{Glance, glance};
use super::line::Line;
use super::{GRAZE, RayCast, RayHit, RaySpan, SurfacePoint, turned_hit, walk};
use crate::geometry::{Feature, Polytope, Pose, Ray};
use glam::DVec3;

/// From neighbour to neighbour towards the face the line enters by: two or three
/// faces as a rule, O(√faces) of them where the polytope is nowhere near
/// its bounding box. At edges and corners, where the lowest face is sought,
/// O(faces). The first hit of a polytope in a pose is told from a look at all faces at once if there are no
/// more than 32, as hulls of 18 points have, and single precision leaves no doubt.
impl RayCast for Polytope {
    fn line_span(&self, ray: &Ray) -> Option<RaySpan> {
        let line = Line::of(ray)?;
        let growth = growth(self, &line);
        if walk::passes_by(self, &line, growth) {
            return None;
        }
        let enter = walk::enter(self, &line, growth)?;
        let leave = walk::leave(self, &line, growth);
        let Some(leave) = leave.filter(|leave| {
            let tied = leave.tied || enter.tied;
            !tied && enter.fraction <= leave.fraction
        }) else {
            return clip::span(&line, planes(self), growth, Feature::Face);
        };
        let point = |face: u32| {
            let plane = plane(self, face);
            let fraction = clip::refined(&line, plane, enter.fraction, leave.fraction);
            surface_point(&line, fraction, face, plane)
        };
        RaySpan::ordered(point(enter.face), point(leave.face))
    }

    #[inline]
    fn first_hit(&self, ray: &Ray) -> Option<RayHit> {
        let Some(line) = Line::of(ray) else {
            let is_point = ray.direction == DVec3::ZERO;
            return (is_point && self.contains_point(ray.origin)).then_some(RayHit::Inside);
        };
        let size = size(self);
        let growth = GRAZE * (line.distance() + size);
        if walk::passes_by(self, &line, growth) || walk::is_behind(self, &line, growth) {
            return None;
        }
        let enter = walk::enter(self, &line, growth)?;
        let plane = plane(self, enter.face);
        let fraction = clip::refined(&line, plane, enter.fraction, f64::INFINITY);
        // The plain case: one face, met from outside, at no grazing angle.
        let speed = line.direction.abs().max_element();
        let plain = !enter.tied
            && speed * enter.fraction > 16.0 * growth
            && speed * (fraction - enter.fraction) < 1e-9 * size
            && (speed * (fraction - enter.fraction) < 4.0 * growth
                || is_within(
                    self,
                    enter.face,
                    line.origin + fraction * line.direction,
                    growth,
                ));
        if plain {
            let point = surface_point(&line, fraction, enter.face, plane);
            return point.fraction.is_finite().then_some(RayHit::Surface(point));
        }
        self.line_span(ray)?
            .first_hit(ray, || self.contains_point(ray.origin))
    }

    fn first_hit_at(&self, pose: &Pose, ray: &Ray) -> Option<RayHit> {
        match glance(self, pose, ray) {
            Glance::Hit(point) => Some(RayHit::Surface(point)),
            Glance::Miss => None,
            Glance::Unclear => walked(self, pose, ray),
        }
    }

    fn contains_point(&self, point: DVec3) -> bool {
        let by_planes = || planes(self).all(|plane| plane.normal.dot(point) <= plane.offset);
        point.is_finite() && self.face_map().holds(point).unwrap_or_else(by_planes)
    }
}

/// By the walk. Apart, for it needs room that a glance does not.
#[inline(never)]
fn walked(polytope: &Polytope, pose: &Pose, ray: &Ray) -> Option<RayHit> {
    turned_hit(polytope, pose, ray)
}

/// Whether `point` of a face's plane lies behind all its neighbours, as that of a line does not
/// which passes an edge by within rounding and comes down on the plane beyond.
fn is_within(polytope: &Polytope, face: u32, point: DVec3, growth: f64) -> bool {
    let sides = polytope.face_map().sides(face).iter();
    sides
        .map(|side| plane(polytope, side.face))
        .all(|plane| plane.normal.dot(point) - plane.offset <= growth)
}

fn planes(polytope: &Polytope) -> impl Iterator<Item = Plane> + Clone {
    (polytope.face_normals().iter())
        .zip(polytope.face_offsets())
        .map(|(&normal, &offset)| Plane { normal, offset })
}

#[inline]
fn plane(polytope: &Polytope, face: u32) -> Plane {
    let (normal, offset) = polytope.face_map().plane(face);
    Plane { normal, offset }
}

#[inline]
fn surface_point(line: &Line, fraction: f64, face: u32, plane: Plane) -> SurfacePoint {
    SurfacePoint {
        fraction: line.ray_fraction(fraction),
        normal: plane.normal,
        feature: Feature::Face(face),
    }
}

/// A bound on the coordinates of the surface.
#[inline]
fn size(polytope: &Polytope) -> f64 {
    polytope.centre().abs().max_element() + polytope.max_dist()
}

#[inline]
fn growth(polytope: &Polytope, line: &Line) -> f64 {
    GRAZE * (line.distance() + size(polytope))
}
