//! How two bodies stand that have just met.

use super::flight::Flight;
use super::window::{Side, Window};
use super::{Touching, touch as cast};
use crate::geometry::{Feature, Pose, Shape};
use crate::narrow_phase::distance::closest_points;
use crate::narrow_phase::overlap::overlap;
use glam::DVec3;

/// Two bodies in touch.
pub(super) struct Meeting {
    pub(super) touching: Touching,
    /// How fast they approach at the point of touch, across its plane, metres per frame.
    pub(super) closing: f64,
    /// How fast they move there, metres per frame.
    pub(super) speed: f64,
}

/// Share of the pair's size that a touch may be away along the motion.
const NEAR: f64 = 1e-6;

/// Share of the pair's size that bodies may slide on while they close a gap that counts as touching: far from
/// the origin, where that is wide, and at a small angle it may take them long.
const ALONG: f64 = 1e-3;

/// Looks from where bodies stand by then: each leaves some thousandth of what the one before did.
const LOOKS: u32 = 4;

/// Share of the pair's size that the point of touch may be off because bodies turn or slide in the last bit of the way.
const BESIDE: f64 = 1e-11;

/// The touch of two bodies that are nearer than `touch` metres at `time`; `normal` is that of the
/// last plane between them, if there was one.
///
/// Where the features are known to touch, the last bit of the way is straight: one exact cast with
/// the velocity of the point of touch gives time, point, normal and features.
pub(super) fn meet(
    (a, b): (&Flight<'_>, &Flight<'_>),
    window: &Window<'_, '_>,
    normal: Option<DVec3>,
    time: f64,
    touch: f64,
) -> Option<Meeting> {
    let (pose_a, pose_b) = (window.a.instant.pose, window.b.instant.pose);
    let (shape_a, shape_b) = (a.shape, b.shape);
    let reach = a.reach + b.reach;
    let (mut touching, gap) = nearest(shape_a, &pose_a, shape_b, &pose_b)
        .or_else(|| {
            let straight = |motion: DVec3| {
                let found = cast(shape_a, &pose_a, shape_b, &pose_b, motion)?;
                let near = found.fraction.abs() * motion.length() <= NEAR * reach;
                near.then_some((found, 0.0))
            };
            let guess = normal.unwrap_or(window.offset.normalize_or(DVec3::X));
            straight(velocity_at((a, b), window, DVec3::ZERO, time))
                .or_else(|| straight(-reach * guess))
        })
        .unwrap_or((
            Touching {
                fraction: 0.0,
                point: 0.5 * (pose_a.position - pose_b.position),
                normal: normal.unwrap_or(window.offset.normalize_or(DVec3::X)),
                features: [Feature::Surface; 2],
            },
            0.0,
        ));
    let velocity = velocity_at((a, b), window, touching.point, time);
    let speed = velocity.length();
    let is_near = |by: f64, normal: DVec3| {
        let (way, gap) = (by.abs() * speed, by.abs() * normal.dot(velocity).abs());
        way <= NEAR * reach || gap <= 4.0 * touch && way <= ALONG * reach
    };
    let mut later = gap / -touching.normal.dot(velocity);
    if let Some(found) = cast(shape_a, &pose_a, shape_b, &pose_b, velocity) {
        let steep = -found.normal.dot(velocity) > NEAR * speed;
        let alike = found.normal.dot(touching.normal) > 0.99;
        if is_near(found.fraction, found.normal) && steep && alike {
            later = found.fraction;
            touching = found;
        }
    }
    let closing = -touching.normal.dot(velocity);
    let late = later > 0.0 && is_near(later, touching.normal);
    if !late {
        later = 0.0;
    }
    // Who turns or slides on meanwhile touches a little beside: once more from where they stand by
    // then. Far from the origin, where `touch` is wide, this matters.
    let turning = |side: &Side<'_, '_>| side.arm * side.spin.length();
    let going = speed + turning(&window.a) + turning(&window.b) + window.turning;
    let mut off = later;
    for _ in 0..LOOKS {
        if off.abs() * going <= BESIDE * reach {
            break;
        }
        let [by_a, by_b] = [a, b].map(|flight| flight.pose_at((time + later).min(1.0)));
        let Some(found) = cast(shape_a, &by_a, shape_b, &by_b, velocity) else {
            break;
        };
        let near = found.fraction.abs() * speed <= NEAR * reach;
        if !(near && found.normal.dot(touching.normal) > 0.99) {
            break;
        }
        off = found.fraction;
        later = (later + off).max(0.0);
        touching = found;
    }
    touching.fraction = (time + later).min(1.0);
    Some(Meeting {
        touching,
        closing,
        speed,
    })
}

