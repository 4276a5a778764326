//! What the triangles of a mesh may have beside corners: texture coordinates, and textures of their own. A list that a
//! mesh does not have takes no memory.

use crate::scene::shape::face_texture::{FaceTexture, TextureWeight, TextureWeights};
use glam::Vec2;

/// In the lists of a mesh: the triangle has none.
pub(crate) const NO_TRIPLE: [u32; 3] = [u32::MAX; 3];

/// Texture coordinates and textures of triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Looks {
    /// Pairs of texture coordinates.
    pub(crate) uvs: Vec<Vec2>,
    pub(crate) uv_of: UvOf,
    /// The textures.
    pub(crate) skins: Vec<FaceTexture>,
    pub(crate) skins_of: SkinsOf,
}

/// Which texture coordinates the corners of a triangle have.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) enum UvOf {
    /// None: all are zero.
    #[default]
    None,
    /// Those with the number of the corner.
    Corners,
    /// For each triangle those in [`Looks::uvs`].
    Triangles(Vec<[u32; 3]>),
}

/// Which textures the corners of a triangle have.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) enum SkinsOf {
    /// That of the object.
    #[default]
    Object,
    /// For each triangle one of [`Looks::skins`], or `u32::MAX` for that of the object.
    One(Vec<u32>),
    /// For each triangle one at each corner, or [`NO_TRIPLE`].
    Three(Vec<[u32; 3]>),
}

impl SkinsOf {
    /// Gives the next triangle its textures.
    pub(crate) fn push(&mut self, triple: [u32; 3], triangles_before: usize) {
        let is_one = triple[0] == triple[1] && triple[1] == triple[2];
        if matches!(self, SkinsOf::Object) && triple != NO_TRIPLE {
            *self = SkinsOf::One(vec![u32::MAX; triangles_before]);
        }
        if let SkinsOf::One(list) = self
            && !is_one
        {
            *self = SkinsOf::Three(list.iter().map(|&skin| [skin; 3]).collect());
        }
        match self {
            SkinsOf::Object => {}
            SkinsOf::One(list) => list.push(triple[0]),
            SkinsOf::Three(list) => list.push(triple),
        }
    }

    fn of(&self, face: u32) -> [u32; 3] {
        let face = face as usize;
        match self {
            SkinsOf::Object => NO_TRIPLE,
            SkinsOf::One(list) => list.get(face).map_or(NO_TRIPLE, |&skin| [skin; 3]),
            SkinsOf::Three(list) => list.get(face).copied().unwrap_or(NO_TRIPLE),
        }
    }
}

impl Looks {
    /// The texture coordinates at a place of a triangle with these corners.
    pub(crate) fn uv(&self, face: u32, corners: [u32; 3], weights: [f64; 3]) -> [f64; 2] {
        let triple = match &self.uv_of {
            UvOf::None => return [0.0; 2],
            UvOf::Corners => corners,
            UvOf::Triangles(list) => list[face as usize],
        };
        let mut uv = [0.0; 2];
        for (index, weight) in triple.into_iter().zip(weights) {
            let at = self.uvs[index as usize];
            uv[0] += weight * f64::from(at.x);
            uv[1] += weight * f64::from(at.y);
        }
        uv
    }

    /// The shares of textures at a place of a triangle.
    pub(crate) fn shares(&self, face: u32, weights: impl FnOnce() -> [f64; 3]) -> TextureWeights {
        let triple = self.skins_of.of(face);
        if triple == NO_TRIPLE {
            return TextureWeights::new();
        }
        if triple[0] == triple[1] && triple[1] == triple[2] {
            return TextureWeights::from_slice(&[TextureWeight {
                weight: 1.0,
                skin: triple[0],
            }]);
        }
        let weights = weights().map(|weight| weight.max(0.0));
        let sum: f64 = weights.iter().sum();
        let shares = triple.into_iter().zip(weights);
        shares
            .map(|(skin, weight)| TextureWeight {
                weight: weight / sum,
                skin,
            })
            .collect()
    }

    /// Keeps the triangles of this list.
    pub(crate) fn retain(&mut self, is_kept: &[bool]) {
        if let UvOf::Triangles(list) = &mut self.uv_of {
            retain(list, is_kept);
        }
        match &mut self.skins_of {
            SkinsOf::Object => {}
            SkinsOf::One(list) => retain(list, is_kept),
            SkinsOf::Three(list) => retain(list, is_kept),
        }
    }

    /// Gives back memory that is not needed.
    pub(crate) fn shrink(&mut self) {
        self.uvs.shrink_to_fit();
        if let UvOf::Triangles(list) = &mut self.uv_of {
            list.shrink_to_fit();
        }
        match &mut self.skins_of {
            SkinsOf::Object => {}
            SkinsOf::One(list) => list.shrink_to_fit(),
            SkinsOf::Three(list) => list.shrink_to_fit(),
        }
    }

    /// The memory it takes beside its own size.
    pub(crate) fn bytes(&self) -> usize {
        let uv_of = match &self.uv_of {
            UvOf::None | UvOf::Corners => 0,
            UvOf::Triangles(list) => list.capacity() * size_of::<[u32; 3]>(),
        };
        let skins_of = match &self.skins_of {
            SkinsOf::Object => 0,
            SkinsOf::One(list) => list.capacity() * size_of::<u32>(),
            SkinsOf::Three(list) => list.capacity() * size_of::<[u32; 3]>(),
        };
        uv_of
            + skins_of
            + self.uvs.capacity() * size_of::<Vec2>()
            + self.skins.capacity() * size_of::<FaceTexture>()
    }
}

/// Keeps the items whose flag is set, and those that have none.
pub(crate) fn retain<T>(list: &mut Vec<T>, is_kept: &[bool]) {
    let mut kept = is_kept.iter();
    list.retain(|_| kept.next().copied().unwrap_or(true));
}
