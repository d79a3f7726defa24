//! Shapes as they are written.
//!
//! `{ sphere = { radius = 1.0 } }`, `{ hull = { points = [..] } }` and so on. What is
//! read goes through the shapes' constructors.

use crate::error::ShapeError;
use crate::geometry::{Cuboid, Polytope, Shape, Sphere, Triangle};
use crate::math::data::Vector;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SphereData {
    radius: f64,
}

impl TryFrom<SphereData> for Sphere {
    type Error = ShapeError;

    fn try_from(data: SphereData) -> Result<Self, ShapeError> {
        Self::new(data.radius)
    }
}

impl From<Sphere> for SphereData {
    fn from(sphere: Sphere) -> Self {
        Self {
            radius: sphere.radius(),
        }
    }
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CuboidData {
    half_extents: Vector,
}

impl TryFrom<CuboidData> for Cuboid {
    type Error = ShapeError;

    fn try_from(data: CuboidData) -> Result<Self, ShapeError> {
        Self::new(data.half_extents)
    }
}

impl From<Cuboid> for CuboidData {
    fn from(cuboid: Cuboid) -> Self {
        Self {
            half_extents: cuboid.half_extents().into(),
        }
    }
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TriangleData {
    vertices: [Vector; 3],
}

impl TryFrom<TriangleData> for Triangle {
    type Error = ShapeError;

    fn try_from(data: TriangleData) -> Result<Self, ShapeError> {
        let [a, b, c] = data.vertices;
        Self::new(a, b, c)
    }
}

impl From<Triangle> for TriangleData {
    fn from(triangle: Triangle) -> Self {
        Self {
            vertices: triangle.vertices().map(Vector::from),
        }
    }
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct HullData {
    points: Vec<Vector>,
}

impl TryFrom<HullData> for Polytope {
    type Error = ShapeError;

    fn try_from(data: HullData) -> Result<Self, ShapeError> {
        Self::from_points(data.points)
    }
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MeshData {
    vertices: Vec<Vector>,
    triangles: Vec<[u32; 3]>,
}

impl TryFrom<MeshData> for Polytope {
    type Error = ShapeError;

    fn try_from(data: MeshData) -> Result<Self, ShapeError> {
        Self::from_triangles(data.vertices, data.triangles)
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum PolytopeData {
    Hull(HullData),
    Mesh(MeshData),
}

impl TryFrom<PolytopeData> for Polytope {
    type Error = ShapeError;

    fn try_from(data: PolytopeData) -> Result<Self, ShapeError> {
        match data {
            PolytopeData::Hull(hull) => hull.try_into(),
            PolytopeData::Mesh(mesh) => mesh.try_into(),
        }
    }
}

impl From<&Polytope> for PolytopeData {
    /// By its vertices alone where they tell everything, else with its triangles.
    fn from(polytope: &Polytope) -> Self {
        let vertices = polytope.vertices();
        let hull = Polytope::from_points(vertices.iter().copied());
        let vertices = vertices.iter().copied().map(Vector::from).collect();
        if hull.is_ok_and(|hull| hull == *polytope) {
            Self::Hull(HullData { points: vertices })
        } else {
            let triangles = polytope.triangles().to_vec();
            Self::Mesh(MeshData {
                vertices,
                triangles,
            })
        }
    }
}

impl From<Polytope> for PolytopeData {
    fn from(polytope: Polytope) -> Self {
        Self::from(&polytope)
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum ShapeData {
    Sphere(Sphere),
    Cuboid(Cuboid),
    Triangle(Triangle),
    Hull(HullData),
    Mesh(MeshData),
}

impl TryFrom<ShapeData> for Shape {
    type Error = ShapeError;

    fn try_from(data: ShapeData) -> Result<Self, ShapeError> {
        Ok(match data {
            ShapeData::Sphere(sphere) => Self::Sphere(sphere),
            ShapeData::Cuboid(cuboid) => Self::Cuboid(cuboid),
            ShapeData::Triangle(triangle) => triangle.into(),
            ShapeData::Hull(hull) => Self::Polytope(Arc::new(hull.try_into()?)),
            ShapeData::Mesh(mesh) => Self::Polytope(Arc::new(mesh.try_into()?)),
        })
    }
}

impl From<Shape> for ShapeData {
    fn from(shape: Shape) -> Self {
        match shape {
            Shape::Sphere(sphere) => Self::Sphere(sphere),
            Shape::Cuboid(cuboid) => Self::Cuboid(cuboid),
            Shape::Triangle(triangle) => Self::Triangle(*triangle),
            Shape::Polytope(polytope) => match PolytopeData::from(&*polytope) {
                PolytopeData::Hull(hull) => Self::Hull(hull),
                PolytopeData::Mesh(mesh) => Self::Mesh(mesh),
            },
        }
    }
}
