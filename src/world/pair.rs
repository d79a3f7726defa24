//! One pair of bodies in one frame.

use crate::early_out;
use crate::geometry::{Pose, Shape};
use crate::motion::{FrameMotion, Motion, Turning};
use crate::narrow_phase::exact::{self, Encounter, Flight, Touching};
use crate::narrow_phase::overlap::{Gap, of_balls, overlap, overlap_or_gap};
use crate::narrow_phase::rays::{Standing, part};
use crate::tolerance::touch_tolerance;
use crate::world::skew::skew;
use crate::world::slots::Resident;
use crate::world::solver::{Solver, Stretching};
use crate::world::{Body, ContactKind, PairContact};
use glam::{DQuat, DVec3};

/// Sine of the angle to the surface below which a motion slides along it:
/// of a ball that glides in touch, the root of what rounding leaves.
pub(crate) const SLIDE: f64 = 1e-7;

/// A body as the narrow phase sees it.
#[derive(Clone, Copy)]
pub(crate) struct Mover<'a> {
    shape: &'a Shape,
    orientation: DQuat,
    motion: &'a Motion,
    frame: &'a FrameMotion,
    centre_offset: DVec3,
    reach: f64,
    points: &'a [DVec3],
}

impl<'a> Mover<'a> {
    /// The body with its motion in the frame at hand.
    pub(crate) fn new(resident: &'a Resident, frame: &'a FrameMotion) -> Self {
        Self {
            shape: resident.body.shape(),
            orientation: resident.body.orientation(),
            motion: resident.body.motion(),
            frame,
            centre_offset: resident.centre_offset,
            reach: resident.reach,
            points: &resident.points,
        }
    }

    /// A body outside of a world, turned as it is at unit length.
    pub(crate) fn of(
        body: &'a Body,
        orientation: DQuat,
        frame: &'a FrameMotion,
        points: &'a [DVec3],
    ) -> Self {
        let (centre_offset, reach) = body.hub_turned(orientation);
        Self {
            shape: body.shape(),
            orientation,
            motion: body.motion(),
            frame,
            centre_offset,
            reach,
            points,
        }
    }

    fn pose_at(&self, fraction: f64) -> Pose {
        self.frame.pose_at(self.motion, self.orientation, fraction)
    }

    fn flight(&self) -> Flight<'a> {
        Flight::new(self.shape, self.motion, self.frame, self.orientation)
    }

    /// Whether it does more in the frame than move straight.
    fn bends(&self) -> bool {
        self.frame.curved || self.turns()
    }

    /// Whether it moves straight and evenly all through the frame.
    fn is_straight(&self) -> bool {
        !self.bends() && self.frame.is_even()
    }

    /// Whether it turns so that it can be seen: a ball about its centre cannot.
    fn turns(&self) -> bool {
        let about_centre = match self.motion.turning() {
            Turning::Not | Turning::Facing(_) => true,
            Turning::Spin(spin) => spin.point() == DVec3::ZERO,
        };
        self.motion.turns() && !(about_centre && matches!(self.shape, Shape::Sphere(_)))
    }

    fn displacement(&self, from: f64, to: f64) -> DVec3 {
        // Worked out once for the whole frame.
        if from <= 0.0 && to >= 1.0 {
            return self.frame.displacement;
        }
        self.frame.displacement_between(self.motion, from, to)
    }

    fn turn(&self, from: f64, to: f64) -> f64 {
        if self.turns() {
            self.frame.angle_between(self.motion, from, to)
        } else {
            0.0
        }
    }

    fn deviation(&self, chord: DVec3, from: f64, to: f64) -> f64 {
        self.frame.deviation_from(self.motion, chord, from, to)
    }
}

/// A contact, and whether it is news.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Finding {
    pub(crate) contact: PairContact,
    /// Whether the bodies touched already as the frame began.
    pub(crate) resting: bool,
}

impl From<PairContact> for Finding {
    fn from(contact: PairContact) -> Self {
        Self {
            contact,
            resting: false,
        }
    }
}

/// What it took to find out.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct PairEffort {
    pub(crate) stretches: usize,
    pub(crate) rays: u64,
    /// Pairs that ran out of budget.
    pub(crate) undecided: usize,
}

/// A pair of which it could not be told within the budget whether it meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Undecided {
    /// Up to this fraction the two are proven apart.
    pub(crate) clear_until: f64,
}

