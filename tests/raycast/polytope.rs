//! Polytopes: round, sharp and flat ones against the oracle, triangle by triangle.

use crate::cases::{Case, Draw};
use crate::oracle;
use crate::random::check;
use feeler::{Feature, Polytope, Ray, RayCast, RayHit, raycast::GRAZE};
use glam::DVec3;
use std::sync::Arc;

/// Hulls of different make, about as large as `scale`.
fn hull(draw: &mut Draw, scale: f64) -> Arc<Polytope> {
    let count = [4, 5, 8, 12, 30, 100][draw.below(6)];
    let stretch = DVec3::from_array(std::array::from_fn(|_| draw.log(0.05, 1.0)));
    let on_sphere = draw.unit() < 0.5;
    let (centre, turn) = (draw.unit() * draw.ball(), draw.turn());
    loop {
        let points: Vec<DVec3> = (0..count)
            .map(|_| {
                let point = draw.ball();
                let point = if on_sphere { point.normalize() } else { point };
                scale * (centre + turn * (stretch * point))
            })
            .collect();
        if let Ok(hull) = Polytope::from_points(points) {
            return Arc::new(hull);
        }
    }
}

fn case(hull: &Arc<Polytope>) -> Case {
    let (shape, brute) = (Arc::clone(hull), Arc::clone(hull));
    Case {
        name: "polytope",
        shape: Box::new(feeler::Shape::Polytope(shape)),
        oracle: Box::new(move |ray| {
            let corners = |t: &[u32; 3]| t.map(|v| brute.vertices()[v as usize]);
            oracle::triangles(ray, brute.triangles().iter().map(corners))
        }),
        middle: hull.vertices().iter().sum::<DVec3>() / hull.vertices().len() as f64,
        size: hull
            .vertices()
            .iter()
            .fold(0.0, |size, v| v.abs().max_element().max(size)),
    }
}

#[test]
fn drawn_rays_agree_with_every_triangle() {
    let mut draw = Draw::new(20);
    let mut hits = 0;
    for _ in 0..300 {
        let scale = draw.log(1e-6, 1e6);
        let hull = hull(&mut draw, scale);
        let case = case(&hull);
        for _ in 0..20 {
            let target = case.middle + 0.6 * scale * draw.ball();
            let distance = scale * draw.log(1e-2, 1e6) * [-1.0, 1.0][draw.below(2)];
            let ray = draw.ray_through(target, distance);
            hits += usize::from(check(&case, &ray));
        }
    }
    assert!((1_000..=5_000).contains(&hits), "{hits} hits of 6000");
}

/// Aimed at vertices and at points of edges and faces, from where they are in sight,
/// from behind and along the silhouette.
#[test]
fn planted_points_are_hit() {
    let mut draw = Draw::new(21);
    for _ in 0..400 {
        let scale = draw.log(1e-6, 1e6);
        let hull = hull(&mut draw, scale);
        let case = case(&hull);
        for _ in 0..20 {
            let edge = hull.edges()[draw.below(hull.edges().len())];
            let [from, to] = edge.vertices.map(|v| hull.vertices()[v as usize]);
            let target = from.lerp(to, [0.0, 1.0, 0.5, draw.unit()][draw.below(4)]);
            let direction = draw.direction();
            let distance = scale * draw.log(0.1, 1e3);
            let ray = Ray::new(target - distance * direction, direction);
            let span = case
                .shape
                .line_span(&ray)
                .expect("an edge belongs to the hull");
            let allowed = 16.0 * f64::EPSILON * (case.size + ray.origin.abs().max_element());
            let off = [span.enter, span.leave]
                .map(|p| (p.fraction - distance).abs() * p.normal.dot(direction).abs());
            assert!(off[0].min(off[1]) <= allowed, "{off:?} {allowed:e} {ray:?}");
        }
    }
}

