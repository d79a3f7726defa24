//! Drawn rays against the oracle.

use crate::cases::{Case, Draw};
use feeler::{Ray, RayHit, raycast::GRAZE};
use glam::DVec3;

/// The module's promise: how far off the surface a hit may lie.
fn allowed(case: &Case, ray: &Ray) -> f64 {
    16.0 * f64::EPSILON * (case.size + ray.origin.abs().max_element())
}

/// The line moved towards the shape's middle by `by`.
fn nearer(ray: &Ray, middle: DVec3, by: f64) -> Ray {
    let to_middle = middle - ray.origin;
    let aside = to_middle.reject_from(ray.direction);
    Ray {
        origin: ray.origin + by * aside.normalize_or_zero(),
        ..*ray
    }
}

/// Checks one ray; true if it hits.
pub(crate) fn check(case: &Case, ray: &Ray) -> bool {
    let allowed = allowed(case, ray);
    let (got, want) = (case.shape.line_span(ray), (case.oracle)(ray));
    let about = format!("{} {ray:?}: got {got:?}, want {want:?}", case.name);
    let Some((enter, leave)) = want else {
        if got.is_some() {
            // A ghost must be a graze: the line moved in by so little does hit.
            let moved = nearer(ray, case.middle, 4.0 * allowed);
            assert!((case.oracle)(&moved).is_some(), "a ghost: {about}");
        }
        return false;
    };
    let Some(span) = got else {
        panic!("a miss: {about}")
    };
    for (point, want) in [(span.enter, enter), (span.leave, leave)] {
        assert!((point.normal.length() - 1.0).abs() < 1e-14, "{about}");
        let off = (point.fraction - want).abs() * point.normal.dot(ray.direction).abs();
        assert!(
            off <= allowed,
            "off by {off:e}, allowed {allowed:e}: {about}"
        );
    }
    assert!(span.enter.normal.dot(ray.direction) <= GRAZE * ray.direction.length());
    assert!(span.leave.normal.dot(ray.direction) >= -GRAZE * ray.direction.length());
    match case.shape.first_hit(ray) {
        Some(RayHit::Surface(point)) => {
            assert_eq!(point, span.enter, "{about}");
            assert!(point.fraction > 0.0, "{about}");
        }
        Some(RayHit::Inside) => assert!(enter <= 0.0 && leave >= 0.0, "{about}"),
        None => assert!(leave < 0.0, "{about}"),
    }
    true
}

#[test]
fn drawn_rays_agree_with_the_oracle() {
    for (seed, make) in Case::MAKERS.into_iter().enumerate() {
        let mut draw = Draw::new(seed as u64);
        let (mut hits, mut name) = (0, "");
        for _ in 0..4_000 {
            let scale = draw.log(1e-6, 1e6);
            let case = make(&mut draw, scale);
            let target = case.middle + 0.8 * scale * draw.ball();
            let distance = scale * draw.log(1e-2, 1e6) * [-1.0, 1.0][draw.below(2)];
            let ray = draw.ray_through(target, distance);
            hits += usize::from(check(&case, &ray));
            name = case.name;
        }
        assert!((400..=3_600).contains(&hits), "{name}: {hits} hits of 4000");
    }
}

/// Twelve orders of magnitude away the coordinates themselves are coarse; nothing worse may come of it.
#[test]
fn far_origins_cost_no_more_than_their_coordinates() {
    for (seed, make) in Case::MAKERS.into_iter().enumerate() {
        let mut draw = Draw::new(100 + seed as u64);
        let mut hits = 0;
        for _ in 0..1_000 {
            let case = make(&mut draw, 1e3);
            let target = case.middle + 1e3 * draw.ball();
            let ray = draw.ray_through(target, 1e12);
            hits += usize::from(check(&case, &ray));
        }
        assert!((50..=950).contains(&hits), "{seed}: {hits} hits of 1000");
    }
}

