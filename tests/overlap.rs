//! Overlap of two shapes against an oracle that tries every direction that may count.

mod oracle {
    use feeler::{Pose, Shape};
    use glam::DVec3;

    /// A shape as points in the frame of the pair, swollen by a radius.
    pub struct Body {
        pub points: Vec<DVec3>,
        pub radius: f64,
    }

    pub fn body(shape: &Shape, pose: &Pose, origin: DVec3) -> Body {
        let place = |p: DVec3| (pose.position - origin) + pose.orientation * p;
        let (points, radius) = match shape {
            Shape::Sphere(sphere) => (vec![DVec3::ZERO], sphere.radius()),
            Shape::Cuboid(cuboid) => (cuboid.vertices().to_vec(), 0.0),
            Shape::Triangle(triangle) => (triangle.vertices().to_vec(), 0.0),
            Shape::Polytope(polytope) => (polytope.vertices().to_vec(), 0.0),
        };
        Body {
            points: points.into_iter().map(place).collect(),
            radius,
        }
    }

    /// How far `a` must move along `d` to be parted from `b`.
    pub fn width(a: &Body, b: &Body, d: DVec3) -> f64 {
        let top = b.points.iter().map(|p| p.dot(d)).fold(f64::MIN, f64::max);
        let bottom = a.points.iter().map(|p| p.dot(d)).fold(f64::MAX, f64::min);
        top - bottom + a.radius + b.radius
    }

    fn differences(body: &Body) -> Vec<DVec3> {
        let mut all = Vec::new();
        for (i, p) in body.points.iter().enumerate() {
            for q in &body.points[..i] {
                all.push(p - q);
            }
        }
        all
    }

    /// The least width over every direction that may be the normal of a face, a
    /// rounded edge or a rounded vertex of the Minkowski difference.
    pub fn depth(a: &Body, b: &Body) -> f64 {
        let mut least = f64::MAX;
        let mut show = |d: DVec3| {
            let scale = d.abs().max_element();
            if scale > 0.0 {
                let d = (d / scale).normalize();
                least = least.min(width(a, b, d)).min(width(a, b, -d));
            }
        };
        let (edges_a, edges_b) = (differences(a), differences(b));
        for edges in [&edges_a, &edges_b] {
            for (i, e) in edges.iter().enumerate() {
                for f in &edges[..i] {
                    show(e.cross(*f));
                }
            }
        }
        for e in &edges_a {
            for f in &edges_b {
                show(e.cross(*f));
            }
        }
        if a.radius + b.radius > 0.0 {
            show(DVec3::X);
            for p in &a.points {
                for q in &b.points {
                    show(p - q);
                }
            }
            for (from, edges, to) in [(a, &edges_a, b), (b, &edges_b, a)] {
                for p in &from.points {
                    for q in &to.points {
                        for e in edges {
                            show(e.cross((p - q).cross(*e)));
                        }
                    }
                }
            }
        }
        least
    }
}

use feeler::{Cuboid, Feature, Overlap, Polytope, Pose, Shape, Sphere, Triangle, overlap};
use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

