//! A ball cast at a triangle: a line against a slab with rounded edges.

use super::ball_capsule::{Place, meet};
use super::ball_line::{Line, Touch};
use crate::geometry::{Feature, Triangle};
use glam::DVec3;

/// Lines that begin farther away than so many radii are begun anew where they are nearest.
const FAR: f64 = 16.0;

/// The first of what the rounded triangle is made of: the prism over it and three capsules.
pub(super) fn of_triangle(line: &Line, triangle: &Triangle, radius: f64) -> Option<Touch> {
    let vertices @ [a, b, c] = triangle.vertices();
    // A sphere around all three; no matter that a smaller one might do.
    let centre = a + ((b - a) + (c - a)) / 3.0;
    let squares = vertices.map(|vertex| vertex.distance_squared(centre));
    let around = squares[0].max(squares[1]).max(squares[2]).sqrt();
    let slack = line.slack(centre.abs().max_element() + around + radius);
    if line.passes_by(line.origin - centre, around + radius + 8.0 * slack) {
        return None;
    }
    if let Some(top) = over_face(line, triangle, radius) {
        return Some(top);
    }
    // From afar as from near: else each coordinate brings along the rounding of the distance.
    let middle = -(line.origin - centre).dot(line.direction) / line.square;
    let near = FAR * (around + radius);
    let skipped = if middle * middle * line.square > near * near {
        middle
    } else {
        0.0
    };
    let line = &line.begun_at(line.origin + skipped * line.direction);
    let edges = [(a, b), (b, c), (c, a)];
    let meetings = edges.map(|(from, to)| meet(line, from, to - from, radius));
    let mut index = usize::from(meetings[1].before(&meetings[0]));
    if meetings[2].before(&meetings[index]) {
        index = 2;
    }
    let (meeting, (from, to)) = (meetings[index], edges[index]);
    let reach = radius + slack;
    if !meeting.hit && meeting.rank > reach * reach {
        return None;
    }
    let (foot, feature) = match meeting.place {
        Place::Inner => {
            let point = line.origin + meeting.fraction * line.direction;
            (foot_on(from, to - from, point), Feature::Edge(index as u32))
        }
        Place::End(end) => {
            let vertex = (index + end) % 3;
            (vertices[vertex], Feature::Vertex(vertex as u32))
        }
    };
    Some(Touch {
        fraction: skipped + meeting.fraction,
        foot,
        normal: meeting.away.normalize_or(triangle.normal()),
        feature,
    })
}

/// Where the line comes through the side that looks towards it, pushed out by the radius, if it
/// does so over the triangle.
fn over_face(line: &Line, triangle: &Triangle, radius: f64) -> Option<Touch> {
    let vertices = triangle.vertices();
    let rate = triangle.normal().dot(line.direction);
    let (normal, side) = if rate < 0.0 {
        (triangle.normal(), 0)
    } else {
        (-triangle.normal(), 1)
    };
    if rate == 0.0 {
        return None;
    }
    let fraction = (radius - normal.dot(line.origin - vertices[0])) / -rate.abs();
    let point = line.origin + fraction * line.direction;
    let inside = (0..3).all(|index| {
        let (from, to) = (vertices[index], vertices[(index + 1) % 3]);
        triangle.normal().cross(to - from).dot(point - from) >= 0.0
    });
    inside.then(|| Touch {
        fraction,
        foot: point - radius * normal,
        normal,
        feature: Feature::Face(side),
    })
}

/// The point nearest to another on the segment that begins at `from` and leads `along`.
#[inline]
pub(super) fn foot_on(from: DVec3, along: DVec3, point: DVec3) -> DVec3 {
    let share = (point - from).dot(along) / along.length_squared();
    from + share.clamp(0.0, 1.0) * along
}
