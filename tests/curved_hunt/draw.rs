//! Random pairs that may meet.

use crate::course::{Pace, Turning};
use crate::look::Look;
use crate::plan::{Form, Plan, Trip};
use crate::random::Random;
use feeler::{AtEnd, Facing, Knots};
use glam::DVec3;

pub(crate) struct Draw {
    pub(crate) plans: [Plan; 2],
    /// What the pair lies about.
    pub(crate) base: DVec3,
    pub(crate) horizon: f64,
    /// How far both bodies reach, together.
    pub(crate) size: f64,
    pub(crate) grazing: bool,
}

fn form(random: &mut Random, size: f64) -> Form {
    match random.below(8) {
        0 | 1 => Form::Ball(size),
        2 => Form::Cuboid(size * (DVec3::splat(0.2) + 0.37 * random.vector().abs())),
        3 => Form::Cuboid(size * DVec3::new(1.0, 0.02, random.within(0.02, 0.7))),
        4 => loop {
            let corners = [(); 3].map(|()| random.direction());
            let [a, b, c] = corners;
            if (b - a).cross(c - a).length() > 0.1 {
                return Form::Triangle(corners.map(|corner| size * corner));
            }
        },
        5 => {
            // Its origin is not inside.
            let aside = 0.7 * random.direction();
            let corner = |random: &mut Random| size * (aside + 0.3 * random.direction());
            Form::Hull((0..4).map(|_| corner(random)).collect())
        }
        _ => {
            let axes = [DVec3::ONE, DVec3::new(1.0, 0.6, 0.1)][random.below(2) as usize];
            let count = 4 + random.below(17);
            Form::Hull(
                (0..count)
                    .map(|_| size * axes * random.direction())
                    .collect(),
            )
        }
    }
}

/// Around which points a body goes.
struct Place {
    far: DVec3,
    scale: f64,
    side: f64,
}

impl Place {
    fn start(&self, random: &mut Random) -> DVec3 {
        let aside = 1.6 * self.side * random.vector().abs() + 1.2 * random.vector();
        self.far + self.scale * aside
    }

    fn point(&self, random: &mut Random) -> DVec3 {
        self.far + 1.3 * self.scale * random.vector()
    }
}

fn trip(random: &mut Random, place: &Place, horizon: f64) -> Trip {
    let start = place.start(random);
    let kind = random.below(8);
    let points = |random: &mut Random, more: u64| {
        let mut points = vec![start];
        points.extend((0..=random.below(more)).map(|_| place.point(random)));
        points
    };
    match kind {
        0 => Trip::Still(start),
        1 => {
            let way = place.far + 0.8 * place.scale * random.vector() - start;
            Trip::Free(start, random.decades(-0.3, 0.5) / horizon * way)
        }
        2 => Trip::Line([start, place.point(random)]),
        3 => {
            let pieces = 1 + random.below(3);
            let mut control = vec![start];
            control.extend((0..3 * pieces).map(|_| place.point(random)));
            Trip::Bezier(control)
        }
        4 => {
            let points = points(random, 4);
            let tangent = |_: &DVec3| 3.0 * place.scale * random.vector();
            let tangents = points.iter().map(tangent).collect();
            Trip::Tangents(points, tangents)
        }
        5 => {
            let points = points(random, 4);
            let tangents = [(); 2].map(|()| 3.0 * place.scale * random.vector());
            Trip::Ends(points, tangents)
        }
        _ => {
            let mut points = points(random, 6);
            if points.len() > 2 && random.one_in(2) {
                points.push(start);
            }
            let knots = [Knots::Uniform, Knots::Centripetal][random.below(2) as usize];
            Trip::CatmullRom(points, knots)
        }
    }
}

fn turning(random: &mut Random, trip: &Trip, size: f64, horizon: f64) -> Turning {
    let on_path = !matches!(trip, Trip::Still(_) | Trip::Free(..));
    let rate = if random.one_in(12) {
        // Many turns.
        random.decades(1.5, 3.0)
    } else {
        random.decades(-1.0, 1.5)
    } / horizon;
    let rate = if random.one_in(2) { rate } else { -rate };
    match random.below(6) {
        0 | 1 => Turning::Spin {
            point: DVec3::ZERO,
            axis: random.direction(),
            rate,
        },
        2 => Turning::Spin {
            point: 0.7 * size * random.vector(),
            axis: random.direction(),
            rate,
        },
        3 if on_path => {
            let forward = random.direction();
            let up = random.direction();
            if forward.cross(up).length() < 0.1 {
                return Turning::Not;
            }
            Turning::Facing(Facing {
                forward,
                up,
                world_up: random.direction(),
            })
        }
        _ => Turning::Not,
    }
}

fn plan(random: &mut Random, place: &Place, size: f64, horizon: f64) -> Plan {
    let trip = trip(random, place, horizon);
    let mut plan = Plan {
        form: form(random, size),
        turning: turning(random, &trip, size, horizon),
        trip,
        pace: Pace {
            speed: 1.0,
            at_end: AtEnd::Rest,
            offset: 0.0,
            wait: 0.0,
        },
        oriented: (random.direction(), random.within(0.0, 6.0)),
    };
    if let Some(path) = plan.path() {
        let laps = if random.one_in(8) {
            random.decades(0.0, 1.5)
        } else {
            random.decades(-0.3, 0.3)
        };
        plan.pace.speed = laps * path.length() / horizon;
        let closed = path.start() == path.end();
        plan.pace.at_end = match random.below(3) {
            0 => AtEnd::Rest,
            _ if closed => AtEnd::Loop,
            _ => AtEnd::Return,
        };
        if random.one_in(4) {
            plan.pace.offset = random.within(0.0, 1.5) * path.length();
        }
        if random.one_in(4) {
            plan.pace.wait = random.within(0.0, 0.7) * horizon;
        }
    }
    plan
}

impl Draw {
    pub(crate) fn new(seed: u64) -> Self {
        let random = &mut Random::seeded(seed);
        let scale = random.decades(-3.0, 3.0);
        let horizon = random.decades(-2.0, 3.0);
        let far = if random.one_in(4) {
            scale * random.decades(0.0, 5.0) * random.direction()
        } else {
            DVec3::ZERO
        };
        let sizes = [(); 2].map(|()| {
            let small = if random.one_in(8) { -2.0 } else { -0.7 };
            scale * random.decades(small, 0.0)
        });
        let plans = [(1.0, sizes[0]), (-1.0, sizes[1])]
            .map(|(side, size)| plan(random, &Place { far, scale, side }, size, horizon));
        let size = plans
            .each_ref()
            .map(|plan| plan.shape().max_dist())
            .iter()
            .sum();
        let mut draw = Self {
            plans,
            base: far,
            horizon,
            size,
            grazing: false,
        };
        if random.one_in(6) {
            draw.grazing = draw.graze(random);
        }
        draw
    }

    /// Bodies that miss each other, brought together until they nearly or just meet.
    fn graze(&mut self, random: &mut Random) -> bool {
        let [a, b] = self.plans.each_ref().map(|plan| plan.actor(self.base));
        let look = Look::at(&a, &b, self.horizon, 1e-4 * self.size);
        let (least, _, normal) = look.least;
        if look.touch.is_some() || !look.resolved || least > 10.0 * self.size {
            return false;
        }
        let off = self.size * random.decades(-7.0, -3.0);
        let off = if random.one_in(2) { off } else { -off };
        self.plans[1] = self.plans[1].clone().shifted((least + off) * normal);
        true
    }
}
