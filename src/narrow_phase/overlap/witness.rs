//! Where two hulls overlap: the features that meet, and a point between them.

use super::hull::{Hull, Vertices};
use super::pair::Pair;
use super::{Overlap, Width};
use crate::geometry::Feature;
use crate::geometry::sketch::{self, Bits};
use crate::math::frame::orthonormal;
use crate::math::short_list::ShortList;
use glam::{DVec2, DVec3};

/// Share of a hull's radius within which vertices lie in one feature.
///
/// A direction computed from two features is right to some 1e-16; the margin
/// leaves room for shapes whose own numbers were rounded. Larger, and an edge
/// turned by a hair from a face is taken for part of it.
const FEATURE: f64 = 1e-11;

/// How far a triangle's normal may fall short of the direction for the triangle to be taken for the feature
/// unseen its neighbours: larger than rounding, and next to nothing beside what a sliver's may be off by.
const ALONG: f64 = 1e-12;

/// Corners of a flat convex feature; more than these few go to the heap.
pub(in crate::narrow_phase) type Polygon = ShortList<DVec2, 32>;

impl Pair<'_> {
    /// The overlap whose least width was found.
    pub(super) fn witness(&self, least: Width) -> Option<Overlap> {
        let Width { direction, width } = least;
        let (feature_a, vertices_a) = feature(&self.a, -direction);
        let (feature_b, vertices_b) = feature(&self.b, direction);
        let (x, y) = orthonormal(direction);
        let flat = |hull: &Hull, vertex: u32| {
            let point = hull.point(vertex);
            DVec2::new(point.dot(x), point.dot(y))
        };
        let corners = |hull: &Hull, vertices: &[u32]| {
            let corners: Polygon = vertices.iter().map(|&vertex| flat(hull, vertex)).collect();
            // The ends of an edge may come in any order.
            if corners.len() > 2 {
                around(corners)
            } else {
                corners
            }
        };
        let shared = match (&*vertices_a, &*vertices_b) {
            // Most touch with one vertex, which need not be looked for among others.
            ([vertex], _) => flat(&self.a, *vertex),
            (_, [vertex]) => flat(&self.b, *vertex),
            // Or with an edge each.
            ([from, to], [other_from, other_to]) => of_segments(
                [*from, *to].map(|vertex| flat(&self.a, vertex)),
                [*other_from, *other_to].map(|vertex| flat(&self.b, vertex)),
            ),
            _ => between(
                &corners(&self.a, &vertices_a),
                &corners(&self.b, &vertices_b),
            ),
        };
        let height = |hull: &Hull, vertices: &[u32], side: f64| {
            let along = |&vertex: &u32| side * hull.point(vertex).dot(direction);
            side * vertices.iter().map(along).fold(f64::NEG_INFINITY, f64::max)
        };
        let bottom = height(&self.a, &vertices_a, -1.0);
        let top = height(&self.b, &vertices_b, 1.0);
        Some(Overlap {
            depth: width,
            direction,
            point: self.origin + shared.x * x + shared.y * y + (0.5 * (bottom + top)) * direction,
            feature_a,
            feature_b,
        })
    }
}

