//! Polytopes that stand somewhere, small ones above all, against every triangle in twice the precision:
//! rays that come near to edges and vertices or graze, by anything from rounding to the body's size.
//!
//! `CASTS=200 SEED=7 cargo test --release --test raycast glances` looks at so many times as many.

use crate::cases::Draw;
use crate::oracle;
use feeler::{Feature, Polytope, Pose, Ray, RayCast, RayHit, SurfacePoint};
use glam::{DQuat, DVec3};

/// Hulls of every kind, from thin to round, with their frame's origin inside, outside or far away.
fn hull(draw: &mut Draw, scale: f64) -> Polytope {
    let count = [4, 5, 6, 8, 12, 12, 12, 18, 19, 30][draw.below(10)];
    let thin = [1.0, 0.3, 0.01, 1e-4][draw.below(4)];
    let stretch = DVec3::new(1.0, draw.between(thin, 1.0), draw.between(thin, 1.0));
    let on_sphere = draw.unit() < 0.5;
    let away = [0.0, 0.5, 3.0, 12.0, 40.0][draw.below(5)] * draw.ball();
    let turn = draw.turn();
    loop {
        // Some on a grid, with faces of many corners and along the axes.
        let grid = draw.unit() < 0.2;
        let point = || {
            let point = draw.ball();
            if grid {
                return (2.0 * point).round() + away.round();
            }
            let point = if on_sphere { point.normalize() } else { point };
            away + turn * (stretch * point)
        };
        let points: Vec<DVec3> = std::iter::repeat_with(point).take(count).collect();
        if let Ok(hull) = Polytope::from_points(points.into_iter().map(|point| scale * point)) {
            return hull;
        }
    }
}

/// A point on the surface and the ways along it: an edge and across it.
fn target(draw: &mut Draw, hull: &Polytope) -> DVec3 {
    let edge = hull.edges()[draw.below(hull.edges().len())];
    let [from, to] = edge.vertices.map(|v| hull.vertices()[v as usize]);
    from.lerp(to, [0.0, 1.0, 0.5, draw.unit()][draw.below(4)])
}

#[test]
fn glances_agree_with_every_triangle() {
    let number = |name: &str, otherwise: u64| {
        std::env::var(name).map_or(otherwise, |number| number.parse().unwrap())
    };
    let mut draw = Draw::new(number("SEED", 30));
    let (mut hits, mut misses, mut by_walk) = (0, 0, 0);
    let hulls = 400 * number("CASTS", 1);
    for _ in 0..hulls {
        let scale = draw.log(1e-6, 1e6);
        let hull = hull(&mut draw, scale);
        let size = (hull.vertices().iter()).fold(0.0, |size: f64, v| v.length().max(size));
        let middle = hull.vertices().iter().sum::<DVec3>() / hull.vertices().len() as f64;
        let radius = hull.max_dist();
        let pose = match draw.below(4) {
            0 => Pose::IDENTITY,
            1 => Pose::at(scale * draw.ball()),
            _ => Pose::new(scale * draw.log(0.1, 1e3) * draw.ball(), draw.turn()),
        };
        for _ in 0..25 {
            let aim = if draw.unit() < 0.5 {
                middle + 1.1 * radius * draw.ball()
            } else {
                let off = radius * draw.log(1e-16, 1.0) * draw.ball();
                target(&mut draw, &hull) + off
            };
            let direction = match draw.below(4) {
                // Along a face, or nearly.
                0 => {
                    let normal = hull.face_normals()[draw.below(hull.face_normals().len())];
                    let along = draw.direction().reject_from(normal).normalize();
                    along + [0.0, 0.0, draw.log(1e-16, 0.1)][draw.below(3)] * normal
                }
                1 => DVec3::AXES[draw.below(3)],
                _ => draw.direction(),
            };
            let distance = radius * draw.log(1e-3, 1e8) * [1.0, 1.0, 1.0, -1.0][draw.below(4)];
            let length = [1.0, distance.abs(), draw.log(1e-8, 1e8)][draw.below(3)];
            let local = Ray::new(aim - distance * direction, length * direction);
            let ray = Ray::new(pose.point(local.origin), pose.direction(local.direction));
            // What rounding leaves of it: the same but for turning it back.
            let local = Ray::new(
                pose.local_point(ray.origin),
                pose.local_direction(ray.direction),
            );
            let corners = |t: &[u32; 3]| t.map(|v| hull.vertices()[v as usize]);
            let cast = |ray: &Ray| oracle::triangles(ray, hull.triangles().iter().map(corners));
            let want = cast(&local);
            let got = hull.first_hit_at(&pose, &ray);
            let about = || format!("{pose:?} {ray:?}: got {got:?}, want {want:?} of {hull:?}");
            // For the hit, for turning there and back, and for faces that their own corners lie off of.
            let coordinates = ray.origin.length() + pose.position.length() + size;
            let allowed = 128.0 * f64::EPSILON * coordinates;
            // What a glance cannot tell is the walk's business, and the walk's tests'.
            let walked = hull.first_hit(&local).map(|hit| match hit {
                RayHit::Surface(point) => RayHit::Surface(SurfacePoint {
                    normal: pose.direction(point.normal),
                    ..point
                }),
                RayHit::Inside => RayHit::Inside,
            });
            let speed = ray.direction.length();
            let plain = got.is_some_and(|hit| {
                hit.surface().is_some_and(|point| {
                    let rate = point.normal.dot(ray.direction).abs();
                    rate > 0.1 * speed && point.fraction * speed > 1e-5 * size
                })
            });
            if got == walked && got.is_some() && !plain {
                by_walk += 1;
                continue;
            }
            match (want, got) {
                (None, None) => misses += 1,
                (None, Some(RayHit::Surface(point))) => {
                    // A ghost must be a graze, and as near to the body as rounding is large.
                    let point = local.at(point.fraction);
                    let mut faces = hull.faces();
                    let near = faces.all(|face| face.normal.dot(point) <= face.offset + allowed);
                    assert!(near, "a ghost: {}", about());
                }
                (None, Some(RayHit::Inside)) => panic!("a glance inside: {}", about()),
                (Some((enter, leave)), got) => {
                    match got {
                        None => assert!(leave * speed <= allowed, "a miss: {}", about()),
                        Some(RayHit::Inside) => panic!("a glance inside: {}", about()),
                        Some(RayHit::Surface(point)) => {
                            hits += 1;
                            let rate = point.normal.dot(ray.direction);
                            // On the surface, where the line comes in.
                            let at = local.at(point.fraction);
                            let heights = hull.faces().map(|f| f.normal.dot(at) - f.offset);
                            let off = heights.fold(f64::NEG_INFINITY, f64::max);
                            assert!(off.abs() <= allowed, "off by {off:e}: {}", about());
                            let late = (point.fraction - 0.5 * (enter + leave)) * speed;
                            assert!(late <= 10.0 * allowed, "late by {late:e}: {}", about());
                            if let Some(RayHit::Surface(walked)) = hull.first_hit(&local) {
                                let off = (point.fraction - walked.fraction).abs() * rate.abs();
                                assert!(off <= 0.125 * allowed, "off by {off:e}: {}", about());
                            }
                            assert!(point.fraction >= 0.0 && rate <= 1e-15 * speed);
                            let Feature::Face(face) = point.feature else {
                                panic!("no face: {}", about())
                            };
                            let normal = pose.direction(hull.face_normals()[face as usize]);
                            assert!(normal.distance(point.normal) < 1e-15, "{}", about());
                            // The very face.
                            let height = hull.face_normals()[face as usize].dot(at)
                                - hull.face_offsets()[face as usize];
                            assert!(height >= -allowed, "another face: {}", about());
                        }
                    }
                }
            }
        }
    }
    let all = 25 * hulls;
    assert!((all / 8..all / 2).contains(&hits), "{hits} of {all}");
    assert!(
        misses > all / 10 && by_walk > all / 50,
        "{misses} {by_walk} {all}"
    );
}

