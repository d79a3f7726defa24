//! A line clipped by planes.

use super::line::Line;
use super::{RaySpan, SurfacePoint};
use crate::geometry::Feature;
use glam::DVec3;

/// The half-space `normal · x ≤ offset`.
#[derive(Clone, Copy)]
pub(super) struct Plane {
    pub(super) normal: DVec3,
    pub(super) offset: f64,
}

/// Where a line passes into or out of a plane's half-space.
#[derive(Clone, Copy)]
struct Crossing {
    fraction: f64,
    plane: usize,
}

/// The part of a line inside all half-spaces, each of them moved out by `growth`.
///
/// Growing by more than rounding can amount to is what keeps grazing lines: one
/// in a face's plane is then parallel and inside, and not, by an accident of
/// rounding, one that crosses the plane anywhere along its way. Cyrus & Beck
/// 1978; Haines, *Fast Ray–Convex Polyhedron Intersection* (Graphics Gems II).
fn clip(
    line: &Line,
    planes: impl Iterator<Item = Plane> + Clone,
    growth: f64,
) -> Option<(Crossing, Crossing)> {
    let mut enter = Crossing {
        fraction: f64::NEG_INFINITY,
        plane: 0,
    };
    let mut leave = Crossing {
        fraction: f64::INFINITY,
        plane: 0,
    };
    for (index, plane) in planes.enumerate() {
        let inwards = plane.normal.dot(line.direction);
        let room = plane.offset + growth - plane.normal.dot(line.origin);
        let fraction = room / inwards;
        if inwards < 0.0 {
            if fraction > enter.fraction {
                enter = Crossing {
                    fraction,
                    plane: index,
                };
            }
        } else if inwards > 0.0 {
            if fraction < leave.fraction {
                leave = Crossing {
                    fraction,
                    plane: index,
                };
            }
        } else if room < 0.0 {
            return None;
        }
    }
    (enter.fraction <= leave.fraction).then_some((enter, leave))
}

/// The span of `line` between `planes`, which number the features.
pub(super) fn span(
    line: &Line,
    planes: impl Iterator<Item = Plane> + Clone,
    growth: f64,
    feature: impl Fn(u32) -> Feature,
) -> Option<RaySpan> {
    let (enter, leave) = clip(line, planes.clone(), growth)?;
    let point = |crossing: Crossing, inwards: bool| {
        let (number, plane) = lowest(line, planes.clone(), crossing, inwards, growth)?;
        Some(SurfacePoint {
            fraction: line.ray_fraction(refined(line, plane, enter.fraction, leave.fraction)),
            normal: plane.normal,
            feature: feature(number as u32),
        })
    };
    RaySpan::ordered(point(enter, true)?, point(leave, false)?)
}

/// The lowest-numbered plane through the point of `crossing`, among those that
/// the line passes the same way.
fn lowest(
    line: &Line,
    planes: impl Iterator<Item = Plane>,
    crossing: Crossing,
    inwards: bool,
    growth: f64,
) -> Option<(usize, Plane)> {
    let point = line.origin + crossing.fraction * line.direction;
    planes.enumerate().find(|&(number, plane)| {
        let rate = plane.normal.dot(line.direction);
        let same_way = if inwards { rate < 0.0 } else { rate > 0.0 };
        // The point lies on the grown planes, one growth outside the true ones.
        number == crossing.plane || same_way && plane.normal.dot(point) - plane.offset >= -growth
    })
}

/// The fraction at which `line` crosses `plane` itself, not its grown copy, kept
/// within `low..=high`: for a line almost in the plane it may be any number.
pub(super) fn refined(line: &Line, plane: Plane, low: f64, high: f64) -> f64 {
    let room = plane.offset - plane.normal.dot(line.origin);
    let fraction = room / plane.normal.dot(line.direction);
    // `max` and `min` pass over NaN.
    fraction.max(low).min(high)
}
