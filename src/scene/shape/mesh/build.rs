//! Builds a mesh for tracing from the triangles of a scene.

use super::attributes::{NO_TRIPLE, TexturesOf, TriangleAttributes, UvOf, retain};
use super::planes::FacePlane;
use super::{FLAT, Inside, Triangles};
use crate::base::derived::Derived;
use crate::base::math::conditioning::unit;
use crate::base::math::{Bounds, rounding};
use crate::scene::shape::Triangle;
use crate::scene::shape::face_texture::FaceTexture;
use glam::{DVec2, DVec3, Vec2, Vec3};
use rayon::prelude::*;
use rustc_hash::FxHashMap;
use std::sync::OnceLock;

/// Maximum number of triangles of a mesh. The BVH has 31-bit indices.
const MAX_TRIANGLES: usize = 1 << 30;

/// A triangle whose unit normals differ by no more than this is flat (measured: 0.7e-5 is flat, 1.4e-5 is not).
const SAME_NORMAL: f32 = 1e-5;

/// The triangles of a mesh while it is read.
#[derive(Default)]
pub(crate) struct MeshBuilder {
    pub(crate) vertices: Vec<Vec3>,
    pub(crate) corners: Vec<[u32; 3]>,
    pub(crate) normals: Vec<Vec3>,
    /// At most as long as `corners`; triangles beyond its end are flat.
    pub(crate) smooth: Vec<[u32; 3]>,
    pub(crate) inside: Option<DVec3>,
    pub(crate) attributes: TriangleAttributes,
    /// The planes of triangles from the corners as they were given; none beyond its end.
    planes: Vec<FacePlane>,
    /// True if some corner was rounded.
    is_rounded: bool,
    known_vertices: FxHashMap<[u32; 3], u32>,
    known_normals: FxHashMap<[u32; 3], u32>,
    known_uvs: FxHashMap<[u32; 2], u32>,
    /// Keyed by address.
    known_textures: FxHashMap<usize, u32>,
}

/// Converts a corner to single precision, or describes what is wrong with it.
pub(crate) fn single(point: DVec3) -> Result<Vec3, String> {
    let single = Vec3::from(point.to_array().map(rounding::nearest));
    if single.is_finite() {
        // Adding zero takes the sign from a negative zero.
        return Ok(single + Vec3::ZERO);
    }
    Err(format!(
        "the corners of a mesh are stored in single precision: <{}, {}, {}> is too large",
        point.x, point.y, point.z
    ))
}

/// Converts a normal to single precision, of length one or zero.
pub(crate) fn single_normal(normal: DVec3) -> Vec3 {
    let normal = unit(normal).unwrap_or(DVec3::ZERO);
    Vec3::from(normal.to_array().map(rounding::nearest)) + Vec3::ZERO
}

/// Converts texture coordinates to single precision.
pub(crate) fn single_pair(pair: DVec2) -> Vec2 {
    Vec2::from(pair.to_array().map(rounding::nearest)) + Vec2::ZERO
}

impl MeshBuilder {
    /// Adds a triangle of a `mesh`; equal corners and normals are shared.
    pub(crate) fn triangle(
        &mut self,
        corners: [DVec3; 3],
        normals: Option<[DVec3; 3]>,
    ) -> Result<(), String> {
        let mut indices = [0; 3];
        for (index, corner) in indices.iter_mut().zip(corners) {
            let stored = single(corner)?;
            self.is_rounded |= stored.as_dvec3() != corner;
            *index = share(stored, &mut self.vertices, &mut self.known_vertices);
        }
        let smooth = normals.map_or(FLAT, |normals| {
            normals.map(|normal| {
                let normal = single_normal(normal);
                share(normal, &mut self.normals, &mut self.known_normals)
            })
        });
        self.smooth.push(smooth);
        self.planes.push(FacePlane::new(corners));
        self.face(indices)
    }

