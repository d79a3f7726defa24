//! Where bodies are and how they are turned, by the formulas of the thesis.

use crate::route::Route;
use feeler::{AtEnd, Facing};
use glam::{DMat3, DVec3};

/// How a body's carried point goes.
pub(crate) enum Way {
    Free { from: DVec3, velocity: DVec3 },
    Line { from: DVec3, to: DVec3, pace: Pace },
    Curve { route: Route, pace: Pace },
}

/// How fast a path is walked, and what comes before and after.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pace {
    pub(crate) speed: f64,
    pub(crate) at_end: AtEnd,
    pub(crate) offset: f64,
    pub(crate) wait: f64,
}

impl Pace {
    /// The distance along a path of this length.
    fn distance(&self, length: f64, time: f64) -> f64 {
        let flown = self.offset + self.speed * (time - self.wait).max(0.0);
        match self.at_end {
            AtEnd::Rest => flown.min(length),
            AtEnd::Loop => flown.rem_euclid(length),
            AtEnd::Return => {
                let flown = flown.rem_euclid(2.0 * length);
                flown.min(2.0 * length - flown)
            }
        }
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) enum Turning {
    Not,
    Spin {
        point: DVec3,
        axis: DVec3,
        rate: f64,
    },
    Facing(Facing),
}

pub(crate) struct Course {
    pub(crate) way: Way,
    pub(crate) turning: Turning,
    /// How the body is turned as its motion begins.
    pub(crate) turned: DMat3,
}

/// A body's origin and axes.
#[derive(Clone, Copy)]
pub(crate) struct Stand {
    pub(crate) at: DVec3,
    pub(crate) turned: DMat3,
    /// Where the point is that the motion carries.
    pub(crate) hub: DVec3,
}

impl Stand {
    pub(crate) fn point(&self, local: DVec3) -> DVec3 {
        self.at + self.turned * local
    }
}

/// `r` turned about a unit vector `d`: the thesis, B.1 to B.4.
pub(crate) fn turn(r: DVec3, d: DVec3, angle: f64) -> DVec3 {
    let along = r.dot(d) * d;
    let x = r - along;
    let y = d.cross(r);
    along + angle.cos() * x + angle.sin() * y
}

/// The axes turned.
pub(crate) fn axes(d: DVec3, angle: f64) -> DMat3 {
    let [x, y, z] = DVec3::AXES.map(|axis| turn(axis, d, angle));
    DMat3::from_cols(x, y, z)
}

/// Forward, left, up.
fn frame(forward: DVec3, up: DVec3) -> DMat3 {
    let left = up.cross(forward).normalize_or(DVec3::ZERO);
    DMat3::from_cols(forward, left, forward.cross(left))
}

impl Course {
    fn carried(&self, time: f64) -> (DVec3, DVec3) {
        match &self.way {
            Way::Free { from, velocity } => (*from + time * *velocity, DVec3::X),
            Way::Line { from, to, pace } => {
                let length = from.distance(*to);
                let tangent = (*to - *from) / length;
                let distance = pace.distance(length, time);
                (*from + distance * tangent, tangent)
            }
            Way::Curve { route, pace } => route.at(pace.distance(route.length(), time)),
        }
    }

    pub(crate) fn at(&self, time: f64) -> Stand {
        let (carried, tangent) = self.carried(time);
        match &self.turning {
            Turning::Not => Stand {
                at: carried,
                turned: self.turned,
                hub: carried,
            },
            Turning::Spin { point, axis, rate } => {
                let turned = axes(*axis, rate * time) * self.turned;
                let hub = carried + self.turned * *point;
                Stand {
                    at: hub - turned * *point,
                    turned,
                    hub,
                }
            }
            Turning::Facing(facing) => {
                let own = frame(facing.forward.normalize(), facing.up.normalize());
                let turned = frame(tangent, facing.world_up.normalize()) * own.transpose();
                Stand {
                    at: carried,
                    turned,
                    hub: carried,
                }
            }
        }
    }

    /// The highest speed of the hub.
    pub(crate) fn speed(&self) -> f64 {
        match &self.way {
            Way::Free { velocity, .. } => velocity.length(),
            Way::Line { pace, .. } | Way::Curve { pace, .. } => pace.speed,
        }
    }

    /// The same between two times: nothing before it sets out and after it has come.
    pub(crate) fn speed_between(&self, from: f64, to: f64) -> f64 {
        let (pace, length) = match &self.way {
            Way::Free { velocity, .. } => return velocity.length(),
            Way::Line { from, to, pace } => (pace, from.distance(*to)),
            Way::Curve { route, pace } => (pace, route.length()),
        };
        let flown = pace.offset + pace.speed * (from - pace.wait).max(0.0);
        let is_over = pace.at_end == AtEnd::Rest && flown > length;
        if to < pace.wait || is_over {
            0.0
        } else {
            pace.speed
        }
    }

    /// The hub in the body's own frame.
    pub(crate) fn pivot(&self) -> DVec3 {
        match &self.turning {
            Turning::Spin { point, .. } => *point,
            Turning::Not | Turning::Facing(_) => DVec3::ZERO,
        }
    }

    /// Radians per second; none if that depends on the path.
    pub(crate) fn rate(&self) -> Option<f64> {
        match &self.turning {
            Turning::Not => Some(0.0),
            Turning::Spin { rate, .. } => Some(rate.abs()),
            Turning::Facing(_) => None,
        }
    }
}
