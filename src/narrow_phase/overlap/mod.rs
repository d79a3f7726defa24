//! Do two shapes overlap, how deep, and which way out is the shortest?
//!
//! All of it is one question to the Minkowski difference K = B ⊕ (−A), the set
//! of all `b − a`: A and B overlap if K holds the origin, and the least
//! translation of A that parts them leads from the origin to K's nearest face.
//! The width of the pair along a unit vector `d`, the translation along `d`
//! that parts them, is K's support there, `max d·b − min d·a`; the depth is the
//! least width over all directions.

mod apart;
mod bounds;
mod boxes;
mod enclose;
mod expand;
mod faces;
mod few;
mod hull;
mod order;
mod pair;
mod separate;
mod sphere;
pub(in crate::narrow_phase) mod witness;

use crate::geometry::{Cuboid, Feature, Pose, Shape};
use crate::tolerance::touch_tolerance;
pub(crate) use apart::keep_apart;
use glam::DVec3;
use pair::Pair;
pub(crate) use sphere::Nearest;
use std::cmp::Ordering;

/// How two shapes overlap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overlap {
    /// The least distance by which A must move to part the two, in metres; positive.
    pub depth: f64,
    /// Unit vector out of B, towards A: moving A by `depth · direction` leaves
    /// the two in touch.
    pub direction: DVec3,
    /// A world point half way between the part of A that lies deepest in B and
    /// the part of B that lies deepest in A. If one body lies deep inside the
    /// other, it may be a point of the larger only.
    pub point: DVec3,
    /// The part of A that lies deepest in B.
    pub feature_a: Feature,
    /// The part of B that lies deepest in A.
    pub feature_b: Feature,
}

impl Overlap {
    /// The same overlap told with the shapes' roles exchanged.
    fn swapped(self) -> Self {
        Self {
            direction: -self.direction,
            feature_a: self.feature_b,
            feature_b: self.feature_a,
            ..self
        }
    }
}

/// A direction along which two shapes do not overlap, or touch only.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Gap {
    /// Unit vector out of B, towards A.
    direction: DVec3,
    /// How far A would have to move along it to be in touch with B, in metres; as a rule negative.
    width: f64,
}

impl Gap {
    /// The same gap told with the shapes' roles exchanged.
    fn swapped(self) -> Self {
        Self {
            direction: -self.direction,
            ..self
        }
    }

    /// Whether it stays wider than `slack` all the way that A moves by `motion` relative to B.
    pub(crate) fn stays(&self, motion: DVec3, slack: f64) -> bool {
        self.width < -slack && self.width - motion.dot(self.direction) < -slack
    }
}

/// Whether and how `a` standing at `pose_a` overlaps `b` standing at `pose_b`.
///
/// None if the shapes are apart, or touch: overlap no deeper than
/// [`TOUCH`](crate::tolerance::TOUCH) of the pair's size and coordinates. A
/// triangle has no thickness but overlaps what it passes through; triangles in
/// one plane only touch. A shape inside another overlaps it.
///
/// Exchanging the shapes gives the same overlap with the opposite direction.
/// Where several directions are equally short (shapes around one centre, a point
/// in the middle of a slab), spheres and boxes prefer faces, then lower axes,
/// then positive directions; for polytopes the choice is fixed but arbitrary. It
/// is made with the two shapes in an order of their own, by kind, then place,
/// then turn, then size. Only equal shapes at equal poses cannot be told apart:
/// then both calls give the same direction.
///
/// Depth and direction are those of the Minkowski difference's nearest face:
/// the minimum over all directions, not a local one. The depth is within
/// 1e-12 of the pair's size, plus rounding in the coordinates given; the
/// direction is computed afresh from the two features.
///
/// Sources: Cameron & Culley, *Determining the Minimum Translational Distance
/// between Two Convex Polyhedra* (1986); Gilbert, Johnson & Keerthi (1988) for
/// parting axes; van den Bergen, *Proximity Queries and Penetration Depth
/// Computation* (2001) for the expansion, done here with exact predicates.
///
/// Poses that are not finite overlap nothing.
///
/// Two spheres, or two boxes, take constant time. Polytopes that are apart
/// take a few supports; those that overlap some more the deeper they do.
///
/// ```
/// use feeler::{Pose, Shape, Sphere, overlap};
/// use glam::DVec3;
///
/// let ball = Shape::from(Sphere::new(1.0)?);
/// let found = overlap(&ball, &Pose::at([1.5, 0.0, 0.0]), &ball, &Pose::IDENTITY);
/// let found = found.expect("they share half a metre");
/// assert_eq!(found.depth, 0.5);
/// assert_eq!(found.direction, DVec3::X);
/// assert_eq!(found.point, DVec3::new(0.75, 0.0, 0.0));
///
/// // In touch, but no overlap.
/// assert!(overlap(&ball, &Pose::at([2.0, 0.0, 0.0]), &ball, &Pose::IDENTITY).is_none());
/// # Ok::<(), feeler::ShapeError>(())
/// ```
#[must_use]
pub fn overlap(a: &Shape, pose_a: &Pose, b: &Shape, pose_b: &Pose) -> Option<Overlap> {
    let is_finite = |pose: &Pose| pose.position.is_finite() && pose.orientation.is_finite();
    if !is_finite(pose_a) || !is_finite(pose_b) {
        return None;
    }
    overlap_or_gap(a, pose_a, b, pose_b).ok()
}

