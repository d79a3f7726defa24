//! Casts of shapes that start in touch, or end in touch, with every kind of motion: as in a frame.

use feeler::{
    Body, CollisionWorld, ContactKind, Cuboid, Method, Motion, Polytope, Pose, QueryFilter, Shape,
    Sphere, Triangle, first_contact,
};
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Multiples of half a metre, so that shapes meet exactly.
struct Lattice(ChaCha8Rng);

impl Lattice {
    fn below(&mut self, count: u64) -> u64 {
        self.0.next_u64() % count
    }

    fn point(&mut self, reach: u64) -> DVec3 {
        DVec3::from_array(std::array::from_fn(|_| {
            0.5 * (self.below(2 * reach + 1) as f64 - reach as f64)
        }))
    }

    fn shape(&mut self) -> Shape {
        loop {
            let shape = match self.below(4) {
                0 => Sphere::new(0.5 + 0.5 * self.below(3) as f64)
                    .ok()
                    .map(Shape::from),
                1 => Cuboid::new(self.point(2).abs()).ok().map(Shape::from),
                2 => {
                    let [a, b, c] = [self.point(2), self.point(2), self.point(2)];
                    Triangle::new(a, b, c).ok().map(Shape::from)
                }
                _ => {
                    let points: Vec<DVec3> = (0..7).map(|_| self.point(2)).collect();
                    Polytope::from_points(points).ok().map(Shape::from)
                }
            };
            if let Some(shape) = shape {
                return shape;
            }
        }
    }

    fn turn(&mut self) -> DQuat {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        match self.below(4) {
            0 => DQuat::from_xyzw(0.0, 0.0, half, half),
            1 => DQuat::from_xyzw(half, 0.0, 0.0, half),
            2 => DQuat::from_xyzw(0.5, 0.5, 0.5, 0.5),
            _ => DQuat::IDENTITY,
        }
    }
}

#[test]
fn a_cast_tells_of_touches_what_a_frame_tells() {
    let mut lattice = Lattice(ChaCha8Rng::seed_from_u64(44));
    let (mut touches, mut none) = (0, 0);
    for _ in 0..20_000 {
        let (shape, other) = (lattice.shape(), lattice.shape());
        let pose = Pose::new(lattice.point(4), lattice.turn());
        let stands = Pose::new(lattice.point(3), lattice.turn());
        let motion = lattice.point(6);
        if motion == DVec3::ZERO {
            continue;
        }
        let free = Motion::free(pose.position, motion).unwrap();
        let mover = Body::moving(shape.clone(), free).oriented(pose.orientation);
        let stander = Body::fixed(other, stands.position).oriented(stands.orientation);
        let mut world = CollisionWorld::default();
        world.insert(stander.clone()).unwrap();
        let cast = world
            .cast(&shape, &pose, motion, &QueryFilter::default())
            .unwrap();
        let frame = first_contact(&mover, &stander, 1.0, &Method::Exact).unwrap();
        assert_eq!(
            cast.is_some(),
            frame.is_some(),
            "{cast:?} or {frame:?} of {mover:?} and {stander:?}"
        );
        if let (Some(cast), Some(frame)) = (cast, frame) {
            assert!((cast.distance - frame.fraction * motion.length()).abs() < 1e-12);
            touches += usize::from(matches!(frame.kind, ContactKind::Touch));
        } else {
            none += 1;
        }
    }
    assert!(
        touches > 1_000 && none > 1_000,
        "{touches} touches, {none} misses"
    );
}
