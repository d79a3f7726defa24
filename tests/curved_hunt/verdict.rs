//! What the crate says against what the oracle saw.

use crate::draw::Draw;
use crate::gap::{apart, gap};
use crate::look::{Actor, Look, above};
use crate::plan::Plan;
use feeler::tolerance::TOUCH;
use feeler::{Body, ContactKind, FirstContactError, Method, PairContact, first_contact};

/// How a case came out.
#[derive(Debug)]
pub(crate) enum Verdict {
    /// The same touch; share of the horizon between both times, of the pair's size between the bodies.
    Hit {
        late: f64,
        gap: f64,
    },
    /// The same touch, where they come together so slowly that times differ.
    SlowHit,
    /// The same touch, in which one turns at once into the other.
    Jump,
    Miss,
    /// One saw a touch of less than the oracle resolves, and the other did not.
    Graze,
    Overlap,
    /// It said up to when they are apart, and so they are. How far then, as a share of the pair's size.
    Undecided {
        near: f64,
    },
    /// The oracle cannot tell.
    Unknown,
    Wrong(String),
}

/// Share of the pair's size from grazing within which either answer is right.
const GRAZE: f64 = 1e-6;

/// Share of the horizon.
const LATE: f64 = 1e-8;

pub(crate) struct Pair {
    pub(crate) bodies: [Body; 2],
    pub(crate) actors: [Actor; 2],
    pub(crate) horizon: f64,
    pub(crate) size: f64,
    /// Metres of rounding in the coordinates and angles given.
    pub(crate) rounding: f64,
    /// Metres that count as touching, as [`feeler::tolerance::TOUCH`] has it.
    touch: f64,
    pub(crate) draw: Draw,
}

impl Pair {
    pub(crate) fn new(draw: Draw) -> Self {
        let bodies = draw.plans.each_ref().map(Plan::body);
        let actors = draw.plans.each_ref().map(|plan| plan.actor(draw.base));
        let turned: f64 = (actors.iter())
            .map(|actor| actor.course.rate().unwrap_or(0.0) * draw.horizon)
            .sum();
        let ways: f64 = actors
            .iter()
            .map(|actor| actor.course.speed() * draw.horizon)
            .sum();
        let coordinate = draw.base.length() + 4.0 * draw.size + ways;
        let rounding = 16.0 * f64::EPSILON * (coordinate + turned * draw.size);
        Self {
            bodies,
            actors,
            horizon: draw.horizon,
            size: draw.size,
            rounding,
            touch: TOUCH * (draw.size + coordinate),
            draw,
        }
    }

    pub(crate) fn above(&self, time: f64) -> f64 {
        above(&self.actors[0], &self.actors[1], time)
    }

    /// The least height between two times.
    fn lowest(&self, from: f64, to: f64) -> f64 {
        let share = |step: i32| from + f64::from(step) / 64.0 * (to - from);
        (0..=64)
            .map(|step| self.above(share(step)))
            .fold(f64::MAX, f64::min)
    }

    pub(crate) fn look(&self) -> Look {
        Look::at(
            &self.actors[0],
            &self.actors[1],
            self.horizon,
            1e-7 * self.size,
        )
    }

    pub(crate) fn verdict(&self) -> Verdict {
        let [a, b] = &self.bodies;
        let found = first_contact(a, b, self.horizon, &Method::Exact);
        let start = self.above(0.0);
        let slack = 1e-9 * self.size + self.rounding;
        if start.abs() <= slack + self.touch {
            return Verdict::Unknown;
        }
        if start < 0.0 {
            return match found {
                Ok(Some(found)) => self.overlap(&found),
                other => Verdict::Wrong(format!("overlaps by {start:e}, but {other:?}")),
            };
        }
        if let Ok(Some(found)) = &found
            && let Some(off) = self.mirrored(found)
        {
            return Verdict::Wrong(format!("seen from the other side {off}"));
        }
        let look = self.look();
        let graze = GRAZE * self.size + self.rounding;
        match found {
            Ok(Some(found)) => self.touch(&found, &look),
            Ok(None) => match look.touch {
                None if look.resolved => Verdict::Miss,
                None => Verdict::Unknown,
                Some(touch) => {
                    let until = (touch + 1e-3 * self.horizon).min(self.horizon);
                    let depth = self.lowest(touch, until);
                    if depth < -graze {
                        Verdict::Wrong(format!("missed at {touch}, {depth:e} of {}", self.size))
                    } else {
                        Verdict::Graze
                    }
                }
            },
            Err(FirstContactError::Undecided { clear_until }) => {
                let until = clear_until * self.horizon;
                let depth = match look.touch {
                    Some(touch) if touch < until => self.lowest(touch, until),
                    _ => 0.0,
                };
                if depth < -graze {
                    return Verdict::Wrong(format!(
                        "not clear until {clear_until}, {depth:e} deep"
                    ));
                }
                let [a, b] = self.actors.each_ref().map(|actor| actor.placed(until));
                Verdict::Undecided {
                    near: apart(&a, &b).0 / self.size,
                }
            }
            Err(other) => Verdict::Wrong(format!("{other}")),
        }
    }

