//! A sphere and any shape: how far its centre lies from, or in, the other.

use super::{Overlap, unit};
use crate::geometry::{Cuboid, Edge, Feature, Polytope, Pose, Sphere, Triangle};
use glam::DVec3;

/// Share of a body's size within which of a vertex rounding of the coordinates may turn the
/// direction from it by more than 1e-13.
const CLOSE: f64 = 1e-2;

/// Where a shape lies nearest to a point, or nearest to let it out.
pub(crate) struct Nearest {
    /// Signed distance in metres, negative inside.
    pub(crate) distance: f64,
    /// Unit vector out of the shape, to the point or through it.
    pub(crate) direction: DVec3,
    pub(crate) feature: Feature,
}

/// The overlap of a sphere with the shape of which `nearest` was found, in that shape's frame.
fn of_nearest(
    sphere: &Sphere,
    pose: &Pose,
    nearest: &Nearest,
    pose_b: &Pose,
    touch: f64,
) -> Option<Overlap> {
    let depth = sphere.radius() - nearest.distance;
    let direction = pose_b.direction(nearest.direction);
    (depth > touch).then(|| Overlap {
        depth,
        direction,
        point: pose.position - 0.5 * (sphere.radius() + nearest.distance) * direction,
        feature_a: Feature::Surface,
        feature_b: nearest.feature,
    })
}

/// Two spheres; around one centre the way out is +x.
pub(super) fn of_spheres(
    a: &Sphere,
    pose_a: &Pose,
    b: &Sphere,
    pose_b: &Pose,
    touch: f64,
) -> Option<Overlap> {
    of_balls(
        (pose_a.position, a.radius()),
        (pose_b.position, b.radius()),
        touch,
    )
}

/// Two spheres, each by its centre and radius.
#[inline]
pub(super) fn of_balls(a: (DVec3, f64), b: (DVec3, f64), touch: f64) -> Option<Overlap> {
    let offset = a.0 - b.0;
    let distance = offset.length() - b.1;
    let depth = a.1 - distance;
    (depth > touch).then(|| {
        let direction = unit(offset).unwrap_or(DVec3::X);
        Overlap {
            depth,
            direction,
            point: a.0 - 0.5 * (a.1 + distance) * direction,
            feature_a: Feature::Surface,
            feature_b: Feature::Surface,
        }
    })
}

pub(super) fn of_cuboid(
    sphere: &Sphere,
    pose: &Pose,
    cuboid: &Cuboid,
    pose_b: &Pose,
    touch: f64,
) -> Option<Overlap> {
    let nearest = to_cuboid(pose_b.local_point(pose.position), cuboid)?;
    of_nearest(sphere, pose, &nearest, pose_b, touch)
}

/// Where a cuboid is nearest to a point of its frame.
pub(super) fn to_cuboid(centre: DVec3, cuboid: &Cuboid) -> Option<Nearest> {
    let excess = centre.abs() - cuboid.half_extents();
    let sides = centre.to_array().map(|x| u32::from(x >= 0.0));
    let outside = excess.max(DVec3::ZERO);
    Some(if outside == DVec3::ZERO {
        let axis = (1..3).fold(0, |best, axis| {
            if excess[axis] > excess[best] {
                axis
            } else {
                best
            }
        });
        Nearest {
            distance: excess[axis],
            direction: (2.0 * f64::from(sides[axis]) - 1.0) * DVec3::AXES[axis],
            feature: Feature::Face(2 * axis as u32 + sides[axis]),
        }
    } else {
        Nearest {
            distance: outside.length(),
            direction: unit(outside.copysign(centre))?,
            feature: feature_of_cuboid(outside, sides),
        }
    })
}

/// The feature of a cuboid from which a point sticks out along the axes where `outside` is not zero.
fn feature_of_cuboid(outside: DVec3, [x, y, z]: [u32; 3]) -> Feature {
    match outside.to_array().map(|excess| excess > 0.0) {
        [true, true, true] => Feature::Vertex(x + 2 * y + 4 * z),
        [false, true, true] => Feature::Edge(y + 2 * z),
        [true, false, true] => Feature::Edge(4 + x + 2 * z),
        [true, true, false] => Feature::Edge(8 + x + 2 * y),
        [_, false, false] => Feature::Face(x),
        [false, true, false] => Feature::Face(2 + y),
        [false, false, true] => Feature::Face(4 + z),
    }
}

/// A centre in the triangle leaves to the side of its normal.
pub(super) fn of_triangle(
    sphere: &Sphere,
    pose: &Pose,
    triangle: &Triangle,
    pose_b: &Pose,
    touch: f64,
) -> Option<Overlap> {
    let centre = pose_b.local_point(pose.position);
    let height = triangle.normal().dot(centre - triangle.vertices()[0]);
    if height.abs() > sphere.radius() - touch {
        return None;
    }
    of_nearest(sphere, pose, &to_triangle(centre, triangle), pose_b, touch)
}

