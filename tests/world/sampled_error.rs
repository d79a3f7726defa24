//! What sampled rays are worth: the error their documentation states.

use crate::support::{Random, ball, cuboid, flying};
use feeler::{Body, Method, Placement, RayConfig, Refinement, Shape, first_contact};

fn even(rays: u32, seed: u64) -> Method {
    Method::Rays(RayConfig {
        rays,
        seed,
        placement: Placement::Even,
        refinement: Refinement::None,
        ..RayConfig::default()
    })
}

/// How late even rays see a touch at worst, and how far from it, as shares of the pair's reach.
fn worst(a: &Shape, b: &Shape, rays: u32) -> (f64, f64) {
    let mut random = Random::seeded(71);
    let reach = a.max_dist() + b.max_dist();
    let (mut late, mut off) = (0.0_f64, 0.0_f64);
    for seed in 0..400 {
        let along = random.direction();
        let aside = random.direction();
        let aside = (aside - aside.dot(along) * along).normalize() * random.within(0.0, 0.5);
        let start = reach * (aside - 3.0 * along);
        let (turn_a, turn_b) = (random.turn(), random.turn());
        let body = flying(a, start, 6.0 * reach * along).oriented(turn_a);
        let target = Body::fixed(b.clone(), [0.0; 3]).oriented(turn_b);
        let exact = first_contact(&body, &target, 1.0, &Method::Exact).unwrap();
        let sampled = first_contact(&body, &target, 1.0, &even(rays, seed)).unwrap();
        let Some(exact) = exact else {
            continue;
        };
        let sampled = sampled.unwrap();
        let delay = 6.0 * (sampled.fraction - exact.fraction);
        assert!(delay > -1e-12, "rays see nothing early: {delay}");
        late = late.max(delay);
        off = off.max(sampled.point.distance(exact.point) / reach);
    }
    (late, off)
}

/// The figures of `Placement::Even`'s documentation.
#[test]
fn even_rays_are_as_late_as_their_documentation_says() {
    let (small, large) = (cuboid(0.4, 0.6, 0.5), cuboid(0.8, 0.7, 0.3));
    for rays in [10, 30, 100, 300, 1000] {
        let n = f64::from(rays);
        for other in [&ball(0.7), &small] {
            let (late, off) = worst(&ball(1.0), other, rays);
            assert!(
                late < 0.8 / n && off < 0.8 / n.sqrt(),
                "{rays}: {late} {off}"
            );
        }
        let (late, off) = worst(&large, &small, rays);
        assert!(
            late < 0.3 / n.sqrt() && off < 0.8 / n.sqrt(),
            "{rays}: {late} {off}"
        );
        // They are no better than that either.
        assert!(
            late > 0.01 / n.sqrt() && off > 0.1 / n.sqrt(),
            "{rays}: {late} {off}"
        );
    }
}
