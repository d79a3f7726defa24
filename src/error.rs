//! One small error enum per door.
//!
//! Every call that takes input from outside checks it there and answers bad
//! input with one of these. An error names the field, the value and the limit;
//! whatever the call was made on is as it was before.

use crate::world::BodyId;
use thiserror::Error;

/// A number is outside its documented domain.
///
/// The limits are constants in [`tolerance`](crate::tolerance).
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum ValueError {
    /// The number is NaN or infinite.
    #[error("{field} is not finite: {value}")]
    NotFinite {
        /// What the number stands for.
        field: &'static str,
        /// The number given.
        value: f64,
    },
    /// The number is below its floor.
    #[error("{field} is {value:e}, below the minimum of {min:e}")]
    TooSmall {
        /// What the number stands for.
        field: &'static str,
        /// The number given.
        value: f64,
        /// The smallest number allowed.
        min: f64,
    },
    /// The number is above its ceiling.
    #[error("{field} is {value:e}, above the maximum of {max:e}")]
    TooLarge {
        /// What the number stands for.
        field: &'static str,
        /// The number given.
        value: f64,
        /// The largest number allowed.
        max: f64,
    },
}

/// A shape cannot be built from what was given.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ShapeError {
    /// A coordinate or length is outside its domain.
    #[error(transparent)]
    Value(#[from] ValueError),
    /// There are too few points for a body with volume.
    #[error("{count} points given, at least {min} are needed")]
    TooFewPoints {
        /// How many points were given.
        count: usize,
        /// How many are needed.
        min: usize,
    },
    /// The points or triangles span no volume: they coincide, or lie on one line or one plane.
    #[error(
        "the points span {dimensions} dimensions: thinner than {min_thickness:e} m, \
         they enclose no volume"
    )]
    Flat {
        /// How many dimensions the points span: 0 (all coincide), 1 (a line) or 2 (a plane).
        dimensions: u8,
        /// The least thickness that counts as a dimension, in metres.
        min_thickness: f64,
    },
    /// A triangle's corners coincide or lie on one line.
    #[error("triangle {triangle} is degenerate: its height is {height:e} m, below {min:e} m")]
    DegenerateTriangle {
        /// Index of the triangle.
        triangle: usize,
        /// Its least height, in metres.
        height: f64,
        /// The least height allowed, in metres.
        min: f64,
    },
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} names vertex {vertex}, but there are only {count} vertices")]
    NoSuchVertex {
        /// Index of the triangle.
        triangle: usize,
        /// The vertex index it names.
        vertex: usize,
        /// How many vertices were given.
        count: usize,
    },
    /// Two vertices lie at the same point.
    #[error("vertices {first} and {second} coincide")]
    DuplicateVertex {
        /// Index of the first of the two.
        first: usize,
        /// Index of the second.
        second: usize,
    },
    /// A vertex belongs to no triangle.
    #[error("vertex {vertex} belongs to no triangle")]
    UnusedVertex {
        /// Index of the vertex.
        vertex: usize,
    },
    /// An edge does not lie between exactly two triangles: the surface is open or branches.
    #[error(
        "the surface is not closed: the edge from vertex {from} to vertex {to} of triangle \
         {triangle} lies on {count} triangles instead of 2"
    )]
    NotClosed {
        /// Index of a triangle with that edge.
        triangle: usize,
        /// The edge's first vertex.
        from: usize,
        /// The edge's second vertex.
        to: usize,
        /// How many triangles have that edge.
        count: usize,
    },
    /// A triangle's corners run the other way round than its neighbour's.
    #[error("triangle {triangle} is wound against its neighbour {neighbour}")]
    InconsistentWinding {
        /// Index of the triangle.
        triangle: usize,
        /// Index of the triangle next to it.
        neighbour: usize,
    },
    /// All triangles face inwards.
    #[error("the surface is inside out: triangle {triangle} faces inwards")]
    InsideOut {
        /// Index of a triangle that faces inwards.
        triangle: usize,
    },
    /// A vertex lies outside the plane of a triangle: the surface is not convex.
    #[error(
        "the surface is not convex: vertex {vertex} lies {distance:e} m outside triangle {triangle}"
    )]
    NotConvex {
        /// Index of the triangle.
        triangle: usize,
        /// Index of the vertex outside its plane.
        vertex: usize,
        /// How far outside, in metres.
        distance: f64,
    },
    /// The triangles go round the body more than once.
    #[error("the surface covers the body {layers} times")]
    Overlapping {
        /// How many times.
        layers: usize,
    },
    /// The triangles form more than one surface.
    #[error("triangle {triangle} is not connected to triangle 0")]
    NotConnected {
        /// Index of a triangle that belongs to another surface.
        triangle: usize,
    },
}

