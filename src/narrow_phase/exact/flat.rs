//! Straight casts between shapes with flat faces.

use super::crossing::{Crossing, Touching};
use super::pair::{Ends, Pair, STEEP};
use super::portal::{Found, Portal, Shadow};
use super::snap::{Place, Touch};
use super::{boxes, faces};
use crate::geometry::Shape;
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
/// Two boxes take fifteen swept separating axes (Gottschalk, Lin & Manocha, 1996). Other
/// pairs search the portal of the Minkowski difference that the ray goes through
/// (Snethen, *XenoCollide*, 2008): some ten supports, more for large hulls. The few that
/// rounding leaves undecided try every face of the difference.
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
    let scale = motion.abs().max_element();
    if !(scale > 0.0 && motion.is_finite() && between.is_finite()) {
        return None;
    }
    // Dividing by a subnormal number need not end at 1.
    let motion = motion / scale;
    if !motion.is_finite() {
        return None;
    }
    let (a, b) = ((a, orientation_a), (b, orientation_b));
    // Each pair is looked at from one side only, so that exchanging the shapes changes nothing.
    let leading = motion.to_array().into_iter().find(|&x| x != 0.0)?;
    let swapped = leading < 0.0;
    let pair = if swapped {
        Pair::new(b, a, -between, -motion)?
    } else {
        Pair::new(a, b, between, motion)?
    };
    let (touch, leave) = cross(&pair)?;
    let Touch {
        time,
        mut normal,
        mut features,
        point,
        certain: _,
    } = touch;
    // From the centre of one of the pair's bodies to the position of B.
    let (of_b, offset) = match point {
        Place::OnA(offset) => (swapped, offset + pair.a.rotation * pair.a.centre),
        Place::OnB(offset) => (!swapped, offset + pair.b.rotation * pair.b.centre),
    };
    let point = if of_b {
        offset
    } else {
        offset + (between + time * motion)
    };
    if swapped {
        normal = -normal;
        features.reverse();
    }
    let fraction = |time: f64| (time / scale).clamp(f64::MIN, f64::MAX);
    Some(Crossing {
        enter: Touching {
            fraction: fraction(time),
            point,
            normal,
            features,
        },
        leave: fraction(leave.max(time)),
    })
}

/// The touch, and the time of parting.
fn cross(pair: &Pair) -> Option<(Touch, f64)> {
    if pair.spheres_miss() {
        return None;
    }
    let Ends { enter, leave } = match (pair.a.shape, pair.b.shape) {
        (Shape::Cuboid(a), Shape::Cuboid(b)) => boxes::ends(pair, a, b)?,
        (Shape::Polytope(_), _) | (_, Shape::Polytope(_)) => match by_portals(pair) {
            Found::Miss => return None,
            Found::Yes(found) => return Some(found),
            Found::Unclear => faces::ends(pair)?,
        },
        _ => faces::ends(pair)?,
    };
    let (normal, time) = enter;
    let touch = pair.touch(normal, pair.time(normal, time), [pair.supports(normal)]);
    Some((touch, pair.time(leave.0, leave.1)))
}

fn by_portals(pair: &Pair) -> Found<(Touch, f64)> {
    let Some(mut shadow) = Shadow::new(pair) else {
        return Found::Unclear;
    };
    let probes = match shadow.enclose() {
        Found::Yes(probes) => probes,
        Found::Miss => return Found::Miss,
        Found::Unclear => return Found::Unclear,
    };
    let (Some(enter), Some(leave)) = (shadow.refine(probes, -1.0), shadow.refine(probes, 1.0))
    else {
        return Found::Unclear;
    };
    let length = pair.motion.length();
    let time = |portal: &Portal| pair.nearest_distance + portal.distance / length;
    let [p, q, r] = enter.probes.map(|probe| probe.vertices);
    let touch = pair.touch(enter.normal, time(&enter), [enter.vertices, p, q, r]);
    if !touch.certain {
        return Found::Unclear;
    }
    let speed = leave.normal.dot(pair.motion);
    let leave = if speed > STEEP {
        pair.height(leave.normal, leave.vertices) / speed
    } else {
        time(&leave)
    };
    Found::Yes((touch, leave))
}
