//! Hulls of many vertices, where brute force over faces would take for ever.
//!
//! A touch is proved by what it claims: a plane that parts the bodies then and before, and a point
//! that both share. A miss is proved by a line that parts their shadows along the motion.

use crate::bodies::{direction, index, log, turn, unit};
use feeler::narrow_phase::exact::{Touching, flat_touch};
use feeler::{Feature, Polytope, Shape};
use glam::{DMat3, DQuat, DVec2, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use std::f64::consts::{PI, TAU};

struct Large {
    polytope: Polytope,
    shape: Shape,
}

fn large(rng: &mut ChaCha8Rng, scale: f64) -> Large {
    let size = scale * log(rng, 0.05, 3.0);
    let axes = size * DVec3::new(1.0, log(rng, 0.05, 1.0), log(rng, 0.05, 1.0));
    let points: Vec<DVec3> = match index(rng, 4) {
        0 => {
            // Meridians and parallels: opposite faces are parallel, and many have four corners.
            let (rows, columns) = (3 + index(rng, 10), 2 * (2 + index(rng, 8)));
            (0..rows * columns)
                .map(|i| {
                    let (sine, cosine) =
                        (PI * ((i / columns) as f64 + 0.5) / rows as f64).sin_cos();
                    let (y, x) = (TAU * (i % columns) as f64 / columns as f64).sin_cos();
                    axes * DVec3::new(sine * x, sine * y, cosine)
                })
                .collect()
        }
        1 => {
            let sides = 10 + index(rng, 90);
            (0..2 * sides)
                .map(|i| {
                    let (y, x) = (TAU * (i % sides) as f64 / sides as f64).sin_cos();
                    axes * DVec3::new(x, y, if i < sides { -1.0 } else { 1.0 })
                })
                .collect()
        }
        _ => {
            let count = log(rng, 20.0, 600.0) as usize;
            (0..count).map(|_| axes * direction(rng)).collect()
        }
    };
    let polytope = Polytope::from_points(points).unwrap();
    Large {
        shape: polytope.clone().into(),
        polytope,
    }
}

/// Corners of the convex hull of points in the plane, counter-clockwise.
fn outline(points: impl Iterator<Item = DVec2>) -> Vec<DVec2> {
    let mut points: Vec<DVec2> = points.collect();
    points.sort_by(|p, q| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)));
    let half = |points: &mut dyn Iterator<Item = &DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for &point in points {
            while let [.., p, q] = chain[..]
                && (q - p).perp_dot(point - q) <= 0.0
            {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut points.iter());
    hull.extend(half(&mut points.iter().rev()));
    hull
}

/// By how much two outlines are apart at least; negative if they overlap.
fn apart(a: &[DVec2], b: &[DVec2]) -> f64 {
    let beyond = |one: &[DVec2], other: &[DVec2]| {
        let mut most = f64::NEG_INFINITY;
        for (i, &from) in one.iter().enumerate() {
            let edge = one[(i + 1) % one.len()] - from;
            let outwards = -edge.perp().normalize_or_zero();
            let nearest = other.iter().map(|p| outwards.dot(*p - from));
            most = most.max(nearest.fold(f64::INFINITY, f64::min));
        }
        most
    };
    beyond(a, b).max(beyond(b, a))
}

