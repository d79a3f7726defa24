//! What bodies in touch share, and the normals that part them, against brute force.

use crate::bodies::{self, Body, direction, index, log, signed, unit};
use feeler::narrow_phase::exact::{contact_patch, crossing, normal_cone, touch};
use feeler::{Cuboid, Polytope, Pose, Shape};
use glam::{DQuat, DVec2, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// Whether a point lies in a convex polygon, to within `slack`.
fn holds(polygon: &[DVec2], point: DVec2, slack: f64) -> bool {
    (0..polygon.len()).all(|i| {
        let along = polygon[(i + 1) % polygon.len()] - polygon[i];
        along.perp_dot(point - polygon[i]) >= -slack * along.length()
    })
}

/// All corners that the intersection of two convex polygons can have, by trying each.
fn common(a: &[DVec2], b: &[DVec2], slack: f64) -> Vec<DVec2> {
    let mut corners: Vec<DVec2> = Vec::new();
    corners.extend(a.iter().filter(|&&p| holds(b, p, slack)));
    corners.extend(b.iter().filter(|&&p| holds(a, p, slack)));
    for i in 0..a.len() {
        for j in 0..b.len() {
            let (p, q) = (a[i], b[j]);
            let (u, v) = (a[(i + 1) % a.len()] - p, b[(j + 1) % b.len()] - q);
            let cross = u.perp_dot(v);
            if cross.abs() > 1e-9 * u.length() * v.length() {
                let (s, t) = ((q - p).perp_dot(v) / cross, (q - p).perp_dot(u) / cross);
                if (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) {
                    corners.push(p + s * u);
                }
            }
        }
    }
    corners
}

#[test]
fn faces_that_meet_share_the_polygon_that_brute_force_finds() {
    let mut rng = ChaCha8Rng::seed_from_u64(31);
    let mut sizes = [0; 9];
    for _ in 0..4000 {
        let scale = log(&mut rng, 1e-3, 1e3);
        let mut half = || scale * DVec3::new(0.1 + unit(&mut rng), 0.1 + unit(&mut rng), 0.2);
        let (half_a, half_b) = (half(), half());
        let frame = DQuat::from_axis_angle(direction(&mut rng), 3.0 * signed(&mut rng));
        let spin = DQuat::from_rotation_z(3.0 * signed(&mut rng));
        let aside = scale * DVec3::new(signed(&mut rng), signed(&mut rng), 0.0);
        let above = frame * (aside + (half_a.z + half_b.z) * DVec3::Z);
        let (a, b) = (bodies::cuboid(half_a).shape, bodies::cuboid(half_b).shape);
        let far = 1e3 * scale * direction(&mut rng);
        let pose_a = Pose::new(far + above, frame * spin);
        let pose_b = Pose::new(far, frame);
        let found = contact_patch(&a, &pose_a, &b, &pose_b, frame * DVec3::Z);
        let rectangle = |half: DVec3| {
            [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
                .map(|(x, y)| DVec3::new(x * half.x, y * half.y, 0.0))
        };
        let flat_a = rectangle(half_a).map(|p| (spin * p + aside).truncate());
        let flat_b = rectangle(half_b).map(DVec3::truncate);
        let (slack, near) = (1e-11 * scale, 1e-10 * scale);
        let want = common(&flat_a, &flat_b, slack);
        let locals: Vec<DVec3> = found.iter().map(|&p| frame.inverse() * p).collect();
        if want.is_empty() {
            assert_eq!(found.len(), 1, "{locals:?}");
            continue;
        }
        sizes[found.len().min(8)] += 1;
        for corner in &want {
            let met = |p: &DVec3| p.truncate().distance(*corner) < near;
            assert!(locals.iter().any(met), "{corner} not in {locals:?}");
        }
        for point in &locals {
            assert!((point.z - half_b.z).abs() < near);
            assert!(
                want.iter().any(|c| c.distance(point.truncate()) < near),
                "{point}"
            );
        }
        // Counter-clockwise, seen from above.
        for i in 0..locals.len() {
            let [p, q, r] = [0, 1, 2].map(|k| locals[(i + k) % locals.len()].truncate());
            assert!((q - p).perp_dot(r - q) > -near * scale, "{locals:?}");
        }
    }
    assert!(
        sizes[3] > 100 && sizes[4] > 100 && sizes[6] > 100,
        "{sizes:?}"
    );
}

#[test]
fn parallel_edges_share_a_segment_and_crossing_ones_a_point() {
    let cube = bodies::cuboid(DVec3::ONE).shape;
    let turned = DQuat::from_rotation_x(std::f64::consts::FRAC_PI_4);
    let root = std::f64::consts::SQRT_2;
    let (low, high) = (
        Pose::new(DVec3::ZERO, turned),
        Pose::new(DVec3::new(0.5, 0.0, 2.0 * root), turned),
    );
    let mut ends = contact_patch(&cube, &high, &cube, &low, DVec3::Z);
    ends.sort_by(|p, q| p.x.total_cmp(&q.x));
    assert_eq!(ends.len(), 2, "{ends:?}");
    assert!((ends[0] - DVec3::new(-0.5, 0.0, root)).length() < 1e-14);
    assert!((ends[1] - DVec3::new(1.0, 0.0, root)).length() < 1e-14);

    let across = DQuat::from_rotation_z(0.7) * turned;
    let crossed = Pose::new(DVec3::new(0.1, 0.0, 2.0 * root), across);
    let points = contact_patch(&cube, &crossed, &cube, &low, DVec3::Z);
    assert_eq!(points.len(), 1);
    assert!((points[0] - DVec3::new(0.1, 0.0, root)).length() < 1e-14);
}

/// How far a body reaches along a direction.
fn reach(body: &Body, turn: DQuat, direction: DVec3) -> f64 {
    let heights = body.hull.points.iter().map(|&p| direction.dot(turn * p));
    heights.fold(f64::NEG_INFINITY, f64::max)
}

#[test]
fn the_cone_holds_all_normals_that_part_and_no_others() {
    let mut rng = ChaCha8Rng::seed_from_u64(32);
    let (mut wide, mut single, mut inside, mut outside) = (0, 0, 0, 0);
    for _ in 0..600 {
        let scale = log(&mut rng, 1e-3, 1e3);
        let (a, b) = (
            bodies::random(&mut rng, scale),
            bodies::random(&mut rng, scale),
        );
        let turns =
            [(); 2].map(|()| DQuat::from_axis_angle(direction(&mut rng), 3.0 * signed(&mut rng)));
        // A vertex of A on a vertex, an edge or a face of B, pushed apart till they touch.
        let along = direction(&mut rng);
        let summit = |body: &Body, turn: DQuat, along: DVec3| {
            let best = body
                .hull
                .points
                .iter()
                .max_by(|p, q| along.dot(turn * **p).total_cmp(&along.dot(turn * **q)));
            turn * *best.unwrap()
        };
        let at_b = summit(&b, turns[1], along);
        let at_a = summit(&a, turns[0], -along);
        let vertex_on_vertex = index(&mut rng, 2) == 0;
        let (between, point) = if vertex_on_vertex {
            (at_b - at_a, at_b)
        } else {
            let start = 4.0 * (a.shape.max_dist() + b.shape.max_dist()) * along;
            let poses = [Pose::new(start, turns[0]), Pose::new(DVec3::ZERO, turns[1])];
            let Some(found) = touch(&a.shape, &poses[0], &b.shape, &poses[1], -start) else {
                continue;
            };
            (start - found.fraction * start, found.point)
        };
        let poses = [
            Pose::new(between, turns[0]),
            Pose::new(DVec3::ZERO, turns[1]),
        ];
        let corners = normal_cone(&a.shape, &poses[0], &b.shape, &poses[1], point);
        let size = a.shape.max_dist() + b.shape.max_dist();
        let gap = |n: DVec3| n.dot(between) - reach(&a, turns[0], -n) - reach(&b, turns[1], n);
        assert!(!corners.is_empty(), "vertex on vertex {vertex_on_vertex}");
        for &corner in &corners {
            assert!((corner.length() - 1.0).abs() < 1e-12);
            assert!(gap(corner) > -1e-8 * size, "{}", gap(corner) / size);
        }
        single += usize::from(corners.len() == 1);
        wide += usize::from(corners.len() > 2);
        for _ in 0..40 {
            // Every combination of the corners parts them too.
            let weights: Vec<f64> = corners.iter().map(|_| unit(&mut rng).powi(3)).collect();
            let sum: DVec3 = corners.iter().zip(&weights).map(|(&c, &w)| w * c).sum();
            if let Some(normal) = sum.try_normalize() {
                assert!(gap(normal) > -1e-7 * size);
                inside += 1;
            }
            // What parts them is on no plane's far side that has all corners on its near side.
            let normal = (corners[0] + 0.7 * direction(&mut rng)).normalize();
            if gap(normal) > -1e-13 * size {
                for _ in 0..50 {
                    let plane = direction(&mut rng);
                    if corners.iter().all(|corner| plane.dot(*corner) < -1e-6) {
                        assert!(plane.dot(normal) < 1e-6, "{normal} beyond {corners:?}");
                    }
                }
                outside += 1;
            }
        }
    }
    assert!(single > 50 && wide > 50, "{single} {wide}");
    assert!(inside > 5000 && outside > 200, "{inside} {outside}");
}

#[test]
fn balls_share_a_point_and_one_normal() {
    let ball = Shape::from(feeler::Sphere::new(2.0).unwrap());
    let cube = bodies::cuboid(DVec3::ONE).shape;
    let (above, below) = (Pose::at([0.5, 0.0, 3.0]), Pose::IDENTITY);
    let foot = DVec3::new(0.5, 0.0, 1.0);
    assert_eq!(
        contact_patch(&ball, &above, &cube, &below, DVec3::Z),
        [foot]
    );
    assert_eq!(normal_cone(&ball, &above, &cube, &below, foot), [DVec3::Z]);
    // Not in touch there.
    assert!(normal_cone(&ball, &above, &cube, &below, DVec3::Z).is_empty());
}

#[test]
fn a_normal_of_any_length_says_where_to_look() {
    let cube = Shape::from(Cuboid::new(DVec3::ONE).unwrap());
    let above = Pose::at([0.5, 0.25, 2.0]);
    let patch = |normal| contact_patch(&cube, &above, &cube, &Pose::IDENTITY, normal);
    let corners = patch(DVec3::Z);
    assert_eq!(corners.len(), 4);
    for length in [1e-300, 0.5, 2.0, 1e300] {
        assert_eq!(patch(length * DVec3::Z), corners);
    }
    for none in [DVec3::ZERO, DVec3::NAN, DVec3::INFINITY] {
        assert!(patch(none).is_empty());
    }
}

#[test]
fn what_a_face_shares_with_a_needle_level_but_for_a_hair_lies_on_the_needle() {
    // The needle's edges are out of level by picometres; its lowest corner is beside the face.
    let face = [
        [
            -0.2643528661679899,
            -0.13217643308399496,
            0.13217643308399496,
        ],
        [
            0.13217643308399496,
            -0.13217643308399496,
            0.13217643308399496,
        ],
        [
            0.13217643308399496,
            0.2643528661679899,
            -0.13217643308399496,
        ],
        [0.13217643308399496, -0.13217643308399496, 0.0],
    ];
    let needle = [
        [
            -0.00012054896256557099,
            -0.00012054896044426317,
            -0.264352870168188,
        ],
        [
            0.00012054896144246054,
            -0.00012054895947764401,
            -0.2643528733065898,
        ],
        [
            -0.00012054896517734961,
            0.00012054896413255156,
            -0.26435285607600695,
        ],
        [
            0.0001205489613060068,
            0.00012054896237572455,
            -0.26435285970225014,
        ],
        [
            -0.000120548964537174,
            -0.00012054896374209973,
            0.2643528695030357,
        ],
        [
            0.00012054896834789689,
            -0.00012054896536934299,
            0.2643528574674613,
        ],
        [
            -0.00012054896143703254,
            0.00012054896256955947,
            0.2643528679794918,
        ],
        [
            0.00012054896456622337,
            0.00012054896446167125,
            0.2643528556869981,
        ],
    ];
    let a = Shape::from(Polytope::from_points(face).unwrap());
    let b = Shape::from(Polytope::from_points(needle).unwrap());
    let between = DVec3::new(
        0.0008043736555007053,
        0.0005500646019297607,
        0.00146152583381205,
    );
    let motion = DVec3::new(48919.16769597415, -32768.2796133247, 85166.53385405878);
    let found = crossing(&a, &Pose::at(between), &b, &Pose::IDENTITY, motion).unwrap();
    let landed = Pose::at(between + found.enter.fraction * motion);
    let corners = contact_patch(&a, &landed, &b, &Pose::IDENTITY, found.enter.normal);
    assert!(!corners.is_empty());
    for corner in corners {
        assert!(corner.y.abs() < 1.21e-4, "{corner}");
    }
}
