//! The nearest bodies, against brute force with distances of its own.

use super::worlds::{Crowd, Random};
use super::{all, world};
use feeler::{
    Body, CollisionWorld, Cuboid, Motion, Polytope, Pose, QueryFilter, Ray, Shape, Sphere, Triangle,
};
use glam::{DQuat, DVec3};

fn to_segment(point: DVec3, from: DVec3, to: DVec3) -> f64 {
    let along = to - from;
    let share = ((point - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    point.distance(from + share * along)
}

/// Over all faces and edges.
fn to_polytope(point: DVec3, hull: &Polytope) -> f64 {
    let planes = || hull.face_normals().iter().zip(hull.face_offsets());
    let height = |at: DVec3, (normal, offset): (&DVec3, &f64)| normal.dot(at) - offset;
    let most = planes()
        .map(|plane| height(point, plane))
        .fold(f64::MIN, f64::max);
    if most <= 0.0 {
        return most;
    }
    let vertex = |index: u32| hull.vertices()[index as usize];
    let edges = hull.edges().iter();
    let edges =
        edges.map(|edge| to_segment(point, vertex(edge.vertices[0]), vertex(edge.vertices[1])));
    let faces = planes().filter_map(|plane| {
        let above = height(point, plane);
        let foot = point - above * plane.0;
        let inside = planes().all(|other| height(foot, other) <= 1e-12);
        (above > 0.0 && inside).then_some(above)
    });
    edges.chain(faces).fold(f64::INFINITY, f64::min)
}

fn distance(point: DVec3, shape: &Shape, pose: &Pose) -> f64 {
    let local = pose.orientation.inverse() * (point - pose.position);
    match shape {
        Shape::Sphere(ball) => local.length() - ball.radius(),
        Shape::Cuboid(cuboid) => {
            let half = cuboid.half_extents();
            let excess = local.abs() - half;
            if excess.max_element() <= 0.0 {
                excess.max_element()
            } else {
                local.distance(local.clamp(-half, half))
            }
        }
        Shape::Polytope(hull) => to_polytope(local, hull),
        _ => f64::NAN,
    }
}

#[test]
fn nearest_bodies_are_those_that_brute_force_finds() {
    let rounds = std::env::var("WORLDS").map_or(6, |worlds| worlds.parse().unwrap());
    let none = QueryFilter::default();
    for crowd in Crowd::ALL {
        let (mut inside, mut asked) = (0, 0);
        for round in 0..rounds {
            let mut random = Random::seeded(4_000 + 10 * round + crowd as u64);
            let world = world(crowd, &mut random);
            let middle = all(&world)
                .next()
                .map_or(DVec3::ZERO, |(_, _, pose)| pose.position);
            for _ in 0..20 {
                let point = middle + 8.0 * random.unit() * random.vector();
                let count = random.below(12);
                let found = world.nearest(point, count, &none).unwrap();
                let bodies = all(&world);
                let mut expected: Vec<_> = bodies
                    .map(|(id, shape, pose)| (distance(point, shape, &pose), id))
                    .collect();
                expected.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
                assert_eq!(found.len(), count.min(expected.len()));
                let slack = 1e-14 * (1.0 + point.abs().max_element()) + 1e-13;
                for (hit, (nearest, _)) in found.iter().zip(&expected) {
                    let context = format!("{crowd:?} {round} {point} {hit:?} {nearest}");
                    assert!((hit.distance - nearest).abs() <= slack, "{context}");
                    // The body named is as near as is said, and the point lies on it.
                    let (shape, pose) = (
                        world.shape(hit.body).unwrap(),
                        world.pose(hit.body).unwrap(),
                    );
                    assert!(
                        (distance(point, shape, &pose) - hit.distance).abs() <= slack,
                        "{context}"
                    );
                    assert!(
                        distance(hit.point, shape, &pose).abs() <= slack,
                        "{context}"
                    );
                    inside += usize::from(hit.distance < 0.0);
                    asked += 1;
                }
            }
        }
        println!("{crowd:?}: {inside} of {asked} inside");
        assert!(asked > 50, "lopsided, {crowd:?}: {asked}");
    }
}

#[test]
fn a_point_beside_a_triangle_is_nearest_to_an_edge_or_a_corner() {
    let mut world = CollisionWorld::default();
    let corners = [DVec3::ZERO, 4.0 * DVec3::X, 4.0 * DVec3::Y];
    let triangle = Triangle::new(corners[0], corners[1], corners[2]).unwrap();
    world.insert(Body::fixed(triangle, [0.0; 3])).unwrap();
    let all = QueryFilter::default();
    let cases = [
        (DVec3::new(1.0, 1.0, 2.0), 2.0, DVec3::new(1.0, 1.0, 0.0)),
        (DVec3::new(1.0, -3.0, 0.0), 3.0, DVec3::new(1.0, 0.0, 0.0)),
        (DVec3::new(-3.0, -4.0, 0.0), 5.0, DVec3::ZERO),
    ];
    for (point, distance, foot) in cases {
        let found = world.nearest(point, 3, &all).unwrap();
        assert_eq!(found.len(), 1);
        assert!((found[0].distance - distance).abs() <= 1e-15);
        assert!(found[0].point.distance(foot) <= 1e-15);
        assert!(world.nearest(point, 0, &all).unwrap().is_empty());
    }
}

/// A bar that has turned by a quarter is found where it lies now, by every query.
#[test]
fn queries_see_spinning_bodies_as_they_are_turned_now() {
    let mut world = CollisionWorld::default();
    let bar = Cuboid::new([3.0, 0.1, 0.1]).unwrap();
    let rate = std::f64::consts::FRAC_PI_2;
    let motion = Motion::free([0.0; 3], [0.0; 3]).unwrap();
    let motion = motion.spin(DVec3::Z, rate).unwrap();
    let id = world.insert(Body::moving(bar, motion)).unwrap();
    let all = QueryFilter::default();
    let ball = Shape::from(Sphere::new(0.5).unwrap());
    let probes = |world: &CollisionWorld, at: DVec3| {
        let above = Ray::new(at + 5.0 * DVec3::Z, -DVec3::Z);
        let down = -5.0 * DVec3::Z;
        let from = Pose::at(at - down);
        [
            world
                .cast_ray(&above, f64::INFINITY, &all)
                .unwrap()
                .is_some(),
            world
                .cast(&ball, &from, 2.0 * down, &all)
                .unwrap()
                .is_some(),
            !world
                .overlaps(&ball, &Pose::at(at), &all)
                .unwrap()
                .is_empty(),
            world.nearest(at, 1, &all).unwrap()[0].distance < 0.0,
        ]
    };
    let (x, y) = (2.5 * DVec3::X, 2.5 * DVec3::Y);
    assert_eq!(
        (probes(&world, x), probes(&world, y)),
        ([true; 4], [false; 4])
    );
    for _ in 0..10 {
        world.step(0.1).unwrap();
    }
    assert_eq!(
        (probes(&world, x), probes(&world, y)),
        ([false; 4], [true; 4])
    );
    let turned = world.pose(id).unwrap().orientation;
    assert!(turned.angle_between(DQuat::from_rotation_z(rate)) < 1e-9);
}
