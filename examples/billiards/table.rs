//! A billiard table without friction: what collides when is the world's
//! business, what follows from it is ours.

use feeler::tolerance::MIN_TIME_STEP;
use feeler::{Body, BodyId, CollisionWorld, Contact, Cuboid, Motion, Sphere};
use glam::DVec3;
use std::error::Error;

/// Radius and mass of every ball, in metres and kilograms.
pub(crate) const RADIUS: f64 = 0.028_575;
pub(crate) const MASS: f64 = 0.17;
/// The cloth between the cushions, in metres; its corner is the origin.
pub(crate) const LENGTH: f64 = 2.54;
pub(crate) const WIDTH: f64 = 1.27;
/// How wide the cushions are, in metres.
pub(crate) const CUSHION: f64 = 0.05;

/// Two things met.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hit {
    /// Seconds since the start.
    pub(crate) time: f64,
    pub(crate) ball: usize,
    pub(crate) target: Target,
    pub(crate) point: DVec3,
    /// How fast they closed in, in metres per second.
    pub(crate) speed: f64,
}

/// What a ball hits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Target {
    Ball(usize),
    /// Left, right, near, far.
    Cushion(usize),
}

pub(crate) struct Table {
    world: CollisionWorld,
    /// The cue ball, then the nine others.
    balls: Vec<BodyId>,
    cushions: Vec<BodyId>,
    /// What the cushions have given to the balls, in newton seconds.
    pub(crate) impulse: DVec3,
    pub(crate) hits: Vec<Hit>,
    /// Where each ball's way began and where it bounced.
    bounces: Vec<Vec<DVec3>>,
}

/// Where the cue ball starts and the diamond's nine balls lie, each touching its neighbours.
pub(crate) fn rack() -> [DVec3; 10] {
    let foot = DVec3::new(0.75 * LENGTH, 0.5 * WIDTH, 0.0);
    let row = RADIUS * DVec3::new(3.0_f64.sqrt(), 1.0, 0.0);
    let place = |row_x: f64, row_y: f64| foot + DVec3::new(row_x, row_y, 0.0) * row;
    [
        DVec3::new(0.25 * LENGTH, 0.5 * WIDTH, 0.0),
        place(0.0, 0.0),
        place(1.0, -1.0),
        place(1.0, 1.0),
        place(2.0, -2.0),
        place(2.0, 2.0),
        place(3.0, -1.0),
        place(3.0, 1.0),
        place(4.0, 0.0),
        place(2.0, 0.0),
    ]
}

/// The four cushions: half extents and centre. Their corners overlap, so that nothing slips out.
pub(crate) fn cushions() -> [(DVec3, DVec3); 4] {
    let (x, y, edge) = (0.5 * LENGTH, 0.5 * WIDTH, 0.5 * CUSHION);
    let short = DVec3::new(edge, y + CUSHION, 2.0 * RADIUS);
    let long = DVec3::new(x + CUSHION, edge, 2.0 * RADIUS);
    [
        (short, DVec3::new(-edge, y, 0.0)),
        (short, DVec3::new(LENGTH + edge, y, 0.0)),
        (long, DVec3::new(x, -edge, 0.0)),
        (long, DVec3::new(x, WIDTH + edge, 0.0)),
    ]
}

impl Table {
    /// The balls racked, and the cue ball with this velocity.
    pub(crate) fn new(cue_velocity: DVec3) -> Result<Self, Box<dyn Error>> {
        let mut world = CollisionWorld::default();
        let mut balls = Vec::new();
        for position in rack() {
            let motion = Motion::free(position, DVec3::ZERO)?;
            balls.push(world.insert(Body::moving(Sphere::new(RADIUS)?, motion))?);
        }
        world.set_velocity(balls[0], cue_velocity)?;
        let mut rim = Vec::new();
        for (half_extents, centre) in cushions() {
            rim.push(world.insert(Body::fixed(Cuboid::new(half_extents)?, centre))?);
        }
        Ok(Self {
            world,
            balls,
            cushions: rim,
            impulse: DVec3::ZERO,
            hits: Vec::new(),
            bounces: rack().map(|start| vec![start]).to_vec(),
        })
    }

