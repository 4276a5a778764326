//! A mesh with its transform, accessed triangle by triangle: for `mesh_camera`.

use super::{FLAT, Mesh};
use crate::base::math::Transform;
use glam::{DVec2, DVec3};

/// A mesh and its transform to the world.
#[derive(Clone, Debug)]
pub struct MeshInstance {
    /// The mesh.
    pub mesh: Mesh,
    /// From the mesh's object space to the world.
    pub transform: Transform,
}

impl MeshInstance {
    /// A mesh with a transform.
    #[must_use]
    pub fn new(mesh: Mesh, transform: Transform) -> Self {
        MeshInstance { mesh, transform }
    }

    /// Number of triangles, degenerate ones not counted.
    #[must_use]
    pub fn len(&self) -> usize {
        self.mesh.len()
    }

    /// True if there are no triangles.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.mesh.is_empty()
    }

    /// The corners of a triangle in the world.
    #[must_use]
    pub fn corners(&self, face: usize) -> [DVec3; 3] {
        let to_world = &self.transform.world_from_object;
        let triangles = self.mesh.triangles();
        triangles.corners[face].map(|corner| {
            let corner = triangles.vertices[corner as usize].as_dvec3();
            to_world.transform_point3(corner)
        })
    }

    /// The centroid of a triangle in the world; computed in single precision before the transform, as in POV-Ray.
    #[must_use]
    pub fn centroid(&self, face: usize) -> DVec3 {
        let triangles = self.mesh.triangles();
        let [a, b, c] = triangles.corners[face].map(|corner| triangles.vertices[corner as usize]);
        let centroid = ((a + b + c) / 3.0).as_dvec3();
        self.transform.world_from_object.transform_point3(centroid)
    }

    /// The normal of the plane of a triangle in the world, of any length.
    #[must_use]
    pub fn normal(&self, face: usize) -> DVec3 {
        let number = u32::try_from(face).unwrap_or(u32::MAX);
        let normal = self.mesh.triangles().plane(number).normal;
        self.transform.normal(normal.as_dvec3())
    }

    /// The normals at the corners of a triangle in object space, if it is smooth.
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
        let Some(attributes) = &triangles.attributes else {
            return [DVec2::ZERO; 3];
        };
        let number = u32::try_from(face).unwrap_or(u32::MAX);
        let corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        corners.map(|weights| DVec2::from(attributes.uv(number, triangles.corners[face], weights)))
    }
}
