//! Balls that fly all but along the edge they come down on.

use crate::draw::Draw;
use feeler::narrow_phase::exact::ball_touch;
use feeler::{Feature, Polytope, Shape, Sphere};
use glam::{DQuat, DVec3};

/// From a point to the nearest of all edges: nearer than all faces where these look away from it.
fn distance_to_edges(polytope: &Polytope, point: DVec3) -> f64 {
    let distances = polytope.edges().iter().map(|edge| {
        let [from, to] = edge.vertices.map(|end| polytope.vertices()[end as usize]);
        let (along, start) = (to - from, point - from);
        let share = start.dot(along) / along.length_squared();
        (start - share.clamp(0.0, 1.0) * along).length()
    });
    distances.fold(f64::INFINITY, f64::min)
}

/// What is left of the motion across the edge is far below the motion's own rounding at the smallest angles, and yet
/// the ball comes to rest on the edge to within rounding of the pair's size.
#[test]
fn a_ball_that_comes_down_at_next_to_no_angle_touches_to_rounding() {
    let mut draw = Draw::new(71);
    let mut edges = 0;
    for _ in 0..300 {
        let hull = draw.hull(12, DVec3::ONE);
        let shape = Shape::from(hull.clone());
        let normals: Vec<_> = hull.faces().map(|face| face.normal).collect();
        for _ in 0..10 {
            let edge = hull.edges()[draw.below(hull.edges().len())];
            let [from, to] = edge.vertices.map(|end| hull.vertices()[end as usize]);
            let [left, right] = edge.faces.map(|face| normals[face as usize]);
            let lean = 0.1 + 0.8 * draw.unit();
            let out = (lean * left + (1.0 - lean) * right).normalize();
            let (radius, angle) = (draw.log(1e-3, 1.0), draw.log(1e-11, 1e-2));
            let motion = (to - from).normalize() - angle * out;
            let at = from + (0.3 + 0.4 * draw.unit()) * (to - from) + radius * out;
            let back = draw.log(3.0, 30.0);
            let ball = Sphere::new(radius).unwrap();
            let start = at - back * motion;
            let found = ball_touch(&ball, start, &shape, DQuat::IDENTITY, 2.0 * back * motion);
            let about = || format!("{radius} {angle:e} {back} {edge:?} {hull:?}");
            let found = found.unwrap_or_else(|| panic!("a miss: {}", about()));
            let centre = start + found.fraction * (2.0 * back * motion);
            let gap = distance_to_edges(&hull, centre) - radius;
            assert!(gap.abs() < 1e-14 * (1.0 + back), "{gap:e} m: {}", about());
            edges += u32::from(matches!(found.features[1], Feature::Edge(_)));
        }
    }
    assert!(edges > 2500, "{edges} of 3000 on edges");
}