    /// What is different if the bodies change places.
    fn mirrored(&self, found: &PairContact) -> Option<String> {
        let [a, b] = &self.bodies;
        let Ok(Some(back)) = first_contact(b, a, self.horizon, &Method::Exact) else {
            return Some("they do not meet".into());
        };
        let same = back.fraction.to_bits() == found.fraction.to_bits()
            && back.normal == -found.normal
            // A ball that spins on a straight way is cast as any other, seen from the second body.
            && back.point.distance(found.point) <= self.rounding
            && back.features == [found.features[1], found.features[0]];
        let touch = matches!(found.kind, ContactKind::Touch);
        (touch && !same).then(|| format!("{back:?} instead of {found:?}"))
    }

    /// Contact where they overlap from the beginning.
    fn overlap(&self, found: &PairContact) -> Verdict {
        let ContactKind::Overlap { depth } = found.kind else {
            return Verdict::Wrong(format!("no overlap, but {found:?}"));
        };
        let [a, b] = self.actors.each_ref().map(|actor| actor.placed(0.0));
        // Shifted by so much along the normal they touch.
        let left = gap(&a, &b, found.normal) + depth;
        if found.fraction == 0.0 && left.abs() <= 1e-9 * self.size + self.rounding {
            Verdict::Overlap
        } else {
            Verdict::Wrong(format!("overlap with {left:e} left: {found:?}"))
        }
    }

    /// Whether a body that faces its way comes to a corner then, and turns into the other.
    fn jumps(&self, time: f64) -> bool {
        let faces = self
            .actors
            .iter()
            .any(|actor| actor.course.rate().is_none());
        let [before, after] = [-1e-9, 1e-9].map(|share| self.above(time + share * self.horizon));
        faces && before > 0.0 && after < 0.0
    }

    fn touch(&self, found: &PairContact, look: &Look) -> Verdict {
        let slack = 1e-9 * self.size + self.rounding;
        let time = found.fraction * self.horizon;
        let here = self.actors.each_ref().map(|actor| actor.placed(time));
        let now = apart(&here[0], &here[1]).0;
        let wrong = |what: &str| {
            Verdict::Wrong(format!(
                "{what}: {now:e} of {} apart at {time}, {found:?}, oracle {:?}",
                self.size, look.touch
            ))
        };
        if !matches!(found.kind, ContactKind::Touch) || !(0.0..=1.0).contains(&found.fraction) {
            return wrong("no touch");
        }
        if now.abs() > 10.0 * slack && self.jumps(time) {
            let late = look.touch.map_or(f64::MAX, |touch| time - touch) / self.horizon;
            return if late.abs() <= LATE {
                Verdict::Jump
            } else {
                wrong("jump")
            };
        }
        if now > slack + self.touch {
            return wrong("ghost");
        }
        let slack = slack + now.max(0.0);
        // Both bodies have the point, and lie on their sides of it.
        let [on_a, on_b] = here
            .each_ref()
            .map(|body| body.height(found.point - self.draw.base));
        if on_a.abs().max(on_b.abs()) > 10.0 * slack {
            return wrong(&format!("point off by {on_a:e} {on_b:e}"));
        }
        if (found.normal.length() - 1.0).abs() > 1e-12 {
            return wrong("normal too long");
        }
        let parted = gap(&here[0], &here[1], found.normal);
        if parted.abs() > 10.0 * slack {
            return wrong(&format!("normal does not separate: {parted:e}"));
        }
        let gap = now.abs() / self.size;
        let Some(touch) = look.touch else {
            // Less than the oracle sees.
            return if look.resolved {
                Verdict::Graze
            } else {
                Verdict::Unknown
            };
        };
        let late = (time - touch) / self.horizon;
        if late.abs() <= LATE {
            return Verdict::Hit { late, gap };
        }
        if late > 0.0 {
            let depth = self.lowest(touch, time);
            if depth < -GRAZE * self.size - self.rounding {
                return wrong(&format!("late, {depth:e} deep before"));
            }
        }
        // Between both times they are as good as in touch, or grazed.
        let (from, to) = if late > 0.0 {
            (touch, time)
        } else {
            (time, touch)
        };
        let far = [0.25, 0.5, 0.75].map(|share| self.above(from + share * (to - from)).abs());
        if far.into_iter().all(|far| far <= slack) {
            Verdict::SlowHit
        } else {
            Verdict::Graze
        }
    }
}
