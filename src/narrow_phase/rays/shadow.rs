//! A body seen along the motion.

use crate::geometry::{Feature, Mesh, Pose, Shape};
use crate::math::frame::orthonormal;
use glam::{DVec2, DVec3};

/// The frame in which all rays of a pair are parallel to `z`.
///
/// Its origin is the first body's bounding centre as the stretch begins.
#[derive(Debug, Clone, Copy)]
pub(super) struct View {
    /// Unit vectors across the motion.
    pub(super) x: DVec3,
    pub(super) y: DVec3,
    /// Unit vector along the motion.
    pub(super) z: DVec3,
}

impl View {
    /// A frame along the motion, its first axis towards the second body.
    pub(super) fn along(direction: DVec3, between: DVec3) -> Self {
        let across = between - between.dot(direction) * direction;
        let x = across
            .try_normalize()
            .and_then(|x| (x - x.dot(direction) * direction).try_normalize());
        let (x, y) = match x {
            // What is left of a body straight ahead is rounding, and no direction.
            Some(x) if across.length() > 1e-14 * between.length() => (x, direction.cross(x)),
            _ => orthonormal(direction),
        };
        Self { x, y, z: direction }
    }

    /// Coordinates in this frame of a vector of the world.
    pub(super) fn coordinates(&self, vector: DVec3) -> DVec3 {
        DVec3::new(vector.dot(self.x), vector.dot(self.y), vector.dot(self.z))
    }

    /// The vector of the world with these coordinates.
    pub(super) fn vector(&self, coordinates: DVec3) -> DVec3 {
        coordinates.x * self.x + coordinates.y * self.y + coordinates.z * self.z
    }
}

/// A body's surface over the plane across the motion: where a line parallel to
/// the motion enters (near) and leaves (far) it.
///
/// Many lines share one direction, so all that depends on the direction alone
/// is worked out once, and a line is two coordinates.
pub(super) struct Shadow<'a> {
    shape: &'a Shape,
    pose: &'a Pose,
    view: View,
    /// The body's bounding centre, in the view's coordinates.
    pub(super) centre: DVec3,
    /// The shadow lies within these coordinates.
    pub(super) min: DVec2,
    pub(super) max: DVec2,
    surface: Surface,
    /// The body's `max_dist`.
    pub(super) size: f64,
    /// Distance outside a plane that still counts as on it, in metres.
    slack: f64,
}

enum Surface {
    Ball { radius: f64 },
    Facets(Facets),
    Flat([DVec3; 3]),
}

/// The faces of a convex body as depths over the plane: `depth + slope · (x, y)`.
#[derive(Default)]
struct Facets {
    near: Vec<Facet>,
    far: Vec<Facet>,
    /// Faces along the motion: `normal · (x, y) ≤ offset`.
    side: Vec<(DVec2, f64)>,
}

#[derive(Clone, Copy)]
struct Facet {
    depth: f64,
    slope: DVec2,
    /// Component of the unit normal along the motion, without its sign.
    steepness: f64,
    face: u32,
}

/// A face whose normal is this nearly across the motion is a wall that rays run
/// along: its depth as a function of x and y would be rounding alone.
const WALL: f64 = 1e-12;

/// Share of a body's size by which a ray may miss it and still graze it.
///
/// A ray from a vertex towards an edge straight ahead passes it by a few ulp of
/// the coordinates, on one side or the other. 1e-13 is a thousandth of what
/// counts as touching.
const GRAZE: f64 = 1e-13;

/// Share of a body's size by which faces may differ in depth and still meet at a ray.
const MEET: f64 = 1e-9;

impl<'a> Shadow<'a> {
    /// `centre` is the bounding centre in the view's coordinates.
    pub(super) fn new(shape: &'a Shape, pose: &'a Pose, view: View, centre: DVec3) -> Self {
        let size = shape.max_dist();
        let (surface, min, max) = match shape {
            Shape::Sphere(sphere) => {
                let radius = sphere.radius();
                (
                    Surface::Ball { radius },
                    DVec2::splat(-radius),
                    DVec2::splat(radius),
                )
            }
            Shape::Triangle(triangle) => {
                let local = local_view(pose, view);
                let corners = triangle
                    .vertices()
                    .map(|v| local.coordinates(v - shape.centre()));
                let flat = corners.map(DVec3::truncate);
                let min = flat[0].min(flat[1]).min(flat[2]);
                let max = flat[0].max(flat[1]).max(flat[2]);
                (Surface::Flat(corners), min, max)
            }
            Shape::Cuboid(_) | Shape::Polytope(_) => {
                let local = local_view(pose, view);
                let (min, max) = extent(shape, &local);
                (Surface::Facets(Facets::new(shape, &local)), min, max)
            }
        };
        let (min, max) = (min + centre.truncate(), max + centre.truncate());
        Self {
            shape,
            pose,
            view,
            centre,
            min,
            max,
            surface,
            size,
            slack: GRAZE * size,
        }
    }

