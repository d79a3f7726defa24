//! Answers known beforehand.

use crate::case::*;
use feeler::{Cuboid, Feature, Polytope, Pose, Shape, Sphere, Triangle};
use glam::{DQuat, DVec3};
use std::f64::consts::FRAC_PI_4;

fn cube(half: f64) -> Shape {
    Cuboid::new([half; 3]).unwrap().into()
}

fn at(a: Shape, pose_a: Pose, b: Shape, pose_b: Pose) -> Case {
    Case {
        a,
        pose_a,
        b,
        pose_b,
    }
}

#[test]
fn two_balls() {
    let ball = Shape::from(Sphere::new(0.5).unwrap());
    let case = at(
        ball.clone(),
        Pose::at([3.0, 4.0, 0.0]),
        ball,
        Pose::IDENTITY,
    );
    let found = case.check("two balls").unwrap();
    assert_eq!(found.distance, 4.0);
    assert!((found.normal - DVec3::new(0.6, 0.8, 0.0)).length() < 1e-15);
    assert!((found.point_b - DVec3::new(0.3, 0.4, 0.0)).length() < 1e-15);
    assert_eq!([found.feature_a, found.feature_b], [Feature::Surface; 2]);
}

#[test]
fn two_cubes_face_to_face_edge_to_edge_and_corner_to_corner() {
    for gap in [1e-12, 1e-9, 1e-3, 1.0, 1e3] {
        let label = format!("gap {gap:e}");
        // Coordinates of 1 are rounded by 1e-16.
        let near = |distance: f64, want: f64| (distance - want).abs() <= 1e-15 * (1.0 + want);

        let place = Pose::at([1.0 + gap, 0.25, -0.25]);
        let found = at(cube(0.5), place, cube(0.5), Pose::IDENTITY)
            .check(&label)
            .unwrap();
        assert!(near(found.distance, gap), "{label}: {found:?}");
        assert_eq!(found.normal, DVec3::X);
        assert_eq!(
            [found.feature_a, found.feature_b],
            [Feature::Face(0), Feature::Face(1)]
        );

        let place = Pose::at([1.0 + gap, 1.0 + gap, 0.3]);
        let found = at(cube(0.5), place, cube(0.5), Pose::IDENTITY)
            .check(&label)
            .unwrap();
        assert!(
            near(found.distance, 2_f64.sqrt() * gap),
            "{label}: {found:?}"
        );
        assert_eq!(
            [found.feature_a, found.feature_b],
            [Feature::Edge(8), Feature::Edge(11)]
        );

        let place = Pose::at(DVec3::splat(1.0 + gap));
        let found = at(cube(0.5), place, cube(0.5), Pose::IDENTITY)
            .check(&label)
            .unwrap();
        assert!(
            near(found.distance, 3_f64.sqrt() * gap),
            "{label}: {found:?}"
        );
        assert_eq!(
            [found.feature_a, found.feature_b],
            [Feature::Vertex(0), Feature::Vertex(7)]
        );
        assert!((found.point_a + DVec3::splat(0.5)).length() < 1e-15);
    }
}

#[test]
fn crossed_edges_and_a_corner_over_a_face() {
    let turned = DQuat::from_rotation_x(FRAC_PI_4);
    let crossed = DQuat::from_rotation_y(FRAC_PI_4);
    let reach = 0.5_f64.sqrt();
    for gap in [1e-12, 1e-9, 1e-3, 1.0] {
        let label = format!("gap {gap:e}");
        let place = Pose::new([0.1, 0.2, 2.0 * reach + gap], turned);
        let case = at(cube(0.5), place, cube(0.5), Pose::new([0.0; 3], crossed));
        let found = case.check(&label).unwrap();
        assert!((found.distance - gap).abs() < 1e-15, "{label}: {found:?}");
        assert!((found.normal - DVec3::Z).length() < 1e-15);
        // B's edge runs along y at x = 0, A's along x at y = 0.2.
        assert!((found.point_b - DVec3::new(0.0, 0.2, reach)).length() < 1e-15);

        let tip = Polytope::from_points([
            [0.0, 0.0, 0.0],
            [0.3, 0.0, 1.0],
            [-0.2, 0.3, 1.0],
            [-0.2, -0.3, 1.0],
        ]);
        let case = at(
            tip.unwrap().into(),
            Pose::at([0.3, -0.4, 0.5 + gap]),
            cube(0.5),
            Pose::IDENTITY,
        );
        let found = case.check(&label).unwrap();
        assert!((found.distance - gap).abs() < 1e-15, "{label}: {found:?}");
        assert_eq!(
            [found.feature_a, found.feature_b],
            [Feature::Vertex(0), Feature::Face(5)]
        );
        assert!((found.point_b - DVec3::new(0.3, -0.4, 0.5)).length() < 1e-15);
    }
}