/// The feature that lies farthest along `direction`, and its vertices.
fn feature(hull: &Hull, direction: DVec3) -> (Feature, Vertices) {
    let vertices = hull.farthest_within(direction, FEATURE * hull.radius);
    if let [] | [_] = *vertices {
        let vertex = vertices.first().copied().unwrap_or(0);
        return (Feature::Vertex(vertex), vertices);
    }
    // A bit for each of the first vertices; the others are looked for.
    let bit = |vertex: u32| 1_u64.checked_shl(vertex).unwrap_or(0);
    let first_ones = vertices.iter().fold(0, |bits, &vertex| bits | bit(vertex));
    let mut first = None;
    let (mut is_face, mut is_level) = (false, false);
    let mut faces = Foremost {
        direction,
        best: None,
    };
    if let Some(sketch) = hull.sketch() {
        let is_inside = |vertex: u8| first_ones >> (vertex & 63) & 1 == 1;
        // The faces beside one, two or three of the feature's edges.
        let (mut once, mut twice, mut thrice): (Bits, Bits, Bits) = (0, 0, 0);
        for (index, edge) in (0..).zip(sketch.joints()) {
            let [from, to] = edge.vertices;
            if is_inside(from) & is_inside(to) {
                is_face = first.is_some();
                first = first.or(Some(index));
                for face in edge.faces {
                    let bit = 1 << (u32::from(face) % Bits::BITS);
                    thrice |= twice & bit;
                    twice |= once & bit;
                    once |= bit;
                }
            }
        }
        if is_face {
            // A triangle that is the feature need not be compared with its neighbours, whose normals
            // would have to be fetched.
            if vertices.len() == 3 && thrice.is_power_of_two() {
                faces.see(hull, thrice.trailing_zeros());
                is_level = true;
            }
            if faces.best.is_none_or(|(along, _)| along < 1.0 - ALONG) {
                sketch::numbers(once).for_each(|face| faces.see(hull, face));
                is_level = false;
            }
        }
    } else {
        let is_inside = |vertex: u32| match bit(vertex) {
            0 => vertices.binary_search(&vertex).is_ok(),
            bit => first_ones & bit != 0,
        };
        for (index, edge) in (0..).zip(hull.edges()) {
            if edge.vertices.iter().all(|&vertex| is_inside(vertex)) {
                is_face = first.is_some();
                first = first.or(Some(index));
                edge.faces.iter().for_each(|&face| faces.see(hull, face));
            }
        }
    }
    let feature = match (first, faces.best) {
        (Some(_), Some((_, face)))
            if is_face && (is_level || hull.is_level(face, vertices[0], direction)) =>
        {
            Feature::Face(face)
        }
        (Some(edge), _) if is_face => Feature::Edge(longest(hull, &vertices).unwrap_or(edge)),
        (Some(edge), _) => Feature::Edge(edge),
        (None, _) => Feature::Vertex(vertices.first().copied().unwrap_or(0)),
    };
    (feature, vertices)
}

/// The longest edge between some vertices, of several on one line: an edge that rounding broke.
fn longest(hull: &Hull, vertices: &[u32]) -> Option<u32> {
    let is_inside = |vertex: &u32| vertices.binary_search(vertex).is_ok();
    (0..)
        .zip(hull.edges())
        .filter(|(_, edge)| edge.vertices.iter().all(is_inside))
        .map(|(index, edge)| (hull.edge_vector(edge.vertices).length_squared(), index))
        .max_by(|(a, _), (b, _)| a.total_cmp(b))
        .map(|(_, index)| index)
}

/// Of the faces shown to it the one that looks most along a direction.
struct Foremost {
    direction: DVec3,
    best: Option<(f64, u32)>,
}

impl Foremost {
    fn see(&mut self, hull: &Hull, face: u32) {
        let along = hull.face_normal(face).dot(self.direction);
        // Of equals the one of the lower number.
        let order = |&(most, other): &(f64, u32)| along.total_cmp(&most).then(other.cmp(&face));
        if self.best.as_ref().is_none_or(|best| order(best).is_gt()) {
            self.best = Some((along, face));
        }
    }
}

/// The corners of a convex polygon in counter-clockwise order.
///
/// What lies amid a face that rounding broke, or on one line with its neighbours, is no corner.
pub(in crate::narrow_phase) fn around(mut points: Polygon) -> Polygon {
    if points.len() <= 1 {
        return points;
    }
    let centre = mean(&points);
    points.sort_by(|p, q| {
        let angle = |p: &DVec2| (p.y - centre.y).atan2(p.x - centre.x);
        angle(p).total_cmp(&angle(q))
    });
    let count = points.len();
    let turns_left = |index: usize| {
        let [p, q, r] = [0, 1, 2].map(|step| points[(index + step) % count]);
        (q - p).perp_dot(r - q) >= 0.0
    };
    if count > 2 && !(0..count).all(turns_left) {
        return outermost(points);
    }
    points
}

/// The corners of the convex hull of some points, counter-clockwise; both ends if they lie on one line.
///
/// Source: Andrew, *Another Efficient Algorithm for Convex Hulls in Two Dimensions* (1979).
#[cold]
fn outermost(mut points: Polygon) -> Polygon {
    points.sort_by(|p, q| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)));
    let half = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for point in points {
            while let [.., before, last] = chain[..]
                && (last - before).perp_dot(point - last) <= 0.0
            {
                chain.pop();
            }
            chain.push(point);
        }
        // The other half begins with the last.
        chain.pop();
        chain
    };
    let mut corners = half(&mut points.iter().copied());
    corners.extend(half(&mut points.iter().rev().copied()));
    corners.into_iter().collect()
}

fn mean(points: &[DVec2]) -> DVec2 {
    points.iter().sum::<DVec2>() / points.len().max(1) as f64
}

