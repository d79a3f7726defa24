//! The bodies of a workload, and what a caller of either library keeps of them.

use feeler::{Body, BodyId, CollisionWorld, Cuboid, Motion, Polytope, Shape, Sphere};
use glam::{DQuat, DVec3};
use parry3d::shape::SharedShape;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use std::error::Error;

/// Sixty frames a second.
pub(crate) const DT: f64 = 1.0 / 60.0;

#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Kind {
    Balls,
    Boxes,
    Hulls,
    /// Radii from 2 mm to 2 m, evenly over the logarithms.
    Sizes,
    /// 99 % of the balls within 1 % of the space.
    Cluster,
    /// 99 % of the balls stand.
    Still,
    /// All at 1000 m/s.
    Fast,
}

impl Kind {
    pub(crate) const ALL: [(&'static str, Self); 7] = [
        ("balls", Self::Balls),
        ("boxes", Self::Boxes),
        ("hulls", Self::Hulls),
        ("sizes", Self::Sizes),
        ("cluster", Self::Cluster),
        ("still", Self::Still),
        ("fast", Self::Fast),
    ];
}

pub(crate) struct Mote {
    pub(crate) id: BodyId,
    pub(crate) shape: SharedShape,
    pub(crate) turn: DQuat,
    pub(crate) place: DVec3,
    pub(crate) velocity: DVec3,
    /// Half the edge of the cube that it keeps to.
    half: f64,
}

pub(crate) struct Crowd {
    pub(crate) world: CollisionWorld,
    pub(crate) motes: Vec<Mote>,
    /// Half the edge of the cube that all keep to.
    pub(crate) half: f64,
    pub(crate) random: ChaCha8Rng,
}

pub(crate) fn unit(random: &mut ChaCha8Rng) -> f64 {
    (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

pub(crate) fn vector(random: &mut ChaCha8Rng) -> DVec3 {
    let mut coordinate = || 2.0 * unit(random) - 1.0;
    DVec3::new(coordinate(), coordinate(), coordinate())
}

fn shapes(
    kind: Kind,
    size: f64,
    random: &mut ChaCha8Rng,
) -> Result<(Shape, SharedShape), Box<dyn Error>> {
    Ok(match kind {
        Kind::Boxes => {
            let half = 0.8 * size;
            let theirs = SharedShape::cuboid(half as f32, half as f32, half as f32);
            (Cuboid::new(DVec3::splat(half))?.into(), theirs)
        }
        Kind::Hulls => {
            let points: Vec<_> = (0..12).map(|_| size * vector(random).normalize()).collect();
            let singles: Vec<_> = points.iter().map(|&point| super::single(point)).collect();
            let theirs = SharedShape::convex_hull(&singles).ok_or("parry makes no hull")?;
            (Polytope::from_points(points)?.into(), theirs)
        }
        _ => (Sphere::new(size)?.into(), SharedShape::ball(size as f32)),
    })
}

impl Crowd {
    /// 5 % of a cube are filled.
    pub(crate) fn new(kind: Kind, count: usize) -> Result<Self, Box<dyn Error>> {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let sizes: Vec<f64> = (0..count)
            .map(|_| match kind {
                Kind::Sizes => 2.0 * 10_f64.powf(-3.0 * unit(&mut random)),
                _ => 0.3 + 0.4 * unit(&mut random),
            })
            .collect();
        let volume: f64 = sizes.iter().map(|size| 4.19 * size.powi(3)).sum();
        let half = 0.5 * (volume / 0.05).cbrt();
        let mut world = CollisionWorld::default();
        let mut motes = Vec::new();
        for (number, size) in sizes.into_iter().enumerate() {
            let (ours, shape) = shapes(kind, size, &mut random)?;
            let half = match kind {
                Kind::Cluster if !number.is_multiple_of(100) => half * 0.01_f64.cbrt(),
                _ => half,
            };
            let place = half * vector(&mut random);
            let speed = match kind {
                Kind::Still if !number.is_multiple_of(100) => 0.0,
                Kind::Fast => 1000.0,
                _ => 10.0 * unit(&mut random),
            };
            let velocity = speed * vector(&mut random).normalize();
            let turn = match kind {
                Kind::Boxes | Kind::Hulls => {
                    DQuat::from_axis_angle(vector(&mut random).normalize(), 3.0)
                }
                _ => DQuat::IDENTITY,
            };
            let motion = if speed > 0.0 {
                Motion::free(place, velocity)?
            } else {
                Motion::fixed(place)?
            };
            let id = world.insert(Body::moving(ours, motion).oriented(turn))?;
            motes.push(Mote {
                id,
                shape,
                turn,
                place,
                velocity,
                half,
            });
        }
        Ok(Self {
            world,
            motes,
            half,
            random,
        })
    }

    /// A frame later: the walls throw back whoever has left.
    pub(crate) fn reflect(&mut self) -> Result<(), Box<dyn Error>> {
        for mote in &mut self.motes {
            mote.place += DT * mote.velocity;
            let outside = mote.place.abs().cmpgt(DVec3::splat(mote.half));
            let inwards = DVec3::select(outside, -mote.place.signum(), mote.velocity.signum());
            let turned = mote.velocity.abs() * inwards;
            if turned != mote.velocity {
                mote.velocity = turned;
                self.world.set_velocity(mote.id, turned)?;
            }
        }
        Ok(())
    }
}