#[test]
fn triangles_in_one_plane_and_above_each_other() {
    let triangle = || -> Shape {
        Triangle::new([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
            .unwrap()
            .into()
    };
    let case = at(
        triangle(),
        Pose::at([2.0, 0.0, 0.0]),
        triangle(),
        Pose::IDENTITY,
    );
    let found = case.check("one plane").unwrap();
    assert_eq!((found.distance, found.normal), (1.0, DVec3::X));
    // A's whole edge along y, and B's corner.
    assert_eq!(
        [found.feature_a, found.feature_b],
        [Feature::Edge(2), Feature::Vertex(1)]
    );

    let case = at(
        triangle(),
        Pose::at([0.1, 0.1, 1e-9]),
        triangle(),
        Pose::IDENTITY,
    );
    let found = case.check("one above the other").unwrap();
    assert!((found.distance - 1e-9).abs() < 1e-24);
    assert_eq!(
        [found.feature_a, found.feature_b],
        [Feature::Face(1), Feature::Face(0)]
    );
}

#[test]
fn a_ball_of_a_centimetre_over_a_slab_of_ten_kilometres() {
    let slab = Shape::from(Cuboid::new([5e3, 5e3, 0.5]).unwrap());
    let ball = Shape::from(Sphere::new(0.01).unwrap());
    let case = at(
        ball,
        Pose::at([4321.0, -1234.5, 0.51 + 1e-6]),
        slab,
        Pose::IDENTITY,
    );
    let found = case.check("ball over slab").unwrap();
    // Not worse for the slab's width.
    assert!((found.distance - 1e-6).abs() < 1e-15, "{found:?}");
    assert_eq!(found.normal, DVec3::Z);
    assert!((found.point_b - DVec3::new(4321.0, -1234.5, 0.5)).length() < 1e-12);
}

/// The search's last steps lower the distance by less than rounding, and yet the normal needs them.
#[test]
fn a_ball_beside_a_corner_where_an_edge_begins() {
    let ball = Shape::from(Sphere::new(1.0).unwrap());
    for along in [1e-16, 1e-13, 1e-11, 1e-9, 1e-7] {
        for sign in [-1.0, 1.0] {
            let at_corner = DVec3::new(0.5 - sign * along, 0.5, 0.5);
            let place = Pose::at(at_corner + 1.003 * DVec3::new(0.0, 0.6, 0.8));
            let case = at(ball.clone(), place, cube(0.5), Pose::IDENTITY);
            let found = case.check(&format!("{along:e}")).unwrap();
            // Beyond the corner it is a little farther.
            let beyond = along * f64::midpoint(1.0, -sign);
            let want = 1.003_f64.hypot(beyond) - 1.0;
            assert!(
                (found.distance - want).abs() < 1e-15,
                "{along:e}: {found:?}"
            );
        }
    }
}

#[test]
fn a_thin_triangle_that_all_but_touches_an_edge_is_parted_by_the_normal_told() {
    // The gap is 3e-14 of the triangle's length: the nearest point of two triangles that make up
    // the parallelogram between two edges lay on their common diagonal, and the vector to it was
    // mostly rounding.
    let triangle = Triangle::new(
        [-20239.075949891547, 9975.869346368469, 17208.17096928383],
        [-21513.317121937427, -9941.666101115004, 15472.461789559215],
        [-21238.710333867366, -5645.250843551767, 15847.093158085429],
    )
    .unwrap();
    let vertices = triangle.vertices();
    let turn = DQuat::from_xyzw(
        0.012495107693542255,
        0.04639436551054855,
        0.009128374293374217,
        0.9988033379576584,
    );
    let half = DVec3::new(12.854694131901292, 2.260698848477199, 35.11239673136808);
    let from = DVec3::new(7029605.0848965505, -3637305.3753027823, 5908862.944272771);
    let to = DVec3::new(7009808.060428541, -3648034.868926506, 5925961.1845439);
    let found = at(
        triangle.into(),
        Pose::new(from, turn),
        Cuboid::new(half).unwrap().into(),
        Pose::at(to),
    )
    .closest()
    .unwrap();
    let lowest = (vertices.iter())
        .map(|&vertex| ((from - to) + turn * vertex).dot(found.normal))
        .fold(f64::INFINITY, f64::min);
    let highest = half.dot(found.normal.abs());
    let gap = lowest - highest;
    assert!((gap - found.distance).abs() < 1e-9, "{gap:e} {found:?}");
    assert!(matches!(found.feature_a, Feature::Edge(_)), "{found:?}");
}

#[test]
fn a_corner_far_below_the_nearest_is_no_part_of_the_feature() {
    // All but touching: an edge was told of which one end lay 0.22 m off the touch.
    let box_of_hairs = [
        [
            -0.15863475372830513,
            -0.11422771326808198,
            -0.154833983910427,
        ],
        [
            0.1586347533481638,
            -0.11422771378189008,
            -0.15483398382733204,
        ],
        [
            -0.158634753396711,
            0.11422771413641414,
            -0.15483398396733902,
        ],
        [
            0.15863475329402746,
            0.11422771387213145,
            -0.15483398379445562,
        ],
        [
            -0.15863475408779013,
            -0.11422771386215613,
            0.15483398366391574,
        ],
        [
            0.15863475305757058,
            -0.11422771362192762,
            0.1548339832928419,
        ],
        [
            -0.15863475298112084,
            0.11422771336369818,
            0.15483398382228503,
        ],
        [
            0.15863475395793056,
            0.11422771365841294,
            0.15483398342648505,
        ],
    ];
    let triangle = Triangle::new(
        [2.152232319230431, 1.0478967926835356, -0.6816660001041366],
        [2.1220129777528034, -0.3523359074916254, -2.3016778596360012],
        [-2.5285554638379066, 0.4829987236022632, 2.325156075559142],
    )
    .unwrap();
    let hull = Polytope::from_points(box_of_hairs).unwrap();
    let pose = Pose::at([-2.3699207104411926, 0.3687710094658314, 2.4799900595264717]);
    let found = at(hull.clone().into(), pose, triangle.into(), Pose::IDENTITY)
        .closest()
        .unwrap();
    let Feature::Edge(edge) = found.feature_a else {
        panic!("{found:?}");
    };
    for vertex in hull.edges()[edge as usize].vertices {
        // As the point, seen from the body's position.
        let vertex = hull.vertices()[vertex as usize];
        let above = (vertex - found.point_a).dot(found.normal);
        assert!(above < 1e-8, "{above:e}");
    }
}
