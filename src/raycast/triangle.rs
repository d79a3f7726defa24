//! Rays against triangles.

use super::clip::{self, Plane};
use super::line::Line;
use super::{GRAZE, RayCast, RaySpan, SurfacePoint};
use crate::geometry::{Feature, Ray, Triangle};
use glam::{DVec2, DVec3};
use robust::{Coord, Coord3D, orient2d, orient3d};

/// Watertight: a line through an edge that two triangles share hits at least
/// one of them. Looking along the ray, the test takes the same rounded products
/// for an edge from either side, with opposite signs. The thesis takes
/// Möller–Trumbore, which loses rays between triangles.
/// Source: Woop, Benthin & Wald, *Watertight Ray/Triangle Intersection*, JCGT 2 (1), 2013;
/// their second, slower try at zero is not needed where zero counts as a hit.
///
/// O(1).
impl RayCast for Triangle {
    #[inline]
    fn line_span(&self, ray: &Ray) -> Option<RaySpan> {
        let line = Line::of(ray)?;
        let seen = Seen::along(&line, self.vertices());
        let [a, b, c] = seen.points;
        let mut shares = [c.perp_dot(b), a.perp_dot(c), b.perp_dot(a)];
        // What rounding may have done to them: each coordinate is off by some ulp of the reach.
        let [size_a, size_b, size_c] = seen.points.map(|point| point.x.abs() + point.y.abs());
        let slack = [size_b + size_c, size_c + size_a, size_a + size_b]
            .map(|size| 0.5 * GRAZE * seen.reach * size);
        let negative = (0..3).any(|i| shares[i] < -slack[i]);
        let positive = (0..3).any(|i| shares[i] > slack[i]);
        if negative && positive {
            return None;
        }
        if !negative && !positive {
            return span_in_plane(self, &line, seen.reach);
        }
        shares = shares.map(|share| {
            if positive {
                share.max(0.0)
            } else {
                share.min(0.0)
            }
        });
        let from_front = positive != seen.backwards;
        let fraction = fraction(self, &line, &seen, shares, from_front);
        let point = |front: bool| SurfacePoint {
            fraction: line.ray_fraction(fraction),
            normal: if front { self.normal() } else { -self.normal() },
            feature: Feature::Face(u32::from(!front)),
        };
        RaySpan::new(point(from_front), point(!from_front))
    }

    fn contains_point(&self, point: DVec3) -> bool {
        if !point.is_finite() || side(self, point) != 0.0 {
            return false;
        }
        // In the triangle's plane. Looked at along the normal's longest component
        // it keeps its shape, and the corners stay exact.
        let longest = self.normal().abs().max_position();
        let flat = |v: DVec3| {
            let (x, y) = match longest {
                0 => (v.y, v.z),
                1 => (v.z, v.x),
                _ => (v.x, v.y),
            };
            Coord { x, y }
        };
        let [a, b, c] = self.vertices().map(flat);
        let point = flat(point);
        let turns = [(a, b), (b, c), (c, a)].map(|(from, to)| orient2d(from, to, point));
        turns.iter().all(|&turn| turn >= 0.0) || turns.iter().all(|&turn| turn <= 0.0)
    }
}

/// A triangle seen along a line, which is the origin of the picture.
struct Seen {
    /// The corners, sheared along the line onto the plane across its longest component.
    points: [DVec2; 3],
    /// The fractions of the line level with them.
    depths: [f64; 3],
    /// The largest coordinate of a corner, from the line's origin.
    reach: f64,
    /// The line's longest component is negative: the picture is mirrored.
    backwards: bool,
}

impl Seen {
    #[inline]
    fn along(line: &Line, vertices: [DVec3; 3]) -> Self {
        let size = line.direction.abs();
        // Cyclic, to keep the handedness.
        let turn = |v: DVec3| {
            if size.z >= size.x && size.z >= size.y {
                v
            } else if size.x >= size.y {
                DVec3::new(v.y, v.z, v.x)
            } else {
                DVec3::new(v.z, v.x, v.y)
            }
        };
        let direction = turn(line.direction);
        let shear = direction.truncate() / direction.z;
        let corners = vertices.map(|vertex| turn(vertex - line.origin));
        Self {
            points: corners.map(|corner| corner.truncate() - corner.z * shear),
            depths: corners.map(|corner| corner.z / direction.z),
            reach: corners
                .iter()
                .fold(0.0, |reach, corner| corner.abs().max_element().max(reach)),
            backwards: direction.z < 0.0,
        }
    }
}

/// Where the line meets the triangle, whose corners have these shares in the point hit.
#[inline]
fn fraction(
    triangle: &Triangle,
    line: &Line,
    seen: &Seen,
    shares: [f64; 3],
    from_front: bool,
) -> f64 {
    let normal = triangle.normal();
    let rate = normal.dot(line.direction);
    let speed = line.direction.abs().max_element();
    let fraction = if rate.abs() > 0.01 * speed {
        normal.dot(triangle.vertices()[0] - line.origin) / rate
    } else {
        // A mean of the corners' depths stays between them however badly the
        // shares are rounded, and so the hit is near the triangle however
        // nearly the line lies in its plane.
        let sum = shares[0] + shares[1] + shares[2];
        (0..3).map(|i| shares[i] / sum * seen.depths[i]).sum()
    };
    if fraction.abs() * speed > 2.0 * GRAZE * (seen.reach + line.distance()) {
        return fraction;
    }
    // So near that rounding might carry the origin through the triangle.
    let side = side(triangle, line.origin);
    if side == 0.0 {
        0.0
    } else if (side > 0.0) == from_front {
        fraction.max(f64::MIN_POSITIVE)
    } else {
        fraction.min(-f64::MIN_POSITIVE)
    }
}

/// Positive on the side the normal points to, zero in the plane; exact.
fn side(triangle: &Triangle, point: DVec3) -> f64 {
    let coord = |v: DVec3| Coord3D {
        x: v.x,
        y: v.y,
        z: v.z,
    };
    let [a, b, c] = triangle.vertices().map(coord);
    -orient3d(a, b, c, coord(point))
}

/// The span of a line in the triangle's plane: clipped by the edges.
#[cold]
fn span_in_plane(triangle: &Triangle, line: &Line, reach: f64) -> Option<RaySpan> {
    let vertices = triangle.vertices();
    let edges: [Plane; 3] = std::array::from_fn(|edge| {
        let along = vertices[(edge + 1) % 3] - vertices[edge];
        let normal = along.cross(triangle.normal()).normalize_or_zero();
        Plane {
            normal,
            offset: normal.dot(vertices[edge]),
        }
    });
    // The offsets are rounded in the triangle's own coordinates.
    let growth = GRAZE * (reach + 2.0 * line.distance());
    clip::span(line, edges.iter().copied(), growth, Feature::Edge)
}
