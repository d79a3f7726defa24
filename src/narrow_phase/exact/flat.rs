//! Straight casts between shapes with flat faces.

use super::ball_line::passes_by;
use super::box_touch::{self, Plain};
use super::boxes::{self, Swept};
use super::crossing::{Crossing, Touching};
use super::faces;
use super::pair::Pair;
use super::portal::{Found, Probe, Shadow};
use super::rough::{self, Rough};
use super::snap::{Place, Touch};
use crate::geometry::Shape;
use crate::raycast::PLAIN_SQUARES;
use glam::{DQuat, DVec3};

/// When `a`, moving straight past `b`, touches it and parts from it.
///
/// `between` leads from B's position to A's as the motion begins, and `motion`
/// is A's motion relative to B, both along the world's axes, in metres. The whole
/// line of the motion is looked at: fractions may be negative or beyond 1. Shapes
/// are cuboids, triangles and polytopes in any pairing.
///
/// None if they miss each other, if there is no motion, if a number is not
/// finite, or if one of the shapes is a sphere. Touching counts, grazing too: there
/// the crossing may be a single moment. What passes by at less than some
/// 1e-14 of the pair's size counts as touching. Fractions beyond the range of `f64` are
/// its largest.
///
/// The normal is that of a face of B, of a face of A turned round, or perpendicular to an edge of
/// each: where more than one will do (a vertex on an edge, on a vertex, parallel edges) one that
/// parts the bodies, always the same for the same input. The features are those that lie
/// farthest along it. Where they share more than a point, the point is the middle of what
/// they share.
///
/// Exchanging the shapes gives the same fractions and features and the opposite
/// normal, to the last bit.
///
/// Gap or overlap left at the time found is within 1e-12 of the pair's size, plus
/// rounding in the coordinates given; time, normal and point are computed afresh from the
/// features. Where edges or faces are parallel but for a hair, rounding decides which features
/// they are, and the point is as uncertain as what they share.
///
/// Two boxes take fifteen swept separating axes (Gottschalk, Lin & Manocha, 1996), six if they
/// share one, in single precision where that leaves no doubt. Other pairs search the portal of
/// the Minkowski difference that the ray goes through (Snethen, *XenoCollide*, 2008): five to ten
/// supports, more for large hulls. With up to 256 vertices a body the search is in single
/// precision, and what it finds is proven in double. The few that rounding leaves undecided try
/// every face of the difference.
///
/// ```
/// use feeler::narrow_phase::exact::flat_crossing;
/// use feeler::{Cuboid, Shape};
/// use glam::{DQuat, DVec3};
///
/// let cube = Shape::from(Cuboid::new([0.5, 0.5, 0.5])?);
/// let cast = |from: DVec3, motion: DVec3| {
///     flat_crossing(&cube, DQuat::IDENTITY, &cube, DQuat::IDENTITY, from, motion)
/// };
/// let crossing = cast(DVec3::new(5.0, 0.5, 0.0), DVec3::new(-8.0, 0.0, 0.0)).expect("they touch");
/// assert_eq!(crossing.enter.fraction, 0.5);
/// assert_eq!(crossing.leave, 0.75);
/// assert_eq!(crossing.enter.normal, DVec3::X);
/// assert_eq!(crossing.enter.point, DVec3::new(0.5, 0.25, 0.0));
///
/// // A hair too high.
/// assert!(cast(DVec3::new(5.0, 1.000_001, 0.0), DVec3::new(-8.0, 0.0, 0.0)).is_none());
/// # Ok::<(), feeler::ShapeError>(())
/// ```
#[must_use]
pub fn flat_crossing(
    a: &Shape,
    orientation_a: DQuat,
    b: &Shape,
    orientation_b: DQuat,
    between: DVec3,
    motion: DVec3,
) -> Option<Crossing> {
    let enter = flat_touch(a, orientation_a, b, orientation_b, between, motion)?;
    let cast = Cast::new((a, orientation_a), (b, orientation_b), between, motion)?;
    // The touch when all runs backwards. Of a graze rounding may lose one end.
    let leave = touch(&cast.pair.reversed()).map_or(enter.fraction, |last| {
        enter.fraction.max(cast.fraction(-last.time))
    });
    Some(Crossing { enter, leave })
}

/// How `a`, moving straight past `b`, comes to touch it: the entry of [`flat_crossing`], to the
/// last bit, without the exit.
///
/// ```
/// use feeler::narrow_phase::exact::flat_touch;
/// use feeler::{Cuboid, Shape};
/// use glam::{DQuat, DVec3};
///
/// let cube = Shape::from(Cuboid::new([0.5, 0.5, 0.5])?);
/// let turned = DQuat::from_rotation_z(0.5);
/// let cast = |motion| {
///     flat_touch(&cube, turned, &cube, DQuat::IDENTITY, DVec3::new(5.0, 0.0, 0.0), motion)
/// };
/// assert!(cast(DVec3::new(-8.0, 0.0, 0.0)).is_some_and(|touch| touch.fraction < 0.5));
/// assert!(cast(DVec3::Z).is_none());
/// # Ok::<(), feeler::ShapeError>(())
/// ```
#[must_use]
pub fn flat_touch(
    a: &Shape,
    orientation_a: DQuat,
    b: &Shape,
    orientation_b: DQuat,
    between: DVec3,
    motion: DVec3,
) -> Option<Touching> {
    if let (Shape::Cuboid(a), Shape::Cuboid(b)) = (a, b) {
        match box_touch::touch((a, &orientation_a), (b, &orientation_b), between, motion) {
            Plain::Touch(touching) => return Some(touching),
            Plain::Miss => return None,
            Plain::Unclear => {}
        }
    }
    if let (Shape::Polytope(a), Shape::Polytope(b)) = (a, b) {
        // Before anything is turned: that takes as long as half of a search.
        let square = motion.length_squared();
        let reach = a.reach() + b.reach();
        if PLAIN_SQUARES.contains(&square) && passes_by(between, motion, square, reach) {
            return None;
        }
    }
    let cast = Cast::new((a, orientation_a), (b, orientation_b), between, motion)?;
    let touch = touch(&cast.pair)?;
    Some(cast.touching(touch))
}