    /// The radius, if the shadow is a disc.
    pub(super) fn disc(&self) -> Option<f64> {
        match self.surface {
            Surface::Ball { radius } => Some(radius),
            Surface::Facets(_) | Surface::Flat(_) => None,
        }
    }

    /// Centre and radius, if the shadow is a disc.
    pub(super) fn ball(&self) -> Option<(DVec2, f64)> {
        Some((self.centre.truncate(), self.disc()?))
    }

    /// The unit normals, without their components along the motion, of all faces on one side.
    pub(super) fn for_each_normal(&self, side: Side, mut each: impl FnMut(DVec2)) {
        match &self.surface {
            Surface::Ball { .. } => {}
            Surface::Facets(facets) => {
                let (facets, sign) = match side {
                    Side::Near => (&facets.near, 1.0),
                    Side::Far => (&facets.far, -1.0),
                };
                for facet in facets {
                    each(sign * facet.steepness * facet.slope);
                }
            }
            Surface::Flat([a, b, c]) => {
                if let Some(normal) = (b - a).cross(c - a).try_normalize() {
                    let turned = (normal.z > 0.0) == (side == Side::Near);
                    each(if turned { -normal } else { normal }.truncate());
                }
            }
        }
    }

    /// Distance outside the body that still grazes it, in metres.
    pub(super) fn slack(&self) -> f64 {
        self.slack
    }

    /// Adds where lines through `(xs[i], ys[i])` enter or leave the body; NaN where they miss it.
    pub(super) fn depths(&self, side: Side, xs: &[f64], ys: &[f64], out: &mut Vec<f64>) {
        let points = xs.iter().zip(ys).map(|(&x, &y)| DVec2::new(x, y));
        match self.surface {
            // All that is needed at hand, so that the compiler does several points at a time.
            Surface::Ball { radius } => {
                let (centre, slack, sign) = (self.centre, self.slack, side.sign());
                out.extend(points.map(|point| ball_depth(centre, radius, slack, sign, point)));
            }
            Surface::Facets(_) | Surface::Flat(_) => {
                out.extend(points.map(|point| self.depth(side, point)));
            }
        }
    }

    /// Where the line through a point enters or leaves the body; NaN where it misses it.
    #[inline]
    pub(super) fn depth(&self, side: Side, point: DVec2) -> f64 {
        if let Surface::Ball { radius } = self.surface {
            return ball_depth(self.centre, radius, self.slack, side.sign(), point);
        }
        match (self.span(point.x, point.y), side) {
            (Some((near, _)), Side::Near) => near,
            (Some((_, far)), Side::Far) => far,
            (None, _) => f64::NAN,
        }
    }

    /// Where the line through `(x, y)` enters and leaves the body.
    pub(super) fn span(&self, x: f64, y: f64) -> Option<(f64, f64)> {
        let at = DVec2::new(x, y) - self.centre.truncate();
        let (near, far) = match &self.surface {
            Surface::Ball { radius } => {
                let left = radius * radius - at.length_squared();
                let height = left.max(0.0).sqrt();
                (left >= -2.0 * radius * self.slack).then_some((-height, height))
            }
            Surface::Facets(facets) => facets.span(at, self.slack),
            Surface::Flat(corners) => flat_span(corners, at, self.slack),
        }?;
        Some((near + self.centre.z, far + self.centre.z))
    }

