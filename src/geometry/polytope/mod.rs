//! Convex polytopes.

mod bounding_sphere;
mod edge_map;
mod facade;
mod face_map;
mod faces;
mod hull;
mod lanes;
mod mesh_check;
mod orient;
mod simplex;
pub(crate) mod sketch;
mod summits;
mod support;
mod topology;
mod trim;

use crate::error::ShapeError;
use crate::math::domain;
use crate::tolerance::MAX_LENGTH;
use bounding_sphere::bounding_sphere;
use edge_map::EdgeMap;
pub(crate) use facade::{Facade, FourTimes};
use face_map::FaceMap;
use faces::Faces;
use glam::DVec3;
use hull::convex_hull;
pub(crate) use lanes::{Lanes, WIDTH as LANES};
use sketch::Sketch;
pub(crate) use summits::Summits;
use support::Support;
use topology::{Lists, vertex_neighbours};

/// An edge of a polytope, cuboid or triangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Edge {
    /// The two vertices it joins.
    pub vertices: [u32; 2],
    /// The faces on its two sides: seen from outside, running from the first
    /// vertex to the second, the first face lies to the left.
    pub faces: [u32; 2],
}

/// A flat face of a polytope: the half-space `normal · x ≤ offset` holds the whole body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face<'a> {
    /// Unit normal, pointing outwards.
    pub normal: DVec3,
    /// Largest `normal · x` over the vertices, in metres.
    pub offset: f64,
    /// The vertices around it, counter-clockwise seen from outside.
    pub vertices: &'a [u32],
}

/// A solid convex polytope.
///
/// Made from points, of which it is the convex hull, or from a mesh of triangles
/// that is checked to be closed, outward and convex. It lies where its points
/// were given; the origin need not be inside.
///
/// *Vertices* and *triangles* make up the surface; triangles run
/// counter-clockwise seen from outside. Triangles on one plane, to within 16 ulp
/// of the largest coordinate, form one *face*: all its vertices lie that close
/// to one plane, so that the facets of a finely curved hull stay apart. Faces are
/// numbered by their first triangles. *Edges* lie between different faces;
/// diagonals of a face are none.
///
/// ```
/// use feeler::{Polytope, ShapeError};
/// use glam::DVec3;
///
/// // A pyramid; the middle of its base is no corner.
/// let base = [[1.0, 1.0, 0.0], [-1.0, 1.0, 0.0], [-1.0, -1.0, 0.0], [1.0, -1.0, 0.0]];
/// let points = base.into_iter().chain([[0.0, 0.0, 0.0], [0.0, 0.0, 2.0]]);
/// let pyramid = Polytope::from_points(points)?;
/// assert_eq!(pyramid.vertices().len(), 5);
/// assert_eq!(pyramid.faces().len(), 5);
/// assert_eq!(pyramid.edges().len(), 8);
/// assert_eq!(pyramid.support(DVec3::Z), 4);
///
/// // The base alone encloses no volume.
/// let flat = Polytope::from_points(base);
/// assert!(matches!(flat, Err(ShapeError::Flat { dimensions: 2, .. })));
/// # Ok::<(), ShapeError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "crate::geometry::data::PolytopeData",
        into = "crate::geometry::data::PolytopeData"
    )
)]
#[repr(C)]
pub struct Polytope {
    // What every cast reads comes first: in memory too, for on the way to a body that was not
    // looked at for a while each line of cache costs as much as a search.
    centre: DVec3,
    max_dist: f64,
    reach: f64,
    /// Empty if it is not small.
    sketch: Sketch,
    /// The vertices in single precision, if there are few.
    lanes: Vec<Lanes>,
    /// By directions, if they are many.
    summits: Summits,
    vertices: Vec<DVec3>,
    normals: Vec<DVec3>,
    edge_map: EdgeMap,
    support: Support,
    face_map: FaceMap,
    /// Empty if there are many faces.
    facade: Facade,
    edges: Vec<Edge>,
    offsets: Vec<f64>,
    triangles: Vec<[u32; 3]>,
    triangle_faces: Vec<u32>,
    /// The vertices around each face.
    rims: Lists,
}

