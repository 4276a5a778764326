//! Optional attributes of the triangles of a mesh: texture coordinates and per-triangle textures. An absent list takes
//! no memory.

use crate::scene::shape::face_texture::{FaceTexture, TextureWeight, TextureWeights};
use glam::Vec2;

/// Entry in a per-triangle list: the triangle has none of its own.
pub(crate) const NO_TRIPLE: [u32; 3] = only(u32::MAX);

/// Entry in a per-triangle list: one texture for the whole triangle. Three equal indices are blended like any other
/// three, which differs in the last digits of single precision.
pub(crate) const fn only(texture: u32) -> [u32; 3] {
    [texture, u32::MAX, u32::MAX]
}

/// Texture coordinates and textures of triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct TriangleAttributes {
    /// The texture coordinates.
    pub(crate) uvs: Vec<Vec2>,
    pub(crate) uv_of: UvOf,
    /// The textures.
    pub(crate) textures: Vec<FaceTexture>,
    pub(crate) textures_of: TexturesOf,
}

/// Assignment of texture coordinates to the corners of triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) enum UvOf {
    /// No texture coordinates: all are zero.
    #[default]
    None,
    /// Indexed by vertex.
    Corners,
    /// Per triangle, three indices into [`TriangleAttributes::uvs`].
    Triangles(Vec<[u32; 3]>),
}

/// Assignment of textures to the corners of triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) enum TexturesOf {
    /// The texture of the object.
    #[default]
    Object,
    /// Per triangle one index into [`TriangleAttributes::textures`], or `u32::MAX` for the texture of the object.
    One(Vec<u32>),
    /// Per triangle an index for each corner, [`only`] one, or [`NO_TRIPLE`].
    Three(Vec<[u32; 3]>),
}

impl TexturesOf {
    /// Appends the textures of the next triangle.
    pub(crate) fn push(&mut self, triple: [u32; 3], triangles_before: usize) {
        let is_one = triple == only(triple[0]);
        if matches!(self, TexturesOf::Object) && triple != NO_TRIPLE {
            *self = TexturesOf::One(vec![u32::MAX; triangles_before]);
        }
        if let TexturesOf::One(list) = self
            && !is_one
        {
            *self = TexturesOf::Three(list.iter().copied().map(only).collect());
        }
        match self {
            TexturesOf::Object => {}
            TexturesOf::One(list) => list.push(triple[0]),
            TexturesOf::Three(list) => list.push(triple),
        }
    }

    fn of(&self, face: u32) -> [u32; 3] {
        let face = face as usize;
        match self {
            TexturesOf::Object => NO_TRIPLE,
            TexturesOf::One(list) => list.get(face).copied().map_or(NO_TRIPLE, only),
            TexturesOf::Three(list) => list.get(face).copied().unwrap_or(NO_TRIPLE),
        }
    }
}

impl TriangleAttributes {
    /// Texture coordinates at a point of a triangle with these corners and barycentric coordinates.
    pub(crate) fn uv(&self, face: u32, corners: [u32; 3], weights: [f64; 3]) -> [f64; 2] {
        let triple = match &self.uv_of {
            UvOf::None => return [0.0; 2],
            UvOf::Corners => corners,
            UvOf::Triangles(list) => list[face as usize],
        };
        let mut uv = [0.0; 2];
        for (index, weight) in triple.into_iter().zip(weights) {
            let coordinates = self.uvs[index as usize];
            uv[0] += weight * f64::from(coordinates.x);
            uv[1] += weight * f64::from(coordinates.y);
        }
        uv
    }

    /// Texture weights at a point of a triangle; `weights` computes its barycentric coordinates.
    pub(crate) fn texture_weights(
        &self,
        face: u32,
        weights: impl FnOnce() -> [f64; 3],
    ) -> TextureWeights {
        let triple = self.textures_of.of(face);
        if triple == NO_TRIPLE {
            return TextureWeights::new();
        }
        if triple == only(triple[0]) {
            return TextureWeights::from_slice(&[TextureWeight {
                weight: 1.0,
                texture: triple[0],
            }]);
        }
        let weights = weights().map(|weight| weight.max(0.0));
        let sum: f64 = weights.iter().sum();
        let pairs = triple.into_iter().zip(weights);
        pairs
            .map(|(skin, weight)| TextureWeight {
                weight: weight / sum,
                texture: skin,
            })
            .collect()
    }

    /// Keeps the triangles whose flag is set.
    pub(crate) fn retain(&mut self, keep: &[bool]) {
        if let UvOf::Triangles(list) = &mut self.uv_of {
            retain(list, keep);
        }
        match &mut self.textures_of {
            TexturesOf::Object => {}
            TexturesOf::One(list) => retain(list, keep),
            TexturesOf::Three(list) => retain(list, keep),
        }
    }

    /// Shrinks the lists to their lengths.
    pub(crate) fn shrink(&mut self) {
        self.uvs.shrink_to_fit();
        if let UvOf::Triangles(list) = &mut self.uv_of {
            list.shrink_to_fit();
        }
        match &mut self.textures_of {
            TexturesOf::Object => {}
            TexturesOf::One(list) => list.shrink_to_fit(),
            TexturesOf::Three(list) => list.shrink_to_fit(),
        }
    }

    /// Heap memory in bytes.
    pub(crate) fn bytes(&self) -> usize {
        let uv_of = match &self.uv_of {
            UvOf::None | UvOf::Corners => 0,
            UvOf::Triangles(list) => list.capacity() * size_of::<[u32; 3]>(),
        };
        let textures_of = match &self.textures_of {
            TexturesOf::Object => 0,
            TexturesOf::One(list) => list.capacity() * size_of::<u32>(),
            TexturesOf::Three(list) => list.capacity() * size_of::<[u32; 3]>(),
        };
        uv_of
            + textures_of
            + self.uvs.capacity() * size_of::<Vec2>()
            + self.textures.capacity() * size_of::<FaceTexture>()
    }
}

/// Keeps the items whose flag is set, and those beyond the end of the flags.
pub(crate) fn retain<T>(list: &mut Vec<T>, keep: &[bool]) {
    let mut flags = keep.iter();
    list.retain(|_| flags.next().copied().unwrap_or(true));
}