    /// Sets the texture coordinates at the corners of the triangle added last; earlier triangles without any get zero.
    pub(crate) fn set_uv_of_last(&mut self, pairs: [Vec2; 3]) {
        let indices = pairs.map(|pair| self.uv(pair));
        let zero = self.uv(Vec2::ZERO);
        let before = self.corners.len() - 1;
        let mut list = match std::mem::take(&mut self.attributes.uv_of) {
            UvOf::Triangles(list) => list,
            UvOf::None | UvOf::Corners => Vec::new(),
        };
        list.resize(before, [zero; 3]);
        list.push(indices);
        self.attributes.uv_of = UvOf::Triangles(list);
    }

    fn uv(&mut self, pair: Vec2) -> u32 {
        let uvs = &mut self.attributes.uvs;
        let key = pair.to_array().map(f32::to_bits);
        *self.known_uvs.entry(key).or_insert_with(|| {
            uvs.push(pair);
            index(uvs.len() - 1)
        })
    }

    /// Adds vertices, unit normals and triangles with smooth corners by index; a vertex has the normal of its index.
    ///
    /// # Errors
    /// A vertex that single precision cannot hold, an index out of range, or fewer or more normals than vertices. The
    /// error is the reason.
    pub(crate) fn lists(
        &mut self,
        vertices: &[DVec3],
        normals: Option<&[DVec3]>,
        faces: &[[u32; 3]],
    ) -> Result<(), String> {
        self.vertices = vertices
            .iter()
            .map(|&v| single(v))
            .collect::<Result<_, _>>()?;
        let largest = faces.iter().flatten().max().copied();
        if let Some(largest) = largest.filter(|&index| index as usize >= vertices.len()) {
            let count = vertices.len();
            return Err(format!(
                "vertex {largest} of {count}, counted from 0, is not there"
            ));
        }
        if let Some(normals) = normals {
            let (count, vertices) = (normals.len(), vertices.len());
            if count != vertices {
                return Err(format!("there are {count} normals for {vertices} vertices"));
            }
            self.normals = normals
                .iter()
                .map(|&normal| single_normal(normal))
                .collect();
            self.smooth = faces.to_vec();
        }
        faces.iter().try_for_each(|&face| self.face(face))
    }

    /// Index of a texture, appended to the list if it is new.
    pub(crate) fn texture_index(&mut self, texture: FaceTexture) -> u32 {
        let key = std::sync::Arc::as_ptr(&texture.0).addr();
        let textures = &mut self.attributes.textures;
        *self.known_textures.entry(key).or_insert_with(|| {
            textures.push(texture);
            index(textures.len() - 1)
        })
    }

    /// Sets the textures of the triangle added last.
    pub(crate) fn set_textures_of_last(&mut self, textures: [u32; 3]) {
        let before = self.corners.len() - 1;
        self.fill_textures(before);
        self.attributes.textures_of.push(textures, before);
    }

    /// Assigns the texture of the object to triangles without one, if others have their own.
    fn fill_textures(&mut self, triangles: usize) {
        match &mut self.attributes.textures_of {
            TexturesOf::Object => {}
            TexturesOf::One(list) => list.resize(triangles, u32::MAX),
            TexturesOf::Three(list) => list.resize(triangles, NO_TRIPLE),
        }
    }

    /// Adds a triangle between existing vertices.
    pub(crate) fn face(&mut self, corners: [u32; 3]) -> Result<(), String> {
        if self.corners.len() >= MAX_TRIANGLES {
            return Err(format!("a mesh has at most {MAX_TRIANGLES} triangles"));
        }
        self.corners.push(corners);
        Ok(())
    }

