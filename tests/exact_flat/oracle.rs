//! Every candidate plane of the Minkowski difference, from nothing but the points.

use feeler::Feature;
use feeler::narrow_phase::exact::Crossing;
use glam::{DQuat, DVec3};

/// A convex body as its corners, and all directions that may be normals or edges of it.
#[derive(Clone)]
pub(crate) struct Hull {
    pub(crate) points: Vec<DVec3>,
    pub(crate) normals: Vec<DVec3>,
    pub(crate) edges: Vec<DVec3>,
}

impl Hull {
    /// Tries every triple of points: a face has all the others on one side.
    pub(crate) fn new(points: &[DVec3]) -> Self {
        let size = points
            .iter()
            .map(|p| p.distance(points[0]))
            .fold(0.0, f64::max);
        let (mut normals, mut pairs) = (Vec::new(), std::collections::BTreeSet::new());
        for i in 0..points.len() {
            for j in i + 1..points.len() {
                for k in j + 1..points.len() {
                    let (u, v) = (points[j] - points[i], points[k] - points[i]);
                    let Some(normal) = u.cross(v).try_normalize() else {
                        continue;
                    };
                    let heights = points.iter().map(|&p| normal.dot(p - points[i]));
                    let (low, high) =
                        heights.fold((0.0_f64, 0.0_f64), |(l, h), x| (l.min(x), h.max(x)));
                    // A sliver's normal is rounding; more candidates do no harm.
                    if low < -1e-11 * size && high > 1e-11 * size {
                        continue;
                    }
                    if high <= 1e-11 * size {
                        normals.push(normal);
                    }
                    if low >= -1e-11 * size {
                        normals.push(-normal);
                    }
                    pairs.extend([(i, j), (i, k), (j, k)]);
                }
            }
        }
        let edges: Vec<DVec3> = pairs
            .iter()
            .map(|&(i, j)| (points[j] - points[i]).normalize())
            .collect();
        if points.len() == 3 {
            let normal = normals[0];
            for edge in &edges {
                normals.push(edge.cross(normal));
                normals.push(-edge.cross(normal));
            }
        }
        let mut hull = Self {
            points: points.to_vec(),
            normals,
            edges,
        };
        hull.thin_out();
        hull
    }

    /// Directions that are the same to the last bits need be tried once.
    fn thin_out(&mut self) {
        let mut kept: Vec<DVec3> = Vec::new();
        for &n in &self.normals {
            if kept.iter().all(|k| (*k - n).length() > 1e-15) {
                kept.push(n);
            }
        }
        self.normals = kept;
        let mut kept: Vec<DVec3> = Vec::new();
        for &e in &self.edges {
            if kept.iter().all(|k| k.cross(e).length() > 1e-15) {
                kept.push(e);
            }
        }
        self.edges = kept;
    }
}

/// Share of the size within which two things count as touching nearly at once.
const NEAR: f64 = 1e-8;

struct Axis {
    normal: DVec3,
    /// How far outside A's centre is as the motion begins.
    outside: f64,
    speed: f64,
}

/// A cast of two hulls, as half-spaces.
pub(crate) struct Oracle {
    axes: Vec<Axis>,
    a: (Hull, DQuat),
    b: (Hull, DQuat),
    between: DVec3,
    motion: DVec3,
    pub(crate) size: f64,
    pub(crate) enter: f64,
    pub(crate) leave: f64,
}

impl Oracle {
    pub(crate) fn new(a: (&Hull, DQuat), b: (&Hull, DQuat), between: DVec3, motion: DVec3) -> Self {
        let turned = |(hull, turn): (&Hull, DQuat), list: &[DVec3]| -> Vec<DVec3> {
            let _ = hull;
            list.iter().map(|&v| turn * v).collect()
        };
        let (points_a, points_b) = (turned(a, &a.0.points), turned(b, &b.0.points));
        let extent = |points: &[DVec3]| {
            let middle = points.iter().sum::<DVec3>() / points.len() as f64;
            points
                .iter()
                .map(|p| p.distance(middle))
                .fold(0.0, f64::max)
        };
        let size = extent(&points_a) + extent(&points_b);
        let mut axes = Vec::new();
        let rounding = 1e-15 * (size + between.length());
        let (mut enter, mut leave) = (f64::NEG_INFINITY, f64::INFINITY);
        let (mut enter_low, mut leave_high) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut show = |normal: DVec3| {
            let top = points_b
                .iter()
                .map(|p| normal.dot(*p))
                .fold(f64::NEG_INFINITY, f64::max);
            let bottom = points_a
                .iter()
                .map(|p| normal.dot(*p))
                .fold(f64::INFINITY, f64::min);
            let outside = normal.dot(between) - (top - bottom);
            let speed = normal.dot(motion);
            if speed < 0.0 {
                let low = (outside - rounding) / -speed;
                if low > enter_low {
                    (enter_low, enter) = (low, outside / -speed);
                }
            } else if speed > 0.0 {
                let high = (-outside + rounding) / speed;
                if high < leave_high {
                    (leave_high, leave) = (high, -outside / speed);
                }
            } else if outside > rounding {
                (enter, enter_low) = (f64::INFINITY, f64::INFINITY);
            }
            axes.push(Axis {
                normal,
                outside,
                speed,
            });
        };
        turned(a, &a.0.normals).into_iter().for_each(|n| show(-n));
        turned(b, &b.0.normals).into_iter().for_each(&mut show);
        let edges_b = turned(b, &b.0.edges);
        for ea in turned(a, &a.0.edges) {
            for &eb in &edges_b {
                let cross = ea.cross(eb);
                if cross.length() > 1e-13 {
                    let mut normal = cross.normalize();
                    for _ in 0..2 {
                        normal = (normal - normal.dot(ea) * ea).normalize();
                    }
                    show(normal);
                    show(-normal);
                }
            }
        }
        Self {
            axes,
            a: (a.0.clone(), a.1),
            b: (b.0.clone(), b.1),
            between,
            motion,
            size,
            enter,
            leave,
        }
    }

