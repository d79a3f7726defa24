//! A ball beside a ball or a cuboid: the nearest point by its regions.

use super::body::Body;
use super::separator::{End, Found, Separation, Separator};
use crate::geometry::{Cuboid, Shape};
use glam::DVec3;

impl Separator<'_> {
    /// The distance of a pair that has a closed form; its nearest vertices are kept.
    #[inline]
    pub(super) fn ball(&mut self, offset: DVec3, rounding: f64) -> Option<End> {
        let nearest = match (self.a.shape, self.b.shape) {
            (Shape::Sphere(_), Shape::Sphere(_)) => {
                self.keep_only(&[[0, 0]]);
                offset
            }
            (Shape::Sphere(_), Shape::Cuboid(cuboid)) => {
                let (way, corners, count) = from_cuboid(&self.b, cuboid, offset);
                self.keep_only(&corners.map(|corner| [0, corner])[..count]);
                way
            }
            (Shape::Cuboid(cuboid), Shape::Sphere(_)) => {
                let (way, corners, count) = from_cuboid(&self.a, cuboid, -offset);
                self.keep_only(&corners.map(|corner| [corner, 0])[..count]);
                -way
            }
            _ => return None,
        };
        let height = nearest.length();
        let distance = height - self.radii();
        // NaN touches.
        Some(if distance > rounding && distance < f64::INFINITY {
            End::Settled(Found {
                nearest,
                separation: Separation {
                    normal: nearest / height,
                    gap: distance,
                    distance,
                },
            })
        } else {
            End::Touching
        })
    }
}

/// The way to a point from the nearest point of a cuboid, and the corners, up to three, between which that
/// lies.
#[inline]
fn from_cuboid(body: &Body, cuboid: &Cuboid, point: DVec3) -> (DVec3, [u32; 3], usize) {
    let half = cuboid.half_extents();
    // The axes are as long as the half-extents.
    let local = body.along_axes(point) / half;
    let beyond = (local.abs() - half).max(DVec3::ZERO);
    let way = body.sum_of_axes(beyond.copysign(local) / half);
    // The corner on the point's side, and its neighbours along the axes on which the point is not
    // beyond: a triangle that holds a quarter of their face.
    let corner = (0..3).fold(0, |corner, axis| {
        corner | u32::from(local[axis] > 0.0) << axis
    });
    let (mut corners, mut count) = ([corner; 3], 1);
    for axis in 0..3 {
        if beyond[axis] == 0.0 && count < corners.len() {
            corners[count] = corner ^ 1 << axis;
            count += 1;
        }
    }
    (way, corners, count)
}