fn unit_float(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

fn signed(rng: &mut ChaCha8Rng) -> f64 {
    2.0 * unit_float(rng) - 1.0
}

fn log_uniform(rng: &mut ChaCha8Rng, from: f64, to: f64) -> f64 {
    from * (to / from).powf(unit_float(rng))
}

fn vector(rng: &mut ChaCha8Rng) -> DVec3 {
    DVec3::new(signed(rng), signed(rng), signed(rng))
}

fn direction(rng: &mut ChaCha8Rng) -> DVec3 {
    loop {
        let v = vector(rng);
        if (0.1..1.0).contains(&v.length()) {
            return v.normalize();
        }
    }
}

fn turn(rng: &mut ChaCha8Rng) -> DQuat {
    DQuat::from_axis_angle(direction(rng), std::f64::consts::TAU * unit_float(rng))
}

const KINDS: usize = 4;

/// A shape of some `scale`; `stretch` squeezes it along its axes.
fn shape(rng: &mut ChaCha8Rng, kind: usize, scale: f64, stretch: DVec3) -> Shape {
    match kind {
        0 => Sphere::new(scale).unwrap().into(),
        1 => Cuboid::new(scale * stretch * (0.6 + 0.4 * vector(rng).abs()))
            .unwrap()
            .into(),
        2 => loop {
            let corner = |rng: &mut ChaCha8Rng| scale * (stretch * vector(rng));
            if let Ok(triangle) = Triangle::new(corner(rng), corner(rng), corner(rng)) {
                return triangle.into();
            }
        },
        _ => hull(rng, 12, scale, stretch),
    }
}

fn hull(rng: &mut ChaCha8Rng, count: usize, scale: f64, stretch: DVec3) -> Shape {
    let points: Vec<DVec3> = (0..count)
        .map(|_| scale * (stretch * direction(rng)))
        .collect();
    Polytope::from_points(points).unwrap().into()
}

/// One pair and its two poses.
struct Case {
    a: Shape,
    pose_a: Pose,
    b: Shape,
    pose_b: Pose,
}

impl Case {
    fn overlap(&self) -> Option<Overlap> {
        overlap(&self.a, &self.pose_a, &self.b, &self.pose_b)
    }

    fn size(&self) -> f64 {
        self.a.max_dist() + self.b.max_dist()
    }

    /// Rounding in coordinates of this pair's place.
    fn rounding(&self) -> f64 {
        4.0 * f64::EPSILON
            * self
                .pose_a
                .position
                .abs()
                .max(self.pose_b.position.abs())
                .max_element()
    }

    fn bodies(&self) -> (oracle::Body, oracle::Body) {
        let origin = self.pose_b.position;
        (
            oracle::body(&self.a, &self.pose_a, origin),
            oracle::body(&self.b, &self.pose_b, origin),
        )
    }

    fn moved(&self, by: DVec3) -> Self {
        Self {
            a: self.a.clone(),
            pose_a: Pose::new(self.pose_a.position + by, self.pose_a.orientation),
            b: self.b.clone(),
            pose_b: self.pose_b,
        }
    }

    fn swapped(&self) -> Self {
        Self {
            a: self.b.clone(),
            pose_a: self.pose_b,
            b: self.a.clone(),
            pose_b: self.pose_a,
        }
    }

    /// Checks everything that can be said of the pair without knowing the answer;
    /// returns whether it overlaps.
    fn check(&self, label: &str) -> bool {
        let (a, b) = self.bodies();
        let depth = oracle::depth(&a, &b);
        let exact = 1e-12 * self.size() + self.rounding();
        let Some(found) = self.overlap() else {
            let touch = 1.001e-12 * (self.size() + self.rounding() / (4.0 * f64::EPSILON)) + exact;
            assert!(depth <= touch, "{label}: missed an overlap of {depth:e}");
            return false;
        };
        assert!(
            (found.depth - depth).abs() <= exact,
            "{label}: depth {:e}, not {depth:e}; off by {:e} of the size",
            found.depth,
            (found.depth - depth).abs() / self.size(),
        );
        assert!(
            (found.direction.length() - 1.0).abs() < 1e-14,
            "{label}: {found:?}"
        );
        let along = oracle::width(&a, &b, found.direction);
        assert!(
            (along - depth).abs() <= exact,
            "{label}: the direction needs {along:e} instead of {depth:e}"
        );
        assert!(found.point.is_finite(), "{label}: {found:?}");
        self.check_moves(label, &found);
        self.check_swap(label, &found);
        true
    }

    fn check_moves(&self, label: &str, found: &Overlap) {
        let exact = 2e-12 * self.size() + 4.0 * self.rounding();
        let rest = self.moved(found.depth * found.direction).overlap();
        assert!(
            rest.is_none_or(|rest| rest.depth <= exact),
            "{label}: moved out, still overlaps: {rest:?}"
        );
        if 1e-3 * found.depth > 1e-12 * (self.size() + self.pose_a.position.length()) + exact {
            let rest = self.moved(0.999 * found.depth * found.direction).overlap();
            assert!(
                rest.is_some(),
                "{label}: not moved out, yet apart: {found:?}"
            );
        }
    }

    fn check_swap(&self, label: &str, found: &Overlap) {
        let back = self.swapped().overlap();
        let same = self.a == self.b && self.pose_a == self.pose_b;
        if let Some(back) = back {
            assert!(
                (back.depth, back.point) == (found.depth, found.point),
                "{label}"
            );
            if !same {
                assert!(
                    back.direction == -found.direction,
                    "{label}: swapped turns otherwise"
                );
                assert!(
                    (back.feature_a, back.feature_b) == (found.feature_b, found.feature_a),
                    "{label}"
                );
            }
        } else {
            panic!("{label}: found one way only");
        }
    }
}

const LABELS: [&str; KINDS] = ["sphere", "cuboid", "triangle", "polytope"];

/// `a` at a random place around `b`: from one centre to clear of each other.
fn placed(rng: &mut ChaCha8Rng, a: Shape, b: Shape, around: DVec3) -> Case {
    let reach = 1.2 * (a.max_dist() + b.max_dist()) * unit_float(rng).powi(2);
    Case {
        pose_a: Pose::new(around + reach * direction(rng), turn(rng)),
        pose_b: Pose::new(around, turn(rng)),
        a,
        b,
    }
}

/// Runs `count` random pairs of each two kinds, made by `make`; guards that both
/// outcomes come up.
fn every_pair(seed: u64, count: u32, make: impl Fn(&mut ChaCha8Rng, usize, usize) -> Case) {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    for kind_a in 0..KINDS {
        for kind_b in 0..KINDS {
            let mut hits = 0;
            for index in 0..count {
                let case = make(&mut rng, kind_a, kind_b);
                let label = format!("{} {} {index}", LABELS[kind_a], LABELS[kind_b]);
                hits += u32::from(case.check(&label));
            }
            assert!(
                (count / 40..count).contains(&hits),
                "{} {}: lopsided, {hits} of {count} overlap",
                LABELS[kind_a],
                LABELS[kind_b]
            );
        }
    }
}

#[test]
fn random_pairs_of_like_size() {
    every_pair(1, 150, |rng, kind_a, kind_b| {
        let a = shape(rng, kind_a, 1.0, DVec3::ONE);
        let b = shape(rng, kind_b, 1.0, DVec3::ONE);
        placed(rng, a, b, DVec3::ZERO)
    });
}

#[test]
fn random_pairs_of_any_scale() {
    every_pair(2, 60, |rng, kind_a, kind_b| {
        let scale = log_uniform(rng, 1e-3, 1e3);
        let other = scale * log_uniform(rng, 0.03, 30.0);
        let a = shape(rng, kind_a, scale, DVec3::ONE);
        let b = shape(rng, kind_b, other, DVec3::ONE);
        let around = scale * vector(rng);
        placed(rng, a, b, around)
    });
}

#[test]
fn random_slabs_and_needles() {
    every_pair(3, 80, |rng, kind_a, kind_b| {
        let stretch = |rng: &mut ChaCha8Rng| {
            if unit_float(rng) < 0.6 {
                DVec3::new(1.0, 0.01, 1.0)
            } else {
                DVec3::new(0.01, 0.01, 1.0)
            }
        };
        let (stretch_a, stretch_b) = (stretch(rng), stretch(rng));
        let a = shape(rng, kind_a, 1.0, stretch_a);
        let b = shape(rng, kind_b, 1.0, stretch_b);
        let mut case = placed(rng, a, b, DVec3::ZERO);
        case.pose_a.position *= unit_float(rng);
        case
    });
}

#[test]
fn random_pairs_not_turned() {
    // Edges and faces are parallel: every crossing of arcs is a degenerate one.
    every_pair(4, 60, |rng, kind_a, kind_b| Case {
        a: shape(rng, kind_a, 1.0, DVec3::ONE),
        pose_a: Pose::at((2.0 * vector(rng)).round() * 0.5),
        b: shape(rng, kind_b, 1.0, DVec3::ONE),
        pose_b: Pose::at((2.0 * vector(rng)).round() * 0.5),
    });
}

#[test]
fn random_pairs_ten_kilometres_from_the_origin() {
    every_pair(5, 40, |rng, kind_a, kind_b| {
        let a = shape(rng, kind_a, 1.0, DVec3::ONE);
        let b = shape(rng, kind_b, 1.0, DVec3::ONE);
        let around = 1e4 * direction(rng);
        placed(rng, a, b, around)
    });
}

#[test]
fn random_pairs_turned_by_a_hair() {
    // Nearly parallel faces and edges.
    every_pair(6, 60, |rng, kind_a, kind_b| {
        let a = shape(rng, kind_a, 1.0, DVec3::ONE);
        let b = shape(rng, kind_b, 1.0, DVec3::ONE);
        let hair = DQuat::from_axis_angle(direction(rng), log_uniform(rng, 1e-16, 1e-3));
        let mut case = placed(rng, a, b, DVec3::ZERO);
        case.pose_a.orientation = (case.pose_b.orientation * hair).normalize();
        case
    });
}

#[test]
fn one_shape_on_itself_and_nearly_so() {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    for kind in 0..KINDS {
        for index in 0..60 {
            let a = shape(&mut rng, kind, 1.0, DVec3::ONE);
            let pose = Pose::new(vector(&mut rng), turn(&mut rng));
            let nudge = log_uniform(&mut rng, 1e-16, 1e-2) * direction(&mut rng);
            let hair =
                DQuat::from_axis_angle(direction(&mut rng), log_uniform(&mut rng, 1e-16, 1e-2));
            let poses = [
                pose,
                Pose::new(pose.position + nudge, pose.orientation),
                Pose::new(pose.position, (pose.orientation * hair).normalize()),
            ];
            for pose_b in poses {
                let case = Case {
                    a: a.clone(),
                    pose_a: pose,
                    b: a.clone(),
                    pose_b,
                };
                let hit = case.check(&format!("{} on itself {index}", LABELS[kind]));
                assert!(hit || kind == 2, "{} does not overlap itself", LABELS[kind]);
            }
        }
    }
}

#[test]
fn hulls_of_a_hundred_points() {
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    for index in 0..4 {
        let case = Case {
            a: hull(&mut rng, 40, 1.0, DVec3::ONE),
            pose_a: Pose::new(0.4 * vector(&mut rng), turn(&mut rng)),
            b: hull(&mut rng, 40, 0.5, DVec3::new(1.0, 0.3, 1.0)),
            pose_b: Pose::new(0.4 * vector(&mut rng), turn(&mut rng)),
        };
        assert!(case.check(&format!("hulls of 40 points {index}")));
    }
}

/// A pair that touches when A stands `touch` metres along +x from B; moved in
/// from there along x it overlaps by as much.
struct Planted {
    name: &'static str,
    a: Shape,
    turn_a: DQuat,
    b: Shape,
    turn_b: DQuat,
    touch: f64,
    features: (Feature, Feature),
}

fn planted() -> Vec<Planted> {
    use std::f64::consts::{FRAC_PI_4, SQRT_2};
    let cube = Shape::from(Cuboid::new([1.0, 1.0, 1.0]).unwrap());
    let ball = Shape::from(Sphere::new(1.0).unwrap());
    let corners: Vec<DVec3> = Cuboid::new([1.0, 1.0, 1.0]).unwrap().vertices().to_vec();
    let hull = Shape::from(Polytope::from_points(corners).unwrap());
    let upright = Triangle::new([0.0, 0.0, -1.0], [0.0, 0.0, 1.0], [2.0, 0.0, 0.0]).unwrap();
    let flat = Triangle::new([0.0, 1.0, 0.0], [-2.0, 0.0, 0.0], [0.0, -1.0, 0.0]).unwrap();
    let corner = DQuat::from_rotation_arc(DVec3::ONE.normalize(), DVec3::X);
    let about_y = DQuat::from_rotation_y(FRAC_PI_4);
    let about_z = DQuat::from_rotation_z(FRAC_PI_4);
    let new = |name, a: &Shape, turn_a, b: &Shape, turn_b, touch, features| Planted {
        name,
        a: a.clone(),
        turn_a,
        b: b.clone(),
        turn_b,
        touch,
        features,
    };
    let (i, surface) = (DQuat::IDENTITY, Feature::Surface);
    let (face, edge, vertex) = (Feature::Face, Feature::Edge, Feature::Vertex);
    let (upright, flat) = (Shape::from(upright), Shape::from(flat));
    let any = u32::MAX;
    vec![
        new(
            "sphere on sphere",
            &ball,
            i,
            &ball,
            i,
            2.0,
            (surface, surface),
        ),
        new(
            "sphere on face",
            &ball,
            i,
            &cube,
            i,
            2.0,
            (surface, face(1)),
        ),
        new(
            "sphere on edge",
            &ball,
            i,
            &cube,
            about_z,
            1.0 + SQRT_2,
            (surface, edge(9)),
        ),
        new(
            "sphere on vertex",
            &ball,
            i,
            &cube,
            corner,
            1.0 + 3_f64.sqrt(),
            (surface, vertex(7)),
        ),
        new(
            "sphere on hull's face",
            &ball,
            i,
            &hull,
            i,
            2.0,
            (surface, face(any)),
        ),
        new(
            "sphere on hull's edge",
            &ball,
            i,
            &hull,
            about_z,
            1.0 + SQRT_2,
            (surface, edge(any)),
        ),
        new(
            "sphere on hull's vertex",
            &ball,
            i,
            &hull,
            corner,
            1.0 + 3_f64.sqrt(),
            (surface, vertex(any)),
        ),
        new(
            "sphere on triangle's edge",
            &ball,
            i,
            &flat,
            i,
            1.0,
            (surface, edge(2)),
        ),
        new("face on face", &cube, i, &cube, i, 2.0, (face(0), face(1))),
        new(
            "face on edge",
            &cube,
            i,
            &cube,
            about_z,
            1.0 + SQRT_2,
            (face(0), edge(9)),
        ),
        new(
            "face on vertex",
            &cube,
            i,
            &cube,
            corner,
            1.0 + 3_f64.sqrt(),
            (face(0), vertex(7)),
        ),
        new(
            "edge on edge",
            &cube,
            about_y,
            &cube,
            about_z,
            2.0 * SQRT_2,
            (edge(4), edge(9)),
        ),
        new(
            "hull's face on face",
            &hull,
            i,
            &cube,
            i,
            2.0,
            (face(any), face(1)),
        ),
        new(
            "hull's face on hull's edge",
            &hull,
            i,
            &hull,
            about_z,
            1.0 + SQRT_2,
            (face(any), edge(any)),
        ),
        new(
            "hull's edge on hull's edge",
            &hull,
            about_y,
            &hull,
            about_z,
            2.0 * SQRT_2,
            (edge(any), edge(any)),
        ),
        new(
            "hull's face on hull's vertex",
            &hull,
            i,
            &hull,
            corner,
            1.0 + 3_f64.sqrt(),
            (face(any), vertex(any)),
        ),
        new(
            "triangle's edge on face",
            &upright,
            i,
            &cube,
            i,
            1.0,
            (edge(0), face(1)),
        ),
        new(
            "triangle's edge on edge",
            &upright,
            i,
            &flat,
            i,
            0.0,
            (edge(0), edge(2)),
        ),
        new(
            "triangle's edge on box's edge",
            &upright,
            about_y * about_y * about_z,
            &cube,
            about_z,
            SQRT_2,
            (edge(any), edge(9)),
        ),
    ]
}

fn same_feature(found: Feature, wanted: Feature) -> bool {
    match wanted {
        Feature::Face(u32::MAX) => matches!(found, Feature::Face(_)),
        Feature::Edge(u32::MAX) => matches!(found, Feature::Edge(_)),
        Feature::Vertex(u32::MAX) => matches!(found, Feature::Vertex(_)),
        _ => found == wanted,
    }
}

#[test]
fn planted_depths_come_out() {
    let mut rng = ChaCha8Rng::seed_from_u64(9);
    for Planted {
        name,
        a,
        turn_a,
        b,
        turn_b,
        touch,
        features,
    } in planted()
    {
        for index in 0..20 {
            // The first as it stands, the others turned together.
            let common = if index == 0 {
                DQuat::IDENTITY
            } else {
                turn(&mut rng)
            };
            for depth in [-0.1, -1e-6, -1e-9, 0.0, 1e-11, 1e-9, 1e-6, 1e-3, 0.02] {
                let at = common * DVec3::new(touch - depth, 0.0, 0.0);
                let case = Case {
                    a: a.clone(),
                    pose_a: Pose::new(at, (common * turn_a).normalize()),
                    b: b.clone(),
                    pose_b: Pose::new(DVec3::ZERO, (common * turn_b).normalize()),
                };
                let found = case.overlap();
                if depth <= 0.0 {
                    assert!(found.is_none(), "{name}, {depth:e} deep: {found:?}");
                    continue;
                }
                let Some(found) = found else {
                    panic!("{name}, {depth:e} deep: missed");
                };
                assert!((found.depth - depth).abs() < 5e-15, "{name}: {found:?}");
                assert!(
                    found.direction.distance(common * DVec3::X) < 1e-14,
                    "{name}, {depth:e} deep: {found:?}"
                );
                assert!(
                    same_feature(found.feature_a, features.0)
                        && same_feature(found.feature_b, features.1),
                    "{name}, {depth:e} deep: {found:?}"
                );
                // The pair is symmetric about the x axis, where it meets.
                let local = common.conjugate() * found.point;
                assert!(local.y.abs() + local.z.abs() < 1e-9, "{name}: {local}");
                assert!(case.check(name));
            }
        }
    }
}

#[test]
fn triangles_in_one_plane_only_touch() {
    let triangle = Shape::from(Triangle::new([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]).unwrap());
    let mut rng = ChaCha8Rng::seed_from_u64(10);
    for _ in 0..200 {
        let common = turn(&mut rng);
        let spin = DQuat::from_rotation_z(unit_float(&mut rng));
        let shift = DVec3::new(0.2 * signed(&mut rng), 0.2 * signed(&mut rng), 0.0);
        let at = Pose::new(common * shift, (common * spin).normalize());
        let found = overlap(&triangle, &at, &triangle, &Pose::new(DVec3::ZERO, common));
        assert!(found.is_none(), "{found:?}");
    }
}

#[test]
fn a_triangle_through_a_box_takes_the_shortest_way() {
    let plate =
        Shape::from(Triangle::new([-9.0, -9.0, 0.0], [9.0, -9.0, 0.0], [0.0, 9.0, 0.0]).unwrap());
    let cube = Shape::from(Cuboid::new([1.0, 1.0, 1.0]).unwrap());
    let found = overlap(&plate, &Pose::at([0.0, 0.0, 0.25]), &cube, &Pose::IDENTITY).unwrap();
    assert!((found.depth - 0.75).abs() < 1e-15 && found.direction.distance(DVec3::Z) < 1e-15);
    assert_eq!(
        (found.feature_a, found.feature_b),
        (Feature::Face(1), Feature::Face(5))
    );
    assert!(
        found.point.distance(DVec3::new(0.0, 0.0, 0.625)) < 1e-14,
        "{found:?}"
    );
}

#[test]
fn ties_break_the_same_way_each_time() {
    let ball = Shape::from(Sphere::new(1.0).unwrap());
    let cube = Shape::from(Cuboid::new([1.0, 1.0, 1.0]).unwrap());
    for shape in [&ball, &cube] {
        let found = overlap(shape, &Pose::IDENTITY, shape, &Pose::IDENTITY).unwrap();
        assert_eq!((found.depth, found.direction), (2.0, DVec3::X));
    }
    let found = overlap(&ball, &Pose::IDENTITY, &cube, &Pose::IDENTITY).unwrap();
    assert_eq!((found.depth, found.direction), (2.0, DVec3::X));
    let swapped = overlap(&cube, &Pose::IDENTITY, &ball, &Pose::IDENTITY).unwrap();
    assert_eq!((swapped.depth, swapped.direction), (2.0, DVec3::NEG_X));
}

#[test]
fn the_largest_and_smallest_shapes_give_finite_answers() {
    let mut rng = ChaCha8Rng::seed_from_u64(11);
    let sizes = [2e-9, 1e-6, 1.0, 1e6, 4e8];
    for kind_a in 0..KINDS {
        for kind_b in 0..KINDS {
            for (size_a, size_b) in sizes.iter().flat_map(|a| sizes.map(|b| (*a, b))) {
                // Hulls of a nanometre are no hulls.
                let size = |kind, size: f64| if kind == 3 { size.max(1e-6) } else { size };
                let a = shape(&mut rng, kind_a, size(kind_a, size_a), DVec3::ONE);
                let b = shape(&mut rng, kind_b, size(kind_b, size_b), DVec3::ONE);
                for around in [DVec3::ZERO, DVec3::splat(1e12)] {
                    let mut case = placed(&mut rng, a.clone(), b.clone(), around);
                    for _ in 0..2 {
                        if let Some(found) = case.overlap() {
                            assert!(found.depth > 0.0 && found.depth <= 2.0 * case.size());
                            assert!((found.direction.length() - 1.0).abs() < 1e-14);
                            assert!(found.point.is_finite(), "{found:?}");
                        }
                        case.pose_a.position = around;
                    }
                    // From one centre a solid pair always overlaps, where f64 can tell.
                    if kind_a != 2 && kind_b != 2 && kind_a + kind_b < 3 && around == DVec3::ZERO {
                        assert!(
                            case.overlap().is_some(),
                            "{kind_a} {kind_b} {size_a} {size_b}"
                        );
                    }
                }
            }
        }
    }
}
