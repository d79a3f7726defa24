//! Two polytopes, by every axis that could separate them.

use super::Truth;
use super::faces::{Triple, plane_normal};
use glam::DVec3;

/// A polytope where it stands.
pub struct Flat {
    corners: Vec<DVec3>,
    /// Of the faces, both ways.
    normals: Vec<DVec3>,
    /// Of the sides of the triples: all edges, and some diagonals of faces.
    edges: Vec<DVec3>,
}

impl Flat {
    pub fn new(corners: Vec<DVec3>, triples: &[Triple]) -> Self {
        let (mut normals, mut edges) = (Vec::new(), Vec::new());
        let add = |list: &mut Vec<DVec3>, unit: DVec3| {
            // The same axis twice is only time lost.
            if list.iter().all(|known| known.cross(unit).length() > 1e-12) {
                list.push(unit);
            }
        };
        for &[i, j, k] in triples {
            if let Some(normal) = plane_normal(&corners, [i, j, k]) {
                add(&mut normals, normal);
            }
            for (from, to) in [(i, j), (j, k), (k, i)] {
                add(&mut edges, (corners[to] - corners[from]).normalize());
            }
        }
        Self {
            corners,
            normals,
            edges,
        }
    }
}

/// How far `a` is apart from `b` along `normal`, which leads from `b` towards `a`.
pub fn separation(a: &[DVec3], b: &[DVec3], normal: DVec3) -> f64 {
    let least = |points: &[DVec3], axis: DVec3| {
        let along = |point: &DVec3| axis.dot(*point);
        points.iter().map(along).fold(f64::INFINITY, f64::min)
    };
    least(a, normal) + least(b, -normal)
}

/// When `a` meets `b`.
///
/// They share a point as long as they overlap along every axis. An axis that is
/// needlessly tried, or is a little off, does no harm: it only says less.
pub fn truth(a: &Flat, b: &Flat, motion: DVec3) -> Truth {
    let (mut enter, mut leave) = (f64::NEG_INFINITY, f64::INFINITY);
    let mut normal = DVec3::ZERO;
    let mut apart = false;
    let mut try_axis = |axis: DVec3| {
        let (gap, speed) = (separation(&a.corners, &b.corners, axis), axis.dot(motion));
        if speed < 0.0 {
            let fraction = gap / -speed;
            if fraction > enter {
                (enter, normal) = (fraction, axis);
            }
        } else if speed > 0.0 {
            leave = leave.min(-gap / speed);
        } else {
            apart |= gap > 0.0;
        }
    };
    let crossed = a.edges.iter().flat_map(|&edge_a| {
        b.edges
            .iter()
            .map(move |&edge_b| edge_a.cross(edge_b))
            .filter(|axis| axis.length() > 1e-9)
            .map(DVec3::normalize)
    });
    for axis in a.normals.iter().chain(&b.normals).copied().chain(crossed) {
        try_axis(axis);
        try_axis(-axis);
    }

    // The shadow's edges, seen along the motion.
    let mut aside = f64::NEG_INFINITY;
    for edge in a.edges.iter().chain(&b.edges) {
        let axis = motion.cross(*edge);
        if axis.length() > 1e-12 * motion.length() {
            let axis = axis.normalize();
            for axis in [axis, -axis] {
                aside = aside.max(separation(&a.corners, &b.corners, axis));
            }
        }
    }
    let length = motion.length();
    if apart || enter > leave || aside > 0.0 {
        return Truth::Clear {
            margin: aside.max(0.0),
        };
    }
    if !(0.0..=1.0).contains(&enter) {
        let beyond = (enter - 1.0).max(-leave) * length;
        return Truth::Clear {
            margin: beyond.max(0.0),
        };
    }
    Truth::Hit {
        fraction: enter,
        normal,
        margin: (-aside).min((1.0 - enter) * length),
    }
}
