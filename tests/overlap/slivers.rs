//! Pairs with faces so thin, or edges so nearly parallel, that rounding turns what they span.

use feeler::{Cuboid, Feature, Polytope, Pose, Shape, Sphere, Triangle, closest_points, overlap};
use glam::{DQuat, DVec3};

fn hull<const N: usize>(points: [[f64; 3]; N]) -> Shape {
    Polytope::from_points(points).unwrap().into()
}

#[test]
fn a_tetrahedron_just_off_a_thin_triangle_does_not_overlap_it() {
    // The triangle is a kilometre long and next to nothing wide: the planes of the difference's thin faces
    // did not go through their far corners.
    let a = hull([
        [-7.729630232732753, 4.112296638615779, -229.97558001571855],
        [6.990474435393398, 2.026714683645769, 354.45679023924976],
        [4.714902860602297, 6.311300633227911, -449.5712005515758],
        [-0.9630670817649956, 1.8205393674505954, -434.1513176686725],
    ]);
    let pose = Pose::at([113.58902025479989, -342.7746280830584, -378.21871246204716]);
    let b = Shape::from(
        Triangle::new(
            [314.42433981054813, -142.54846641649894, -284.97251099044223],
            [-100.52253984978667, -566.8168653167617, 274.17838451919835],
            [265.08739135296764, -192.99373940157187, -218.48978206528355],
        )
        .unwrap(),
    );
    let apart = closest_points(&a, &pose, &b, &Pose::IDENTITY).unwrap();
    assert!((apart.distance - 1.18e-9).abs() < 1e-11, "{apart:?}");
    assert_eq!(overlap(&a, &pose, &b, &Pose::IDENTITY), None);
}

#[test]
fn nearly_parallel_edges_are_measured_square_to_both() {
    // The depth was told 6e-9 m too large, for
    // rounding of their product leads along both.
    let a = hull([
        [
            -0.1918741205455611,
            -0.19187300953300943,
            -577.3834437786938,
        ],
        [0.19187096061605563, -0.1918746069635111, -577.3816475615092],
        [
            -0.19187386301850484,
            0.19187230155198393,
            -577.3944935766721,
        ],
        [0.1918715555767037, 0.19187380124772782, -577.3904165441827],
        [
            -0.19187063208623065,
            -0.19187182948861867,
            577.3820018195466,
        ],
        [0.19187207588183236, -0.19187303312831308, 577.3857397131235],
        [-0.1918715241135895, 0.19187409716978518, 577.389756488326],
        [0.19187197003371834, 0.19187423215688149, 577.3936970349295],
        [
            -0.19038389474366826,
            -0.19606642696413829,
            577.3806558603344,
        ],
        [
            -1.2824844286968284e-6,
            3.958573591977821e-7,
            -577.3941366006813,
        ],
    ]);
    let half = DVec3::new(7.318816258298937, 7.318816258298937, 577.3877945385008);
    let b = Shape::from(Cuboid::new(half).unwrap());
    let turn = DQuat::from_xyzw(
        -0.46378855352672665,
        0.12475350915576947,
        0.08167014064163246,
        0.8733079226129143,
    );
    let place = [128.95524524157798, 696.1582839131629, 457.8768682546927];
    let found = overlap(&a, &Pose::new(place, turn), &b, &Pose::new([0.0; 3], turn)).unwrap();
    // In twice the digits.
    assert!((found.depth - 7.161431338e-7).abs() < 1e-12, "{found:?}");
}

#[test]
fn a_ball_centred_by_a_corner_of_two_points_is_as_deep_as_the_nearer_edge_says() {
    // A box with corners moved by 1e-7; edges to two of them run side by side, as near to the
    // centre but for rounding, and the plane across the wrong one does not part the two.
    let b = hull([
        [-3996.4106689061705, -3996.410668919729, -3996.4106688890865],
        [3996.41066909265, -3996.4106689006226, -3996.4106688161046],
        [-3996.4106690390977, 3996.410669072568, -3996.410669018571],
        [3996.4106688512156, 3996.410668895976, -3996.410669081211],
        [-3996.410668985248, -3996.41066885959, 3996.4106689111422],
        [3996.4106690028534, -3996.4106689106725, 3996.4106689748],
        [-3996.4106690265457, 3996.4106689920773, 3996.4106689006676],
        [3996.4106688761603, 3996.4106688588213, 3996.4106688223164],
        [3996.4106689862274, -3996.4106688524657, 3996.4106689804003],
    ]);
    let radius = 3996.4106689517803;
    let ball = Shape::from(Sphere::new(radius).unwrap());
    let pose = Pose::at([-radius, -radius, radius]);
    let found = overlap(&ball, &pose, &b, &Pose::IDENTITY).unwrap();
    assert!((found.depth - 3996.410668851031).abs() < 2e-12, "{found:?}");
}