/// What a glance looks at in single precision must not be out of its range, nor nothing but rounding.
#[test]
fn extreme_rays_are_left_to_the_walk() {
    let cube =
        (0..8).map(|i| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)));
    let cube = Polytope::from_points(cube.map(|corner| 2.0 * corner - 1.0)).unwrap();
    let pose = Pose::new([3.0, 4.0, 5.0], DQuat::from_rotation_z(0.3));
    for length in [1e-290, 1e-40, 1e-7, 1.0, 1e7, 1e40, 1e300] {
        for distance in [2.0, 1e3, 1e7, 1e12] {
            let to = pose.point(DVec3::new(0.25, 0.5, 1.0));
            let ray = Ray::new(to + distance * DVec3::Z, -length * DVec3::Z);
            let hit = cube.first_hit_at(&pose, &ray).unwrap().surface().unwrap();
            let off = hit.fraction * length - distance;
            assert!(
                off.abs() < 1e-15 * distance.max(10.0),
                "{length} {distance} {off:e}"
            );
            assert!(hit.normal.distance(DVec3::Z) < 1e-15);
            let past = Ray::new(ray.origin + 3.0 * DVec3::X, ray.direction);
            assert_eq!(cube.first_hit_at(&pose, &past), None);
            let away = Ray::new(ray.origin, -ray.direction);
            assert_eq!(cube.first_hit_at(&pose, &away), None);
        }
    }
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for axis in 0..3 {
            let mut ray = Ray::new(DVec3::ONE, DVec3::ONE);
            ray.origin[axis] = bad;
            assert_eq!(cube.first_hit_at(&pose, &ray), None);
            let mut ray = Ray::new(DVec3::ONE, DVec3::ONE);
            ray.direction[axis] = bad;
            assert_eq!(cube.first_hit_at(&pose, &ray), None);
        }
    }
    // Along its faces, on them and beside them by a hair.
    for (height, hits) in [
        (1.0, true),
        (1.0 + 1e-9, false),
        (1.0 - 1e-9, true),
        (1.1, false),
    ] {
        for axis in 0..3 {
            let mut origin = DVec3::splat(0.1);
            origin[(axis + 1) % 3] = height;
            origin[axis] = -5.0;
            let ray = Ray::new(origin, DVec3::AXES[axis]);
            let hit = cube.first_hit_at(&Pose::IDENTITY, &ray);
            assert_eq!(
                hit.map(|hit| hit.fraction()),
                hits.then_some(4.0),
                "{height}"
            );
        }
    }
}
