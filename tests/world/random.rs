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
    /// The same as shares of what rounding explains.
    excess: f64,
    /// Touches where there is none, or before there is one.
    ghosts: usize,
    /// How far points of contact are off either body, as shares of the pair's size.
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

fn hunt(kinds: [Kind; 2], casts: usize, seed: u64, far: f64, method: Method) -> Tally {
    let mut random = Random::seeded(seed);
    let mut tally = Tally::default();
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
        // Coordinates are off by 1e-16 of their size, a graze by the root of that.
        let rounding = 1e-13 + 1e-14 * far / size;
        let depth = shadow_depth(&solids[0], &solids[1], way) / size;
        let tolerance = 10.0 * rounding / depth.abs().max(rounding).sqrt();
        match (want, got) {
            (Some(want), Some(got)) => {
                tally.hits += 1;
                let error = (got.fraction - want) * way.length() / size;
                if error < -tolerance {
                    tally.ghosts += 1;
                }
                tally.errors.push(error.abs());
                tally.excess = tally.excess.max(error.abs() / tolerance);
                assert!((got.normal.length() - 1.0).abs() < 1e-12);
                let then = [0, 1].map(|i| {
                    let moved = [way + carried, carried][i] * got.fraction;
                    Solid::of(&shapes[i], &Pose::new(poses[i].position + moved, turns[i]))
                });
                for solid in then {
                    tally.off_surface = tally
                        .off_surface
                        .max(solid.distance(got.point).abs() / size);
                }
            }
            (None, Some(_)) => {
                if depth < -rounding {
                    tally.ghosts += 1;
                }
            }
            (Some(want), None) => {
                tally.hits += 1;
                let ends = (1.0 - want) * way.length() / size;
                tally.missed.push(depth.min(ends));
            }
            (None, None) => {}
        }
    }
    tally
}

#[test]
fn straight_casts_of_all_shapes_miss_nothing_and_see_no_ghosts() {
    let casts = std::env::var("CASTS").map_or(150, |casts| casts.parse().unwrap());
    for (index, a) in Kind::ALL.into_iter().enumerate() {
        for b in Kind::ALL.into_iter().skip(index) {
            let rays = |rays| {
                Method::Rays(RayConfig {
                    rays,
                    ..RayConfig::default()
                })
            };
            for (far, method, name) in [
                (0.0, rays(100), "100 rays"),
                (0.0, rays(1), "1 ray"),
                (1e4, rays(100), "100 rays"),
                (0.0, Method::Exact, "exact"),
                (1e4, Method::Exact, "exact"),
            ] {
                let tally = hunt([a, b], casts, 1, far, method);
                let error = |quantile| tally.error(quantile);
                let told = format!(
                    "{a:?} and {b:?}, {name}, {far} m out: {} hits of {}, {} missed, by {:.1e} \
                     at worst, {} ghosts; errors {:.1e} at the median, {:.1e} at worst, {:.1e} of \
                     the tolerance; points off by {:.1e}",
                    tally.hits,
                    tally.casts,
                    tally.missed.len(),
                    tally.worst_miss(),
                    tally.ghosts,
                    error(0.5),
                    error(1.0),
                    tally.excess,
                    tally.off_surface,
                );
                println!("{told}");
                let share = tally.hits as f64 / tally.casts as f64;
                assert!((0.15..=0.999).contains(&share), "lopsided: {told}");
                assert!(tally.ghosts == 0, "{told}");
                assert!(tally.worst_miss() < 1e-9, "{told}");
                assert!(tally.excess < 1.0, "{told}");
                assert!(tally.off_surface < 1e-12 + 1e-12 * far / 2e-4, "{told}");
            }
        }
    }
}

/// Two crossed bars whose shadows share no vertex.
#[test]
fn crossed_needles_meet() {
    let bar = Kind::Needle;
    let mut random = Random::seeded(7);
    let needle = random.shape(bar, 1.0);
    for _ in 0..500 {
        let turns = [random.turn(), random.turn()];
        // Along both bars' common normal, from one inner point to another.
        let [u, v] = turns.map(|turn| turn * DVec3::Z);
        let across = u.cross(v).normalize();
        let start = random.within(-0.9, 0.9) * u + random.within(-0.9, 0.9) * v - across;
        let a = Body::moving(needle.clone(), Motion::free(start, 2.0 * across).unwrap());
        let b = Body::fixed(needle.clone(), DVec3::ZERO);
        let got = first_contact(
            &a.oriented(turns[0]),
            &b.oriented(turns[1]),
            1.0,
            &Method::default(),
        );
        let got = got.unwrap().unwrap();
        let poses = [Pose::new(start, turns[0]), Pose::new(DVec3::ZERO, turns[1])];
        let solids = [0, 1].map(|i| Solid::of(&needle, &poses[i]));
        let want = first_touch(&solids[0], &solids[1], 2.0 * across).unwrap();
        assert!((got.fraction - want).abs() < 1e-12, "{got:?} {want}");
        // A ray reports the normal of the triangle that it hits.
        assert!(got.normal.dot(across) < -0.5, "{got:?}");
    }
}