/// A box of which an edge is broken in its middle by rounding, if at all: it may be three points on one line.
fn broken(outwards: f64) -> Shape {
    let mut points = Cuboid::new([1.0; 3]).unwrap().vertices().to_vec();
    points.push(DVec3::new(0.0, 1.0 + outwards, 1.0));
    Polytope::from_points(points).unwrap().into()
}

#[test]
fn an_edge_that_rounding_broke_is_no_face() {
    let turn = DQuat::from_rotation_x(std::f64::consts::FRAC_PI_4);
    let cube = Shape::from(Cuboid::new([1.0; 3]).unwrap());
    let mut broken_ones = 0;
    for exponent in [13, 14, 15] {
        let shape = broken(10_f64.powi(-exponent));
        let Shape::Polytope(polytope) = &shape else {
            continue;
        };
        broken_ones += usize::from(polytope.vertices().len() > 8);
        // Edge up, and another box's edge across it.
        let across = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2) * turn;
        let height = 2.0 * std::f64::consts::SQRT_2;
        for gap in [-1e-3, 1e-3] {
            let above = Pose::new([0.3, 0.0, height + gap], across);
            let below = Pose::new([0.0; 3], turn);
            let features = if gap < 0.0 {
                let found = overlap(&shape, &below, &cube, &above).unwrap();
                [found.feature_a, found.feature_b]
            } else {
                let found = closest_points(&shape, &below, &cube, &above).unwrap();
                [found.feature_a, found.feature_b]
            };
            for feature in features {
                assert!(matches!(feature, Feature::Edge(_)), "{gap} {features:?}");
            }
        }
    }
    assert!(broken_ones > 0);
}

#[test]
fn a_face_that_rounding_broke_in_its_middle_is_hit_where_both_bodies_are() {
    // A vertex amid a face stands out by less than tells it from the face: sorted around the middle
    // with the corners it made a star of them, and the point told lay beside the bodies.
    use feeler::narrow_phase::exact::{contact_patch, touch};
    let small = Shape::from(Cuboid::new([0.25, 0.125, 0.25]).unwrap());
    let (mut broken_ones, motion) = (0, DVec3::new(0.0, 0.0, -2.0));
    for outwards in [1e-14, 3e-14, 1e-13, 3e-13] {
        for middle in [[0.0, 0.0], [0.1, -0.05], [-0.3, 0.2], [0.01, 0.01]] {
            let mut points = Cuboid::new([1.0; 3]).unwrap().vertices().to_vec();
            points.push(DVec3::new(middle[0], middle[1], 1.0 + outwards));
            let polytope = Polytope::from_points(points).unwrap();
            broken_ones += usize::from(polytope.vertices().len() > 8);
            let shape = Shape::from(polytope);
            for x in [0.5, 0.9, 1.1, -0.7] {
                let from = Pose::at([x, 0.5, 2.0]);
                let found = touch(&small, &from, &shape, &Pose::IDENTITY, motion).unwrap();
                let point = found.point;
                let beside = (point - DVec3::new(x, 0.5, 1.0)).abs();
                assert!(point.abs().max_element() < 1.0 + 1e-12, "{found:?}");
                assert!(beside.x < 0.25 + 1e-12 && beside.y < 0.125 + 1e-12);
                let landed = Pose::at(from.position + found.fraction * motion);
                let patch = contact_patch(&small, &landed, &shape, &Pose::IDENTITY, DVec3::Z);
                let area: f64 = (0..patch.len())
                    .map(|i| 0.5 * patch[i].cross(patch[(i + 1) % patch.len()]).z)
                    .sum();
                let want = 0.25 * ((x + 0.25).min(1.0) - (x - 0.25).max(-1.0));
                assert!((area - want).abs() < 1e-11, "{area} {want} {patch:?}");
            }
        }
    }
    assert!(broken_ones > 4, "{broken_ones}");
}
