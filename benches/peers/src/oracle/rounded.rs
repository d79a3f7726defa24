//! A ball against triangles.

use super::Truth;
use super::faces::Triple;
use glam::DVec3;

/// When a ball around `centre` meets the hull of `corners`, whose supporting
/// triples are given; without any it meets the first corner alone.
///
/// The centre's path against the hull grown by the radius, which is the union of
/// prisms over the triples, cylinders around their sides and spheres around their
/// corners: the first of all that it enters. Sides that cross a face do no harm,
/// since they belong to the hull.
pub fn truth(
    centre: DVec3,
    radius: f64,
    corners: &[DVec3],
    triples: &[Triple],
    motion: DVec3,
) -> Truth {
    let mut first: Option<(f64, DVec3)> = None;
    let mut enter = |found: Option<(f64, DVec3)>| {
        if let Some((fraction, normal)) = found
            && fraction >= 0.0
            && first.is_none_or(|(least, _)| fraction < least)
        {
            first = Some((fraction, normal));
        }
    };
    let along = motion.normalize();
    // Seen along the motion.
    let shadow = |point: DVec3| (point - centre) - along * along.dot(point - centre);
    let mut miss = f64::INFINITY;
    for &corner in corners {
        enter(sphere(centre - corner, motion, radius));
        miss = miss.min(shadow(corner).length());
    }
    for triple in triples {
        let [p, q, r] = triple.map(|number| corners[number]);
        let (face, pierced) = prism(centre, motion, radius, [p, q, r]);
        enter(face);
        if pierced {
            miss = 0.0;
        }
        for (from, to) in [(p, q), (q, r), (r, p)] {
            enter(cylinder(centre, motion, radius, [from, to]));
            miss = miss.min(distance_to_segment(shadow(from), shadow(to)));
        }
    }
    let length = motion.length();
    match first {
        Some((fraction, normal)) if fraction <= 1.0 => Truth::Hit {
            fraction,
            normal,
            margin: (radius - miss).min((1.0 - fraction) * length),
        },
        Some((fraction, _)) => Truth::Clear {
            margin: (miss - radius).max((fraction - 1.0) * length),
        },
        None => Truth::Clear {
            margin: miss - radius,
        },
    }
}

/// By the point of closest approach; `from` is seen from the centre.
fn sphere(from: DVec3, motion: DVec3, radius: f64) -> Option<(f64, DVec3)> {
    let squared = motion.length_squared();
    let closest = -from.dot(motion) / squared;
    let height = radius * radius - (from + closest * motion).length_squared();
    if height < 0.0 {
        return None;
    }
    let fraction = closest - (height / squared).sqrt();
    Some((fraction, (from + fraction * motion).normalize()))
}

fn cylinder(
    centre: DVec3,
    motion: DVec3,
    radius: f64,
    [from, to]: [DVec3; 2],
) -> Option<(f64, DVec3)> {
    let length = (to - from).length();
    let axis = (to - from) / length;
    let across = |vector: DVec3| vector - axis * axis.dot(vector);
    let sideways = across(motion);
    if sideways.length() < 1e-14 * motion.length() {
        return None;
    }
    let (fraction, normal) = sphere(across(centre - from), sideways, radius)?;
    let place = axis.dot(centre + fraction * motion - from);
    (0.0..=length)
        .contains(&place)
        .then_some((fraction, normal))
}

/// Also whether the centre's line, both ways without end, goes through the triangle.
fn prism(
    centre: DVec3,
    motion: DVec3,
    radius: f64,
    [p, q, r]: [DVec3; 3],
) -> (Option<(f64, DVec3)>, bool) {
    let mut normal = (q - p).cross(r - p).normalize();
    if normal.dot(centre - p) < 0.0 {
        normal = -normal;
    }
    let inside = |point: DVec3| {
        let side = |from: DVec3, to: DVec3| normal.dot((to - from).cross(point - from));
        let sides = [side(p, q), side(q, r), side(r, p)];
        sides.iter().all(|&side| side >= 0.0) || sides.iter().all(|&side| side <= 0.0)
    };
    let closing = -normal.dot(motion);
    if closing == 0.0 {
        return (None, false);
    }
    let height = normal.dot(centre - p);
    let pierced = inside(centre + height / closing * motion);
    let fraction = (height - radius) / closing;
    let touched = centre + fraction * motion - radius * normal;
    let enters = closing > 0.0 && inside(touched);
    (enters.then_some((fraction, normal)), pierced)
}

/// From the origin.
fn distance_to_segment(from: DVec3, to: DVec3) -> f64 {
    let side = to - from;
    let squared = side.length_squared();
    if squared == 0.0 {
        return from.length();
    }
    let share = (-from.dot(side) / squared).clamp(0.0, 1.0);
    (from + share * side).length()
}
