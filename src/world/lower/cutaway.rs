//! `cutaway_textures`: parts without a texture of their own take the textures of the objects they cut.
//!
//! Measured with POV-Ray 3.7: textures are collected in the outermost CSG object around the part that is not a union.
//! Every child that contains the point contributes its texture, all with the same weight; CSG children contribute those
//! of their children. A difference contributes that of its first child only. Objects that clip a child do not count,
//! but those that clip its parts do. Where nothing contributes, the surface is black and opaque.
//!
//! Missing: textures of single blob components or mesh triangles that a difference cuts.

use super::inherit::texture_steps;
use super::lowering::Lowering;
use super::parts::inherited::{Inherited, TransformedTexture, joined};
use crate::scene::{Kind, Object, Operation};
use crate::world::index::index;
use crate::world::lower::probe::solid;
use crate::world::surface::cutaway::{CutPart, Cutaway};
use std::sync::Arc;

impl Lowering {
    /// The texture sources for the parts of a CSG object, inverse or not; `below` is what its parts inherit.
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
                    Some(own) => Some(TransformedTexture {
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
                (Kind::Shape(_), Some(transformed)) => {
                    into.textures.push(self.prepare(transformed).shared());
                    Some(index(into.textures.len() - 1))
                }
                (Kind::Csg { .. }, _) => None,
                _ => continue,
            };
            let solid = solid(&Arc::new(child.as_solid(is_inverse, &above.steps)));
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