/// [`overlap`], or how the two are apart, if it is known.
pub(crate) fn overlap_or_gap(
    a: &Shape,
    pose_a: &Pose,
    b: &Shape,
    pose_b: &Pose,
) -> Result<Overlap, Option<Gap>> {
    debug_assert!(
        pose_a.position.is_finite() && pose_b.position.is_finite(),
        "a pose is not finite"
    );
    match order::compare(a, pose_a, b, pose_b) {
        Ordering::Greater => match in_order(b, pose_b, a, pose_a) {
            Ok(overlap) => Ok(overlap.swapped()),
            Err(gap) => Err(gap.map(Gap::swapped)),
        },
        Ordering::Less | Ordering::Equal => in_order(a, pose_a, b, pose_b),
    }
}

/// [`overlap_or_gap`] for shapes in the order of [`order::compare`]: a sphere comes first.
fn in_order(a: &Shape, pose_a: &Pose, b: &Shape, pose_b: &Pose) -> Result<Overlap, Option<Gap>> {
    let touch = touch(a, pose_a, b, pose_b);
    let found = match (a, b) {
        (Shape::Sphere(a), Shape::Sphere(b)) => sphere::of_spheres(a, pose_a, b, pose_b, touch),
        (Shape::Sphere(a), Shape::Cuboid(b)) => sphere::of_cuboid(a, pose_a, b, pose_b, touch),
        (Shape::Sphere(a), Shape::Triangle(b)) => sphere::of_triangle(a, pose_a, b, pose_b, touch),
        (Shape::Sphere(a), Shape::Polytope(b)) => sphere::of_polytope(a, pose_a, b, pose_b, touch),
        (Shape::Cuboid(half_a), Shape::Cuboid(half_b)) => {
            of_boxes((a, pose_a), (b, pose_b), [half_a, half_b], touch)
        }
        _ => return of_hulls(&Pair::new(a, pose_a, b, pose_b, touch).ok_or(None)?),
    };
    found.ok_or(None)
}

fn of_boxes(
    (a, pose_a): (&Shape, &Pose),
    (b, pose_b): (&Shape, &Pose),
    [half_a, half_b]: [&Cuboid; 2],
    touch: f64,
) -> Option<Overlap> {
    let offset = pose_a.position - pose_b.position;
    let least = boxes::least(half_a, pose_a, half_b, pose_b, offset, touch)?;
    Pair::new(a, pose_a, b, pose_b, touch)?.witness(least)
}

fn of_hulls(pair: &Pair) -> Result<Overlap, Option<Gap>> {
    let few = few::are_few(pair);
    let least = match few.then(|| few::least(pair)).flatten() {
        Some(Width { direction, width }) if width <= pair.touch => {
            return Err(Some(Gap { direction, width }));
        }
        Some(least) => Some(least),
        None if !few && separate::apart(pair) => None,
        None => pair.least(),
    };
    least.and_then(|least| pair.witness(least)).ok_or(None)
}

/// Where a shape that stands at `pose` lies nearest to a point of the world, or
/// nearest to let it out.
pub(crate) fn to_point(point: DVec3, shape: &Shape, pose: &Pose) -> Option<Nearest> {
    let local = pose.local_point(point);
    let found = match shape {
        Shape::Sphere(ball) => Nearest {
            distance: local.length() - ball.radius(),
            direction: unit(local).unwrap_or(DVec3::X),
            feature: Feature::Surface,
        },
        Shape::Cuboid(cuboid) => sphere::to_cuboid(local, cuboid)?,
        Shape::Triangle(triangle) => sphere::to_triangle(local, triangle),
        Shape::Polytope(polytope) => sphere::to_polytope(local, polytope, f64::INFINITY)?,
    };
    Some(Nearest {
        direction: pose.direction(found.direction),
        ..found
    })
}

/// [`overlap`] of two balls, to the bit: their centres and radii.
#[inline]
pub(crate) fn of_balls(a: (DVec3, f64), b: (DVec3, f64)) -> Option<Overlap> {
    let coordinate = a.0.abs().max(b.0.abs()).max_element();
    let touch = touch_tolerance(a.1 + b.1, coordinate);
    if order::balls(a, b).is_gt() {
        sphere::of_balls(b, a, touch).map(Overlap::swapped)
    } else {
        sphere::of_balls(a, b, touch)
    }
}

/// The depth in metres up to which the pair counts as touching.
fn touch(a: &Shape, pose_a: &Pose, b: &Shape, pose_b: &Pose) -> f64 {
    let reach = |shape: &Shape, pose: &Pose| {
        pose.position
            .abs()
            .max_element()
            .max(shape.centre().abs().max_element())
    };
    touch_tolerance(
        a.max_dist() + b.max_dist(),
        reach(a, pose_a).max(reach(b, pose_b)),
    )
}

/// A direction and the pair's width along it.
#[derive(Debug, Clone, Copy)]
struct Width {
    direction: DVec3,
    width: f64,
}

/// `vector` in unit length, however long or short it is; none if it is zero or not finite.
fn unit(vector: DVec3) -> Option<DVec3> {
    let scale = vector.abs().max_element();
    // A NaN component fails the test as a whole or by `is_finite`.
    if scale > 0.0 && vector.is_finite() {
        // Squares of what is below 1e-154 would lose their bits.
        (vector / scale).try_normalize()
    } else {
        None
    }
}