    /// How far apart the bodies are at a time, negative if they overlap.
    pub(crate) fn apart(&self, time: f64) -> f64 {
        self.axes
            .iter()
            .map(|axis| axis.outside + time * axis.speed)
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// The depth of the crossing; negative by how much they miss.
    pub(crate) fn depth(&self) -> f64 {
        // The distance is convex in time.
        let reach = 3.0 * (self.size + self.between.length()) / self.motion.length();
        let (mut low, mut high) = (-reach, reach);
        for _ in 0..90 {
            let third = (high - low) / 3.0;
            if self.apart(low + third) < self.apart(high - third) {
                high -= third;
            } else {
                low += third;
            }
        }
        -self.apart(0.5 * (low + high))
    }

    /// What is wrong with an answer.
    pub(crate) fn complaint(&self, found: Option<&Crossing>) -> Option<String> {
        let Some(found) = found else {
            let depth = self.depth();
            return (depth > 1e-9 * self.size).then(|| format!("missed: depth {depth:e}"));
        };
        let coordinates = self.between.length() + (found.enter.fraction * self.motion).length();
        let exact = 1e-12 * self.size + 8.0 * f64::EPSILON * coordinates;
        let enter = found.enter;
        let gap = self.apart(enter.fraction);
        if gap.abs() > exact {
            return Some(format!(
                "{gap:e} apart on entry, {:e} of size",
                gap / self.size
            ));
        }
        let gap = self.apart(found.leave);
        if gap.abs() > exact {
            return Some(format!("{gap:e} apart on leaving"));
        }
        if found.leave < enter.fraction {
            return Some("leaves before it enters".into());
        }
        if (enter.normal.length() - 1.0).abs() > 1e-14 {
            return Some("normal not of unit length".into());
        }
        let normal = enter.normal;
        if normal.dot(self.motion.normalize()) > 1e-14 {
            return Some("normal along the motion".into());
        }
        let at = self.between + enter.fraction * self.motion;
        let points = |hull: &Hull, turn: DQuat| -> Vec<DVec3> {
            hull.points.iter().map(|&p| turn * p).collect()
        };
        let a: Vec<DVec3> = points(&self.a.0, self.a.1)
            .into_iter()
            .map(|p| p + at)
            .collect();
        let b = points(&self.b.0, self.b.1);
        let bottom = a
            .iter()
            .map(|p| normal.dot(*p))
            .fold(f64::INFINITY, f64::min);
        let top = b
            .iter()
            .map(|p| normal.dot(*p))
            .fold(f64::NEG_INFINITY, f64::max);
        if (bottom - top).abs() > exact {
            return Some(format!("normal parts by {:e}", bottom - top));
        }
        // The point lies in both bodies.
        let mut outside: f64 = 0.0;
        for (hull, turn, position) in [
            (&self.a.0, self.a.1, at),
            (&self.b.0, self.b.1, DVec3::ZERO),
        ] {
            let local = turn.conjugate() * (enter.point - position);
            for n in &hull.normals {
                let reach = hull
                    .points
                    .iter()
                    .map(|p| n.dot(*p))
                    .fold(f64::NEG_INFINITY, f64::max);
                let out = n.dot(local) - reach;
                outside = outside.max(out);
            }
        }
        if outside > 1e-7 * self.size {
            return Some(format!("point {outside:e} outside"));
        }
        self.unique(found, bottom, &a, &b).or_else(|| {
            (self.is_unique(found, 1e-14) && outside > 20.0 * exact)
                .then(|| format!("point {outside:e} outside"))
        })
    }

    /// Whether no other normal would do, or nearly do, but those within an angle.
    fn is_unique(&self, found: &Crossing, angle: f64) -> bool {
        let enter = found.enter;
        self.axes.iter().all(|axis| {
            let outside = axis.outside + enter.fraction * axis.speed;
            outside.abs() > NEAR * self.size || axis.normal.cross(enter.normal).length() <= angle
        })
    }

    /// Normal and features where only one will do.
    fn unique(&self, found: &Crossing, level: f64, a: &[DVec3], b: &[DVec3]) -> Option<String> {
        let enter = found.enter;
        let near = NEAR * self.size;
        if !self.is_unique(found, 1e-7) {
            return None;
        }
        let normal = (self.axes.iter().map(|axis| axis.normal))
            .max_by(|m, n| m.dot(enter.normal).total_cmp(&n.dot(enter.normal)))?;
        if normal.cross(enter.normal).length() > 1e-6 || normal.dot(enter.normal) < 0.0 {
            return Some(format!("normal {} for {normal}", enter.normal));
        }
        for (points, feature) in [(a, enter.features[0]), (b, enter.features[1])] {
            let heights: Vec<f64> = points
                .iter()
                .map(|p| (enter.normal.dot(*p) - level).abs())
                .collect();
            let on = heights.iter().filter(|&&h| h < 4e-15 * self.size).count();
            let nearly = heights.iter().filter(|&&h| h < near).count();
            if on != nearly {
                return None;
            }
            let right = match feature {
                Feature::Vertex(_) => on == 1,
                Feature::Edge(_) => on == 2,
                Feature::Face(_) => on >= 3,
                Feature::Surface => false,
            };
            if !right {
                return Some(format!("{feature:?} where {on} vertices touch"));
            }
            if let Feature::Vertex(vertex) = feature
                && heights[vertex as usize] > near
            {
                return Some(format!("{feature:?} does not touch"));
            }
        }
        None
    }
}
