//! From the triangles of a scene to a mesh ready for rays.

use super::attributes::{Looks, NO_TRIPLE, SkinsOf, UvOf, retain};
use super::{FLAT, Inside, Triangles};
use crate::base::math::conditioning::unit;
use crate::base::math::{Bounds, rounding};
use crate::scene::shape::Triangle;
use crate::scene::shape::face_texture::FaceTexture;
use glam::{DVec2, DVec3, Vec2, Vec3};
use rayon::prelude::*;
use rustc_hash::FxHashMap;
use std::sync::OnceLock;

/// Triangles of one mesh. The tree counts in 31 bits.
const MOST: usize = 1 << 30;

/// A triangle whose unit normals differ by no more than this is flat (measured: 0.7e-5 is flat, 1.4e-5 is not).
const SAME_NORMAL: f32 = 1e-5;

/// The triangles of a mesh while it is read.
#[derive(Default)]
pub(crate) struct Draft {
    pub(crate) vertices: Vec<Vec3>,
    pub(crate) corners: Vec<[u32; 3]>,
    pub(crate) normals: Vec<Vec3>,
    /// As long as `corners`, or shorter: the others are flat.
    pub(crate) smooth: Vec<[u32; 3]>,
    pub(crate) inside: Option<DVec3>,
    pub(crate) looks: Looks,
    known_vertices: FxHashMap<[u32; 3], u32>,
    known_normals: FxHashMap<[u32; 3], u32>,
    known_uvs: FxHashMap<[u32; 2], u32>,
    /// By address.
    known_skins: FxHashMap<usize, u32>,
}

/// A corner as it is kept, or what is wrong with it.
pub(crate) fn single(point: DVec3) -> Result<Vec3, String> {
    let single = Vec3::from(point.to_array().map(rounding::nearest));
    if single.is_finite() {
        // Adding zero takes the sign from a negative zero.
        return Ok(single + Vec3::ZERO);
    }
    Err(format!(
        "the corners of a mesh are kept in single precision: <{}, {}, {}> is too large",
        point.x, point.y, point.z
    ))
}

/// A normal as it is kept: of length one, or zero.
pub(crate) fn single_normal(normal: DVec3) -> Vec3 {
    let normal = unit(normal).unwrap_or(DVec3::ZERO);
    Vec3::from(normal.to_array().map(rounding::nearest)) + Vec3::ZERO
}

/// Texture coordinates as they are kept.
pub(crate) fn single_pair(pair: DVec2) -> Vec2 {
    Vec2::from(pair.to_array().map(rounding::nearest)) + Vec2::ZERO
}

impl Draft {
    /// Adds a triangle of a `mesh`; corners and normals that were there before are shared.
    pub(crate) fn triangle(
        &mut self,
        corners: [DVec3; 3],
        normals: Option<[DVec3; 3]>,
    ) -> Result<(), String> {
        let mut indices = [0; 3];
        for (index, corner) in indices.iter_mut().zip(corners) {
            *index = share(
                single(corner)?,
                &mut self.vertices,
                &mut self.known_vertices,
            );
        }
        let smooth = normals.map_or(FLAT, |normals| {
            normals.map(|normal| {
                let normal = single_normal(normal);
                share(normal, &mut self.normals, &mut self.known_normals)
            })
        });
        self.smooth.push(smooth);
        self.face(indices)
    }

    /// Gives the triangle that was added last texture coordinates at its corners; those before without any have zero.
    pub(crate) fn uv_of_last(&mut self, pairs: [Vec2; 3]) {
        let indices = pairs.map(|pair| self.uv(pair));
        let zero = self.uv(Vec2::ZERO);
        let before = self.corners.len() - 1;
        let mut list = match std::mem::take(&mut self.looks.uv_of) {
            UvOf::Triangles(list) => list,
            UvOf::None | UvOf::Corners => Vec::new(),
        };
        list.resize(before, [zero; 3]);
        list.push(indices);
        self.looks.uv_of = UvOf::Triangles(list);
    }

    fn uv(&mut self, pair: Vec2) -> u32 {
        let uvs = &mut self.looks.uvs;
        let key = pair.to_array().map(f32::to_bits);
        *self.known_uvs.entry(key).or_insert_with(|| {
            uvs.push(pair);
            index(uvs.len() - 1)
        })
    }

    /// The number of a texture, which the list gets if it is new.
    pub(crate) fn skin(&mut self, skin: FaceTexture) -> u32 {
        let key = std::sync::Arc::as_ptr(&skin.0).addr();
        let skins = &mut self.looks.skins;
        *self.known_skins.entry(key).or_insert_with(|| {
            skins.push(skin);
            index(skins.len() - 1)
        })
    }

    /// Gives the triangle that was added last its textures.
    pub(crate) fn skins_of_last(&mut self, skins: [u32; 3]) {
        let before = self.corners.len() - 1;
        self.fill_skins(before);
        self.looks.skins_of.push(skins, before);
    }

    /// Gives triangles without a word on textures that of the object, if others have some.
    fn fill_skins(&mut self, triangles: usize) {
        match &mut self.looks.skins_of {
            SkinsOf::Object => {}
            SkinsOf::One(list) => list.resize(triangles, u32::MAX),
            SkinsOf::Three(list) => list.resize(triangles, NO_TRIPLE),
        }
    }

    /// Adds a triangle between known corners.
    pub(crate) fn face(&mut self, corners: [u32; 3]) -> Result<(), String> {
        if self.corners.len() >= MOST {
            return Err(format!("a mesh has at most {MOST} triangles"));
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
        self.fill_skins(triangles);
        if let UvOf::Triangles(list) = &self.looks.uv_of
            && list.len() < triangles
        {
            let zero = self.uv(Vec2::ZERO);
            if let UvOf::Triangles(list) = &mut self.looks.uv_of {
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
        self.looks.shrink();
        Triangles {
            vertices: self.vertices,
            corners: self.corners,
            normals: self.normals,
            smooth: self.smooth,
            looks: (self.looks != Looks::default()).then(|| Box::new(self.looks)),
            inside,
            bounds: Bounds::EMPTY,
            tree: OnceLock::new(),
        }
        .bounded()
    }

    fn drop_degenerate(&mut self) {
        let is_kept: Vec<bool> = self
            .corners
            .par_iter()
            .map(|corners| {
                let corners = corners.map(|i| self.vertices[i as usize].as_dvec3());
                !Triangle { corners }.is_flat_line()
            })
            .collect();
        if is_kept.iter().all(|is_kept| *is_kept) {
            return;
        }
        retain(&mut self.corners, &is_kept);
        retain(&mut self.smooth, &is_kept);
        self.looks.retain(&is_kept);
    }

    /// Whether every edge belongs to an even number of triangles; corners at the same place are one.
    fn is_closed(&self) -> bool {
        let mut known: FxHashMap<[u32; 3], u32> = FxHashMap::default();
        let places: Vec<u32> = (0u32..)
            .zip(&self.vertices)
            .map(|(index, vertex)| *known.entry(bits(*vertex)).or_insert(index))
            .collect();
        let mut edges: Vec<u64> = Vec::with_capacity(3 * self.corners.len());
        for corners in &self.corners {
            let [a, b, c] = corners.map(|i| places[i as usize]);
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

/// The index of a point in a list, which gets it if it is new.
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
