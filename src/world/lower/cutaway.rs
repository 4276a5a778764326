//! `cutaway_textures`: parts without a texture of their own look like what they cut.
//!
//! Measured with POV-Ray 3.7: the textures are gathered in the outermost combination around the part that is no union.
//! Every child that holds the point gives its texture, all with the same weight; combinations give those of their
//! children. A difference gives that of its first child alone. What clips a child does not count, but what clips its parts
//! does. Where nothing is gathered the surface is black and opaque.
//!
//! Missing: the textures of single components of a blob or triangles of a mesh that a difference cuts.

use super::flatten::{Lowering, index};
use super::inherit::{Inherited, PlacedTexture, joined, texture_steps};
use crate::scene::shape::{TextureWeight, TextureWeights};
use crate::scene::texture::PreparedTexture;
use crate::scene::{Kind, Object, Operation};
use crate::world::compiled::World;
use crate::world::query::probe::compiled;
use glam::DVec3;
use std::sync::Arc;

/// What may lend its texture to the surfaces of a combination.
#[derive(Debug, Default)]
pub(crate) struct Cutaway {
    /// Parents before children.
    parts: Vec<CutPart>,
    textures: Vec<Arc<PreparedTexture>>,
}

#[derive(Debug)]
struct CutPart {
    solid: World,
    /// Its texture, unless it is a combination.
    texture: Option<u32>,
    /// Where the parts that are not in it go on.
    end: usize,
}

impl Cutaway {
    /// All textures.
    pub(crate) fn textures(&self) -> &[Arc<PreparedTexture>] {
        &self.textures
    }

    /// The shares of the textures at a world point.
    pub(crate) fn shares(&self, point: DVec3) -> TextureWeights {
        let mut shares = TextureWeights::new();
        let mut at = 0;
        while let Some(part) = self.parts.get(at) {
            if !part.solid.holds(point) {
                at = part.end;
                continue;
            }
            at += 1;
            let share = |skin| TextureWeight { weight: 1.0, skin };
            shares.extend(part.texture.map(share));
        }
        let count = f64::from(index(shares.len()));
        for share in &mut shares {
            share.weight /= count;
        }
        shares
    }
}

impl Lowering {
    /// What lends its texture to the parts of a combination, which is inverse or not, with what is handed down to them.
    pub(crate) fn cutaway(
        &mut self,
        combination: &Object,
        is_inverse: bool,
        below: &Inherited,
    ) -> Cutaway {
        let mut cutaway = Cutaway::default();
        self.gather(combination, is_inverse, below, &mut cutaway);
        cutaway
    }

    fn gather(&mut self, around: &Object, is_inverse: bool, above: &Inherited, into: &mut Cutaway) {
        let Kind::Csg {
            operation,
            children,
        } = &around.kind
        else {
            return;
        };
        let is_difference = *operation == Operation::Difference && !is_inverse;
        let counted = if is_difference { 1 } else { children.len() };
        for (at, child) in children.iter().enumerate().take(counted) {
            let is_cut = *operation == Operation::Difference && at > 0;
            let is_inverse = child.is_inverse != (is_inverse != is_cut);
            let below = Inherited {
                texture: match &child.texture {
                    Some(own) => Some(PlacedTexture {
                        texture: Arc::clone(&own.what),
                        steps: texture_steps(child, own.after, above),
                    }),
                    None => above.texture.clone(),
                },
                steps: joined(&child.steps, &above.steps),
                ..Inherited::default()
            };
            let first = into.parts.len();
            let texture = match (&child.kind, &below.texture) {
                (Kind::Shape(_), Some(placed)) => {
                    into.textures.push(self.prepare(placed).shared());
                    Some(index(into.textures.len() - 1))
                }
                (Kind::Csg { .. }, _) => None,
                _ => continue,
            };
            let solid = compiled(&Arc::new(child.as_solid(is_inverse, &above.steps)));
            into.parts.push(CutPart {
                solid,
                texture,
                end: first,
            });
            self.gather(child, is_inverse, &below, into);
            if texture.is_none() && into.parts.len() == first + 1 {
                into.parts.pop();
                continue;
            }
            into.parts[first].end = into.parts.len();
        }
    }
}