struct Cast<'a> {
    a: (&'a Large, DQuat),
    b: (&'a Large, DQuat),
    between: DVec3,
    motion: DVec3,
}

impl Cast<'_> {
    fn size(&self) -> f64 {
        self.a.0.shape.max_dist() + self.b.0.shape.max_dist()
    }

    fn points(&self, (body, turn): (&Large, DQuat), at: DVec3) -> Vec<DVec3> {
        let turn = DMat3::from_quat(turn);
        let vertices = body.polytope.vertices().iter();
        vertices.map(|&vertex| turn * vertex + at).collect()
    }

    /// What is wrong with a touch.
    fn complaint(&self, touch: &Touching) -> Option<String> {
        let size = self.size();
        let at = self.between + touch.fraction * self.motion;
        let tolerance = 2e-12 * size + 1e-15 * (self.between.length() + at.length());
        let normal = touch.normal;
        if (normal.length() - 1.0).abs() > 1e-12 {
            return Some(format!("a normal of length {}", normal.length()));
        }
        if normal.dot(self.motion) > 1e-12 * self.motion.length() {
            return Some("it moves away".into());
        }
        let (a, b) = (self.points(self.a, at), self.points(self.b, DVec3::ZERO));
        let lowest = a
            .iter()
            .map(|p| normal.dot(*p))
            .fold(f64::INFINITY, f64::min);
        let highest = b
            .iter()
            .map(|p| normal.dot(*p))
            .fold(f64::NEG_INFINITY, f64::max);
        if (lowest - highest).abs() > tolerance {
            return Some(format!(
                "a gap of {:e} of the size",
                (lowest - highest) / size
            ));
        }
        for ((body, turn), at, side, feature) in [
            (self.a, at, -1.0, touch.features[0]),
            (self.b, DVec3::ZERO, 1.0, touch.features[1]),
        ] {
            let local = turn.conjugate() * (touch.point - at);
            let outside = (body.polytope.faces())
                .map(|face| face.normal.dot(local) - face.offset)
                .fold(f64::NEG_INFINITY, f64::max);
            if outside > 1e-9 * size {
                return Some(format!("the point lies {:e} outside", outside / size));
            }
            let along = turn.conjugate() * (side * normal);
            let vertices = body.polytope.vertices();
            let heights = vertices.iter().map(|v| along.dot(*v));
            let most = heights.fold(f64::NEG_INFINITY, f64::max);
            let of_feature: Vec<u32> = match feature {
                Feature::Vertex(vertex) => vec![vertex],
                Feature::Edge(edge) => body.polytope.edges()[edge as usize].vertices.to_vec(),
                Feature::Face(face) => {
                    let face = body.polytope.faces().nth(face as usize).unwrap();
                    face.vertices.to_vec()
                }
                Feature::Surface => return Some("no feature".into()),
            };
            for vertex in of_feature {
                let short = most - along.dot(vertices[vertex as usize]);
                if short > 1e-9 * size {
                    return Some(format!("{feature:?} lies {:e} lower", short / size));
                }
            }
        }
        None
    }

    /// By how much their shadows along the motion are apart.
    fn apart(&self) -> f64 {
        let (right, up) = self.motion.normalize().any_orthonormal_pair();
        let shadow = |points: Vec<DVec3>| {
            outline(
                points
                    .into_iter()
                    .map(|p| DVec2::new(p.dot(right), p.dot(up))),
            )
        };
        apart(
            &shadow(self.points(self.a, self.between)),
            &shadow(self.points(self.b, DVec3::ZERO)),
        )
    }
}

#[test]
fn touches_of_large_hulls_prove_themselves() {
    let number = |name: &str, default: u64| {
        let text = std::env::var(name).ok();
        text.map_or(default, |text| text.parse().unwrap())
    };
    let mut rng = ChaCha8Rng::seed_from_u64(number("SEED", 1));
    let casts = number("CASTS", 3000);
    let (mut hits, mut wrong) = (0, Vec::new());
    let mut pair = None;
    for number in 0..casts {
        if number % 20 == 0 {
            let scale = log(&mut rng, 1e-3, 1e3);
            let a = large(&mut rng, scale);
            let b = large(&mut rng, scale);
            pair = Some((a, b));
        }
        let Some((a, b)) = &pair else { continue };
        let b = if index(&mut rng, 4) == 0 { a } else { b };
        let turn_a = turn(&mut rng);
        let turn_b = if index(&mut rng, 3) == 0 {
            turn_a
        } else {
            turn(&mut rng)
        };
        let vertex = |rng: &mut ChaCha8Rng, (body, turn): (&Large, DQuat)| {
            let vertices = body.polytope.vertices();
            turn * vertices[index(rng, vertices.len())]
        };
        let size = a.shape.max_dist() + b.shape.max_dist();
        let along = match index(&mut rng, 3) {
            0 => DVec3::AXES[index(&mut rng, 3)],
            1 => (vertex(&mut rng, (a, turn_a)) - vertex(&mut rng, (a, turn_a)))
                .try_normalize()
                .unwrap_or(DVec3::X),
            _ => direction(&mut rng),
        };
        let aside = match index(&mut rng, 4) {
            0 => DVec3::ZERO,
            1 => size * log(&mut rng, 1e-16, 1e-6) * direction(&mut rng),
            _ => 1.2 * size * unit(&mut rng) * direction(&mut rng),
        };
        let through = vertex(&mut rng, (b, turn_b)) - vertex(&mut rng, (a, turn_a));
        let cast = Cast {
            a: (a, turn_a),
            b: (b, turn_b),
            between: through + aside - size * 4.0 * unit(&mut rng) * along,
            motion: size * log(&mut rng, 0.1, 10.0) * along,
        };
        let Cast {
            between, motion, ..
        } = cast;
        let complaint = match flat_touch(&a.shape, turn_a, &b.shape, turn_b, between, motion) {
            Some(touch) => {
                hits += 1;
                cast.complaint(&touch)
            }
            None => {
                let apart = cast.apart();
                (apart < -1e-12 * size).then(|| format!("missed by {:e} of the size", apart / size))
            }
        };
        wrong.extend(complaint.map(|complaint| format!("cast {number}: {complaint}")));
    }
    println!("{casts} casts, {hits} hits, {} wrong", wrong.len());
    assert!(wrong.is_empty(), "{:#?}", &wrong[..wrong.len().min(10)]);
    assert!(
        (casts * 3 / 10..casts * 9 / 10).contains(&hits),
        "lopsided: {hits} hits of {casts}"
    );
}
