//! Triangles.

use crate::error::ShapeError;
use crate::math::{domain, exact};
use crate::tolerance::{MAX_LENGTH, MIN_LENGTH};
use glam::DVec3;

/// A triangle without thickness, solid on both sides.
///
/// Vertices 0, 1, 2 are its corners; edge `i` runs from vertex `i` to vertex
/// `(i + 1) % 3`. Face 0 is the side its normal points to (the corners run
/// counter-clockwise seen from there), face 1 the other side.
///
/// ```
/// use feeler::{ShapeError, Triangle};
/// use glam::DVec3;
///
/// let triangle = Triangle::new([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])?;
/// assert_eq!(triangle.normal(), DVec3::Z);
///
/// // Three points of one line are no triangle.
/// let line = Triangle::new([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]);
/// assert!(matches!(line, Err(ShapeError::DegenerateTriangle { .. })));
/// # Ok::<(), ShapeError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "crate::geometry::data::TriangleData",
        into = "crate::geometry::data::TriangleData"
    )
)]
pub struct Triangle {
    vertices: [DVec3; 3],
    normal: DVec3,
}

impl Triangle {
    /// The triangle with the given corners, in metres.
    ///
    /// # Errors
    /// If a coordinate is not finite or beyond [`MAX_LENGTH`], or if the least
    /// of the triangle's heights is below [`MIN_LENGTH`].
    pub fn new(
        a: impl Into<DVec3>,
        b: impl Into<DVec3>,
        c: impl Into<DVec3>,
    ) -> Result<Self, ShapeError> {
        let vertices = [a.into(), b.into(), c.into()];
        for vertex in vertices {
            domain::vector("vertex", vertex, MAX_LENGTH)?;
        }
        let (normal, height) = normal_and_height(vertices);
        // A NaN height would fail the comparison and be refused as well.
        if height >= MIN_LENGTH {
            Ok(Self { vertices, normal })
        } else {
            Err(ShapeError::DegenerateTriangle {
                triangle: 0,
                height,
                min: MIN_LENGTH,
            })
        }
    }

    /// The corners.
    #[must_use]
    pub fn vertices(&self) -> [DVec3; 3] {
        self.vertices
    }

    /// The unit normal of the side from which the corners run counter-clockwise.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// Centre and radius of the smallest sphere around the triangle.
    pub(crate) fn bounding_sphere(&self) -> (DVec3, f64) {
        let [a, b, c] = self.vertices;
        let (mut centre, mut widest) = (DVec3::ZERO, -1.0);
        for (from, to, other) in [(a, b, c), (b, c, a), (c, a, b)] {
            let length = from.distance(to);
            if length > widest {
                widest = length;
                let middle = 0.5 * from + 0.5 * to;
                // An obtuse corner lies inside the sphere over the opposite edge.
                centre = if other.distance(middle) <= 0.5 * length {
                    middle
                } else {
                    circumcentre(from, to, other)
                };
            }
        }
        let radius = [a, b, c]
            .into_iter()
            .map(|v| v.distance(centre))
            .fold(0.0, f64::max);
        (centre, radius)
    }
}

/// Sine of the angle between two sides of a triangle below which their product is worked out with
/// twice the digits: as it is, it would tell the direction to some 1e-15 only.
pub(crate) const THIN: f64 = 0.1;

/// Unit normal and least height of a triangle; the height is 0 and the normal
/// zero if two corners coincide or all lie on one line.
pub(crate) fn normal_and_height([a, b, c]: [DVec3; 3]) -> (DVec3, f64) {
    let longest = (b - a).length().max((c - b).length()).max((a - c).length());
    // The two shorter edges give the least rounded normal.
    let (u, v) = if longest <= (c - b).length() {
        (b - a, c - a)
    } else if longest <= (a - c).length() {
        (c - b, a - b)
    } else {
        (a - c, b - c)
    };
    let plain = u.cross(v);
    let is_thin = plain.length() < THIN * u.length() * v.length();
    let doubled_area = if is_thin {
        exact::doubled_area(a, b, c)
    } else {
        plain
    };
    let height = if longest > 0.0 {
        doubled_area.length() / longest
    } else {
        0.0
    };
    (doubled_area.normalize_or_zero(), height)
}

fn circumcentre(a: DVec3, b: DVec3, c: DVec3) -> DVec3 {
    let (u, v) = (b - a, c - a);
    let normal = u.cross(v);
    a + (u.length_squared() * v.cross(normal) + v.length_squared() * normal.cross(u))
        / (2.0 * normal.length_squared())
}
