//! Random casts of all shapes and scales against the oracle.

use crate::oracle::{Solid, first_touch, shadow_depth};
use crate::support::{Kind, Random};
use feeler::{Body, Method, Motion, Pose, RayConfig, first_contact};
use glam::DVec3;

#[derive(Default)]
struct Tally {
    casts: usize,
    hits: usize,
    /// Shares of the pair's size by which missed pairs would have overlapped.
    missed: Vec<f64>,
    /// Errors of touches, along the motion, as shares of the pair's size.
    errors: Vec<f64>,
    /// Angles of the normals of balls against the line between centres' truth.
    ghosts: usize,
    off_surface: f64,
}

impl Tally {
    fn error(&self, quantile: f64) -> f64 {
        let mut sorted = self.errors.clone();
        sorted.sort_by(f64::total_cmp);
        let at = (quantile * sorted.len().saturating_sub(1) as f64) as usize;
        sorted.get(at).copied().unwrap_or(0.0)
    }

    fn worst_miss(&self) -> f64 {
        self.missed.iter().copied().fold(0.0, f64::max)
    }
}

fn hunt(kinds: [Kind; 2], casts: usize, seed: u64, far: f64, rays: u32) -> Tally {
    let mut random = Random::seeded(seed);
    let mut tally = Tally::default();
    let method = Method::Rays(RayConfig {
        rays,
        ..RayConfig::default()
    });
    while tally.casts < casts {
        let scale = random.decades(-3.0, 3.0);
        let sizes = [scale, scale * random.decades(-1.0, 1.0)];
        let shapes = [0, 1].map(|i| random.shape(kinds[i], sizes[i]));
        let turns = [random.turn(), random.turn()];
        let size = shapes[0].max_dist() + shapes[1].max_dist();
        let origin = far * random.vector();
        let direction = random.direction();
        let aside = direction.any_orthonormal_vector();
        let aside = glam::DQuat::from_axis_angle(direction, random.within(0.0, 6.3)) * aside;
        let start = origin - random.within(1.0, 3.0) * size * direction
            + random.within(0.0, 1.0) * size * aside;
        let poses = [Pose::new(start, turns[0]), Pose::new(origin, turns[1])];
        let solids = [0, 1].map(|i| Solid::of(&shapes[i], &poses[i]));
        if feeler::overlap(&shapes[0], &poses[0], &shapes[1], &poses[1]).is_some() {
            continue;
        }
        let carried = size * random.vector();
        let way = random.within(2.0, 6.0) * size * direction;
        let bodies = [(0, way + carried), (1, carried)].map(|(i, velocity): (usize, DVec3)| {
            let motion = Motion::free(poses[i].position, velocity).unwrap();
            Body::moving(shapes[i].clone(), motion).oriented(turns[i])
        });
        let way = (way + carried) - carried;
        tally.casts += 1;
        let want = first_touch(&solids[0], &solids[1], way);
        let got = first_contact(&bodies[0], &bodies[1], 1.0, &method).unwrap();
        let rounding = 1e-11 + 1e-13 * far / size;
        match (want, got) {
            (Some(want), Some(got)) => {
                tally.hits += 1;
                let error = (got.fraction - want) * way.length() / size;
                // Early at a graze: a touch within rounding of the surface.
                let early = if shadow_depth(&solids[0], &solids[1], way) > 1e-9 * size {
                    rounding.sqrt() * 1e-2
                } else {
                    1e-3
                };
                if error < -early {
                    tally.ghosts += 1;
                    eprintln!("early: {kinds:?} {error:e}");
                }
                tally.errors.push(error.abs());
                assert!((got.normal.length() - 1.0).abs() < 1e-12);
                let then = [0, 1].map(|i| {
                    let moved = [way + carried, carried][i] * got.fraction;
                    Solid::of(
                        &shapes[i],
                        &Pose::new(poses[i].position + moved, turns[i]),
                    )
                });
                for solid in then {
                    tally.off_surface =
                        tally.off_surface.max(solid.distance(got.point).abs() / size);
                }
            }
            (None, Some(_)) => {
                let depth = shadow_depth(&solids[0], &solids[1], way) / size;
                if depth < -rounding {
                    tally.ghosts += 1;
                    eprintln!("ghost: {kinds:?} {depth:e}");
                }
            }
            (Some(want), None) => {
                tally.hits += 1;
                let depth = shadow_depth(&solids[0], &solids[1], way) / size;
                let ends = (1.0 - want) * way.length() / size;
                tally.missed.push(depth.min(ends));
            }
            (None, None) => {}
        }
    }
    tally
}

#[test]
#[ignore = "prints figures"]
fn figures() {
    let casts = std::env::var("CASTS").map_or(2000, |c| c.parse().unwrap());
    for rays in [100, 1000] {
        for (i, a) in Kind::ALL.into_iter().enumerate() {
            for b in Kind::ALL.into_iter().skip(i) {
                let t = hunt([a, b], casts, 1, 0.0, rays);
                println!(
                    "{rays:5} {a:?}-{b:?}: hits {}/{} missed {} worst {:.1e} ghosts {} \
                     error median {:.1e} 99% {:.1e} worst {:.1e} off {:.1e}",
                    t.hits,
                    t.casts,
                    t.missed.len(),
                    t.worst_miss(),
                    t.ghosts,
                    t.error(0.5),
                    t.error(0.99),
                    t.error(1.0),
                    t.off_surface
                );
            }
        }
    }
}