/// A path or curve cannot be built from what was given.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum PathError {
    /// A coordinate is outside its domain.
    #[error(transparent)]
    Value(#[from] ValueError),
    /// There are too few points to lead a path through.
    #[error("{count} points given, at least {min} are needed")]
    TooFewPoints {
        /// How many points were given.
        count: usize,
        /// How many are needed.
        min: usize,
    },
    /// There is not one tangent for every point.
    #[error("{tangents} tangents given for {points} points")]
    TangentCount {
        /// How many points were given.
        points: usize,
        /// How many tangents were given.
        tangents: usize,
    },
    /// Two successive points coincide, or the piece between them has no length.
    #[error("piece {piece} of the path is {length:e} m long, below the minimum of {min:e} m")]
    PieceTooShort {
        /// Index of the piece.
        piece: usize,
        /// Its length in metres.
        length: f64,
        /// The least length allowed.
        min: f64,
    },
    /// Control points do not make whole cubic pieces: three for each and one more.
    #[error("{count} control points given: 4, 7, 10 and so on make whole pieces")]
    ControlPointCount {
        /// How many control points were given.
        count: usize,
    },
    /// A row of an arc-length table does not continue the row before it, or there is no row.
    #[error("row {row} of the arc-length table is missing or does not continue the row before it")]
    TableRow {
        /// Index of the row.
        row: usize,
    },
}

/// A motion cannot be built from what was given.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum MotionError {
    /// A coordinate, velocity, speed, spin or time is outside its domain.
    #[error(transparent)]
    Value(#[from] ValueError),
    /// What was asked for needs a path, and the motion follows none.
    #[error("{what} needs a path, and this motion follows none")]
    NoPath {
        /// What was asked for.
        what: &'static str,
    },
    /// A path is to be flown in a loop, but does not end where it begins.
    #[error("the path does not close: its end is {gap:e} m from its start")]
    OpenLoop {
        /// From its end to its start, in metres.
        gap: f64,
    },
    /// Two axes that are to span a plane lie on one line, as nearly as matters.
    #[error("{a} and {b} are parallel: the sine of their angle is {sine:e}, below {min:e}")]
    Parallel {
        /// The first axis.
        a: &'static str,
        /// The second axis.
        b: &'static str,
        /// Sine of the angle between them.
        sine: f64,
        /// The least sine allowed.
        min: f64,
    },
}

/// A world cannot be configured as asked.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum ConfigError {
    /// A number is outside its domain.
    #[error(transparent)]
    Value(#[from] ValueError),
}

/// A body cannot be inserted, or be given what was asked.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum BodyError {
    /// A number is outside its domain.
    #[error(transparent)]
    Value(#[from] ValueError),
    /// The motion is not possible.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The body has been removed, or belongs to another world.
    #[error("there is no body {id}: it has been removed, or belongs to another world")]
    UnknownBody {
        /// The id given.
        id: BodyId,
    },
    /// The world is full.
    #[error("the world holds {max} bodies already")]
    TooManyBodies {
        /// How many bodies a world can hold.
        max: usize,
    },
}

/// A world cannot be stepped as asked.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum StepError {
    /// The time step is outside its domain.
    #[error(transparent)]
    Value(#[from] ValueError),
    /// A body would fly out of the domain of coordinates.
    #[error("body {id} would leave the world: {source}")]
    LeftWorld {
        /// The body.
        id: BodyId,
        /// The coordinate that would be too large.
        source: ValueError,
    },
}

/// What [`first_contact`](crate::first_contact) cannot work with, or cannot tell.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum FirstContactError {
    /// One of the bodies.
    #[error(transparent)]
    Body(#[from] BodyError),
    /// The method.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// The horizon.
    #[error(transparent)]
    Step(#[from] StepError),
    /// The two come or stay so near to each other, without a touch, that the search
    /// ran out of budget.
    #[error("proven apart until {clear_until} of the horizon; undecided from there")]
    Undecided {
        /// Up to this fraction of the horizon the two are proven apart.
        clear_until: f64,
    },
}

/// A world cannot be asked this.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum QueryError {
    /// A number is outside its domain.
    #[error(transparent)]
    Value(#[from] ValueError),
    /// A shape on a curve comes or stays so near to a body, without a touch, that the search
    /// ran out of budget.
    #[error("proven apart from body {body} for {clear_until} m of the path; undecided from there")]
    Undecided {
        /// The body.
        body: BodyId,
        /// Up to this distance along the path, in metres, nothing is met.
        clear_until: f64,
    },
}

/// A scene cannot be read, or no world be made of it.
#[cfg(feature = "serde")]
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SceneError {
    /// A number is outside its domain.
    #[error(transparent)]
    Value(#[from] ValueError),
    /// The settings.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// One of the bodies.
    #[error("body \"{name}\": {source}")]
    Body {
        /// Its name.
        name: String,
        /// What is wrong with it.
        source: BodyError,
    },
    /// Two bodies have the same name.
    #[error("two bodies are named \"{name}\"")]
    DuplicateName {
        /// The name.
        name: String,
    },
}