impl Polytope {
    /// The convex hull of `points`.
    ///
    /// Its vertices are the points that are corners of the hull, in the order
    /// given and each once. Points inside the body, inside a face or in the
    /// middle of an edge are left out: exactly those, decided by exact
    /// arithmetic, and also points that rounding (16 ulp of the largest
    /// coordinate) lets stand out of the middle of a face. Points that nearly
    /// coincide, or nearly lie on an edge, all remain if they are corners. The
    /// order of the points makes no difference but for the vertices' numbers.
    ///
    /// Quickhull (Barber, Dobkin, Huhdanpaa 1996) on Shewchuk's exact
    /// orientations; O(n log n) in the usual case, some 60 ms for
    /// 10 000 points on a sphere.
    ///
    /// # Errors
    /// If a coordinate is not finite or beyond [`MAX_LENGTH`]; if there are fewer
    /// than four points; or if all lie closer than
    /// [`MIN_LENGTH`](crate::tolerance::MIN_LENGTH) to one point, one line or
    /// one plane. Coordinates below 1e-75 m count as 0.
    pub fn from_points<P: Into<DVec3>>(
        points: impl IntoIterator<Item = P>,
    ) -> Result<Self, ShapeError> {
        let given = tidied("points", points)?;
        // By coordinates: whatever rounding decides below, it decides the same
        // way for any order of the points.
        let order = sorted(&given);
        let mut points: Vec<DVec3> = order.iter().map(|&place| given[place as usize]).collect();
        let mut places = order;
        // Each round leaves points out that lie flat inside a face. One more
        // round, rarely two, finds none: what is left is an exact hull again.
        loop {
            let hull = convex_hull(&points)?;
            let tolerance = hull.flatness(&points);
            places = hull.pick(&places);
            points = hull.pick(&points);
            let mut triangles = hull.triangles;
            let mut faces = Faces::merge(&points, &triangles, tolerance);
            let corners = faces.corners(points.len());
            if corners.len() == points.len() {
                let numbers = ranks(&places);
                for corner in triangles.iter_mut().flatten() {
                    *corner = numbers[*corner as usize];
                }
                faces.renumber(&numbers);
                places.sort_unstable();
                let vertices: Vec<DVec3> = places.iter().map(|&p| given[p as usize]).collect();
                let climb = vertex_neighbours(vertices.len(), &triangles);
                let support = Support::new(&vertices, climb, 0);
                return Ok(Self::assemble(
                    vertices, triangles, faces, support, tolerance,
                ));
            }
            points = corners.iter().map(|&c| points[c as usize]).collect();
            places = corners.iter().map(|&c| places[c as usize]).collect();
        }
    }

    /// The body whose surface the triangles are. Vertices and triangles keep
    /// their numbers.
    ///
    /// A triangle's corners run counter-clockwise seen from outside. Vertices in
    /// the middle of an edge or face are allowed. The surface may be dented by rounding,
    /// like that of a turned box: by 1e-12 of its size and 16 ulp of the largest
    /// coordinate. What has no tolerance is decided exactly.
    ///
    /// O(n log n) for n triangles, if most vertices are corners of the hull.
    ///
    /// ```
    /// use feeler::{Polytope, ShapeError};
    ///
    /// let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    /// let triangles = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    /// let tetrahedron = Polytope::from_triangles(vertices, triangles)?;
    /// assert_eq!(tetrahedron.triangles(), triangles);
    ///
    /// // Without its last triangle the surface is open.
    /// let open = Polytope::from_triangles(vertices, triangles.into_iter().take(3));
    /// assert!(matches!(open, Err(ShapeError::NotClosed { .. })));
    /// # Ok::<(), ShapeError>(())
    /// ```
    ///
    /// # Errors
    /// The first of these that applies: a coordinate is not finite or beyond
    /// [`MAX_LENGTH`]; there are fewer than four vertices; a triangle names no
    /// vertex; two vertices coincide; a vertex is unused; a triangle's corners
    /// lie on one line; an edge has not two triangles; neighbours are wound
    /// against each other; there is more than one surface; it has no volume; it
    /// is inside out, not convex, or goes round the body more than once.
    pub fn from_triangles<P: Into<DVec3>>(
        vertices: impl IntoIterator<Item = P>,
        triangles: impl IntoIterator<Item = [u32; 3]>,
    ) -> Result<Self, ShapeError> {
        let vertices = tidied("vertices", vertices)?;
        let triangles: Vec<[u32; 3]> = triangles.into_iter().collect();
        let checked = mesh_check::check(&vertices, &triangles)?;
        let tolerance = checked.hull.flatness(&vertices);
        let faces = Faces::merge(&vertices, &triangles, tolerance);
        Ok(Self::assemble(
            vertices,
            triangles,
            faces,
            checked.support,
            tolerance,
        ))
    }