/// First contact of a pair in the frame.
pub(crate) fn examine(
    solver: &mut Solver,
    a: &Mover<'_>,
    b: &Mover<'_>,
    effort: &mut PairEffort,
) -> Result<Option<Finding>, Undecided> {
    let exact = matches!(solver, Solver::Exact);
    let mut pair = Pair {
        a,
        b,
        stretching: solver.stretching(),
        solver,
        effort,
        halvings: 0,
    };
    // Most pairs are told apart here, and of straight ones nothing else need be asked.
    let motions = [a, b].map(|mover| mover.displacement(0.0, 1.0));
    let straight = exact && a.is_straight() && b.is_straight();
    if straight
        && early_out::reject(pair.between(0.0), motions[0] - motions[1], pair.reach()).is_some()
    {
        return Ok(None);
    }
    if pair.stretching.reports_overlaps {
        match pair.overlap_or_gap_at(0.0) {
            Ok(contact) => return Ok(Some(contact.into())),
            Err(Some(gap)) if straight && pair.stays_open(&gap, motions) => return Ok(None),
            Err(_) => {}
        }
    }
    if straight {
        pair.effort.stretches += 1;
        return Ok(pair.cast(0.0, 1.0, motions));
    }
    if exact && (a.bends() || b.bends()) {
        return pair.examine_curved();
    }
    Ok(pair.examine_chords())
}

/// Radians that two bodies may turn together on a stretch, which is examined
/// with both turned as it begins.
///
/// A point of a body is off by this share of its distance to the axis at most. What a
/// turn brings together without any motion is found as the next stretch begins.
const TURN: f64 = 1e-2;

/// So many laps within one frame are examined one by one. The rest is examined
/// along chords that are halved where they stray, which cuts the corner where a
/// body turns round by as much as chords may stray.
const MAX_BREAKS: u32 = 10_000;

/// The touch of a pair that could not be decided, if it overlaps as the frame ends: it met some time
/// after it was last proven apart.
pub(crate) fn overlap_at_end(
    a: &Mover<'_>,
    b: &Mover<'_>,
    undecided: Undecided,
) -> Option<Finding> {
    let found = overlap(a.shape, &a.pose_at(1.0), b.shape, &b.pose_at(1.0))?;
    let contact = PairContact {
        fraction: undecided.clear_until,
        point: found.point,
        normal: found.direction,
        features: [found.feature_a, found.feature_b],
        kind: ContactKind::Touch,
    };
    Some(contact.into())
}

struct Pair<'a> {
    a: &'a Mover<'a>,
    b: &'a Mover<'a>,
    solver: &'a mut Solver,
    stretching: Stretching,
    effort: &'a mut PairEffort,
    /// How often a stretch of this frame has been halved.
    halvings: u32,
}

