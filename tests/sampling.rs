//! Where surface rays start: even, in place, and the same for ever.

use feeler::sampling::{
    hemisphere_even, hemisphere_grid, square_lattice, triangle_even, triangle_thesis,
};
use glam::{DVec2, DVec3};

const CORNERS: [DVec3; 3] = [DVec3::ZERO, DVec3::X, DVec3::Y];

fn directions() -> [DVec3; 5] {
    let diagonal = DVec3::new(1.0, -2.0, 3.0).normalize();
    [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_Z, diagonal]
}

/// Bits that must be the same on every platform and in every release.
#[test]
fn the_same_seed_gives_the_same_points_for_ever() {
    let bits = |point: DVec3| point.to_array().map(f64::to_bits);
    let even = triangle_even(CORNERS, 2, 10);
    assert_eq!(bits(even[1]), EVEN, "{:x?}", bits(even[1]));
    let lattice = square_lattice(3, 10)[2];
    assert_eq!(
        lattice.to_array().map(f64::to_bits),
        LATTICE,
        "{:x?}",
        lattice.to_array().map(f64::to_bits)
    );
    let grid = hemisphere_grid(100)[47];
    assert_eq!(bits(grid), GRID, "{:x?}", bits(grid));
    let sunflower = hemisphere_even(100, DVec3::Z)[47];
    assert_eq!(bits(sunflower), SUNFLOWER, "{:x?}", bits(sunflower));
}

const EVEN: [u64; 3] = [0x3fb9e53b18035444, 0x3fe44146f4422b3e, 0x0];
const LATTICE: [u64; 2] = [0xbfeb8b3ff42904cc, 0xbfe68556d6ce44fc];
const GRID: [u64; 3] = [0x3fc73fd61d9df549, 0x3fe9e3779b97f4a8, 0x3fe1e3779b97f4a8];
const SUNFLOWER: [u64; 3] = [0x3fe513569f942284, 0xbfc9fdc30e72a731, 0x3fe72faafc7e3cd7];

/// `srand(10)` and `srand(16)` of the runtime the thesis used, as its tables print the points.
#[test]
fn the_thesis_draws_come_out_again() {
    let base = [[1.0, -1.0, 1.0], [-1.0, -1.0, 1.0], [0.0, -1.0, -1.0]].map(DVec3::from);
    for (count, seed, x, z) in [
        (1, 10, 0.481052, -0.029230),
        (10, 10, -0.265349, 0.066396),
        (30, 10, -0.126160, -0.185515),
        (80, 10, -0.128035, 0.089186),
        (60, 16, 0.006193, 0.106779),
    ] {
        let nearest = triangle_thesis(base, count, seed)
            .into_iter()
            .min_by(|a, b| a.x.hypot(a.z).total_cmp(&b.x.hypot(b.z)))
            .expect("there are points");
        let off = (nearest.x - x).abs().max((nearest.z - z).abs());
        assert!(off < 6e-7, "{count} rays, seed {seed}: {nearest}");
    }
}

#[test]
fn points_of_a_triangle_lie_in_it_and_even_ones_evenly() {
    let quarter =
        |points: &[DVec3]| points.iter().filter(|p| p.x > 0.5).count() as f64 / points.len() as f64;
    for seed in [0, 1, 10, u64::MAX] {
        let even = triangle_even(CORNERS, 10_000, seed);
        let thesis = triangle_thesis(CORNERS, 10_000, seed);
        for point in even.iter().chain(&thesis) {
            assert!(point.x >= 0.0 && point.y >= 0.0 && point.x + point.y <= 1.0 + 1e-15);
        }
        // The corner's quarter of the area; the thesis's draw puts half of all points there.
        assert!((quarter(&even) - 0.25).abs() < 0.02, "{}", quarter(&even));
        assert!(
            (quarter(&thesis) - 0.5).abs() < 0.02,
            "{}",
            quarter(&thesis)
        );
    }
}

#[test]
fn points_of_a_hemisphere_lie_on_it_and_face_the_motion() {
    for direction in directions() {
        for count in [1, 2, 10, 1000] {
            let points = hemisphere_even(count, direction);
            assert_eq!(points.len(), count as usize);
            for point in points {
                assert!((point.length() - 1.0).abs() < 1e-12, "{point}");
                assert!(point.dot(direction) > 0.0, "{point}");
            }
        }
        assert!((hemisphere_even(1, direction)[0] - direction).length() < 1e-15);
    }
    for count in [1, 2, 3, 10, 81, 100, 1000] {
        for point in hemisphere_grid(count) {
            assert!((point.length() - 1.0).abs() < 1e-15, "{point}");
            assert!(point.y > -1e-15, "{point}");
        }
    }
    assert!(hemisphere_grid(0).is_empty() && hemisphere_even(0, DVec3::X).is_empty());
}

/// Seen along the motion, every ring of equal area holds its share of the points.
#[test]
fn even_points_fill_the_disc_evenly() {
    let points = hemisphere_even(1000, DVec3::Z);
    for ring in 0..10 {
        let (inner, outer) = (f64::from(ring) / 10.0, f64::from(ring + 1) / 10.0);
        let share = |p: &&DVec3| (inner..outer).contains(&p.truncate().length_squared());
        let count = points.iter().filter(share).count();
        assert!((99..=101).contains(&count), "ring {ring} holds {count}");
    }
    let nearest = |a: &DVec3| {
        let others = points.iter().filter(|b| *b != a);
        others
            .map(|b| a.truncate().distance(b.truncate()))
            .fold(f64::INFINITY, f64::min)
    };
    let closest = points.iter().map(nearest).fold(f64::INFINITY, f64::min);
    assert!(closest > 0.03, "two points only {closest} apart");
}

#[test]
fn the_lattice_fills_the_square_without_clusters() {
    for seed in [0, 7, 1 << 40] {
        let points = square_lattice(1000, seed);
        assert_eq!(points[0], DVec2::ZERO);
        assert_eq!(points[..10], square_lattice(10, seed));
        let mut cells = [0_u32; 100];
        for point in &points {
            assert!(point.cmpge(DVec2::NEG_ONE).all() && point.cmplt(DVec2::ONE).all());
            let cell = ((*point + 1.0) * 5.0).floor();
            cells[cell.x as usize + 10 * cell.y as usize] += 1;
        }
        assert!(
            cells.iter().all(|count| (7..=13).contains(count)),
            "{cells:?}"
        );
    }
}
