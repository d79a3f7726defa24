//! The casts that every contender is given.

use crate::random::{Random, single, single_vector};
use glam::{DQuat, DVec3};

/// A shape, in its own frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Solid {
    /// Casting it is casting a ray.
    Point,
    /// A ball of this radius.
    Ball(f64),
    /// A box with these half extents.
    Cuboid(DVec3),
    Triangle([DVec3; 3]),
    /// The convex hull of these points.
    Hull(Vec<DVec3>),
}

impl Solid {
    /// The corners whose hull, grown by [`radius`](Self::radius), is the shape.
    pub fn corners(&self) -> Vec<DVec3> {
        match self {
            Self::Point | Self::Ball(_) => vec![DVec3::ZERO],
            Self::Cuboid(half) => (0..8)
                .map(|corner| {
                    let sign = |bit: u32| if corner >> bit & 1 == 0 { -1.0 } else { 1.0 };
                    *half * DVec3::new(sign(0), sign(1), sign(2))
                })
                .collect(),
            Self::Triangle(vertices) => vertices.to_vec(),
            Self::Hull(points) => points.clone(),
        }
    }

    pub fn radius(&self) -> f64 {
        match self {
            Self::Ball(radius) => *radius,
            _ => 0.0,
        }
    }

    /// Largest distance from the frame's origin to the surface.
    pub fn reach(&self) -> f64 {
        let corner = |corner: &DVec3| corner.length();
        self.radius() + self.corners().iter().map(corner).fold(0.0, f64::max)
    }
}

/// What a set's shapes are drawn from, sizes in units of the set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Point,
    Ball,
    Box,
    /// A box a hundred times as wide as thick.
    Slab,
    Triangle,
    /// The hull of so many points on an ellipsoid: all of them are corners.
    Hull(usize),
}

impl Kind {
    pub fn name(self) -> String {
        match self {
            Self::Point => "ray".into(),
            Self::Ball => "ball".into(),
            Self::Box => "box".into(),
            Self::Slab => "slab".into(),
            Self::Triangle => "triangle".into(),
            Self::Hull(points) => format!("hull{points}"),
        }
    }

    /// A shape of this kind, its numbers exact in `f32`.
    fn solid(self, random: &mut Random, unit: f64) -> Solid {
        match self {
            Self::Point => Solid::Point,
            Self::Ball => Solid::Ball(single(unit * random.between(0.3, 1.0))),
            Self::Box => Solid::Cuboid(single_vector(unit * random.vector(0.3, 1.0))),
            Self::Slab => {
                let wide = random.between(0.5, 1.0);
                let half = DVec3::new(wide, random.between(0.5, 1.0), 0.01 * wide);
                Solid::Cuboid(single_vector(unit * half))
            }
            Self::Triangle => loop {
                let corners = [(); 3].map(|()| random.vector(-1.0, 1.0));
                let [a, b, c] = corners;
                if (b - a).cross(c - a).length() > 0.3 {
                    break Solid::Triangle(corners.map(|corner| single_vector(unit * corner)));
                }
            },
            Self::Hull(points) => {
                let axes = random.vector(0.5, 1.0);
                let point = |_| single_vector(unit * axes * random.direction());
                Solid::Hull((0..points).map(point).collect())
            }
        }
    }

    /// How many different shapes a set has.
    fn variety(self) -> usize {
        match self {
            Self::Point => 1,
            Self::Hull(points) if points > 500 => 8,
            Self::Hull(points) if points > 50 => 32,
            _ => 256,
        }
    }
}

/// A shape somewhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placed {
    /// Its number in [`CastSet::solids`].
    pub solid: usize,
    pub position: DVec3,
    /// As `f32` has it: of unit length only to the rounding of `f32`.
    pub orientation: DQuat,
}

impl Placed {
    /// The orientation meant: of unit length to the rounding of `f64`.
    pub fn unit_orientation(&self) -> DQuat {
        self.orientation.normalize()
    }
}

/// `a` moves straight by `motion`, `b` stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cast {
    pub a: Placed,
    pub b: Placed,
    pub motion: DVec3,
}

/// Casts of one kind of pair.
pub struct CastSet {
    pub kinds: [Kind; 2],
    pub solids: Vec<Solid>,
    pub casts: Vec<Cast>,
}

impl CastSet {
    /// `count` casts of bodies about `unit` metres large.
    ///
    /// The bodies start well apart, `a` flies past or into `b`, and some
    /// motions end before they would touch. All numbers are exact in `f32`, so that
    /// every contender is given the same.
    pub fn new(kinds: [Kind; 2], unit: f64, count: usize, seed: u64) -> Self {
        let mut random = Random::new(seed);
        let mut solids = Vec::new();
        let ranges = kinds.map(|kind| {
            let start = solids.len();
            solids.extend((0..kind.variety()).map(|_| kind.solid(&mut random, unit)));
            (start, solids.len())
        });
        // So that a third to two thirds of the casts hit.
        let thin = |kind: &Kind| matches!(kind, Kind::Slab | Kind::Triangle);
        let spread = if kinds.iter().any(thin) { 0.85 } else { 1.15 };
        let reaches: Vec<f64> = solids.iter().map(Solid::reach).collect();
        let casts = (0..count)
            .map(|number| {
                let [a, b] = ranges.map(|(start, end)| start + number % (end - start));
                let reach = reaches[a] + reaches[b];
                let towards = random.direction();
                let aside = towards.any_orthonormal_vector();
                let turn = DQuat::from_axis_angle(towards, random.between(0.0, 6.3));
                let offset = spread * reach * random.unit().sqrt() * (turn * aside);
                let distance = reach * random.between(1.5, 4.0);
                let target = random.vector(-5.0, 5.0) * unit;
                let placed = |solid, position, orientation: DQuat| Placed {
                    solid,
                    position: single_vector(position),
                    orientation: orientation.as_quat().as_dquat(),
                };
                Cast {
                    a: placed(
                        a,
                        target - distance * towards + offset,
                        random.orientation(),
                    ),
                    b: placed(b, target, random.orientation()),
                    motion: single_vector(distance * random.between(0.6, 2.5) * towards),
                }
            })
            .collect();
        Self {
            kinds,
            solids,
            casts,
        }
    }

    pub fn name(&self) -> String {
        self.kinds.map(Kind::name).join("–")
    }

    /// The pair's size: how far its bodies reach, together.
    pub fn size(&self, cast: &Cast) -> f64 {
        self.solids[cast.a.solid].reach() + self.solids[cast.b.solid].reach()
    }
}