/// Points on the surface, edges and corners of boxes, aimed at from outside.
#[test]
fn planted_box_points_are_hit_where_they_were_planted() {
    let mut draw = Draw::new(7);
    for _ in 0..5_000 {
        let scale = draw.log(1e-6, 1e6);
        let case = Case::cuboid(&mut draw, scale);
        let half = {
            // The half-extents, from rays along the axes.
            let along = |axis: DVec3| {
                let ray = Ray::new(DVec3::ZERO, axis);
                case.shape
                    .line_span(&ray)
                    .map_or(0.0, |span| span.leave.fraction)
            };
            DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z))
        };
        let mut share = DVec3::from_array(std::array::from_fn(|_| draw.between(-1.0, 1.0)));
        // One, two or three coordinates on the surface: a face, an edge, a corner.
        for _ in 0..3 {
            let axis = draw.below(3);
            share[axis] = 1.0_f64.copysign(share[axis]);
        }
        let target = share * half;
        let direction = draw.direction();
        let distance = scale * draw.log(0.1, 1e3);
        let ray = Ray::new(target - distance * direction, direction);
        let span = case
            .shape
            .line_span(&ray)
            .expect("an edge or corner is part of the box");
        let allowed = allowed(&case, &ray);
        let nearest = [span.enter, span.leave]
            .into_iter()
            .map(|point| (point.fraction - distance).abs() * point.normal.dot(direction).abs())
            .fold(f64::INFINITY, f64::min);
        assert!(nearest <= allowed, "{nearest:e} {allowed:e} {ray:?}");
    }
}

/// Lines that touch a sphere, moved in and out by a few ulp.
#[test]
fn tangents_hit_and_lines_beyond_miss() {
    let mut draw = Draw::new(8);
    for _ in 0..5_000 {
        let scale = draw.log(1e-6, 1e6);
        let case = Case::sphere(&mut draw, scale);
        let normal = draw.direction();
        let direction = normal.any_orthonormal_vector();
        let distance = scale * draw.log(0.1, 1e3);
        let line = |offset: f64| {
            Ray::new(
                (case.size + offset) * normal - distance * direction,
                direction,
            )
        };
        let ulp = f64::EPSILON * (case.size + distance);
        for ulps in [-8.0, -1.0, 0.0, 0.5] {
            let span = case
                .shape
                .line_span(&line(ulps * ulp))
                .expect("a tangent hits");
            let at = 0.5 * (span.enter.fraction + span.leave.fraction);
            assert!((at - distance).abs() <= 16.0 * ulp, "{at} {distance}");
        }
        for ulps in [64.0, 1e6] {
            assert_eq!(
                case.shape.line_span(&line(ulps * ulp)),
                None,
                "scale {scale}"
            );
        }
    }
}

/// A fan of triangles without a gap: lines through shared edges and corners hit some triangle.
#[test]
fn shared_edges_let_nothing_through() {
    use feeler::{RayCast, Triangle};
    let mut draw = Draw::new(9);
    let mut by_both = 0;
    for _ in 0..3_000 {
        let scale = draw.log(1e-6, 1e6);
        let hub = scale * draw.ball();
        let normal = draw.direction();
        let (x, y) = normal.any_orthonormal_pair();
        let rim: Vec<DVec3> = (0..5)
            .map(|i| {
                let angle = f64::from(i) * std::f64::consts::TAU / 5.0 + draw.between(0.0, 1.0);
                let lift = draw.between(-0.3, 0.3) * normal;
                hub + scale * (angle.cos() * x + angle.sin() * y + lift)
            })
            .collect();
        let fan: Vec<Triangle> = (0..5)
            .map(|i| Triangle::new(hub, rim[i], rim[(i + 1) % 5]).unwrap())
            .collect();
        let on_edge = hub.lerp(rim[draw.below(5)], [0.0, draw.unit()][draw.below(2)]);
        let direction = (normal + 0.5 * draw.ball()).normalize();
        let ray = Ray::new(on_edge - scale * draw.log(0.1, 1e3) * direction, direction);
        let hits = fan
            .iter()
            .filter(|triangle| triangle.line_span(&ray).is_some())
            .count();
        assert!(hits >= 1, "{ray:?}");
        by_both += usize::from(hits >= 2);
    }
    assert!(
        by_both > 1_500,
        "the lines do not meet the edges: {by_both}"
    );
}
