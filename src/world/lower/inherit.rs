//! Inheritance of object attributes: texture, interior, switches, lights, and transforms.

use super::lowering::Lowering;
use super::parts::inherited::{
    CsgRole, Inherited, TransformedTexture, handed_down, joined, obeyed,
};
use crate::base::math::Step;
use crate::scene::shape::{FaceTexture, Geometry, Shape};
use crate::scene::texture::{Layer, Texture};
use crate::scene::{Attached, Object};
use crate::world::index::index;
use crate::world::interiors::InteriorId;
use crate::world::primitive::Absorb;
use crate::world::surface::flags::ObjectFlags;
use crate::world::surface::{ObjectSpaceShape, OwnedOrShared, Surface};
use std::borrow::Cow;
use std::sync::Arc;

impl Lowering {
    /// Same as [`Lowering::inherit`], for a part of a CSG object. Most parts have no attributes of their own: in
    /// intersections and differences they share those of the CSG object.
    pub(crate) fn inherit_part<'h>(
        &mut self,
        object: &Object,
        above: &'h Inherited,
    ) -> Cow<'h, Inherited> {
        let is_known = above.role == CsgRole::Cut
            && above.obeyed.is_some()
            && above.group.is_none()
            && !above.says_uv
            && self.slots.is_none()
            && self.targets.is_none()
            && !above.has_interior_finish();
        match above.interior {
            Some(interior) if is_known && object.is_plain_part() => {
                self.interiors.set_hollow(interior, above.flags.hollow);
                Cow::Borrowed(above)
            }
            _ => Cow::Owned(self.inherit(object, above)),
        }
    }

    /// The attributes of an object's children, or of the object itself if it is a shape.
    pub(crate) fn inherit(&mut self, object: &Object, above: &Inherited) -> Inherited {
        if let Some(slots) = &mut self.slots {
            return Inherited {
                slot: slots.object(object, above),
                steps: joined(&object.steps, &above.steps),
                flags: handed_down(object, above),
                is_moved: above.is_moved || object.moves_parts(),
                ..Inherited::default()
            };
        }
        let attach = |own: Option<&Attached<Arc<Texture>>>,
                      inherited: &Option<TransformedTexture>| match own {
            Some(own) => Some(TransformedTexture {
                texture: Arc::clone(&own.what),
                steps: texture_steps(object, own.after, above),
            }),
            None => inherited.clone(),
        };
        let own = object.texture.as_ref().map(|own| &own.what);
        let inherited = above.texture.as_ref().map(|above| &above.texture);
        let layers = own
            .or(inherited)
            .map_or(&[][..], |texture| texture.layers());
        let finishes = layers.iter().map(|layer| &*layer.finish);
        let interior = self
            .interiors
            .of_object(object.interior.as_ref(), above.interior, finishes);
        self.fill(interior, object, above);
        let mut flags = handed_down(object, above);
        let mut split_target = None;
        if let Some(targets) = &mut self.targets {
            (flags.photons, split_target) = targets.role(object, above);
        }
        self.interiors.set_hollow(interior, flags.hollow);
        let global_lights = object.light_group.map_or(above.global_lights, |group| {
            Some(above.global_lights.unwrap_or(group.global_lights))
        });
        let group = object
            .light_group
            .map(|_| self.lights.group(global_lights.unwrap_or(true)));
        Inherited {
            lights: group.unwrap_or(above.lights),
            global_lights,
            group,
            texture: attach(object.texture.as_ref(), &above.texture),
            inside_texture: attach(object.interior_texture(), &above.inside_texture),
            interior: Some(interior),
            flags,
            obeyed: obeyed(&flags, above),
            role: CsgRole::Alone,
            says_uv: object.flags.uv_mapping,
            split_target,
            steps: joined(&object.steps, &above.steps),
            is_moved: above.is_moved || object.moves_parts(),
            cutaway: above.cutaway.clone(),
            slot: 0,
        }
    }

    /// Prepares the media of an object's interior.
    fn fill(&mut self, interior: InteriorId, object: &Object, above: &Inherited) {
        match &object.interior {
            Some(own) if !own.media.is_empty() => {
                let steps = joined(&object.steps, &above.steps);
                let media = own.media.iter();
                let media = media.map(|media| media.prepare(&steps, &self.settings));
                self.interiors.fill(interior, media.collect());
            }
            Some(_) => {}
            None => self.interiors.inherit_media(above.interior, interior),
        }
    }

    /// The surface index for a shape with these attributes, and whether the shape may absorb its transforms.
    pub(crate) fn surface_of(&mut self, shape: &Shape, attributes: &Inherited) -> (u32, Absorb) {
        let loses_uv = shape.loses_uv() && !attributes.steps.is_empty();
        if let Some(slots) = &mut self.slots {
            let absorb = if loses_uv && self.keeps_uv {
                Absorb::Nothing
            } else {
                Absorb::AllItCan
            };
            return (slots.shape(attributes, shape.face_textures()), absorb);
        }
        let moves_face_textures = attributes.says_uv && shape.moves_face_textures();
        let moved = moves_face_textures.then(|| Inherited {
            says_uv: false,
            ..attributes.clone()
        });
        let attributes = moved.as_ref().unwrap_or(attributes);
        if let Some(last) = self.same_as_last(shape, attributes) {
            return (last, Absorb::AllItCan);
        }
        let mut surface = self.new_surface(attributes, shape.face_textures());
        if loses_uv && surface.uses_uv() {
            surface.set_unmoved(ObjectSpaceShape::new(shape, &attributes.steps));
        }
        let number = self.number_of(surface);
        self.last_attributes = Some((number, attributes.clone()));
        (number, Absorb::AllItCan)
    }

    /// The last surface, if it fits a shape with these attributes: often the case for the parts of a CSG object.
    fn same_as_last(&self, shape: &Shape, attributes: &Inherited) -> Option<u32> {
        let (number, last) = self.last_attributes.as_ref()?;
        let surface = &self.surfaces[*number as usize];
        let is_same = self.last_surface == Some(*number)
            && shape.face_textures().is_empty()
            && surface.face_textures().is_empty()
            && attributes.cutaway.is_none()
            && !surface.uses_uv()
            && attributes.is_same_material(last, surface.hides_interior());
        is_same.then_some(*number)
    }

    /// The index of a surface, new or that of the last one: neighbours in the file are often the same.
    pub(crate) fn number_of(&mut self, surface: Surface) -> u32 {
        if let Some(last) = self
            .last_surface
            .filter(|&last| self.surfaces[last as usize].is_same(&surface))
        {
            return last;
        }
        let number = index(self.surfaces.len());
        self.surfaces.push(surface);
        self.last_surface = Some(number);
        number
    }

    /// A surface with these attributes.
    pub(crate) fn new_surface(&mut self, attributes: &Inherited, skins: &[FaceTexture]) -> Surface {
        let texture = match &attributes.texture {
            Some(transformed) => self.prepare(transformed),
            None => {
                let fresh = || Texture::from(Layer::default()).prepare(&[], &self.settings);
                let plain = self.plain.get_or_insert_with(|| Arc::new(fresh()));
                OwnedOrShared::Shared(Arc::clone(plain))
            }
        };
        let inside_texture = attributes
            .inside_texture
            .as_ref()
            .map(|transformed| self.prepare(transformed).shared());
        let skin = |skin: &FaceTexture| {
            let steps = if attributes.says_uv {
                Arc::default()
            } else {
                Arc::clone(&attributes.steps)
            };
            let texture = Arc::clone(&skin.0);
            self.prepare(&TransformedTexture { texture, steps })
                .shared()
        };
        let lent = attributes.cutaway.as_ref();
        let lent = lent.filter(|_| attributes.texture.is_none() && skins.is_empty());
        let skins = match lent {
            Some(cutaway) => cutaway.textures().iter().cloned().collect(),
            None => skins.iter().map(skin).collect(),
        };
        let interior = attributes.interior.unwrap_or(InteriorId::NONE);
        let flags = attributes
            .obeyed
            .as_ref()
            .map_or(attributes.flags, |obeyed| ObjectFlags {
                no_shadow: obeyed.no_shadow,
                no_image: obeyed.no_image,
                no_reflection: obeyed.no_reflection,
                no_radiosity: obeyed.no_radiosity,
                ..attributes.flags
            });
        let lights = attributes.lights;
        let mut surface = Surface::new(texture, inside_texture, skins, interior, lights, flags);
        if let Some(cutaway) = lent {
            surface.set_cutaway(Arc::clone(cutaway));
        }
        surface
    }

    /// Prepares a texture for points in world space. One without patterns is prepared once and shared.
    pub(crate) fn prepare(&mut self, transformed: &TransformedTexture) -> OwnedOrShared {
        if transformed.texture.depends_on_position() {
            return OwnedOrShared::Own(
                transformed
                    .texture
                    .prepare(&transformed.steps, &self.settings),
            );
        }
        // Two references, by the object and by what it hands down; more if the texture is shared.
        if Arc::strong_count(&transformed.texture) <= 2 {
            return OwnedOrShared::Own(transformed.texture.prepare(&[], &self.settings));
        }
        let key = Arc::as_ptr(&transformed.texture).addr();
        if let Some((_, known)) = self.prepared.get(&key) {
            return OwnedOrShared::Shared(Arc::clone(known));
        }
        let fresh = Arc::new(transformed.texture.prepare(&[], &self.settings));
        let entry = (Arc::clone(&transformed.texture), Arc::clone(&fresh));
        self.prepared.insert(key, entry);
        self.lately_prepared.push(key);
        OwnedOrShared::Shared(fresh)
    }
}

/// The transforms of a texture that was attached to an object after its first `after` steps. Texture coordinates do not
/// move: the transforms of an object that says `uv_mapping` itself do not apply to its texture. Those of its ancestors
/// do (checked with POV-Ray, which hands `uv_mapping` to the parts when the whole is complete).
pub(crate) fn texture_steps(object: &Object, after: usize, above: &Inherited) -> Arc<[Step]> {
    if object.flags.uv_mapping {
        return Arc::default();
    }
    joined(&object.steps[after..], &above.steps)
}