    fn assemble(
        vertices: Vec<DVec3>,
        triangles: Vec<[u32; 3]>,
        faces: Faces,
        support: Support,
        tolerance: f64,
    ) -> Self {
        let (centre, max_dist) = bounding_sphere(&vertices);
        let lengths = vertices.iter().map(|vertex| vertex.length());
        let reach = lengths.fold(0.0, f64::max) * (1.0 + 1e-6);
        let lanes = if vertices.len() <= Lanes::FEW {
            Lanes::list(&vertices, centre, max_dist)
        } else {
            Vec::new()
        };
        let mut polytope = Self {
            lanes,
            summits: Summits::of(&vertices, &support, centre, max_dist),
            offsets: faces.offsets(&vertices, &triangles, &support, tolerance),
            edge_map: EdgeMap::new(&vertices, &faces.edges),
            vertices,
            triangles,
            triangle_faces: faces.of_triangle,
            edges: faces.edges,
            normals: faces.normals,
            rims: faces.rims,
            support,
            face_map: FaceMap::default(),
            facade: Facade::default(),
            sketch: Sketch::default(),
            centre,
            max_dist,
            reach,
        };
        polytope.face_map = FaceMap::of(&polytope);
        polytope.sketch = Sketch::of(&polytope);
        polytope.facade = Facade::of(&polytope);
        polytope
    }

    /// The vertices in metres.
    #[must_use]
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// Corners of the triangles, counter-clockwise seen from outside.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// How far from the frame's origin all vertices surely lie: which none comes near to by a millionth of it.
    #[inline]
    pub(crate) fn reach(&self) -> f64 {
        self.reach
    }

    /// The faces by place and neighbourhood.
    #[inline]
    pub(crate) fn face_map(&self) -> &FaceMap {
        &self.face_map
    }

    /// For every direction the vertices that may be farthest along it; nothing if there are few, or
    /// very many.
    #[inline]
    pub(crate) fn summits(&self) -> &Summits {
        &self.summits
    }

    /// The polytope roughly, in one piece; none if it is not small.
    #[inline]
    pub(crate) fn sketch(&self) -> Option<&Sketch> {
        (!self.sketch.is_empty()).then_some(&self.sketch)
    }

    /// The faces as a ray looks at them; no planes if they are many.
    #[inline]
    pub(crate) fn facade(&self) -> &Facade {
        &self.facade
    }

    /// The vertices in single precision, four by four; none if they are many.
    #[inline]
    pub(crate) fn lanes(&self) -> &[Lanes] {
        &self.lanes
    }

    /// The edges, and those by vertex.
    #[inline]
    pub(crate) fn edge_map(&self) -> &EdgeMap {
        &self.edge_map
    }

    /// The face each triangle is part of.
    #[must_use]
    pub fn triangle_faces(&self) -> &[u32] {
        &self.triangle_faces
    }