/// The touch of two bodies that are next to each other along `normal` at `time`, if they run into
/// each other there; none where it takes [`meet`] to tell.
///
/// One exact cast across the gap gives point, normal and features.
pub(super) fn strike(
    (a, b): (&Flight<'_>, &Flight<'_>),
    window: &Window<'_, '_>,
    normal: DVec3,
    time: f64,
) -> Option<Touching> {
    if time <= 0.0 {
        return None;
    }
    let [pose_a, pose_b] = [a, b].map(|flight| flight.pose_at(time));
    let between = Pose::new(pose_a.position - pose_b.position, pose_a.orientation);
    let origin = Pose::new(DVec3::ZERO, pose_b.orientation);
    let reach = a.reach + b.reach;
    let mut touching = cast(a.shape, &between, b.shape, &origin, -reach * normal)?;
    let alike = touching.normal.dot(normal);
    let near = touching.fraction.abs() <= NEAR;
    let velocity = velocity_at((a, b), window, touching.point, time);
    let (closing, speed) = (-touching.normal.dot(velocity), velocity.length());
    if !(near && alike > 0.99 && closing > NEAR * speed) {
        return None;
    }
    let later = (touching.fraction * reach * alike / closing).max(0.0);
    // Who turns or slides on by much meanwhile touches beside.
    let turning = |side: &Side<'_, '_>| side.arm * side.spin.length();
    let going = speed + turning(&window.a) + turning(&window.b) + window.turning;
    touching.fraction = (time + later).min(1.0);
    (later * going <= BESIDE * reach).then_some(touching)
}

/// The nearest points, or the deepest ones of bodies that overlap.
fn nearest(a: &Shape, pose_a: &Pose, b: &Shape, pose_b: &Pose) -> Option<(Touching, f64)> {
    if let Some(closest) = closest_points(a, pose_a, b, pose_b) {
        let touching = Touching {
            fraction: 0.0,
            point: closest.point_b,
            normal: closest.normal,
            features: [closest.feature_a, closest.feature_b],
        };
        return Some((touching, closest.distance));
    }
    let overlap = overlap(a, pose_a, b, pose_b)?;
    let touching = Touching {
        fraction: 0.0,
        point: overlap.point - pose_b.position,
        normal: overlap.direction,
        features: [overlap.feature_a, overlap.feature_b],
    };
    Some((touching, 0.0))
}

/// How fast A moves relative to B at the point that lies at `point` from B's position.
///
/// That of a ball moves as its centre does: a ball is the same however it is turned, and what its surface
/// does leads off the touch.
fn velocity_at(
    (a, b): (&Flight<'_>, &Flight<'_>),
    window: &Window<'_, '_>,
    point: DVec3,
    time: f64,
) -> DVec3 {
    let is_ball = |flight: &Flight<'_>| matches!(flight.shape, Shape::Sphere(_));
    if window.stray + window.turning > 0.0 {
        let world = window.b.instant.pose.position + point;
        let of = |flight: &Flight<'_>, side: &Side<'_, '_>| {
            let ball = is_ball(flight).then_some(side.instant.pose.position);
            flight.point_velocity(ball.unwrap_or(world), time)
        };
        return of(a, &window.a) - of(b, &window.b);
    }
    let from_b = point - window.b.instant.hub_offset();
    let about = |flight: &Flight<'_>, side: &Side<'_, '_>, from_hub: DVec3| {
        let from_hub = if is_ball(flight) {
            -side.instant.hub_offset()
        } else {
            from_hub
        };
        side.spin.cross(from_hub)
    };
    window.velocity + about(a, &window.a, from_b - window.offset) - about(b, &window.b, from_b)
}
