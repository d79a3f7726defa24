//! Hulls by brute force, in integers: every three points give a plane; if no
//! point lies above it, it bounds the body.

use std::collections::BTreeSet;

pub(crate) type Point = [i128; 3];

pub(crate) struct OracleHull {
    /// The corners.
    pub(crate) vertices: BTreeSet<Point>,
    /// The corners on each face.
    pub(crate) faces: BTreeSet<BTreeSet<Point>>,
}

fn minus(a: Point, b: Point) -> Point {
    std::array::from_fn(|i| a[i] - b[i])
}

fn cross(a: Point, b: Point) -> Point {
    std::array::from_fn(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3])
}

fn dot(a: Point, b: Point) -> i128 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Coordinates up to 2⁴⁰ cannot overflow.
pub(crate) fn hull(points: &[Point]) -> OracleHull {
    let points: Vec<Point> = points
        .iter()
        .copied()
        .collect::<BTreeSet<_>>()
        .into_iter()
        .collect();
    let mut planes = BTreeSet::new();
    for (i, &a) in points.iter().enumerate() {
        for (j, &b) in points.iter().enumerate().skip(i + 1) {
            for &c in points.iter().skip(j + 1) {
                let normal = cross(minus(b, a), minus(c, a));
                if normal == [0; 3] {
                    continue;
                }
                let heights: Vec<i128> = points.iter().map(|&p| dot(normal, minus(p, a))).collect();
                if heights.iter().all(|&h| h <= 0) || heights.iter().all(|&h| h >= 0) {
                    let on: BTreeSet<Point> = points
                        .iter()
                        .zip(&heights)
                        .filter(|(_, h)| **h == 0)
                        .map(|(p, _)| *p)
                        .collect();
                    planes.insert(on);
                }
            }
        }
    }
    let vertices: BTreeSet<Point> = (points.iter().copied())
        .filter(|&point| is_corner(point, &planes))
        .collect();
    let faces = planes
        .into_iter()
        .map(|plane| plane.intersection(&vertices).copied().collect())
        .collect();
    OracleHull { vertices, faces }
}

/// Whether the normals of the planes through the point span space: in the middle
/// of an edge or face they do not.
fn is_corner(point: Point, planes: &BTreeSet<BTreeSet<Point>>) -> bool {
    let mut normals: Vec<Point> = Vec::new();
    for plane in planes.iter().filter(|plane| plane.contains(&point)) {
        let pairs = plane
            .iter()
            .flat_map(|&b| plane.iter().map(move |&c| (b, c)));
        let mut crosses = pairs.map(|(b, c)| cross(minus(b, point), minus(c, point)));
        normals.extend(crosses.find(|&normal| normal != [0; 3]).map(reduce));
    }
    normals.iter().any(|&a| {
        (normals.iter()).any(|&b| !parallel(a, b) && normals.iter().any(|&c| independent(a, b, c)))
    })
}

fn reduce(normal: Point) -> Point {
    let divisor = normal.iter().fold(0, |g, &x| gcd(g, x.abs()));
    normal.map(|x| x / divisor)
}

fn gcd(a: i128, b: i128) -> i128 {
    if b == 0 { a } else { gcd(b, a % b) }
}

fn parallel(a: Point, b: Point) -> bool {
    a == b || a == b.map(|x| -x)
}

/// Decided modulo a large prime: a determinant that is a multiple of it by
/// chance would be a false alarm of the test, not a silent pass.
fn independent(a: Point, b: Point, c: Point) -> bool {
    const PRIME: i128 = (1 << 61) - 1;
    let [a, b, c] = [a, b, c].map(|v| v.map(|x| x.rem_euclid(PRIME)));
    let mut determinant = 0;
    for (i, a) in a.into_iter().enumerate() {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let minor = (b[j] * c[k] % PRIME - b[k] * c[j] % PRIME).rem_euclid(PRIME);
        determinant = (determinant + a * minor) % PRIME;
    }
    determinant != 0
}