/// The centroid of a convex polygon; the middle of its length if it has next to no area.
///
/// Corners that rounding doubled carry no area, but would pull a mean.
fn centroid(points: &[DVec2]) -> DVec2 {
    let centre = mean(points);
    let (mut area, mut moment) = (0.0, DVec2::ZERO);
    for (index, &point) in points.iter().enumerate() {
        let (p, q) = (point - centre, points[(index + 1) % points.len()] - centre);
        let doubled = p.perp_dot(q);
        area += doubled;
        moment += doubled * (p + q);
    }
    let farthest = |from: DVec2| {
        let nearer = |p: &&DVec2, q: &&DVec2| {
            p.distance_squared(from)
                .total_cmp(&q.distance_squared(from))
        };
        points.iter().max_by(nearer).copied().unwrap_or(from)
    };
    let end = farthest(centre);
    if area > 1e-9 * end.distance_squared(centre) {
        centre + moment / (3.0 * area)
    } else {
        0.5 * (end + farthest(end))
    }
}

/// A point that two features share; if rounding keeps them apart, half way from a corner of one to
/// where the other is nearest to it.
fn between(a: &[DVec2], b: &[DVec2]) -> DVec2 {
    let (subject, clip) = if a.len() <= b.len() { (a, b) } else { (b, a) };
    if let ([from, to], [other_from, other_to]) = (subject, clip) {
        return of_segments([*from, *to], [*other_from, *other_to]);
    }
    let shared = clipped(subject, clip);
    if !shared.is_empty() {
        return centroid(&shared);
    }
    let mut best = (f64::INFINITY, DVec2::ZERO);
    for (corners, other) in [(a, b), (b, a)] {
        for &corner in corners {
            for (index, &from) in other.iter().enumerate() {
                let along = other[(index + 1) % other.len()] - from;
                let share = (corner - from).dot(along) / along.length_squared();
                // Of an edge without length the share is NaN.
                let share = if share > 0.0 { share.min(1.0) } else { 0.0 };
                let foot = from + share * along;
                let distance = foot.distance_squared(corner);
                if distance < best.0 {
                    best = (distance, 0.5 * (foot + corner));
                }
            }
        }
    }
    best.1
}

/// A point that two convex point sets share: points, segments or polygons.
pub(in crate::narrow_phase) fn middle(a: &[DVec2], b: &[DVec2]) -> DVec2 {
    let (subject, clip) = if a.len() <= b.len() { (a, b) } else { (b, a) };
    match (subject, clip) {
        ([point], _) => *point,
        ([from, to], [other_from, other_to]) => of_segments([*from, *to], [*other_from, *other_to]),
        _ => {
            let shared = clipped(subject, clip);
            if shared.is_empty() {
                // Rounding alone keeps them apart.
                0.5 * (mean(a) + mean(b))
            } else {
                centroid(&shared)
            }
        }
    }
}

fn of_segments([from, to]: [DVec2; 2], [other_from, other_to]: [DVec2; 2]) -> DVec2 {
    let (along, other) = (to - from, other_to - other_from);
    let cross = along.perp_dot(other);
    if cross.abs() > 1e-9 * along.length() * other.length() {
        let fraction = (other_from - from).perp_dot(other) / cross;
        return from + fraction.clamp(0.0, 1.0) * along;
    }
    // Parallel: the middle of what they share.
    let fraction =
        |point: DVec2| ((point - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    from + 0.5 * (fraction(other_from) + fraction(other_to)) * along
}

/// What of `subject` lies in the polygon `clip`. Source: Sutherland & Hodgman (1974).
pub(in crate::narrow_phase) fn clipped(subject: &[DVec2], clip: &[DVec2]) -> Polygon {
    let mut lists = [subject.iter().copied().collect(), Polygon::new()];
    let [kept, next] = &mut lists;
    let (mut kept, mut next) = (kept, next);
    for (index, &from) in clip.iter().enumerate() {
        let along = clip[(index + 1) % clip.len()] - from;
        let height = |point: DVec2| along.perp_dot(point - from);
        next.clear();
        for (index, &point) in kept.iter().enumerate() {
            let previous = kept[(index + kept.len() - 1) % kept.len()];
            let (before, here) = (height(previous), height(point));
            if (before < 0.0) != (here < 0.0) {
                next.push(previous + before / (before - here) * (point - previous));
            }
            if here >= 0.0 {
                next.push(point);
            }
        }
        std::mem::swap(&mut kept, &mut next);
    }
    std::mem::replace(kept, Polygon::new())
}