/// Along an edge, and so in two faces' planes: the likeliest to slip through.
#[test]
fn lines_along_edges_and_faces_hit() {
    let mut draw = Draw::new(22);
    for _ in 0..300 {
        let scale = draw.log(1e-6, 1e6);
        let hull = hull(&mut draw, scale);
        for edge in hull.edges().iter().take(30) {
            let [from, to] = edge.vertices.map(|v| hull.vertices()[v as usize]);
            let along = to - from;
            let ray = Ray::new(from - draw.log(0.1, 10.0) * along, along);
            let span = hull.line_span(&ray).expect("the edge belongs to the hull");
            // In a face's plane, from one point of the edge across it.
            let [face, _] = edge.faces;
            let normal = hull.face_normals()[face as usize];
            let across = scale * along.cross(normal).normalize();
            let start = from.lerp(to, draw.unit()) + 2.0 * across;
            let hit = hull.line_span(&Ray::new(start, -across));
            assert!(hit.is_some(), "{start} {across}");
            assert!(span.enter.fraction <= span.leave.fraction);
        }
    }
}

/// Whatever number the walk comes by first, a vertex counts to the lowest face in sight.
#[test]
fn a_vertex_counts_to_its_lowest_face() {
    let mut draw = Draw::new(23);
    for _ in 0..200 {
        let hull = hull(&mut draw, 1.0);
        let vertex = draw.below(hull.vertices().len());
        let corner = hull.vertices()[vertex];
        let middle = hull.vertices().iter().sum::<DVec3>() / hull.vertices().len() as f64;
        let direction = (middle - corner).normalize();
        let ray = Ray::new(corner - direction, direction);
        let lowest = (hull.edges().iter())
            .filter(|edge| edge.vertices.contains(&(vertex as u32)))
            .flat_map(|edge| edge.faces)
            .filter(|&face| hull.face_normals()[face as usize].dot(direction) < 0.0)
            .min()
            .unwrap();
        let Some(RayHit::Surface(point)) = hull.first_hit(&ray) else {
            panic!("a miss")
        };
        assert_eq!(point.feature, Feature::Face(lowest));
        assert_eq!(point.normal, hull.face_normals()[lowest as usize]);
    }
}

#[test]
fn inside_and_outside_are_told_apart_to_within_rounding() {
    let mut draw = Draw::new(24);
    let mut inside = 0;
    for _ in 0..300 {
        let scale = draw.log(1e-6, 1e6);
        let hull = hull(&mut draw, scale);
        let size = hull
            .vertices()
            .iter()
            .fold(0.0, |size, v| v.abs().max_element().max(size));
        let middle = hull.vertices().iter().sum::<DVec3>() / hull.vertices().len() as f64;
        for _ in 0..20 {
            let corner = hull.vertices()[draw.below(hull.vertices().len())];
            let point = middle + draw.unit() * (corner - middle) + 0.05 * scale * draw.ball();
            let depth = (hull.faces())
                .map(|face| face.offset - face.normal.dot(point))
                .fold(f64::INFINITY, f64::min);
            if depth.abs() > GRAZE * size {
                assert_eq!(hull.contains_point(point), depth > 0.0);
                let hit = hull.first_hit(&Ray::new(point, draw.direction()));
                assert_eq!(hit == Some(RayHit::Inside), depth > 0.0);
            }
            inside += usize::from(depth > 0.0);
        }
    }
    assert!((600..=5_400).contains(&inside), "{inside} inside of 6000");
}

/// A long prism: two faces with hundreds of neighbours, and cells whose faces look away.
#[test]
fn needles_and_plates_are_hit_from_everywhere() {
    let mut draw = Draw::new(25);
    for height in [1e-3, 1.0, 1e3] {
        let points = (0..400).map(|i| {
            let angle = f64::from(i / 2) * std::f64::consts::TAU / 200.0;
            DVec3::new(
                angle.cos(),
                angle.sin(),
                if i % 2 == 0 { -height } else { height },
            )
        });
        let hull = Arc::new(Polytope::from_points(points).unwrap());
        let case = case(&hull);
        let mut hits = 0;
        for _ in 0..150 {
            let ball = draw.ball();
            let target = ball * DVec3::new(1.2, 1.2, 1.2 * height);
            let distance = draw.log(0.1, 1e4);
            hits += usize::from(check(&case, &draw.ray_through(target, distance)));
        }
        assert!((40..=148).contains(&hits), "{hits} hits of 150");
    }
}