    /// The edges between different faces.
    #[must_use]
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// The faces, in the order of their numbers.
    #[must_use]
    pub fn faces(&self) -> impl ExactSizeIterator<Item = Face<'_>> {
        (0..self.rims.len()).map(|face| Face {
            normal: self.normals[face],
            offset: self.offsets[face],
            vertices: self.rims.get(face),
        })
    }

    /// Outward unit normals of the faces.
    #[must_use]
    pub fn face_normals(&self) -> &[DVec3] {
        &self.normals
    }

    /// For each face the largest `normal · x` over all vertices, in metres.
    #[must_use]
    pub fn face_offsets(&self) -> &[f64] {
        &self.offsets
    }

    /// Centre of the smallest sphere around the body.
    #[must_use]
    pub fn centre(&self) -> DVec3 {
        self.centre
    }

    /// Largest distance from the [`centre`](Self::centre) to the surface, in
    /// metres: the radius of the smallest sphere around the body, rounded up.
    #[must_use]
    pub fn max_dist(&self) -> f64 {
        self.max_dist
    }

    /// The vertices around a face.
    pub(crate) fn rim(&self, face: u32) -> &[u32] {
        self.rims.get(face as usize)
    }

    /// Number of a vertex farthest along `direction`, which may have any length.
    ///
    /// One of them if several are equally far to within rounding, and always
    /// the same for the same direction; some vertex if `direction` is zero,
    /// NaN or so long that its products overflow.
    ///
    /// Scans a small hull; on a larger one climbs over edges from a vertex that
    /// a table of directions gives, some two steps, whatever the size.
    #[must_use]
    pub fn support(&self, direction: DVec3) -> u32 {
        self.support.vertex(&self.vertices, direction)
    }

    /// The same as [`support`](Self::support), sought from a vertex thought to be near.
    pub(crate) fn support_near(&self, direction: DVec3, start: u32) -> u32 {
        self.support.vertex_near(&self.vertices, direction, start)
    }

    /// A vertex that is farthest along a direction to within [`table_error`](Self::table_error).
    #[inline]
    pub(crate) fn support_by_table(&self, direction: DVec3) -> u32 {
        self.support.by_table(direction).unwrap_or_default()
    }

    /// The same, as a rule the farthest, at the price of looking at a vertex's neighbours.
    #[inline]
    pub(crate) fn support_by_ring(&self, direction: DVec3) -> u32 {
        (self.support.by_ring(&self.vertices, direction)).unwrap_or_default()
    }

    /// In shares of [`max_dist`](Self::max_dist) and of the direction's length.
    pub(crate) fn table_error(&self) -> f64 {
        2.0 * self.support.table_error()
    }

    /// The number of the edge between two vertices.
    #[inline]
    pub(crate) fn edge_between(&self, from: u32, to: u32) -> Option<u32> {
        self.edge_map.between(from, to)
    }

    /// The vertices that share a triangle's edge with `vertex`, if it is a corner of the hull.
    pub(crate) fn neighbours(&self, vertex: u32) -> &[u32] {
        self.support.neighbours(vertex)
    }
}

/// The points, checked, with coordinates next to nothing rounded to 0.
fn tidied<P: Into<DVec3>>(
    field: &'static str,
    points: impl IntoIterator<Item = P>,
) -> Result<Vec<DVec3>, ShapeError> {
    let points = (points.into_iter())
        .map(|point| domain::vector(field, point.into(), MAX_LENGTH).map(orient::tidied))
        .collect::<Result<Vec<_>, _>>()?;
    match points.len() {
        count @ 0..4 => Err(ShapeError::TooFewPoints { count, min: 4 }),
        _ => Ok(points),
    }
}

/// The places of the points in the order of their coordinates; of equal points
/// only the first.
fn sorted(points: &[DVec3]) -> Vec<u32> {
    let point = |place: &u32| points[*place as usize];
    let mut places: Vec<u32> = (0..points.len() as u32).collect();
    places.sort_by(|i, j| simplex::order(point(i), point(j)));
    places.dedup_by(|later, first| point(later) == point(first));
    places
}

/// For each of the distinct numbers how many are smaller.
fn ranks(numbers: &[u32]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..numbers.len() as u32).collect();
    order.sort_unstable_by_key(|&i| numbers[i as usize]);
    let mut ranks = vec![0; numbers.len()];
    for (rank, i) in order.into_iter().enumerate() {
        ranks[i as usize] = rank as u32;
    }
    ranks
}
