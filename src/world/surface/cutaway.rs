//! `cutaway_textures`: textures of untextured CSG operands, mixed from the other operands that contain the point.

use crate::scene::pattern::Solid;
use crate::scene::shape::{TextureWeight, TextureWeights};
use crate::scene::texture::PreparedTexture;
use crate::world::index::index;
use glam::DVec3;
use std::sync::Arc;

/// Textures of the operands of a CSG object that may apply to its untextured surfaces.
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
        let mut weights = TextureWeights::new();
        let mut at = 0;
        while let Some(part) = self.parts.get(at) {
            if !part.solid.contains(point) {
                at = part.end;
                continue;
            }
            at += 1;
            let share = |texture| TextureWeight {
                weight: 1.0,
                texture,
            };
            weights.extend(part.texture.map(share));
        }
        let count = f64::from(index(weights.len()));
        for share in &mut weights {
            share.weight /= count;
        }
        weights
    }
}