    /// Whether the line through `(x, y)` leaves the body, which it does at
    /// `depth`, on an edge between two faces or close to one.
    pub(super) fn leaves_by_edge(&self, x: f64, y: f64, depth: f64) -> bool {
        /// Share of the body's size that is close. The refinement comes within
        /// a thousandth of this.
        const CLOSE: f64 = 1e-6;
        let Surface::Facets(facets) = &self.surface else {
            return false;
        };
        let at = DVec2::new(x, y) - self.centre.truncate();
        let limit = depth - self.centre.z + CLOSE * self.size;
        facets
            .far
            .iter()
            .filter(|facet| facet.at(at) <= limit)
            .count()
            > 1
    }

    /// Outward unit normal and feature where the line through `(x, y)` enters
    /// (`near`) or leaves the body, which it does at `depth`.
    pub(super) fn surface_at(&self, x: f64, y: f64, depth: f64, side: Side) -> (DVec3, Feature) {
        let at = DVec3::new(x, y, depth) - self.centre;
        match (&self.surface, self.shape) {
            (Surface::Facets(facets), _) => {
                let face = facets.face_at(at.truncate(), side, MEET * self.size);
                let normal = match self.shape {
                    Shape::Polytope(polytope) => polytope
                        .face_normals()
                        .get(face as usize)
                        .copied()
                        .unwrap_or(DVec3::Z),
                    _ => cuboid_normal(face),
                };
                (self.pose.direction(normal), Feature::Face(face))
            }
            (Surface::Flat(_), Shape::Triangle(triangle)) => {
                let normal = self.pose.direction(triangle.normal());
                // The side that faces the ray.
                let front = (normal.dot(self.view.z) < 0.0) == (side == Side::Near);
                if front {
                    (normal, Feature::Face(0))
                } else {
                    (-normal, Feature::Face(1))
                }
            }
            (Surface::Ball { .. } | Surface::Flat(_), _) => {
                let normal = self.view.vector(at).normalize_or(-self.view.z);
                (normal, Feature::Surface)
            }
        }
    }
}

/// Where the line through a point enters a ball or leaves it, by the sign of the side.
#[inline]
fn ball_depth(centre: DVec3, radius: f64, slack: f64, sign: f64, point: DVec2) -> f64 {
    let squared = radius * radius - (point - centre.truncate()).length_squared();
    // Without a branch: by `&`, not `&&`.
    let grazing = (squared < 0.0) & (squared >= -2.0 * radius * slack);
    // Below the slack the root is of a negative number: NaN, a miss.
    let height = if grazing { 0.0 } else { squared }.sqrt();
    centre.z + sign * height
}

/// Which of a line's two points on a body is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    /// Where it enters.
    Near,
    /// Where it leaves.
    Far,
}

impl Side {
    /// −1 for where a line enters a ball, seen from its centre, 1 for where it leaves.
    fn sign(self) -> f64 {
        match self {
            Self::Near => -1.0,
            Self::Far => 1.0,
        }
    }
}

impl Facets {
    fn new(shape: &Shape, local: &View) -> Self {
        let mut facets = Self::default();
        match shape {
            Shape::Polytope(polytope) => {
                let centre = shape.centre();
                for (face, (normal, offset)) in polytope
                    .face_normals()
                    .iter()
                    .zip(polytope.face_offsets())
                    .enumerate()
                {
                    let offset = offset - normal.dot(centre);
                    facets.push(face as u32, local.coordinates(*normal), offset);
                }
            }
            Shape::Cuboid(cuboid) => {
                for face in 0..6 {
                    let offset = cuboid.half_extents()[face as usize / 2];
                    facets.push(face, local.coordinates(cuboid_normal(face)), offset);
                }
            }
            Shape::Sphere(_) | Shape::Triangle(_) => {
                debug_assert!(false, "a shape without facets");
            }
        }
        facets
    }

    fn push(&mut self, face: u32, normal: DVec3, offset: f64) {
        if normal.z.abs() < WALL {
            self.side.push((normal.truncate(), offset));
            return;
        }
        let facet = Facet {
            depth: offset / normal.z,
            slope: -normal.truncate() / normal.z,
            steepness: normal.z.abs(),
            face,
        };
        if normal.z < 0.0 {
            self.near.push(facet);
        } else {
            self.far.push(facet);
        }
    }

