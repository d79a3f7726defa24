//! Lines that pass an edge within rounding, at a small angle to a face behind it.

use feeler::{Polytope, Ray, RayCast, RayHit};
use glam::DVec3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

#[test]
fn a_polytope_is_hit_on_its_surface_by_a_ray_aimed_at_an_edge() {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let mut unit = || (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
    let mut hits = 0;
    for _ in 0..300 {
        let mut anywhere = || DVec3::from_array(std::array::from_fn(|_| 2.0 * unit() - 1.0));
        let hull = Polytope::from_points((0..24).map(|_| anywhere())).expect("they span a body");
        for edge in hull.edges() {
            let [from, to] = edge.vertices.map(|vertex| hull.vertices()[vertex as usize]);
            // Over one of its faces, nearly in its plane.
            let normal = hull.face_normals()[edge.faces[0] as usize];
            let aim = 0.5 * (from + to);
            let across = normal.cross(to - from).normalize();
            let steep = 1e-4 * (1.0 + 9.0 * unit());
            let origin = aim + 3.0 * (across + steep * normal);
            let ray = Ray::new(origin, aim - origin);
            let Some(RayHit::Surface(hit)) = hull.first_hit(&ray) else {
                continue;
            };
            hits += 1;
            let point = ray.at(hit.fraction);
            let heights = hull
                .faces()
                .map(|face| face.normal.dot(point) - face.offset);
            let height = heights.fold(f64::NEG_INFINITY, f64::max);
            assert!(
                height.abs() < 3e-14,
                "{height:e} from the surface at {hit:?}"
            );
        }
    }
    assert!(hits > 5_000, "{hits} hits");
}
