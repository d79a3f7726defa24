//! How far apart are two shapes, and where are they nearest?
//!
//! A and B are as far apart as A − B, the set of all `a − b`, is from the
//! origin. A convex search for its nearest point (GJK) ends with a few vertices of each
//! body; the answer is the closed form of the features they span, and
//! it is proven by the plane across its normal: neither body reaches
//! farther than the two nearest points.

mod body;
mod enumerate;
mod feature;
mod frame;
mod separator;
mod simplex;

use crate::geometry::{Feature, Pose, Shape};
use glam::DVec3;
use separator::{End, Found};
pub use separator::{Separation, Separator};

/// Share of the pair's size by which two bounds of a distance may differ where rounding
/// stopped the search. Anything more is searched the slow way.
const STALLED: f64 = 1e-13;

/// Where two shapes that are apart are nearest to each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClosestPoints {
    /// How far the two are apart, in metres; positive.
    pub distance: f64,
    /// Unit vector out of B, towards A: from B's point to A's.
    pub normal: DVec3,
    /// A's point, as an offset from A's position along the world's axes.
    pub point_a: DVec3,
    /// B's point, as an offset from B's position along the world's axes.
    pub point_b: DVec3,
    /// The part of A that lies farthest towards B.
    pub feature_a: Feature,
    /// The part of B that lies farthest towards A.
    pub feature_b: Feature,
}

impl ClosestPoints {
    /// The same told with the shapes' roles exchanged.
    fn swapped(self) -> Self {
        Self {
            normal: -self.normal,
            point_a: self.point_b,
            point_b: self.point_a,
            feature_a: self.feature_b,
            feature_b: self.feature_a,
            ..self
        }
    }
}

/// Where `a` standing at `pose_a` and `b` standing at `pose_b` are nearest to each other.
///
/// None if they touch or overlap ([`overlap`](crate::overlap()) tells how deep), or if
/// a number or its square is not finite. What is apart by less than some 1e-15 of the pair's
/// size and of the offset between them counts as touching.
///
/// Each point is told from its own body's position, so that it keeps all its digits far
/// from the origin; `pose.position + point` is the point of the world. Where
/// faces or edges are parallel the points are some pair of nearest ones, always the same
/// for the same input. The features are those that lie farthest along the
/// normal, the whole of the parallel faces then.
///
/// Exchanging the shapes exchanges the points and features and turns the normal, to the last
/// bit.
///
/// Distance and points are within 1e-12 of the pair's size, plus rounding in the coordinates
/// given; the distance of tiny gaps too, down to that size. The normal is computed
/// afresh from the features.
///
/// Source: Gilbert, Johnson & Keerthi, *A Fast Procedure for Computing the Distance Between
/// Complex Objects in Three-Dimensional Space* (1988), with the answer proven by both
/// its bounds; the few pairs that rounding leaves open try every pair of
/// features. [`Separator`] finds distances of one pair time and again.
///
/// Some five supports of each shape; does not allocate.
///
/// ```
/// use feeler::narrow_phase::distance::closest_points;
/// use feeler::{Cuboid, Feature, Pose, Shape, Sphere};
/// use glam::DVec3;
///
/// let ball = Shape::from(Sphere::new(1.0)?);
/// let cube = Shape::from(Cuboid::new([0.5, 0.5, 0.5])?);
/// let at = Pose::at([4.0, 0.25, 0.0]);
/// let found = closest_points(&ball, &at, &cube, &Pose::IDENTITY).expect("they are apart");
/// assert_eq!(found.distance, 2.5);
/// assert_eq!(found.normal, DVec3::X);
/// assert_eq!(at.position + found.point_a, DVec3::new(3.0, 0.25, 0.0));
/// assert_eq!(found.point_b, DVec3::new(0.5, 0.25, 0.0));
/// assert_eq!(found.feature_b, Feature::Face(1));
///
/// // In touch.
/// assert!(closest_points(&ball, &Pose::at([1.5, 0.0, 0.0]), &cube, &Pose::IDENTITY).is_none());
/// # Ok::<(), feeler::ShapeError>(())
/// ```
#[must_use]
pub fn closest_points(a: &Shape, pose_a: &Pose, b: &Shape, pose_b: &Pose) -> Option<ClosestPoints> {
    let between = pose_a.position - pose_b.position;
    let mut pair = Separator::new(a, pose_a.orientation, b, pose_b.orientation);
    // Each pair is looked at from one side only, so that exchanging the shapes changes nothing.
    let offset = between + (pair.a.shift - pair.b.shift);
    let leading = offset.to_array().into_iter().find(|&x| x != 0.0)?;
    if leading < 0.0 {
        std::mem::swap(&mut pair.a, &mut pair.b);
        pair.closest(-between).map(ClosestPoints::swapped)
    } else {
        pair.closest(between)
    }
}

impl Separator<'_> {
    fn closest(&mut self, between: DVec3) -> Option<ClosestPoints> {
        let Found {
            nearest,
            separation,
        } = match self.search(between, 0.0) {
            End::Touching => return None,
            End::Settled(found) => found,
            End::Stalled(found) if self.is_proven(between, &found) => found,
            End::Stalled(found) => self.enumerated(between, &found)?,
        };
        let simplex = self.kept(self.offset(between));
        let normal = nearest.normalize_or_zero();
        let (a, b) = simplex.witness(nearest);
        let probes = simplex.probes();
        let mut features = [Feature::Surface; 2];
        for (side, feature) in features.iter_mut().enumerate() {
            let (body, direction) = if side == 0 {
                (&self.a, -normal)
            } else {
                (&self.b, normal)
            };
            let (mut known, mut count) = ([0; 4], 0);
            for probe in probes {
                let vertex = probe.vertices[side];
                if !known[..count].contains(&vertex) {
                    known[count] = vertex;
                    count += 1;
                }
            }
            *feature = feature::farthest(body, direction, &known[..count]);
        }
        let [feature_a, feature_b] = features;
        Some(ClosestPoints {
            distance: separation.distance,
            normal,
            point_a: self.a.shift + a - self.a.radius * normal,
            point_b: self.b.shift + b + self.b.radius * normal,
            feature_a,
            feature_b,
        })
    }

    /// Whether the plane across the nearest points proves them to be so but for rounding.
    fn is_proven(&self, between: DVec3, found: &Found) -> bool {
        let gap = self.gap(between, found.nearest.normalize_or_zero());
        found.separation.distance - gap <= STALLED * (self.a.size + self.b.size)
    }

    /// The nearest of all pairs of features, whose vertices are kept; none if the bodies touch.
    ///
    /// `found` is where the search stalled.
    fn enumerated(&mut self, between: DVec3, found: &Found) -> Option<Found> {
        let (offset, rounding) = (self.offset(between), self.rounding(between));
        let (simplex, nearest) = enumerate::nearest(self, offset, found, rounding)?;
        let height = nearest.square.sqrt();
        let distance = height - self.radii();
        let normal = nearest.point / height;
        self.keep(&simplex);
        (distance > rounding).then_some(Found {
            nearest: nearest.point,
            separation: Separation {
                normal,
                gap: self.gap(between, normal),
                distance,
            },
        })
    }
}