    fn span(&self, at: DVec2, slack: f64) -> Option<(f64, f64)> {
        if self
            .side
            .iter()
            .any(|(normal, offset)| normal.dot(at) - offset > slack)
        {
            return None;
        }
        let (mut near, mut near_steepness) = (f64::NEG_INFINITY, 0.0);
        for facet in &self.near {
            let depth = facet.at(at);
            if depth > near {
                (near, near_steepness) = (depth, facet.steepness);
            }
        }
        let (mut far, mut far_steepness) = (f64::INFINITY, 0.0);
        for facet in &self.far {
            let depth = facet.at(at);
            if depth < far {
                (far, far_steepness) = (depth, facet.steepness);
            }
        }
        // Entered behind where it was left: beside the body, by this much
        // measured across the nearer of the two faces.
        let outside = (near - far) * f64::min(near_steepness, far_steepness);
        (outside <= slack).then_some((near, far))
    }

    /// The face that lies foremost, for the side meant, at a point; where several
    /// meet to within `close`, the one that faces the rays most.
    fn face_at(&self, at: DVec2, side: Side, close: f64) -> u32 {
        let (facets, sign) = match side {
            Side::Near => (&self.near, 1.0),
            Side::Far => (&self.far, -1.0),
        };
        let depth = |facet: &Facet| sign * facet.at(at);
        let foremost = facets.iter().map(depth).fold(f64::NEG_INFINITY, f64::max);
        let mut best = (0.0, 0);
        for facet in facets {
            if depth(facet) >= foremost - close && facet.steepness > best.0 {
                best = (facet.steepness, facet.face);
            }
        }
        best.1
    }
}

impl Facet {
    fn at(&self, at: DVec2) -> f64 {
        self.depth + self.slope.dot(at)
    }
}

fn local_view(pose: &Pose, view: View) -> View {
    View {
        x: pose.local_direction(view.x),
        y: pose.local_direction(view.y),
        z: pose.local_direction(view.z),
    }
}

fn extent(shape: &Shape, local: &View) -> (DVec2, DVec2) {
    let centre = shape.centre();
    let (mut min, mut max) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    if let Some(mesh) = Mesh::of(shape) {
        for &vertex in mesh.vertices.iter() {
            let at = local.coordinates(vertex - centre).truncate();
            (min, max) = (min.min(at), max.max(at));
        }
    }
    (min, max)
}

fn cuboid_normal(face: u32) -> DVec3 {
    let sign = if face.is_multiple_of(2) { -1.0 } else { 1.0 };
    sign * DVec3::AXES[face as usize / 2 % 3]
}

/// Where the line through `at` meets a triangle, whose corners are in view
/// coordinates; seen edge-on, where it enters and leaves it.
fn flat_span(corners: &[DVec3; 3], at: DVec2, slack: f64) -> Option<(f64, f64)> {
    let flat = corners.map(DVec3::truncate);
    let doubled_area = (flat[1] - flat[0]).perp_dot(flat[2] - flat[0]);
    let longest = (0..3)
        .map(|i| flat[i].distance(flat[(i + 1) % 3]))
        .fold(0.0, f64::max);
    if doubled_area.abs() <= slack * longest {
        return edge_on_span(corners, at, slack);
    }
    let turn = doubled_area.signum();
    let mut depth = 0.0;
    for index in 0..3 {
        let (from, to) = (flat[(index + 1) % 3], flat[(index + 2) % 3]);
        let inside = turn * (to - from).perp_dot(at - from);
        // A NaN passes this test and is thrown out by the caller's comparisons.
        if inside < -slack * from.distance(to) {
            return None;
        }
        depth += turn * inside / doubled_area * corners[index].z;
    }
    Some((depth, depth))
}

/// Where the line through `at` runs within a triangle that is seen edge-on.
fn edge_on_span(corners: &[DVec3; 3], at: DVec2, slack: f64) -> Option<(f64, f64)> {
    let (mut near, mut far) = (f64::INFINITY, f64::NEG_INFINITY);
    for index in 0..3 {
        let (from, to) = (corners[index], corners[(index + 1) % 3]);
        let along = (to - from).truncate();
        let length_squared = along.length_squared();
        let share = if length_squared > 0.0 {
            ((at - from.truncate()).dot(along) / length_squared).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let point = from.lerp(to, share);
        if point.truncate().distance(at) <= slack {
            near = near.min(point.z);
            far = far.max(point.z);
            if length_squared <= slack * slack {
                near = near.min(to.z);
                far = far.max(to.z);
            }
        }
    }
    (near <= far).then_some((near, far))
}