/// Where a triangle is nearest to a point of its frame.
pub(super) fn to_triangle(centre: DVec3, triangle: &Triangle) -> Nearest {
    let (vertices, normal) = (triangle.vertices(), triangle.normal());
    let height = normal.dot(centre - vertices[0]);
    let (up, face) = if height < 0.0 {
        (-normal, 1)
    } else {
        (normal, 0)
    };
    let above = Nearest {
        distance: height.abs(),
        direction: up,
        feature: Feature::Face(face),
    };
    let mut nearest: Option<Nearest> = None;
    let mut beyond = false;
    for index in 0..3_u32 {
        let from = vertices[index as usize];
        let edge = vertices[(index as usize + 1) % 3] - from;
        let length = edge.length();
        let along = edge / length;
        let rim = along.cross(normal);
        let offset = centre - from;
        let (out, fraction) = (rim.dot(offset), along.dot(offset) / length);
        beyond |= out > 0.0;
        let (distance, away, feature) = if out > 0.0 && fraction > 0.0 && fraction < 1.0 {
            // From height and overhang, so that close to the edge the direction
            // still leads out of the triangle.
            let away = height * normal + out * rim;
            (height.hypot(out), away, Feature::Edge(index))
        } else {
            (offset.length(), offset, Feature::Vertex(index))
        };
        if nearest.as_ref().is_none_or(|best| distance < best.distance) {
            nearest = Some(Nearest {
                distance,
                direction: unit(away).unwrap_or(up),
                feature,
            });
        }
    }
    match nearest.filter(|_| beyond) {
        Some(nearest) => held_in_corner(nearest, centre, triangle),
        None => above,
    }
}

/// What is nearest to a point of a triangle's frame; if it is a corner, with a direction along which
/// no edge sticks out, as rounding may make it close to the corner.
fn held_in_corner(nearest: Nearest, centre: DVec3, triangle: &Triangle) -> Nearest {
    let (vertices, normal) = (triangle.vertices(), triangle.normal());
    let Feature::Vertex(corner) = nearest.feature else {
        return nearest;
    };
    let corner = corner as usize;
    let [from, to, last] = [0, 1, 2].map(|step| vertices[(corner + step) % 3]);
    let sides = [to - from, last - from];
    let size = sides[0].length().max(sides[1].length());
    let rounding = 4.0 * f64::EPSILON * size;
    let sticks_out = |side: &DVec3| nearest.direction.dot(*side) > rounding;
    if nearest.distance > CLOSE * size || !sides.iter().any(sticks_out) {
        return nearest;
    }
    let offset = centre - from;
    let height = normal.dot(offset);
    let up = if height < 0.0 { -normal } else { normal };
    [sides[0].cross(normal), normal.cross(sides[1])]
        .map(|rim| {
            let rim = rim / rim.length();
            let away = height * normal + rim.dot(offset).max(0.0) * rim;
            let direction = unit(away).unwrap_or(up);
            (direction.dot(offset), direction)
        })
        .into_iter()
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(distance, direction)| Nearest {
            distance,
            direction,
            feature: Feature::Vertex(corner as u32),
        })
        .unwrap_or(nearest)
}

/// Only edges and faces that the centre sees can be nearest to it.
pub(super) fn of_polytope(
    sphere: &Sphere,
    pose: &Pose,
    polytope: &Polytope,
    pose_b: &Pose,
    touch: f64,
) -> Option<Overlap> {
    let centre = pose_b.local_point(pose.position);
    let nearest = to_polytope(centre, polytope, sphere.radius() - touch)?;
    of_nearest(sphere, pose, &nearest, pose_b, touch)
}

/// Where a polytope is nearest to a point of its frame; none if it is surely farther
/// away than `reach`.
pub(super) fn to_polytope(centre: DVec3, polytope: &Polytope, reach: f64) -> Option<Nearest> {
    let (normals, offsets) = (polytope.face_normals(), polytope.face_offsets());
    let height = |face: usize| normals[face].dot(centre) - offsets[face];
    let mut highest = (0, f64::NEG_INFINITY);
    for face in 0..normals.len() {
        let height = height(face);
        if height > highest.1 {
            highest = (face, height);
        }
    }
    let (face, most) = highest;
    if most > reach {
        return None;
    }
    // Above the highest face, its foot on that face: nothing else is nearer.
    if most <= 0.0 || over_face(polytope, face as u32, centre) {
        return Some(Nearest {
            distance: most,
            direction: *normals.get(face)?,
            feature: Feature::Face(face as u32),
        });
    }
    let mut best = (f64::INFINITY, 0);
    for (index, edge) in (0..).zip(polytope.edges()) {
        if edge.faces.iter().any(|&face| height(face as usize) > 0.0) {
            let distance = distance_squared(polytope, edge, centre);
            if distance < best.0 {
                best = (distance, index);
            }
        }
    }
    let nearest = on_edge(polytope, best.1, centre);
    let reach = centre.abs().max_element() + polytope.max_dist();
    let farthest = best.0.sqrt() - 16.0 * f64::EPSILON * reach;
    if nearest.distance >= farthest {
        return Some(nearest);
    }
    // Close to a corner edges with little between them are as near but for rounding, and the plane
    // across another one parts the two farther.
    let most = farthest + 32.0 * f64::EPSILON * reach;
    (0..)
        .zip(polytope.edges())
        .filter(|(_, edge)| distance_squared(polytope, edge, centre) <= most * most)
        .map(|(index, _)| on_edge(polytope, index, centre))
        .chain([nearest])
        .max_by(|a, b| a.distance.total_cmp(&b.distance))
}

