//! A ball cast at a triangle: a line against a slab with rounded edges.

use super::ball_capsule::{Meeting, Place, meet};
use super::ball_line::{Line, Touch};
use crate::geometry::{Feature, Triangle};
use glam::DVec3;

/// The first of what the rounded triangle is made of: the prism over it and three capsules.
pub(super) fn of_triangle(line: &Line, triangle: &Triangle, radius: f64) -> Option<Touch> {
    let vertices = triangle.vertices();
    let mut first: Option<(Meeting, usize)> = None;
    let mut leave = f64::NEG_INFINITY;
    let top = over_face(line, triangle, radius);
    let under = over_face(&line.reversed(), triangle, radius);
    if let Some(under) = &under {
        leave = -under.enter;
    }
    if top.is_none() || under.is_none() {
        for index in 0..3 {
            let meeting = meet(line, vertices[index], vertices[(index + 1) % 3], radius);
            if meeting.hit {
                leave = leave.max(meeting.leave);
            }
            if (first.as_ref()).is_none_or(|(before, _)| meeting.before(before)) {
                first = Some((meeting, index));
            }
        }
    }
    if let Some(top) = top {
        return Some(Touch { leave, ..top });
    }
    let (meeting, index) = first?;
    let size = vertices
        .into_iter()
        .map(|vertex| vertex.abs().max_element())
        .fold(radius, f64::max);
    if !meeting.hit {
        let reach = radius + line.slack(size);
        if meeting.rank > reach * reach {
            return None;
        }
        leave = leave.max(meeting.fraction);
    }
    let (foot, feature) = match meeting.place {
        Place::Inner => {
            let (from, to) = (vertices[index], vertices[(index + 1) % 3]);
            let point = line.origin + meeting.fraction * line.direction;
            (foot_on(from, to, point), Feature::Edge(index as u32))
        }
        Place::End(end) => {
            let vertex = (index + end) % 3;
            (vertices[vertex], Feature::Vertex(vertex as u32))
        }
    };
    Some(Touch {
        enter: meeting.fraction,
        leave,
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
    let enter = (radius - normal.dot(line.origin - vertices[0])) / -rate.abs();
    let point = line.origin + enter * line.direction;
    let inside = (0..3).all(|index| {
        let (from, to) = (vertices[index], vertices[(index + 1) % 3]);
        triangle.normal().cross(to - from).dot(point - from) >= 0.0
    });
    inside.then(|| Touch {
        enter,
        leave: enter,
        foot: point - radius * normal,
        normal,
        feature: Feature::Face(side),
    })
}

/// The point of a segment nearest to another.
pub(super) fn foot_on(from: DVec3, to: DVec3, point: DVec3) -> DVec3 {
    let along = to - from;
    let share = (point - from).dot(along) / along.length_squared();
    from + share.clamp(0.0, 1.0) * along
}