impl Pair<'_> {
    /// By stretches along chords, which straight motions are.
    fn examine_chords(&mut self) -> Option<Finding> {
        // Where paths begin and end bodies set out, turn round and stop; between such
        // moments motions are smooth.
        let mut from = 0.0;
        for _ in 0..MAX_BREAKS {
            let next = |mover: &Mover<'_>| mover.frame.next_break(mover.motion, from);
            let to = next(self.a).min(next(self.b));
            if let Some(finding) = self.examine_smooth(from, to) {
                return Some(finding);
            }
            from = to;
            if from >= 1.0 {
                return None;
            }
        }
        self.examine_smooth(from, 1.0)
    }

    /// On the true curves, and turning.
    fn examine_curved(&mut self) -> Result<Option<Finding>, Undecided> {
        let (a, b) = (self.a.flight(), self.b.flight());
        let positions = [self.a, self.b].map(|mover| mover.frame.start);
        let coordinate = positions[0].abs().max(positions[1].abs()).max_element();
        let touch = touch_tolerance(self.reach(), coordinate);
        // In one order whichever is first: so what is told is mirrored to the bit.
        let mirrored = b.comes_before(&a);
        let (pair, origin) = if mirrored {
            ((&b, &a), self.a)
        } else {
            ((&a, &b), self.b)
        };
        let (touching, resting) = match exact::encounter(pair, touch, &mut self.effort.stretches) {
            Encounter::Touch { touching, .. } => (touching, false),
            Encounter::Resting(touching) => (touching, true),
            Encounter::Apart => return Ok(None),
            Encounter::Undecided { clear_until } => return Err(Undecided { clear_until }),
        };
        let Touching {
            fraction,
            point,
            normal,
            features: [first, second],
        } = touching;
        let contact = PairContact {
            fraction,
            point: origin.pose_at(fraction).position + point,
            normal: if mirrored { -normal } else { normal },
            features: if mirrored {
                [second, first]
            } else {
                [first, second]
            },
            kind: ContactKind::Touch,
        };
        Ok(Some(Finding { contact, resting }))
    }

    fn reach(&self) -> f64 {
        self.a.reach + self.b.reach
    }

    /// From the first hub to the second: the centres of the spheres that hold the
    /// bodies however they turn.
    fn between(&self, fraction: f64) -> DVec3 {
        let position = |mover: &Mover<'_>| mover.frame.position_at(mover.motion, fraction);
        position(self.b) - position(self.a) + (self.b.centre_offset - self.a.centre_offset)
    }

    /// Whether a gap in the beginning is one till the end of the frame, if both move straight.
    fn stays_open(&self, gap: &Gap, [motion_a, motion_b]: [DVec3; 2]) -> bool {
        let far = |mover: &Mover<'_>, motion: DVec3| mover.frame.start.abs() + motion.abs();
        let far = far(self.a, motion_a).max(far(self.b, motion_b));
        // What comes as near as this counts as touching; and rounding.
        let slack = 4.0 * touch_tolerance(self.reach(), far.max_element());
        gap.stays(motion_a - motion_b, slack)
    }

    /// The pair as overlapping at `fraction`, if it is.
    fn overlap_at(&self, fraction: f64) -> Option<PairContact> {
        self.overlap_or_gap_at(fraction).ok()
    }

    /// The same, or how the two are apart, if it is known.
    fn overlap_or_gap_at(&self, fraction: f64) -> Result<PairContact, Option<Gap>> {
        if self.between(fraction).length_squared() >= self.reach() * self.reach() {
            return Err(None);
        }
        let found = if let (Shape::Sphere(a), Shape::Sphere(b)) = (self.a.shape, self.b.shape)
            && !self.a.turns()
            && !self.b.turns()
        {
            // Without poses, which take longer than all the rest. What swings about another point than
            // its centre needs one.
            let position = |mover: &Mover<'_>| mover.frame.position_at(mover.motion, fraction);
            let (at_a, at_b) = (position(self.a), position(self.b));
            of_balls((at_a, a.radius()), (at_b, b.radius())).ok_or(None)?
        } else {
            let (pose_a, pose_b) = (self.a.pose_at(fraction), self.b.pose_at(fraction));
            overlap_or_gap(self.a.shape, &pose_a, self.b.shape, &pose_b)?
        };
        Ok(PairContact {
            fraction,
            point: found.point,
            normal: found.direction,
            features: [found.feature_a, found.feature_b],
            kind: ContactKind::Overlap { depth: found.depth },
        })
    }

    /// A stretch without the end of a path inside: by the thesis's rule either
    /// one chord, or subdivided into several, on both bodies alike.
    fn examine_smooth(&mut self, from: f64, to: f64) -> Option<Finding> {
        let turns = |mover: &Mover<'_>, angle: f64| {
            mover.frame.curved && mover.frame.turn_between(mover.motion, from, to) > angle
        };
        let pieces = match self.stretching.bend {
            Some((angle, points)) if turns(self.a, angle) || turns(self.b, angle) => points + 1,
            _ => 1,
        };
        let at = |piece: u32| {
            if piece == pieces {
                to
            } else {
                from + f64::from(piece) / f64::from(pieces) * (to - from)
            }
        };
        (0..pieces).find_map(|piece| self.examine_stretch(at(piece), at(piece + 1)))
    }

    /// A stretch along chords, halved until these follow the curves closely enough.
    fn examine_stretch(&mut self, from: f64, to: f64) -> Option<Finding> {
        let between = self.between(from);
        let motions = [self.a.displacement(from, to), self.b.displacement(from, to)];
        let motion = motions[0] - motions[1];
        let deviation =
            self.a.deviation(motions[0], from, to) + self.b.deviation(motions[1], from, to);
        if early_out::reject(between, motion, self.reach() + deviation).is_some() {
            return None;
        }
        let strays = deviation > 0.0
            && (self.stretching.chords)
                .is_some_and(|share| deviation > share * self.leniency() * self.reach());
        let turn = self.a.turn(from, to) + self.b.turn(from, to);
        if strays || turn > TURN && turn > TURN * self.leniency() {
            let middle = 0.5 * (from + to);
            if from < middle && middle < to {
                self.halvings += 1;
                return self
                    .examine_stretch(from, middle)
                    .or_else(|| self.examine_stretch(middle, to));
            }
        }
        self.effort.stretches += 1;
        // Rays that missed the touch on an earlier stretch leave the bodies in each other.
        if from > 0.0
            && self.stretching.reports_overlaps
            && let Some(contact) = self.overlap_at(from)
        {
            return Some(
                PairContact {
                    kind: ContactKind::Touch,
                    ..contact
                }
                .into(),
            );
        }
        self.cast(from, to, motions)
    }

    /// By how much more than asked chords may stray: 1, unless there are very many.
    ///
    /// Two bodies that keep close to each other along many kilometres in one
    /// frame would need more chords than anyone has the time for.
    fn leniency(&self) -> f64 {
        /// So many halvings are free: a kilometre of a bend of 50 m radius, for a pair 2 m in size.
        const FREE: u32 = 1 << 16;
        /// So many more double what is allowed. Chords twice as long are half as
        /// many, so that the doubling soon ends it.
        const DOUBLING: u32 = 1 << 12;
        f64::from(self.halvings.saturating_sub(FREE) / DOUBLING).exp2()
    }

    /// The touch along the chords of one stretch.
    fn cast(&mut self, from: f64, to: f64, [motion_a, motion_b]: [DVec3; 2]) -> Option<Finding> {
        let (pose_a, pose_b) = (self.a.pose_at(from), self.b.pose_at(from));
        let (a, b) = (self.a, self.b);
        // From the first bounding centre to the second.
        let between = (pose_b.position - pose_a.position)
            + (pose_b.direction(b.shape.centre()) - pose_a.direction(a.shape.centre()));
        let standing = (
            Standing {
                shape: a.shape,
                pose: &pose_a,
                points: a.points,
            },
            Standing {
                shape: b.shape,
                pose: &pose_b,
                points: b.points,
            },
        );
        let motion = motion_a - motion_b;
        let positions = [pose_a.position, pose_b.position];
        let coordinate = positions[0].abs().max(positions[1].abs()).max_element();
        let touch = touch_tolerance(self.reach(), coordinate);
        let found = match self.solver {
            Solver::Rays(caster) => {
                let rays = &mut self.effort.rays;
                let ray = caster.shortest_ray(standing, between, motion, touch, rays)?;
                let centre = pose_a.point(a.shape.centre());
                Touching {
                    fraction: ray.fraction,
                    point: centre + (ray.offset + ray.fraction * motion_b),
                    normal: ray.normal,
                    features: ray.features,
                }
            }
            Solver::Exact => {
                let enter = exact::touch(a.shape, &pose_a, b.shape, &pose_b, motion)?;
                // Bodies that overlap are told of elsewhere. Who is deeper in
                // since they met than a touch is deep, and yet does not overlap, is
                // about to leave.
                let depth = enter.fraction * motion.dot(enter.normal);
                let late = (enter.fraction - 1.0) * motion.length() > touch;
                if late || enter.fraction < 0.0 && depth > touch {
                    return None;
                }
                let fraction = enter.fraction.clamp(0.0, 1.0);
                let point = pose_b.position + (enter.point + fraction * motion_b);
                Touching {
                    fraction,
                    point,
                    ..enter
                }
            }
        };
        // Bodies that touch as the stretch begins and part, or slide along each
        // other, make no contact.
        let length = motion.length();
        let closing = -motion.dot(found.normal);
        // Gliding in touch a curved body may, by rounding, touch a little later.
        let at_once = found.fraction * length <= SLIDE * self.reach();
        let touching =
            found.fraction * length <= touch || at_once && found.fraction * closing <= touch;
        if touching
            && (closing <= SLIDE * length
                || closing <= skew(a.frame.seconds(), b.frame.seconds(), motion_a, motion_b)
                || part(standing, between, motion, touch))
        {
            return None;
        }
        let contact = PairContact {
            fraction: from + found.fraction * (to - from),
            point: found.point,
            normal: found.normal,
            features: found.features,
            kind: ContactKind::Touch,
        };
        Some(Finding {
            contact,
            resting: touching && from <= 0.0,
        })
    }
}