    /// The mesh without its degenerate triangles.
    pub(crate) fn build(mut self) -> Triangles {
        self.known_vertices = FxHashMap::default();
        self.known_normals = FxHashMap::default();
        let inside = self.inside.map(|dir| Inside {
            dir,
            is_closed: self.is_closed(),
        });
        if !self.smooth.is_empty() {
            self.smooth.resize(self.corners.len(), FLAT);
        }
        for smooth in &mut self.smooth {
            let is_flat = *smooth == FLAT || are_same(smooth.map(|i| self.normals[i as usize]));
            if is_flat {
                *smooth = FLAT;
            }
        }
        let triangles = self.corners.len();
        self.fill_textures(triangles);
        if let UvOf::Triangles(list) = &self.attributes.uv_of
            && list.len() < triangles
        {
            let zero = self.uv(Vec2::ZERO);
            if let UvOf::Triangles(list) = &mut self.attributes.uv_of {
                list.resize(triangles, [zero; 3]);
            }
        }
        self.drop_degenerate();
        if self.smooth.iter().all(|smooth| *smooth == FLAT) {
            self.smooth = Vec::new();
            self.normals = Vec::new();
        }
        for list in [&mut self.corners, &mut self.smooth] {
            list.shrink_to_fit();
        }
        for list in [&mut self.vertices, &mut self.normals] {
            list.shrink_to_fit();
        }
        self.planes.shrink_to_fit();
        self.attributes.shrink();
        Triangles {
            vertices: self.vertices,
            corners: self.corners,
            normals: self.normals,
            smooth: self.smooth,
            attributes: (self.attributes != TriangleAttributes::default())
                .then(|| Box::new(self.attributes)),
            inside,
            planes: match self.is_rounded {
                true => OnceLock::from(self.planes),
                false => OnceLock::new(),
            },
            bounds: Bounds::EMPTY,
            tree: Derived::default(),
        }
        .bounded()
    }

    fn drop_degenerate(&mut self) {
        let keep: Vec<bool> = self
            .corners
            .par_iter()
            .map(|corners| {
                let corners = corners.map(|i| self.vertices[i as usize].as_dvec3());
                !Triangle { corners }.is_degenerate()
            })
            .collect();
        if keep.iter().all(|keep| *keep) {
            return;
        }
        retain(&mut self.corners, &keep);
        retain(&mut self.smooth, &keep);
        retain(&mut self.planes, &keep);
        self.attributes.retain(&keep);
    }

    /// True if every edge belongs to an even number of triangles; vertices at the same point count as one.
    fn is_closed(&self) -> bool {
        let mut first_at: FxHashMap<[u32; 3], u32> = FxHashMap::default();
        let vertex_ids: Vec<u32> = (0u32..)
            .zip(&self.vertices)
            .map(|(index, vertex)| *first_at.entry(bits(*vertex)).or_insert(index))
            .collect();
        let mut edges: Vec<u64> = Vec::with_capacity(3 * self.corners.len());
        for corners in &self.corners {
            let [a, b, c] = corners.map(|i| vertex_ids[i as usize]);
            for (from, to) in [(a, b), (b, c), (c, a)] {
                if from != to {
                    edges.push(u64::from(from.min(to)) << 32 | u64::from(from.max(to)));
                }
            }
        }
        edges.par_sort_unstable();
        edges
            .chunk_by(|a, b| a == b)
            .all(|same| same.len() % 2 == 0)
    }
}

/// Index of a point in a list, appended if it is new.
fn share(point: Vec3, list: &mut Vec<Vec3>, known: &mut FxHashMap<[u32; 3], u32>) -> u32 {
    *known.entry(bits(point)).or_insert_with(|| {
        list.push(point);
        index(list.len() - 1)
    })
}

fn index(at: usize) -> u32 {
    u32::try_from(at).expect("three for each of 2^30 triangles fit")
}

fn bits(point: Vec3) -> [u32; 3] {
    point.to_array().map(f32::to_bits)
}

fn are_same([first, second, third]: [Vec3; 3]) -> bool {
    let is_near = |other: Vec3| (other - first).abs().max_element() < SAME_NORMAL;
    is_near(second) && is_near(third)
}