/// Whether the foot of `point` on a face's plane lies in the face.
fn over_face(polytope: &Polytope, face: u32, point: DVec3) -> bool {
    let normal = polytope.face_normals()[face as usize];
    polytope.edges().iter().all(|edge| {
        let [from, to] = edge
            .vertices
            .map(|index| polytope.vertices()[index as usize]);
        // The first face lies to the left of the edge.
        let left = normal.cross(to - from).dot(point - from);
        match edge.faces {
            [first, _] if first == face => left >= 0.0,
            [_, second] if second == face => left <= 0.0,
            _ => true,
        }
    })
}

fn ends(polytope: &Polytope, edge: &Edge) -> [DVec3; 2] {
    edge.vertices
        .map(|index| polytope.vertices()[index as usize])
}

fn distance_squared(polytope: &Polytope, edge: &Edge, point: DVec3) -> f64 {
    let [from, to] = ends(polytope, edge);
    let along = to - from;
    let fraction = (point - from).dot(along) / along.length_squared();
    // An end is taken as it is, so that edges that share it tie.
    let foot = if fraction >= 1.0 {
        to
    } else {
        from + fraction.max(0.0) * along
    };
    point.distance_squared(foot)
}

/// The nearest point of the polytope, known to be on one of its edges.
fn on_edge(polytope: &Polytope, index: u32, point: DVec3) -> Nearest {
    let edge = &polytope.edges()[index as usize];
    let [from, to] = ends(polytope, edge);
    let (along, offset) = (to - from, point - from);
    let fraction = offset.dot(along) / along.length_squared();
    if fraction > 0.0 && fraction < 1.0 {
        let direction = off_edge(polytope, edge, offset);
        return Nearest {
            distance: direction.dot(offset),
            direction,
            feature: Feature::Edge(index),
        };
    }
    let end = usize::from(fraction > 0.0);
    let offset = point - [from, to][end];
    let (distance, direction) = at_vertex(polytope, edge, end, offset);
    Nearest {
        distance,
        direction,
        feature: Feature::Vertex(edge.vertices[end]),
    }
}

/// Unit vector square to an edge along which a point leaves it, `offset` from anywhere on it.
fn off_edge(polytope: &Polytope, edge: &Edge, offset: DVec3) -> DVec3 {
    let [from, to] = ends(polytope, edge);
    let along = to - from;
    let normals = edge
        .faces
        .map(|face| polytope.face_normals()[face as usize]);
    let across = |offset: DVec3| offset - offset.dot(along) / along.length_squared() * along;
    // Close to the edge what is left of the offset is rounding, which may lead along the edge
    // as well: that share is taken out, and where there is little else a face is as near.
    let away = (unit(across(offset)).map(across))
        .filter(|away| away.length_squared() > 0.25)
        .and_then(unit)
        .unwrap_or(normals[0]);
    // Rounding may turn the direction out of the wedge between the two faces too, where it
    // would no longer support the body.
    if normals[0].cross(away).dot(along) < 0.0 {
        normals[0]
    } else if away.cross(normals[1]).dot(along) < 0.0 {
        normals[1]
    } else {
        away
    }
}

/// Distance and direction of a point from the vertex nearest to it: one of the `end`s of `edge`.
fn at_vertex(polytope: &Polytope, edge: &Edge, end: usize, offset: DVec3) -> (f64, DVec3) {
    let vertex = edge.vertices[end];
    let distance = offset.length();
    let direction = unit(offset).unwrap_or(polytope.face_normals()[edge.faces[0] as usize]);
    if distance > CLOSE * polytope.max_dist() {
        return (distance, direction);
    }
    // Rounding may turn it out of the cone between the faces: an edge would stick out.
    let around = || (polytope.edges().iter()).filter(|edge| edge.vertices.contains(&vertex));
    let sticks_out = |edge: &Edge| {
        let [from, to] = ends(polytope, edge);
        let along = if edge.vertices[0] == vertex {
            to - from
        } else {
            from - to
        };
        direction.dot(along) > 4.0 * f64::EPSILON * polytope.max_dist()
    };
    if !around().any(sticks_out) {
        return (distance, direction);
    }
    around()
        .map(|edge| off_edge(polytope, edge, offset))
        .map(|direction| (direction.dot(offset), direction))
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .unwrap_or((distance, direction))
}