/// A pair as it was given, and as it is looked at.
struct Cast<'a> {
    /// Each pair is looked at from one side only, so that exchanging the shapes changes nothing.
    pair: Pair<'a>,
    swapped: bool,
    between: DVec3,
    /// What `pair` counts in.
    motion: DVec3,
    scale: f64,
}

impl<'a> Cast<'a> {
    #[inline(always)]
    fn new(
        a: (&'a Shape, DQuat),
        b: (&'a Shape, DQuat),
        between: DVec3,
        motion: DVec3,
    ) -> Option<Self> {
        let scale = motion.abs().max_element();
        if !(scale > 0.0 && motion.is_finite() && between.is_finite()) {
            return None;
        }
        // Dividing by a subnormal number need not end at 1.
        let motion = motion / scale;
        if !motion.is_finite() {
            return None;
        }
        let leading = motion.to_array().into_iter().find(|&x| x != 0.0)?;
        let swapped = leading < 0.0;
        // Only this hangs on a branch that nobody can predict.
        let (first, second, sign) = if swapped { (b, a, -1.0) } else { (a, b, 1.0) };
        let pair = Pair::new(first, second, sign * between, sign * motion)?;
        Some(Self {
            pair,
            swapped,
            between,
            motion,
            scale,
        })
    }

    #[inline]
    fn fraction(&self, time: f64) -> f64 {
        (time / self.scale).clamp(f64::MIN, f64::MAX)
    }

    #[inline]
    fn touching(&self, touch: Touch) -> Touching {
        let Touch {
            time,
            normal,
            features: [first, second],
            point,
            certain: _,
        } = touch;
        let (pair, swapped) = (&self.pair, self.swapped);
        // From the centre of one of the pair's bodies to the position of B.
        let (of_b, offset) = match point {
            Place::OnA(offset) => (swapped, offset + pair.a.rotation * pair.a.centre),
            Place::OnB(offset) => (!swapped, offset + pair.b.rotation * pair.b.centre),
        };
        let point = if of_b {
            offset
        } else {
            offset + (self.between + time * self.motion)
        };
        let (normal, features) = if swapped {
            (-normal, [second, first])
        } else {
            (normal, [first, second])
        };
        Touching {
            fraction: self.fraction(time),
            point,
            normal,
            features,
        }
    }
}

/// The touch.
pub(super) fn touch(pair: &Pair) -> Option<Touch> {
    if pair.spheres_miss() {
        return None;
    }
    if let (Shape::Cuboid(a), Shape::Cuboid(b)) = (pair.a.shape, pair.b.shape) {
        return match boxes::touch(pair, a, b) {
            Swept::Touch(touch) => Some(touch),
            Swept::Miss => None,
            Swept::Unclear(normal, time) => Some(careful(pair, normal, time)),
        };
    }
    if pair.is_flat() {
        let (normal, time) = faces::entry(pair)?;
        return Some(careful(pair, normal, time));
    }
    match rough::search(pair) {
        Rough::Miss => return None,
        Rough::Near(probes) => {
            if let Some(touch) = pair.prove(probes) {
                return Some(touch);
            }
        }
        Rough::Unclear => {}
    }
    let mut shadow = Shadow::new(pair);
    let found = match shadow.enclose() {
        Found::Yes(probes) => entry(&mut shadow, probes),
        Found::Miss => return None,
        Found::Unclear => None,
    };
    found.or_else(|| {
        let (normal, time) = faces::entry(pair)?;
        Some(careful(pair, normal, time))
    })
}

/// The touch by a normal and a time that are right but for rounding.
fn careful(pair: &Pair, normal: DVec3, time: f64) -> Touch {
    pair.touch(normal, pair.time(normal, time), [pair.supports(normal)])
}

/// The touch from three points around the ray.
fn entry(shadow: &mut Shadow, mut probes: [Probe; 3]) -> Option<Touch> {
    loop {
        let portal = shadow.refine(&mut probes);
        if let Some(touch) = portal.as_ref().and_then(|portal| shadow.settle(portal)) {
            return Some(touch);
        }
        if shadow.take_more_care() {
            continue;
        }
        let portal = portal?;
        let pair = shadow.pair;
        let [p, q, r] = portal.probes.map(|probe| probe.vertices);
        let touch = pair.touch(
            portal.normal,
            pair.nearest_distance + portal.time,
            [portal.vertices, p, q, r],
        );
        return touch.certain.then_some(touch);
    }
}