    /// Plays on until `time`, stopping at every touch to let the balls bounce.
    ///
    /// A touch sets bodies free that touch others: those meet at the same
    /// moment, and the next call stops again without time having passed. In
    /// this way the blow runs through the rack, ball by ball.
    pub(crate) fn play_until(&mut self, time: f64) -> Result<(), Box<dyn Error>> {
        loop {
            let left = time - self.world.time();
            if left < MIN_TIME_STEP {
                return Ok(());
            }
            let contacts = self.world.step_to_contact(left)?.contacts.to_vec();
            for contact in &contacts {
                self.bounce(contact)?;
            }
        }
    }

    /// Bounces two bodies off each other, without loss.
    fn bounce(&mut self, contact: &Contact) -> Result<(), Box<dyn Error>> {
        let Contact { a, b, .. } = *contact;
        // The cloth keeps the balls in its plane, against rounding too.
        let normal = contact.normal.with_z(0.0).normalize();
        let velocities = [self.world.velocity(a)?, self.world.velocity(b)?];
        let speed = (velocities[1] - velocities[0]).dot(normal);
        if speed <= 0.0 {
            // Another bounce of the same moment has parted them already.
            return Ok(());
        }
        let Some(ball) = self.balls.iter().position(|&id| id == a) else {
            return Err("a cushion has moved".into());
        };
        let target = match self.balls.iter().position(|&id| id == b) {
            Some(other) => {
                // Of equal masses, each takes over the other's speed along the normal.
                self.world.set_velocity(a, velocities[0] + speed * normal)?;
                self.world.set_velocity(b, velocities[1] - speed * normal)?;
                Target::Ball(other)
            }
            None => {
                let change = 2.0 * speed * normal;
                self.world.set_velocity(a, velocities[0] + change)?;
                self.impulse += MASS * change;
                let side = self.cushions.iter().position(|&id| id == b);
                Target::Cushion(side.ok_or("the ball hit something unknown")?)
            }
        };
        self.bounces[ball].push(self.world.pose(a)?.position);
        if let Target::Ball(other) = target {
            self.bounces[other].push(self.world.pose(b)?.position);
        }
        self.hits.push(Hit {
            time: contact.time,
            ball,
            target,
            point: contact.point,
            speed,
        });
        Ok(())
    }

    /// Every ball's way so far, from bounce to bounce.
    pub(crate) fn tracks(&self) -> Result<Vec<Vec<DVec3>>, Box<dyn Error>> {
        let mut tracks = self.bounces.clone();
        for (track, position) in tracks.iter_mut().zip(self.positions()?) {
            track.push(position);
        }
        Ok(tracks)
    }

    pub(crate) fn positions(&self) -> Result<Vec<DVec3>, Box<dyn Error>> {
        let position = |&id| Ok(self.world.pose(id)?.position);
        self.balls.iter().map(position).collect()
    }

    pub(crate) fn velocities(&self) -> Result<Vec<DVec3>, Box<dyn Error>> {
        let velocity = |&id| Ok(self.world.velocity(id)?);
        self.balls.iter().map(velocity).collect()
    }

    /// Kinetic energy of all balls, in joules.
    pub(crate) fn energy(&self) -> Result<f64, Box<dyn Error>> {
        let squares = self.velocities()?.into_iter().map(DVec3::length_squared);
        Ok(0.5 * MASS * squares.sum::<f64>())
    }

    /// Momentum of all balls, in newton seconds.
    pub(crate) fn momentum(&self) -> Result<DVec3, Box<dyn Error>> {
        Ok(MASS * self.velocities()?.into_iter().sum::<DVec3>())
    }

    /// Whether every ball lies between the cushions.
    pub(crate) fn all_on_table(&self) -> Result<bool, Box<dyn Error>> {
        let on = |at: &DVec3| (0.0..=LENGTH).contains(&at.x) && (0.0..=WIDTH).contains(&at.y);
        Ok(self.positions()?.iter().all(on))
    }

    /// How deep any two balls are in each other, or any ball in a cushion, or
    /// outside the cloth, at the most; negative if all are apart. In metres.
    pub(crate) fn deepest(&self) -> Result<f64, Box<dyn Error>> {
        let positions = self.positions()?;
        let mut deepest = f64::NEG_INFINITY;
        for (index, &ball) in positions.iter().enumerate() {
            let rim = [ball.x, LENGTH - ball.x, ball.y, WIDTH - ball.y];
            let to_rim = rim.into_iter().fold(f64::INFINITY, f64::min);
            deepest = deepest.max(RADIUS - to_rim).max(ball.z.abs());
            for &other in &positions[..index] {
                deepest = deepest.max(2.0 * RADIUS - ball.distance(other));
            }
        }
        Ok(deepest)
    }
}
