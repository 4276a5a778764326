//! A mesh in its place, triangle by triangle, for cameras that look out of one.

use super::build::single_normal;
use super::{FLAT, Mesh};
use crate::base::math::Transform;
use crate::scene::shape::Geometry;
use glam::{DVec2, DVec3};

/// A mesh and where it stands.
#[derive(Clone, Debug)]
pub struct PlacedMesh {
    /// The mesh.
    pub mesh: Mesh,
    /// Its place in the world.
    pub place: Transform,
}

impl PlacedMesh {
    /// A mesh in a place.
    #[must_use]
    pub fn new(mesh: Mesh, place: Transform) -> Self {
        PlacedMesh { mesh, place }
    }

    /// How many triangles it has, degenerate ones not counted.
    #[must_use]
    pub fn len(&self) -> usize {
        self.mesh.len()
    }

    /// Whether it has no triangles.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.mesh.is_empty()
    }

    /// The corners of a triangle in the world.
    #[must_use]
    pub fn corners(&self, face: usize) -> [DVec3; 3] {
        let to_world = &self.place.world_from_object;
        let triangles = self.mesh.triangles();
        triangles.corners[face].map(|corner| {
            let corner = triangles.vertices[corner as usize].as_dvec3();
            to_world.transform_point3(corner)
        })
    }

    /// The normal of the plane of a triangle in the world, of any length; kept in single precision before it is moved, as
    /// POV-Ray's.
    #[must_use]
    pub fn normal(&self, face: usize) -> DVec3 {
        let number = u32::try_from(face).unwrap_or(u32::MAX);
        let normal = single_normal(self.mesh.normal(DVec3::ZERO, number));
        self.place.normal(normal.as_dvec3())
    }

    /// The normals at the corners of a triangle, of the object, if it is smooth.
    #[must_use]
    pub fn normals(&self, face: usize) -> Option<[DVec3; 3]> {
        let triangles = self.mesh.triangles();
        let smooth = triangles.smooth.get(face).copied();
        let smooth = smooth.filter(|smooth| *smooth != FLAT)?;
        Some(smooth.map(|normal| triangles.normals[normal as usize].as_dvec3()))
    }

    /// The texture coordinates of the corners of a triangle.
    #[must_use]
    pub fn coordinates(&self, face: usize) -> [DVec2; 3] {
        let triangles = self.mesh.triangles();
        let Some(looks) = &triangles.looks else {
            return [DVec2::ZERO; 3];
        };
        let number = u32::try_from(face).unwrap_or(u32::MAX);
        let corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        corners.map(|shares| DVec2::from(looks.uv(number, triangles.corners[face], shares)))
    }
}
