//! Textures that the cut parts of CSG objects take from the objects they cut (`cutaway_textures`).

use crate::scene::pattern::Solid;
use crate::scene::shape::{TextureWeight, TextureWeights};
use crate::scene::texture::PreparedTexture;
use crate::world::index::index;
use glam::DVec3;
use std::sync::Arc;

/// Objects that may lend their textures to the surfaces of a CSG object.
#[derive(Debug, Default)]
pub(crate) struct Cutaway {
    /// Parents before children.
    pub(crate) parts: Vec<CutPart>,
    pub(crate) textures: Vec<Arc<PreparedTexture>>,
}

#[derive(Debug)]
pub(crate) struct CutPart {
    pub(crate) solid: Arc<dyn Solid>,
    /// Its texture; `None` for a CSG object.
    pub(crate) texture: Option<u32>,
    /// Index of the next part outside it.
    pub(crate) end: usize,
}

impl Cutaway {
    /// All textures.
    pub(crate) fn textures(&self) -> &[Arc<PreparedTexture>] {
        &self.textures
    }

    /// The weights of the textures at a world point.
    pub(crate) fn texture_weights(&self, point: DVec3) -> TextureWeights {
        let mut shares = TextureWeights::new();
        let mut at = 0;
        while let Some(part) = self.parts.get(at) {
            if !part.solid.contains(point) {
                at = part.end;
                continue;
            }
            at += 1;
            let share = |skin| TextureWeight {
                weight: 1.0,
                texture: skin,
            };
            shares.extend(part.texture.map(share));
        }
        let count = f64::from(index(shares.len()));
        for share in &mut shares {
            share.weight /= count;
        }
        shares
    }
}
